"""The second look: an alarm must stay. Toys whose probabilities are known, and pytest's part."""

import math
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from law import compare
from scipy import special

TESTS = Path(__file__).resolve().parent.parent
TIMES = 20_000


def toy(bias, *, unsigned=False):
    """Return a law test: the mean of nine draws, wrong by so many standard errors."""

    def test(seed):
        n = compare.scaled(9)
        z = np.random.default_rng(seed).normal(bias / 3.0, 1.0, n).mean() * math.sqrt(n)
        p = 2.0 * special.ndtr(-abs(z))
        assert compare.ok(compare.of_p(p) if unsigned else z)

    return test


def fails(looks):
    try:
        compare.judge(looks)
    except AssertionError:
        return True
    return False


@pytest.mark.parametrize("unsigned", [False, True])
@pytest.mark.parametrize("bias", [0.0, 1.5])
def test_alarms_stay_as_often_as_they_should(bias, unsigned, seed, monkeypatch):
    """8 z: first alarms and failures of the toy, at a limit of 1.5 where they are common.

    Null: Phi(b - L) + Phi(-b - L) at the first look, and at both this with 2 b in its place, on
    each side for itself if there are sides. Mutant: the rates of a single look.
    """
    test, n = toy(bias, unsigned=unsigned), compare.scaled(TIMES)
    monkeypatch.setattr(compare, "LIMIT", 1.5)
    monkeypatch.setattr(compare, "DRAWS_FACTOR", 1.0)
    all_looks = [compare.look_at(test, seed + k) for k in range(n)]
    again, failed = sum(len(looks) == 2 for looks in all_looks), sum(map(fails, all_looks))
    monkeypatch.undo()
    sides = special.ndtr([[bias - 1.5, -bias - 1.5], [2.0 * bias - 1.5, -2.0 * bias - 1.5]])
    once = sides[0].sum()
    twice = once * sides[1].sum() if unsigned else (sides[0] * sides[1]).sum()
    if bias == 0.0:
        assert twice == pytest.approx(compare.chance(unsigned, 1.5))
    assert compare.ok(compare.of_share(again, n, once))
    assert compare.ok(compare.of_share(failed, n, twice))
    assert compare.caught(compare.of_share(failed, n, once))


def test_a_lucky_alarm_passes_and_a_bias_fails(monkeypatch):
    """From one z = 4.5: chance is gone at the second look, a bias is twice as large."""
    monkeypatch.setattr(compare, "DRAWS_FACTOR", 1.0)

    def test(bias):
        return lambda seed: compare.ok(4.5 if compare.scaled(1) == 1 else bias + 0.3)

    chance, biased = (compare.look_at(test(bias), 1) for bias in (0.0, 9.0))
    compare.judge(chance)
    with pytest.raises(AssertionError, match=r"test_looks.py:\d+: z = 4.50, then 9.30 with 4"):
        compare.judge(biased)


@pytest.mark.parametrize(
    ("z", "again", "wanted"),
    [
        (4.1, 4.1, True),
        (-4.1, -9.0, True),
        (4.1, -9.0, False),
        (9.0, 3.9, False),
        (3.9, 9.0, False),
        (math.inf, math.inf, True),
    ],
)
def test_an_alarm_stays_on_its_side_only(z, again, wanted):
    assert compare.stays(z, again) is wanted


def test_a_second_look_draws_more_from_another_seed_and_no_mutants(monkeypatch):
    monkeypatch.setattr(compare, "DRAWS_FACTOR", 1.0)
    found = []

    def test(seed):
        compare.ok(5.0)
        found.append((seed, compare.scaled(1000), compare.controls(1), compare.caught(0.0)))

    compare.look_at(test, 7)
    first, second = found
    assert first == (7, 1000, (1,), False)
    assert second == (7 + compare.FRESH, 4000, (), True)


