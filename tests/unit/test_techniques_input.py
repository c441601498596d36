"""Wrong input of the chapter's tools: refused by name, before any work; same seed, same bits.

No statistics, no false alarms.
"""

import math
import os

import numpy as np
import pytest
from scipy import special

from kacsim import cli, techniques
from kacsim.kernels.provenance import ROOT

SIZE = {"n_draws": 50, "seed": 1}
VELOCITIES = [[1.0, 0.2, 0.0], [-0.5, 1.0, 0.3], [0.4, -0.7, 2.0]]
GOOD = {
    "tabulate": ((special.ndtr, -5.0, 5.0, 7), {}),
    "draw_from_table": (([0.0, 0.3, 1.0],), SIZE),
    "draw_by_inversion": (("exponential",), SIZE | {"rate": 2.5}),
    "draw_by_rejection": ((lambda v: 2 * v, lambda v: 2.0 + 0 * v, lambda u: u), SIZE),
    "inject": (
        (),
        {
            "density": 2.0,
            "temperature": 1.7,
            "drift": [0.3, 0.0, -0.2],
            "half_width": [1.0, 1.5, 0.7],
            "step": 0.1,
            "n_steps": 20,
            "seed": 1,
        },
    ),
    "inject_particles": ((VELOCITIES,), SIZE | {"normal": [1.0, 0, 0], "weights": [1, 2, 3]}),
    "integrate": ((np.cos, 0.0, 1.0), {"n_points": 50, "seed": 1}),
    "lattice_count": ((3, 7), {}),
    "sphere_volume": ((3, 500), {"seed": 1}),
}


def fails_upward(v):
    return np.sin(2.0 * v)


# function, place or name of the argument, wrong value, what the message begins with and holds
WRONG = [
    ("tabulate", 0, fails_upward, "cumulative = ", "must never fall"),
    ("tabulate", 0, lambda v: -v, "cumulative = ", "must never fall"),
    ("tabulate", 0, lambda v: 0.0 * v, "cumulative = ", "must rise"),
    ("tabulate", 0, lambda v: v * math.nan, "cumulative = ", "finite number"),
    ("tabulate", 0, lambda v: 0.5, "cumulative = ", "one finite number per value"),
    ("tabulate", 1, 5.0, "high = 5.0", "greater than low"),
    ("tabulate", 2, math.inf, "high = inf", "finite number"),
    ("tabulate", 3, 0, "n_table = 0", "at least 1"),
    ("tabulate", 3, 2.5, "n_table = 2.5", "integer"),
    ("draw_from_table", 0, [0.0, 2.0, 1.0], "table = ", "must never fall"),
    ("draw_from_table", 0, [0.0], "table = ", "two or more"),
    ("draw_from_table", 0, [0.0, math.nan], "table = ", "finite"),
    ("draw_from_table", "n_draws", 0, "n_draws = 0", "at least 1"),
    ("draw_by_inversion", 0, "kac_initial", "law = 'kac_initial'", "one of exponential"),
    ("draw_by_inversion", "rate", 0.0, "rate = 0.0", "positive"),
    ("draw_by_inversion", "seed", -1, "seed = -1", "at least 0"),
    ("draw_by_rejection", 1, lambda v: 1.5 + 0 * v, "envelope = ", "must not be below"),
    ("draw_by_rejection", 0, lambda v: v - 0.5, "density = ", "zero or positive"),
    ("draw_by_rejection", 0, lambda v: 0 * v, "density = ", "positive where"),
    ("draw_by_rejection", "n_draws", -3, "n_draws = -3", "at least 1"),
    ("inject", "density", 0.0, "density = 0.0", "positive"),
    ("inject", "temperature", -1.0, "temperature = -1.0", "positive"),
    ("inject", "drift", [0.0, 1.0], "drift = [0.0, 1.0]", "three numbers"),
    ("inject", "drift", [0.0, 1.0, math.nan], "drift = nan", "finite"),
    ("inject", "half_width", [1.0, 0.0, 1.0], "half_width = 0.0", "positive"),
    ("inject", "step", math.inf, "step = inf", "positive"),
    ("inject", "n_steps", 0, "n_steps = 0", "at least 1"),
    ("inject_particles", "weights", [1.0, -2.0, 3.0], "weights[1] = -2.0", "zero or positive"),
    ("inject_particles", "weights", [1.0, 2.0], "weights: ", "one per particle"),
    ("inject_particles", "weights", [0.0, 5.0, 0.0], "velocities: ", "must have a flux"),
    ("inject_particles", "normal", [0.0, 0.0, 0.0], "normal = ", "not all zero"),
    ("inject_particles", 0, [[-1.0, 0.0, 0.0]] * 3, "velocities: ", "must have a flux"),
    ("inject_particles", 0, [[1.0, 0.0]] * 3, "velocities: ", "three finite numbers"),
    ("integrate", 0, lambda v: v / 0.0, "function = ", "finite number"),
    ("integrate", 2, -1.0, "high = -1.0", "greater than low"),
    ("integrate", "n_points", 1, "n_points = 1", "at least 2"),
    ("lattice_count", 0, 9, "dimension = 9", "from 1 to 8"),
    ("lattice_count", 1, 0, "edge = 0", "from 1 to 400"),
    ("sphere_volume", 0, 0, "dimension = 0", "from 1 to 8"),
    ("sphere_volume", 1, 0, "n_points = 0", "at least 1"),
]


