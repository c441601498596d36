"""The case behind a mark: found by the value's place in the dataset, or not told."""

import numpy as np
import pytest
import xarray

from kacsim.drawing import origins

ALGORITHMS, NUMBERS = ("bird", "poisson"), (5, 7, 50)
CASES = [
    (f"draws of {a} {n}", {"algorithm": a, "n_particles": n, "n_draws": 30, "n_replicates": 4})
    for a in ALGORITHMS
    for n in NUMBERS
]
VALUES = np.array([[0.5, 0.25, 0.125], [0.3, 0.0, 0.0]])


def dataset(dims=("algorithm", "n_particles"), **others):
    table = {"tvn": (dims, VALUES), "exact": (dims, VALUES + 1.0)} | others
    return xarray.Dataset(table, coords={dims[0]: list(ALGORITHMS), dims[1]: list(NUMBERS)})


def series(y, kind="points", **more):
    x = np.arange(len(y) + 1.0) if kind == "bars" else np.array(NUMBERS[: len(y)], float)
    bars = {"error": np.ones(len(y))} if kind == "points" else {}
    return {"kind": kind, "x": x, "y": np.asarray(y, float)} | bars | more


def test_each_mark_has_the_case_of_its_place():
    assert origins.of_series(series(VALUES[0]), dataset(), CASES) == [0, 1, 2]


def test_a_value_that_stands_twice_is_where_the_others_are():
    assert origins.of_series(series(VALUES[1]), dataset(), CASES) == [3, 4, 5]


def test_no_place_is_guessed():
    """Two equal values, with nothing that tells them apart."""
    several = series([0.0, 0.0], x=np.array([1.0, 2.0]))
    assert origins.of_series(several, dataset(), CASES) == [None, None]


def test_a_value_that_is_none_has_no_case():
    assert origins.of_series(series([0.5, np.nan, 0.125]), dataset(), CASES) == [0, None, 2]


def test_a_table_that_holds_some_of_the_values_is_another():
    some = xarray.Dataset({"first": (("algorithm", "n_particles"), np.fliplr(VALUES) * [1, 1, 0])})
    assert origins.of_series(series(VALUES[0]), some.merge(dataset()), CASES) == [0, 1, 2]


def test_what_was_not_drawn_has_no_case():
    exact = {"kind": "points", "x": np.array(NUMBERS, float), "y": VALUES[0]}
    for one in (exact, exact | {"kind": "curve"}, series(VALUES[0] + 0.01)):
        assert origins.of_series(one, dataset(), CASES) == [None] * 3
    drawn = series(VALUES[0] + 1.0)
    assert origins.of_series(drawn, dataset(), CASES) == [0, 1, 2]  # by its bars it is an estimate


@pytest.mark.parametrize("bounds", [("low", "high"), ("error",)])
def test_bars_of_either_kind_make_an_estimate(bounds):
    one = series(VALUES[0])
    del one["error"]
    one |= {name: np.ones(3) for name in bounds}
    assert origins.of_series(one, dataset(), CASES) == [0, 1, 2]


def test_a_histogram_has_one_case():
    """Its bins are no setting; equal counts stand wherever they like."""
    table = np.array([[0.1, 0.4, 0.1, 0.0], [0.2, 0.4, 0.1, 0.0]])
    own = xarray.Dataset({"density": (("algorithm", "bin"), table)})
    own = own.assign_coords(algorithm=list(ALGORITHMS), edge=("edge", np.arange(5.0)))
    assert origins.of_series(series(table[1], "bars"), own, CASES[2:4]) == [1] * 4
    assert origins.of_series(series(table[1], "bars"), own, CASES) == [None] * 4


@pytest.mark.parametrize("name", ["kind", "n_many"])
def test_a_coordinate_of_another_name_is_told_by_its_values(name):
    dims = (name, "n_particles") if name == "kind" else ("algorithm", name)
    # A time that is one of the numbers: these are not times.
    cases = [(title, own | {"time": 5.0}) for title, own in CASES]
    assert origins.of_series(series(VALUES[0]), dataset(dims), cases) == [0, 1, 2]


def test_a_coordinate_that_may_be_two_settings_tells_nothing():
    cases = [(title, own | {"time": own["n_particles"]}) for title, own in CASES]
    named = dataset(("algorithm", "n_particles"))
    assert origins.of_series(series(VALUES[0]), named, cases) == [0, 1, 2]
    other = dataset(("algorithm", "n_many"))
    assert origins.of_series(series(VALUES[0]), other, cases) == [None] * 3


def test_draws_are_those_of_all_replicates():
    """Cases that differ in their draws alone."""
    cases = [
        ("few", {"n_draws": 25, "n_replicates": 4}),
        ("many", {"n_draws": 100, "n_replicates": 4}),
    ]
    own = xarray.Dataset({"value": ("size", [1.0, 2.0]), "n_draws": ("size", [100, 400])})
    one = series([1.0, 2.0], x=np.array([0.0, 1.0]))
    assert origins.of_series(one, own.assign_coords(size=["few", "many"]), cases) == [0, 1]


def test_a_setting_of_many_values_holds_each():
    """One case, drawn at many speeds and times."""
    cases = [("one", {"speed": [0.5, 1.0], "time": [2.0], "n_draws": 1, "n_replicates": 1})]
    cases += [("other", {"speed": [1.5], "time": [2.0], "n_draws": 1, "n_replicates": 1})]
    own = xarray.Dataset({"value": ("speed", [3.0, 4.0, 5.0])}, {"speed": [0.5, 1.0, 1.5]})
    one = series([3.0, 4.0, 5.0], x=np.array([0.5, 1.0, 1.5]))
    assert origins.of_series(one, own, cases) == [0, 0, 1]