def test_other_z_at_the_second_look_are_refused():
    with pytest.raises(RuntimeError, match="depends on the draws"):
        compare.look_at(lambda seed: [compare.ok(5.0) for _ in range(compare.scaled(1))], 1)


def test_draws_that_are_not_scaled_are_refused():
    with pytest.raises(RuntimeError, match="as many draws as `scaled` says"):
        compare.look_at(lambda seed: compare.ok(0.0), 1)


def test_kept_draws_are_made_once_for_a_seed(monkeypatch):
    monkeypatch.setattr(compare, "DRAWS_FACTOR", 1.0)
    made = compare.kept(lambda seed: (seed, object(), compare.scaled(7)))

    def test(seed):
        assert made(seed) is made(seed)
        compare.ok(5.0)
        found.append(made(seed))

    found = []
    for _ in range(2):
        compare.look_at(test, 3)
    assert [one[0] for one in found[:2]] == [3, 3 + compare.FRESH]
    assert [one[2] for one in found[:2]] == [7, 28]
    assert found[2:] == found[:2]


def test_a_z_without_a_look_is_refused():
    with pytest.raises(RuntimeError, match="takes its seed as an argument"):
        compare.ok(0.0)


def test_what_is_no_number_fails_at_once():
    with compare.look(1):
        assert not compare.ok(0.0, math.nan)


def test_draws_are_not_made_too_few(monkeypatch):
    monkeypatch.setattr(compare, "DRAWS_FACTOR", 0.2)
    assert [compare.scaled(n) for n in (60, 300_000, 2_000_000)] == [60, 100_000, 400_000]
    with compare.look(4):
        assert compare.scaled(2_000_000) == 1_600_000
    monkeypatch.setattr(compare, "DRAWS_FACTOR", 3.0)
    assert compare.scaled(60) == 180


TOYS = """
import pytest
from law import compare

def z(bias, seed):  # an alarm at the first look whatever the bias
    n = compare.scaled(100)
    return 4.5 if seed == 1 else 0.7 + bias * (n / 100) ** 0.5

@pytest.fixture
def seed():
    return 1

@pytest.fixture(scope="module", params=[0.0, 4.5])
def kept(request):
    return compare.kept(lambda seed: z(request.param, seed))

def test_chance(seed):
    assert compare.ok(0.3, z(0.0, seed))

@pytest.mark.parametrize("bias", [4.5])
def test_bias(bias, seed):
    assert compare.ok(0.3, z(bias, seed))

def test_shared(kept, seed):
    assert compare.ok(kept(seed))

def test_slip_elsewhere(seed):
    compare.ok(z(0.0, seed))
    assert seed > 1

def test_not_scaled(seed):
    assert compare.ok(0.0)

def test_without_a_seed():
    assert compare.ok(0.0)
"""


def test_pytest_looks_twice(tmp_path):
    """A lucky alarm passes, and what stays, breaks otherwise or takes no seed fails."""
    (tmp_path / "test_toys.py").write_text(TOYS, encoding="utf-8")
    options = ["-q", "-p", "law.looks", "-p", "no:cacheprovider", "--tb=line", "-rA"]
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *options, "--rootdir", tmp_path, tmp_path],
        env=os.environ | {"PYTHONPATH": str(TESTS)},
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    verdicts = re.findall(r"^(PASSED|FAILED) test_toys.py::(\S+)", done.stdout, re.MULTILINE)
    assert set(verdicts) == {
        ("PASSED", "test_chance"),
        ("FAILED", "test_bias[4.5]"),
        ("PASSED", "test_shared[0.0]"),
        ("FAILED", "test_shared[4.5]"),
        ("FAILED", "test_slip_elsewhere"),
        ("FAILED", "test_not_scaled"),
        ("FAILED", "test_without_a_seed"),
    }
    assert "z = 4.50, then 9.70 with 4 times the draws" in done.stdout
    # Two z of two tests, and one of the two that share theirs.
    assert "6 null z, 4 of them beyond 4 and drawn again" in done.stdout
