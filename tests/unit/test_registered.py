"""Sets written down before a run, and what a report says of those that have changed."""

import numpy as np
import pytest
import xarray as xr

from kacsim import cli, store
from kacsim.kernels import provenance
from kacsim.report import registered

NAN, INF = np.nan, np.inf


def table(**changed):
    """Return a table of three rows, of which one has two components and one has none."""
    columns = {
        "claim": ("row", ["first", "second", "third"]),
        "rule": ("row", ["digits", "implied", "untestable"]),
        "of": ("part", ["first", "second", "second"]),
        "label": ("part", ["", "N = 2", "N = 3"]),
        "allowed_low": ("part", [0.1, 0.99, 1.98]),
        "allowed_high": ("part", [INF, 1.01, 2.02]),
        "right_low": ("part", [NAN, NAN, 2.475]),
        "right_high": ("part", [NAN, NAN, 2.525]),
        "n_intervals": ((), 3),
    }
    return xr.Dataset(columns | changed)


def test_sets_are_by_text_row_and_component():
    found = registered.sets({"kac_numbers": table(), "kac_fig1": xr.Dataset()})
    assert found == {
        "intervals": {"kac": 3},
        "rows": {
            "first": {"rule": "digits", "sets": {"": [0.1, INF]}},
            "second": {
                "rule": "implied",
                "sets": {"N = 2": [0.99, 1.01], "N = 3": [1.98, 2.02, 2.475, 2.525]},
            },
            "third": {"rule": "untestable", "sets": {}},
        },
    }


def test_a_written_file_is_read_as_it_was(tmp_path):
    path = tmp_path / "registered.yaml"
    assert registered.read(path) is None
    registered.write({"kac_numbers": table()}, "0123abc", path)
    known = registered.read(path)
    assert known["commit"] == "0123abc"
    assert registered.changes({"kac_numbers": table()}, known) == []


def test_every_change_is_named(tmp_path):
    path = tmp_path / "registered.yaml"
    registered.write({"kac_numbers": table()}, "0123abc", path)
    now = table(
        claim=("row", ["first", "second", "fourth"]),
        rule=("row", ["words", "implied", "never"]),
        allowed_low=("part", [0.1, 0.98, 1.98]),
        n_intervals=((), 4),
    )
    assert registered.changes({"kac_numbers": now}, registered.read(path)) == [
        "kac: 4 intervals, registered 3",
        "first: rule words, registered digits",
        "second (N = 2): 0.98 to 1.01, registered 0.99 to 1.01",
        "fourth: new",
        "third: left out",
    ]


@pytest.mark.parametrize("commit", ["unknown", "0123abc+changes"])
def test_sets_are_those_of_a_clean_checkout(monkeypatch, capsys, commit):
    monkeypatch.setattr(provenance, "commit", lambda: commit)
    monkeypatch.setattr(registered, "write", lambda *words: pytest.fail("written"))
    assert cli.main(["register"]) != 0
    assert f"commit = '{commit}': must be that of a clean checkout\n" in capsys.readouterr().err


def test_register_writes_the_sets_of_every_table(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(provenance, "commit", lambda: "0123abc")
    monkeypatch.setattr(registered, "PATH", tmp_path / "registered.yaml")
    assert cli.main(["register", "--datasets", str(tmp_path)]) != 0
    assert "holds no *_numbers.nc" in capsys.readouterr().err
    store.write(table(), tmp_path / "kac_numbers.nc", title="t", settings={})
    assert not cli.main(["register", "--datasets", str(tmp_path)])
    assert registered.read(tmp_path / "registered.yaml")["intervals"] == {"kac": 3}
