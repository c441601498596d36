"""The numbers behind a figure's marks: those that were drawn, at their places, with their ids."""

import json

import numpy as np
import pytest
import xarray

from kacsim.drawing import marks, plotting, series

NAN = float("nan")


@pytest.fixture
def figure():
    drawn, (left, right) = plotting.panels(1, 2)
    x, y = np.array([1.0, 10.0, 100.0]), np.array([2.0, 1.23456789, NAN])
    plotting.points(left, x, y, [0.1, 0.2, 0.3], 0, "$N$ = 5")
    left.errorbar(x, y, yerr=[[0.1, 0.1, 0.1], [0.3, 0.3, 0.3]], label="$\\lambda_1 t^{2}$")
    left.axhline(1.0, label="a level")
    left.plot([1.0, 100.0], [1.0, 3.0], label="_child1")
    left.plot([1.0], [3.0], "o", label="alone")
    left.set_xscale("log")
    left.set_xlabel("number $N$")
    plotting.bars(right, np.linspace(-1.0, 1.0, 21), np.arange(20.0), 1, "bars")
    right.bar([0.0, 0.5], [3.0, 4.0], width=0.2, label="columns")
    right.plot(np.linspace(0.0, 1.0, 4001), np.linspace(0.0, 1.0, 4001) ** 2, label="fine")
    return drawn


def table(figure, tmp_path):
    plotting.save(figure, tmp_path / "a.svg", "recipe")
    marks.write(figure, tmp_path / "a.marks.json", xarray.Dataset(), [])
    return json.loads((tmp_path / "a.marks.json").read_text(encoding="utf-8"))


def test_what_was_drawn(figure, tmp_path):
    left, right = table(figure, tmp_path)["axes"]
    shown = {one["label"]: one for one in left["series"]}
    assert shown["N = 5"]["x"] == [1, 10, 100]
    assert shown["N = 5"]["y"] == [2, 1.23457, None]
    assert shown["N = 5"]["error"] == [0.1, 0.2, None]
    assert shown["λ₁ t²"]["low"] == [1.9, 1.13457, None]
    assert shown["λ₁ t²"]["high"] == [2.3, 1.53457, None]
    assert "a level" not in shown  # it has no place on the axis of x
    assert shown[""]["kind"] == "curve"
    assert shown["alone"]["kind"] == "points"
    assert left["x"]["scale"] == "log"
    assert left["labels"][0] == "number N"
    other = {one["label"]: one for one in right["series"]}
    assert other["bars"]["x"] == {"from": -1, "to": 1, "many": 21}
    assert other["bars"]["y"] == list(range(20))
    assert [one["kind"] for one in right["series"]].count("bars") == 1  # not its filling too
    assert other["columns"]["x"] == pytest.approx([0.0, 0.5])
    assert other["columns"]["y"] == [3, 4]
    assert other["fine"]["x"]["many"] <= marks.MOST


def test_a_place_in_the_file_is_where_the_mark_is(figure, tmp_path):
    """By the panel's box and its scale, as the page finds it."""
    found = table(figure, tmp_path)
    text = (tmp_path / "a.svg").read_text(encoding="utf-8")
    axes = found["axes"][0]
    own = next(one for one in axes["series"] if one["label"] == "N = 5")
    part = text.partition(f'id="{own["id"]}"')[2]
    use = part.partition("<use ")[2].partition("/>")[0]
    x, y = (float(use.partition(f'{name}="')[2].partition('"')[0]) for name in ("x", "y"))
    left, top, width, height = axes["box"]
    at = np.log(own["x"][0] / axes["x"]["from"]) / np.log(axes["x"]["to"] / axes["x"]["from"])
    up = (own["y"][0] - axes["y"]["from"]) / (axes["y"]["to"] - axes["y"]["from"])
    assert x == pytest.approx(left + at * width, abs=0.02)
    assert y == pytest.approx(top + height - up * height, abs=0.02)
    assert found["size"] == pytest.approx([72.0 * inch for inch in figure.get_size_inches()])


def test_ids_are_those_of_the_file(figure, tmp_path):
    ids = [one["id"] for axes in table(figure, tmp_path)["axes"] for one in axes["series"]]
    text = (tmp_path / "a.svg").read_text(encoding="utf-8")
    assert len(set(ids)) == len(ids)
    assert all(f'id="{name}"' in text for name in ids)


def test_panels_in_space_tell_three_coordinates_and_their_place(tmp_path):
    """Points with a name, and lines; what has none, such as a net, is no mark."""
    drawn, (axis,) = plotting.panels(1, 1, projection="3d")
    axis.plot([1.0, 2.0], [3.0, 4.0], [5.0, 7.0], "o", label="points")
    axis.plot([1.0, 2.0], [3.0, 4.0], [5.0, 7.0], label="an arc")
    axis.plot([1.0, 2.0], [3.0, 4.0], [5.0, 7.0])
    axis.set_xlabel("$v_3$")
    axis.set_zlabel("$v_2$")
    (own,) = table(drawn, tmp_path)["axes"]
    assert own["labels"] == ["v₃", "", "v₂"]
    assert [(one["label"], one["kind"]) for one in own["series"]] == [
        ("points", "points"),
        ("an arc", "curve"),
    ]
    for one in own["series"]:
        assert [one[name] for name in "xyz"] == [[1, 2], [3, 4], [5, 7]]
    part = (tmp_path / "a.svg").read_text(encoding="utf-8").partition(own["series"][0]["id"])[2]
    for k in range(2):
        use, part = part.partition("<use ")[2].split("/>", 1)
        x, y = (float(use.partition(f'{name}="')[2].partition('"')[0]) for name in ("x", "y"))
        assert x == pytest.approx(own["series"][0]["left"][k], abs=0.01)
        assert y == pytest.approx(own["series"][0]["top"][k], abs=0.01)


def test_a_mark_names_the_case_that_it_is_from(tmp_path):
    """Said once where all marks of a series have the same, and only of those that have any."""
    values = np.array([[2.0, 3.0], [4.0, 5.0]])
    size = {"n_draws": 1, "n_replicates": 1}
    cases = [(f"draws at {n}", {"n_particles": n} | size) for n in (5, 7, 9)]
    dims = {"n_particles": [7, 5], "time": [1.0, 2.0]}
    dataset = xarray.Dataset({"tvn": (tuple(dims), values)}, dims)
    drawn, (axis,) = plotting.panels(1, 1)
    plotting.points(axis, dims["n_particles"], values[:, 0], [0.1, 0.1], 0, "against N")
    plotting.points(axis, dims["time"], values[1], [0.1, 0.1], 1, "against time")
    axis.plot([1.0, 2.0], [2.0, 4.0], label="exact")
    found = marks.table(drawn, dataset, cases)
    assert found["cases"] == ["draws at 7", "draws at 5"]
    assert [one.get("case") for one in found["axes"][0]["series"]] == [[0, 1], 1, None]


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("$N$ = 5", "N = 5"),
        ("E $v^4$", "E v⁴"),
        ("$\\Delta t = 2^{-3}$", "Δt = 2⁻³"),
        ("$\\Delta t = 2/2^k$", "Δt = 2/2ᵏ"),
        ("$c/c_q$", "c/c_q"),
        ("$\\varepsilon$ = 10$^{-6}$", "ε = 10⁻⁶"),
    ],
)
def test_labels_are_plain(text, wanted):
    assert series.plain(text) == wanted
