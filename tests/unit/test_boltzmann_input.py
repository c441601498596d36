"""Wrong input of the branching estimators: refused by name; budgets kept; same seed, same bits.

No statistics, no false alarms.
"""

import math
import os

import numpy as np
import pytest

from kacsim import boltzmann, cli, kac

SIZE = {"n_realizations": 50, "seed": 1}
TREE = {"oversampling": 1.5, "onset": 0.1}
GAS = {"breathing": 0.3, "start_phase": 0.4, "angular_frequency": 0.6, "rms_velocity": 1.7}
# function, good arguments
GOOD = {
    "bkw": (boltzmann.estimate_bkw, {"velocity": 1.0, "time": 0.5, "rms_velocity": 1.7, **TREE}),
    "bkw_fraction": (
        boltzmann.estimate_bkw_fraction,
        {"threshold": 1.0, "time": 0.5, "rms_velocity": 1.7, **TREE},
    ),
    "extinction": (
        boltzmann.estimate_extinction,
        {"time": 0.5, "rate": 2.3, "initial": 0.4, "majorant": 1.6},
    ),
    "trap": (boltzmann.estimate_trap, {"position": 1.0, "velocity": 0.3, "time": 0.5, **GAS}),
    "trap_fraction": (boltzmann.estimate_trap_fraction, {"radius": 1.0, "time": 0.5, **GAS}),
    "kac": (kac.estimate_density, {"v": 1.0, "time": 0.5, "collision_rate": 0.9, **TREE}),
    "kac_tail": (kac.estimate_tail, {"v": 1.0, "time": 0.5, "collision_rate": 0.9, "cut": 0.2}),
}
NOT_POSITIVE = [0.0, -1.7, math.nan, math.inf, "wide", True]
NEGATIVE = [-0.5, math.nan, math.inf, "long", None]
WRONG = {
    "time": NEGATIVE,
    "onset": NEGATIVE,
    "threshold": NEGATIVE,
    "radius": NEGATIVE,
    "velocity": [math.nan, math.inf, [1.0, math.nan, 0.0], [1.0, 2.0], None],
    "position": [math.nan, -math.inf, [1.0, math.nan, 0.0], [[1.0, 2.0, 3.0]]],
    "v": [math.nan, math.inf, "fast", None],
    "rms_velocity": NOT_POSITIVE,
    "collision_rate": NOT_POSITIVE,
    "rate": NOT_POSITIVE,
    "initial": [*NOT_POSITIVE, "equilibrium"],
    "majorant": NOT_POSITIVE,
    "angular_frequency": NOT_POSITIVE,
    "amount": NOT_POSITIVE,
    "cross_section": NOT_POSITIVE,
    "breathing": [-0.1, 1.0, 1.5, math.nan, "deep"],
    "start_phase": [math.nan, math.inf],
    "majorant_factor": NOT_POSITIVE,
    "spread": [0.99, -1.0, math.nan, math.inf],
    "anisotropy": [-1.0, 1.0, 1.5, math.nan],
    "oversampling": [0.99, -1.0, math.nan, math.inf],
    "n_realizations": [1, 0, -3, 2.0, math.inf],
    "seed": [-1, 0.5, None],
    "max_nodes": [0, -1, 1.5],
    "cut": [-0.1, math.nan, math.inf, "deep"],
}
OPTIONAL = {
    "trap": ("initial", "amount", "cross_section", "majorant_factor", "spread", "anisotropy"),
    "trap_fraction": ("initial", "amount", "cross_section"),
}
CASES = [
    (one, name, value)
    for one, (_, good) in GOOD.items()
    for name in (*good, *OPTIONAL.get(one, ()), *SIZE, "max_nodes")
    for value in WRONG[name]
]


def test_every_argument_is_tried():
    assert {name for _, name, _ in CASES} == set(WRONG)


@pytest.mark.parametrize("one", GOOD)
def test_good_arguments_are_accepted(one):
    """Without this the refusals below might have another reason."""
    function, good = GOOD[one]
    answer = function(**good, **SIZE)
    assert math.isfinite(answer.mean)
    assert answer.mean > 0.0
    assert answer.n_realizations == 50


@pytest.mark.parametrize(("one", "name", "value"), CASES, ids=str)
def test_refused_by_name(one, name, value):
    function, good = GOOD[one]
    with pytest.raises(ValueError, match=r"\A[^\n]+\Z") as error:
        function(**(good | SIZE | {name: value}))
    assert str(error.value).startswith(f"{name} = {value!r}: must be ")


@pytest.mark.parametrize("one", GOOD)
def test_a_budget_is_kept(one):
    function, good = GOOD[one]
    late = {"extinction": 3.0, "bkw": 3.0, "bkw_fraction": 3.0, "kac": 3.0, "kac_tail": 3.0}.get(
        one, 40.0
    )
    arguments = good | SIZE | {"time": late, "max_nodes": 3}
    if "breathing" in good:
        arguments |= {"cross_section": 50.0}
    with pytest.raises(boltzmann.BudgetError, match="max_nodes"):
        function(**arguments)
    with pytest.raises(boltzmann.BudgetError, match="max_nodes"):
        function(**(arguments | {"max_nodes": 1}))
    assert function(**(arguments | {"time": 0.0, "max_nodes": 1})).mean_recursion == 1.0


