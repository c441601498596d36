"""The kept report: what is copied, what is refused, and what is said of it later."""

import json
from types import SimpleNamespace

import pytest

from kacsim import cli, files, plan, store
from kacsim.cases import tiny_cases
from kacsim.kernels import provenance, sources
from kacsim.report import kept

CASES = {case.id: case for case in tiny_cases()}
HTML = '<a href="../datasets/kac_fig4.nc">dataset</a> <a href="#here">here</a>'


@pytest.fixture
def results(tmp_path):
    """Return the results of a made-up full run of one item, and its plan."""
    pytest.importorskip("xarray")
    folder = tmp_path / "results"
    settings = {"kac_fig4": {"seed": 1, "n_draws": 10, "time": 2.0}}
    variables = {"tvn": store.described([0.1], ("row",), "TVN")}
    for name, one in settings.items():
        path = folder / "datasets" / f"{name}.nc"
        store.write(variables, path, title="t", settings=one)
    for case in CASES.values():
        path = tmp_path / case.compiled()
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(sources.code(case.roots) + "\n")
    (folder / "report").mkdir()
    (folder / "report/report.html").write_text(HTML, encoding="utf-8")
    return folder, SimpleNamespace(settings=settings, cases=CASES)


def test_a_kept_report_stands_alone_and_knows_what_made_it(results, tmp_path):
    folder, full = results
    assert "kept" in kept.keep(folder, full, tmp_path / "latest")
    html = (tmp_path / "latest/report.html").read_text(encoding="utf-8")
    assert html == 'dataset <a href="#here">here</a>'
    facts = json.loads((tmp_path / "latest/kept.json").read_text(encoding="utf-8"))
    assert facts["configuration"] == full.settings
    assert provenance.commit() in facts["sources"][0]
    assert set(facts["kernels"]) == {case.unit for case in tiny_cases()}


def test_a_run_with_other_settings_is_not_kept(results, tmp_path):
    folder, full = results
    full.settings["kac_fig4"] = full.settings["kac_fig4"] | {"n_draws": 1000}
    with pytest.raises(files.StoreError, match="only a full run is kept"):
        kept.keep(folder, full, tmp_path / "latest")
    assert not (tmp_path / "latest").exists()


def test_a_report_that_is_too_large_is_not_kept(results, tmp_path):
    folder, full = results
    (folder / "report/report.html").write_text("x" * (kept.LARGEST_REPORT + 1), encoding="utf-8")
    with pytest.raises(files.StoreError, match=f"at most {kept.LARGEST_REPORT}"):
        kept.keep(folder, full, tmp_path / "latest")


def test_changed_kernels_are_named(results, tmp_path):
    folder, full = results
    assert "no report is kept yet" in kept.sentence(tmp_path / "latest")
    kept.keep(folder, full, tmp_path / "latest")
    assert kept.sentence(tmp_path / "latest").endswith(
        "no kernel has changed since the kept report"
    )
    bird = next(case for case in tiny_cases() if case.kernel_module == "kacsim.kac.bird")
    (tmp_path / bird.compiled()).write_text("0123456789abcdef\n")
    kept.keep(folder, full, tmp_path / "latest")
    assert kept.sentence(tmp_path / "latest").endswith(f"since the kept report: {bird.unit}")


def test_the_kept_report_of_this_checkout_is_small_enough():
    folder = provenance.ROOT / "reports/latest"
    assert (folder / kept.REPORT).stat().st_size <= kept.LARGEST_REPORT
    assert {"sources", "kernels", "configuration"} <= set(
        json.loads((folder / kept.FACTS).read_text())
    )


def test_the_commands(results, tmp_path, capsys):
    folder, _ = results
    config = str(plan.ROOT / "config/config.yaml")
    words = ["--results", str(folder), "--config", config, "--folder", str(tmp_path / "latest")]
    assert cli.main(["keep", *words]) == 2  # the made-up run has not all items
    assert "kac_fig1.nc: not a readable result file" in capsys.readouterr().err
    assert cli.main(["kept", "--folder", str(tmp_path / "latest")]) == 0
    assert "no report is kept yet" in capsys.readouterr().out
