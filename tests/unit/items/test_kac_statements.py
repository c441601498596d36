"""The study of statements: exact values by closed forms, at the right N. No samples, no z tests."""

import math

import pytest
from fabricated import found, judged, reduced, settings

from kacsim.items import kac_statements
from kacsim.statistics.estimate import Exact

RATE, TIME, STEP = math.sqrt(math.pi) / 2, 2.0, 1.0
NUMBERS = [4, 10, 50, 1000]
LIMIT = 3.75 + 3.0 * (1.0 - math.exp(-RATE * TIME / 4.0))


@pytest.fixture(scope="module")
def dataset():
    return reduced("kac_statements", settings("kac_statements", n_particles=NUMBERS), None)


@pytest.fixture(scope="module")
def findings(dataset):
    return found("kac_statements", dataset)


def parts_of(finding):
    assert all(isinstance(part.measured, Exact) for part in finding.parts)
    return [(part.label, part.measured.value, part.printed) for part in finding.parts]


def process(n):
    relaxed = 1.0 - math.exp(-RATE * (n + 2) * TIME / (4 * (n - 1)))
    return 3.75 + 3.0 * (n - 1) / (n + 2) * relaxed


def bird(n):
    ratio = 1.0 - (n + 2) / (2 * n * (n - 1))
    return 3.75 + 3.0 * (n - 1) / (n + 2) * (1.0 - ratio ** math.ceil(RATE * n * TIME / 2))


VERDICTS = {
    "kac_21_self_adjoint": "reproduced",
    "kac_21_energy": "reproduced",
    "kac_21_momentum": "reproduced",
    "kac_22_solution": "reproduced",
    "kac_5_marginal": "corrected",
    "kac_3_limit": "reproduced",
    "kac_8_solution": "reproduced",
    "kac_9_limit": "reproduced",
    "kac_44_norm": "corrected",
    "kac_41_round": "reproduced",
    "kac_41_energy": "reproduced",
    "kac_41_loop": "corrected",
    "kac_41_limit": "reproduced",
    "kac_41_limit_in_place": "corrected",
    "kac_42_limit": "reproduced",
    "kac_42_count": "corrected",
    "kac_42_replacement": "reproduced",
}


def test_verdicts(findings):
    """Exact rows: the same in every run."""
    assert {claim: judged(one)[0] for claim, one in findings.items()} == VERDICTS


def test_the_walk(findings):
    """35 monomials of degree up to 4 in three variables make 595 pairs; 3 pairs, 4 angles."""
    assert parts_of(findings["kac_21_self_adjoint"])[0][1] == 0.0
    assert "differ: 0 of 595, N = 3" in findings["kac_21_self_adjoint"].evidence
    assert "0 of 12" in findings["kac_21_energy"].evidence
    assert parts_of(findings["kac_21_momentum"])[0][1] == pytest.approx(2.0)


def test_the_series_is_told_from_a_fixed_number(findings):
    for part, n in zip(findings["kac_22_solution"].parts, (4, 1000), strict=True):
        assert part.label == f"N = {n}"
        assert part.measured.value == pytest.approx(process(n))
        assert part.printed == pytest.approx(process(n))
        assert part.rival == pytest.approx(bird(n))


def test_the_marginal_of_four_particles(findings):
    """A mass of 1; 8 / (3 pi) by eq. (5)."""
    (part,) = findings["kac_5_marginal"].parts
    assert part.measured.value == 1.0
    assert (part.printed, part.corrected) == pytest.approx((8 / (3 * math.pi), 1.0))


def test_limits_of_many_particles(findings):
    for claim, moment in (("kac_3_limit", process(1000)), ("kac_42_limit", bird(1000))):
        ((_, value, printed),) = parts_of(findings[claim])
        assert (value, printed) == pytest.approx((moment, LIMIT))


def test_moments_change_as_eq_6_has_it(findings):
    """Order 4: rate (3/4 (m + 9/4) - m)."""
    parts = parts_of(findings["kac_8_solution"])
    assert [label for label, *_ in parts] == ["order 4", "order 6", "order 8"]
    slope = RATE * (0.75 * (LIMIT + 2.25) - LIMIT)
    assert parts[0][1:] == pytest.approx((slope, slope))
    for _, value, printed in parts:
        assert value == pytest.approx(printed)
    assert [value for _, value, _ in parts_of(findings["kac_9_limit"])] == pytest.approx([1.0] * 3)


