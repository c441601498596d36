"""The numbers behind a figure as text."""

import csv
import math

import numpy as np
import pytest

from kacsim import store
from kacsim.report import csv_table

xr = pytest.importorskip("xarray")


@pytest.fixture
def dataset():
    names = np.array(["bird", "poisson"], dtype=object)
    return xr.Dataset(
        {
            "tvn": store.described([[0.1, 1e-300], [np.nan, np.inf]], ("name", "time"), "TVN"),
            "error": store.described([[0.5, 0.25], [0.0, 1.0]], ("name", "time"), "error"),
            "density": store.described([1, 2], ("bin",), "density", "1/m"),
            "said": store.described(np.array(["a, b", 'c "d"'], dtype=object), ("row",), "words"),
            "floor": store.described(0.1 + 0.2, (), "floor"),
        },
        coords={
            "name": store.described(names, ("name",), "name"),
            "time": store.described([0.5, 1.0], ("time",), "time", "s"),
            "edge": store.described([0.0, 0.1, 0.2], ("edge",), "edges"),
        },
    )


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_places_errors_and_units_stand_beside_values(dataset, tmp_path):
    csv_table.write(dataset, tmp_path / "a.csv", "{}")
    rows = [row for row in read(tmp_path / "a.csv") if row["tvn [1]"]]
    found = [(r["name"], r["time [s]"], float(r["tvn [1]"]), r["error [1]"]) for r in rows]
    assert found[:2] == [("bird", "0.5", 0.1, "0.5"), ("bird", "1.0", 1e-300, "0.25")]
    assert math.isnan(found[2][2])
    assert found[3] == ("poisson", "1.0", math.inf, "1.0")
    assert all(row["floor [1]"] == row["density [1/m]"] == "" for row in rows)


def test_bins_stand_between_their_edges(dataset, tmp_path):
    csv_table.write(dataset, tmp_path / "a.csv", "{}")
    rows = [row for row in read(tmp_path / "a.csv") if row["density [1/m]"]]
    found = [(r["bin_from [1]"], r["bin_to [1]"], r["density [1/m]"]) for r in rows]
    assert found == [("0.0", "0.1", "1"), ("0.1", "0.2", "2")]


def test_places_without_a_coordinate_are_counted_and_words_are_quoted(dataset, tmp_path):
    csv_table.write(dataset, tmp_path / "a.csv", "{}")
    rows = [row for row in read(tmp_path / "a.csv") if row["said"]]
    assert [(r["row"], r["said"]) for r in rows] == [("0", "a, b"), ("1", 'c "d"')]


def test_every_number_comes_back_and_none_is_lost(dataset, tmp_path):
    csv_table.write(dataset, tmp_path / "a.csv", "{}")
    rows = read(tmp_path / "a.csv")
    assert len(rows) == 4 + 2 + 2 + 1
    assert [float(r["floor [1]"]) for r in rows if r["floor [1]"]] == [0.1 + 0.2]


def test_the_same_dataset_gives_the_same_bytes(dataset, tmp_path):
    for name in ("a.csv", "b.csv"):
        csv_table.write(dataset, tmp_path / name, "{}")
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()
    assert b"\r" not in (tmp_path / "a.csv").read_bytes()