@pytest.mark.parametrize("one", GOOD)
def test_same_arguments_same_bits(one):
    """Whatever was drawn before; another seed, and the memory of 8192 realizations, tell."""
    function, good = GOOD[one]
    size = {"n_realizations": 20_000, "seed": 1}
    first = function(**good, **size)
    function(**good, **SIZE)
    assert function(**good, **size) == first
    assert function(**good, **(size | {"seed": 2})).mean != first.mean


def test_only_lengths_and_the_angle_between_vectors_matter():
    """A number is a vector along one axis; turning both vectors of a probe turns nothing else."""
    function, good = GOOD["bkw"]
    answers = [function(**(good | SIZE | {"velocity": c})) for c in (3.0, [0.0, -3.0, 0.0])]
    assert answers[0] == answers[1]
    function, good = GOOD["trap"]
    pairs = [(2.0, -0.7), ([0.0, 0.0, 2.0], [0.0, 0.0, -0.7])]
    same = [function(**(good | SIZE | {"position": r, "velocity": c})).mean for r, c in pairs]
    assert same[0] == pytest.approx(same[1], rel=1e-12)
    other = function(**(good | SIZE | {"position": 2.0, "velocity": 0.7})).mean
    assert other != pytest.approx(same[0], rel=1e-3)


def run(capsys, *words):
    """Run a command that must fail; return its lines on stderr."""
    assert cli.main([str(word) for word in words]) == 2
    output = capsys.readouterr()
    assert output.out == ""
    return output.err.splitlines()


SAMPLES = {
    "trap": {"radius": 1.0, "time": 0.5, "n-draws": 10, "seed": 1},
    "trap_fraction": {"radius": 1.0, "time": 0.5, "n-draws": 10, "seed": 1},
    "bkw": {"speed": 1.0, "time": 0.5, "n-draws": 10, "seed": 1},
    "extinction": {"majorant": 1.0, "time": 0.5, "n-draws": 10, "seed": 1},
    "kac_probe": {"speed": 1.0, "time": 0.5, "n-draws": 10, "seed": 1},
    "bkw_moment": {"oversampling": 1.0, "time": 0.5, "n-draws": 10, "seed": 1},
}
BAD = [
    ("trap", "radius", "-1.0"),
    ("trap", "radius", "nan"),
    ("trap", "time", "-0.5"),
    ("trap", "breathing", "1.0"),
    ("trap", "start-phase", "inf"),
    ("trap", "coupling", "0.0"),
    ("trap", "majorant-factor", "0.0"),
    ("trap", "spread", "0.9"),
    ("trap", "anisotropy", "-1.0"),
    ("trap", "initial", "equilibrium"),
    ("trap", "max-nodes", "0"),
    ("trap", "max-nodes", "many"),
    ("trap", "n-draws", "0"),
    ("trap", "seed", "-1"),
    ("trap_fraction", "radius", "-1.0"),
    ("bkw", "speed", "nan"),
    ("bkw", "oversampling", "0.5"),
    ("bkw", "onset", "-0.1"),
    ("extinction", "majorant", "0.0"),
    ("kac_probe", "collision-rate", "-0.9"),
    ("bkw_moment", "oversampling", "0.5"),
]


def words_of(sampler, changes, folder):
    given = SAMPLES[sampler] | changes
    words = [f"--{name}={value}" for name, value in given.items()]
    return "sample", sampler, *words, "--output", folder / "new" / "a.nc"


@pytest.mark.parametrize(("sampler", "name", "value"), BAD)
def test_wrong_sample(sampler, name, value, tmp_path, capsys):
    (line,) = run(capsys, *words_of(sampler, {name: value}, tmp_path))
    assert line.startswith(f"--{name} = ")
    assert "must be" in line
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("sampler", [one for one in SAMPLES if one != "extinction"])
def test_budget_on_the_command_line(sampler, tmp_path, capsys):
    late = "60.0" if sampler.startswith("trap") else "3.0"
    changes = {"time": late, "max-nodes": "3", "n-draws": "1000"}
    (line,) = run(capsys, *words_of(sampler, changes, tmp_path))
    assert "max_nodes" in line
    assert not list(tmp_path.rglob("*.nc"))


@pytest.mark.parametrize("sampler", SAMPLES)
def test_good_sample(sampler, tmp_path):
    """The same words without a wrong one write a file: means of finite realizations."""
    from kacsim import store

    words = words_of(sampler, {}, tmp_path)
    assert cli.main([str(word) for word in words]) == 0
    data = store.read(tmp_path / "new" / "a.nc")
    assert np.isfinite(data["mean"].values).all()
    assert (data["mean_square"].values > 0.0).all()