def test_the_printed_norms(findings, dataset):
    """The supremum is half the sum of differences, printed as the whole of it."""
    (part,) = findings["kac_44_norm"].parts
    assert part.measured.value == pytest.approx(part.corrected)
    assert part.printed == pytest.approx(2.0 * part.corrected)
    assert 0.1 < part.corrected < 0.3


def test_the_loop_around_the_pairs(findings):
    """lambda N step / 2 = 4.43 pairs of ten particles; ten times as many with the loop."""
    pairs = RATE * 10 * STEP / 2
    (part,) = findings["kac_41_loop"].parts
    assert part.measured.value == pytest.approx(pairs)
    assert (part.printed, part.corrected) == pytest.approx((10 * pairs, pairs))
    assert parts_of(findings["kac_41_round"])[0][1:] == pytest.approx((pairs, pairs))


def discretized():
    p = RATE * STEP
    one = (1 - p) * 3.75 + 0.75 * p * 6.0
    return (1 - p) * one + 0.75 * p * (one + 2.25)


def test_limits_at_a_fixed_step(findings, dataset):
    """Eq. (10) gives 4.9321; updated in place 4.973 and 5.124, at N = 1000 a little more."""
    assert discretized() == pytest.approx(4.9321, abs=5e-5)
    synchronous, disjoint = findings["kac_41_limit"].parts
    assert synchronous.label == "Nanbu (synchronous)"
    for part in (synchronous, disjoint):
        assert part.printed == pytest.approx(discretized())
        assert part.measured.value == pytest.approx(discretized(), abs=2e-3)
        assert part.rival == pytest.approx(5.124, abs=5e-3)
    first, population = findings["kac_41_limit_in_place"].parts
    for part, limit in ((first, 4.973), (population, 5.124)):
        assert part.printed == pytest.approx(discretized())
        assert part.corrected == pytest.approx(limit, abs=6e-4)
        assert part.measured.value == pytest.approx(limit, abs=4e-3)
    p = RATE * STEP  # disjoint pairs in closed form: (a, b) -> means over a pair with chance p
    a, b = 3.75, 2.25
    for _ in range(2):
        a, b = a + p * (0.75 * (a + b) - a), b + p / 999 * (0.25 * (a + b) - b)
    assert disjoint.measured.value == pytest.approx(a, rel=1e-12)


def test_energy_grows_in_mean_square(findings, dataset):
    """Both readings at N = 10; it falls as 1/N."""
    parts = parts_of(findings["kac_41_energy"])
    assert [label for label, *_ in parts] == ["Nanbu (sequential)", "Nanbu (synchronous)"]
    for (_, value, _), reading in zip(parts, dataset.reading.values, strict=True):
        growth = dataset.growth.sel(reading=reading)
        assert value == float(growth.sel(n_particles=10))
        ratio = float(growth.sel(n_particles=1000) / growth.sel(n_particles=50))
        assert ratio == pytest.approx(0.05, rel=0.1)


def test_birds_clock_rounds_up(findings):
    """8.86 to 9 at N = 10, 44.3 to 45 at N = 50."""
    for part, n, number in zip(findings["kac_42_count"].parts, (10, 50), (9, 45), strict=True):
        assert part.label == f"N = {n}"
        assert (part.measured.value, part.corrected) == (number, number)
        assert part.printed == pytest.approx(RATE * n * TIME / 2)


def test_pairs_with_replacement_are_birds(findings):
    """4 or 5 collisions a step at N = 10, by chance, against 9 in all."""
    ratio = 1.0 - 12 / 180
    more = RATE * 10 * STEP / 2 - 4
    step = ratio**4 * (1 - more + more * ratio)
    ((_, value, printed),) = parts_of(findings["kac_42_replacement"])
    assert value == pytest.approx(3.75 + 3.0 * 9 / 12 * (1 - step**2))
    assert printed == pytest.approx(bird(10))


def test_a_step_that_is_too_large_is_refused():
    assert kac_statements.problems(settings("kac_statements")) == []
    (problem,) = kac_statements.problems(settings("kac_statements", time_step=2.0))
    assert problem[0] == "time_step"