@pytest.mark.parametrize("name", GOOD)
def test_good_arguments_give_the_same_bits(name):
    positional, named = GOOD[name]
    answers = [getattr(techniques, name)(*positional, **named) for _ in range(2)]
    for a, b in zip(*(x if isinstance(x, tuple) else (x,) for x in answers), strict=True):
        np.testing.assert_array_equal(a, b)
    if "seed" in named:
        other = getattr(techniques, name)(*positional, **(named | {"seed": 2}))
        assert str(other) != str(answers[0])


def label(value):
    """Return a name that is the same in every process: no address of a function."""
    return value.__name__ if callable(value) else str(value)


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize(("name", "place", "value", "begins", "allowed"), WRONG, ids=label)
def test_refused_by_name(name, place, value, begins, allowed):
    positional, named = GOOD[name]
    if isinstance(place, int):
        positional = (*positional[:place], value, *positional[place + 1 :])
    else:
        named = named | {place: value}
    with pytest.raises(ValueError, match=r"\A[^\n]+\Z") as error:
        getattr(techniques, name)(*positional, **named)
    assert str(error.value).startswith(begins)
    assert allowed in str(error.value)


def test_a_lattice_beyond_64_bits_is_refused():
    with pytest.raises(ValueError, match=r"edge = 400: edge\*\*dimension must be below"):
        techniques.lattice_count(8, 400)


def run(capsys, *words):
    assert cli.main([str(word) for word in words]) == 2
    output = capsys.readouterr()
    assert output.out == ""
    return output.err.splitlines()


GAS = "--density 1.0 --temperature 1.0 --drift 0.1 0.0 0.0 --half-width 1.0 1.0 1.0 --step 0.1"
SAMPLES = [
    ("inverse_transform --law gauss --n-table 4", "--law", "one of kac_initial"),
    ("inverse_transform --law ramp --n-table 0", "--n-table", "at least 1"),
    ("inverse_transform --law ramp --n-table 4 many", "--n-table", "integer"),
    ("inversion --law kac_initial --rate 1.0", "--law", "one of exponential"),
    ("inversion --law ramp --rate -1.0", "--rate", "positive"),
    ("rejection --law ramp --envelope closer", "--envelope", "only kac_initial"),
    (f"injection {GAS} --density=-1.0", "--density", "positive"),
    (f"outer_gas {GAS} --half-width 1.0 1.0", "--half-width", "three numbers"),
    (f"injection {GAS} --drift 0.0 0.0 nan", "--drift", "finite"),
    (
        "weighted_particles --n-representatives 0 --temperature 1.0 --drift 0.0 0.0 0.0",
        "--n-representatives",
        "at least 1",
    ),
    ("sphere_lattice --dimension 9 --edge 3", "--dimension", "from 1 to 8"),
    ("sphere_points --generator worse --dimension 2 --n-points 3", "--generator", "one of good"),
    ("sphere_points --generator good --dimension 2 --n-points 3 3", "--n-points", "must grow"),
    ("area --exponent=-0.3 --n-points 5", "--exponent", "at least 0"),
    ("identity --n-draws 0", "--n-draws", "at least 1"),
]


@pytest.mark.parametrize(("words", "flag", "allowed"), SAMPLES, ids=lambda v: str(v)[:40])
def test_wrong_sample(words, flag, allowed, tmp_path, capsys):
    size = "" if "--n-draws" in words else "--n-draws 10"
    words = f"{words} {size} --seed 1".split()
    (line,) = run(capsys, "sample", *words, "--output", tmp_path / "new" / "a.nc")
    assert line.startswith(f"{flag} = ")
    assert allowed in line
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize(
    ("content", "key", "allowed"),
    [
        ("techniques_fig1: {n_table: [4, 0]}", "techniques_fig1.n_table[1] = 0", "at least 1"),
        ("techniques_fig3: {drift: [0.0, 1.0]}", "techniques_fig3.drift", "at least 3"),
        ("techniques_fig3: {half_width: [1.0, 1.0, 0.0]}", "half_width[2] = 0.0", "greater than 0"),
        ("techniques_fig4: {dimension: [1, 2]}", "techniques_fig4.dimension[0] = 1", "at least 2"),
        ("techniques_fig4: {fit_from_edge: 100}", "fit_from_edge = 100", "largest_edge"),
        ("techniques_fig4: {first_power: 17}", "first_power = 17", "last_power"),
        ("techniques_exercises: {n_points: [9, 5]}", "n_points = [9, 5]", "must grow"),
    ],
)
def test_wrong_configuration(content, key, allowed, tmp_path, capsys):
    path = tmp_path / "wrong.yaml"
    path.write_text(content)
    lines = run(capsys, "plan", "--config", ROOT / "config/config.yaml", path)
    assert any(key in line and allowed in line for line in lines), lines
