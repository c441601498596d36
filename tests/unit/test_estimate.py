"""Means, shares and exact values with their intervals, against numpy and scipy.

No z tests: the data are fixed.
"""

import math

import numpy as np
import pytest
from scipy import stats

from kacsim.statistics import estimate
from kacsim.statistics.estimate import Exact, Mean, Share

VALUES = np.array([0.3, -1.7, 2.9, 0.1, 4.1, -0.6])
LEVELS = (0.05, 0.01 / 90, 1e-7)


def test_of_replicates_is_numpys():
    mean = estimate.of_replicates(VALUES)
    assert mean.value == pytest.approx(np.mean(VALUES))
    assert mean.standard_error == pytest.approx(np.std(VALUES, ddof=1) / math.sqrt(6))
    assert mean.degrees == 5


@pytest.mark.parametrize("alpha", LEVELS)
def test_the_interval_of_replicates_is_scipys(alpha):
    """Student's t of six values, two-sided."""
    interval = estimate.of_replicates(VALUES).interval(alpha)
    theirs = stats.ttest_1samp(VALUES, 0.0).confidence_interval(1.0 - alpha)
    assert interval == pytest.approx((theirs.low, theirs.high), rel=1e-6)


def test_one_replicate_has_no_error_and_no_interval():
    mean = estimate.of_replicates([2.5])
    assert mean.value == 2.5
    assert math.isnan(mean.standard_error)
    assert all(math.isnan(end) for end in mean.interval(0.05))


def test_equal_replicates_have_no_interval():
    """Ten replicates without a rare event do not show that there is none."""
    mean = estimate.of_replicates(np.zeros(10))
    assert (mean.value, mean.standard_error) == (0.0, 0.0)
    assert all(math.isnan(end) for end in mean.interval(0.05))


@pytest.mark.parametrize("alpha", LEVELS)
@pytest.mark.parametrize("degrees", [1, 2.5, 4, 9, 19, 39.7, 99, 1e3, 1e6, 1e9, 1e15, math.inf])
def test_quantiles_are_scipys(degrees, alpha):
    reach = Mean(7.0, 0.5, degrees).reach(alpha)
    assert reach == pytest.approx(0.5 * stats.t.isf(alpha / 2.0, degrees), rel=1e-6)
    low, high = Mean(7.0, 0.5, degrees).interval(alpha)
    assert (low, high) == pytest.approx((7.0 - reach, 7.0 + reach))


def test_without_degrees_the_error_counts_as_known():
    assert Mean(1.0, 0.1).reach(0.05) == pytest.approx(0.1 * stats.norm.isf(0.025))
    assert Mean(1.0, 0.1, 19).reach(0.05) > 1.06 * Mean(1.0, 0.1).reach(0.05)


@pytest.mark.parametrize("alpha", LEVELS)
@pytest.mark.parametrize(
    ("successes", "n"), [(0, 7), (1, 7), (7, 7), (3, 10**6), (130, 100_000), (0, 20_000)]
)
def test_the_interval_of_a_share_is_scipys(successes, n, alpha):
    """Clopper and Pearson's, at the levels of verdicts."""
    share = Share(successes, n)
    theirs = stats.binomtest(successes, n).proportion_ci(1.0 - alpha, method="exact")
    assert share.interval(alpha) == pytest.approx((theirs.low, theirs.high), rel=1e-6)
    assert share.reach(alpha) == pytest.approx((theirs.high - theirs.low) / 2.0, rel=1e-6)


def test_no_event_leaves_a_rate():
    """The upper end of 0 of n by hand: (1 - p)**n is half the level."""
    low, high = Share(0, 5000).interval(0.02)
    assert low == 0.0
    assert (1.0 - high) ** 5000 == pytest.approx(0.01)


def test_no_trial_leaves_everything_possible():
    none = Share(0, 0)
    assert math.isnan(none.value)
    assert none.interval(0.01) == (0.0, 1.0)
    assert none.standard_error > 0.0


def test_exact_values_have_an_interval_of_one_value():
    assert Exact(3.5).interval(0.01) == (3.5, 3.5)
    assert Exact(3.5).reach(0.01) == 0.0
    assert Exact(3.5).standard_error == 0.0


@pytest.mark.parametrize(
    ("measured", "law"),
    [
        (Mean(1.0, 0.1), "normal"),
        (Mean(1.0, 0.1, 19), "t with 19 degrees"),
        (Mean(1.0, 0.1, 37.6), "t with 38 degrees"),
        (Share(3, 70), "Clopper-Pearson of 70"),
        (Exact(1.0), "exact"),
    ],
)
def test_laws_are_named(measured, law):
    assert measured.law == law


@pytest.mark.parametrize("order", [2, 4])
def test_of_power_is_numpys(order):
    moments = {k: np.mean(VALUES**k) for k in (2, 4, 6, 8)}
    mean = estimate.of_power(moments, order, VALUES.size)
    assert mean.value == pytest.approx(np.mean(VALUES**order))
    assert mean.standard_error == pytest.approx(np.std(VALUES**order) / math.sqrt(VALUES.size))


def test_a_control_variate_is_the_least_squares_line_at_the_known_mean():
    moments = {k: np.mean(VALUES**k) for k in (2, 4, 6, 8)}
    mean = estimate.of_power(moments, 4, VALUES.size, square=1.25)
    slope, level = np.polyfit(VALUES**2, VALUES**4, 1)
    left = VALUES**4 - slope * VALUES**2 - level
    assert mean.value == pytest.approx(slope * 1.25 + level)
    assert mean.standard_error == pytest.approx(np.std(left) / math.sqrt(VALUES.size))


def test_a_control_variate_that_does_not_vary_changes_nothing():
    ones = dict.fromkeys((2, 4, 6, 8), 1.0)
    mean = estimate.of_power(ones, 4, 10, square=1.5)
    assert (mean.value, mean.standard_error) == (1.0, 0.0)


def test_of_power_of_a_constant_has_no_spread():
    """Rounding may make the variance of equal values slightly negative."""
    mean = estimate.of_power({2: 0.1, 4: 0.1**2 - 1e-18}, 2, 10)
    assert (mean.value, mean.standard_error) == (0.1, 0.0)


@pytest.mark.parametrize(("successes", "n"), [(0, 50), (13, 50), (50, 50)])
def test_of_share(successes, n):
    """The Agresti-Coull centre keeps the error positive at 0 and at n, and changes little else."""
    centre = (successes + 2) / (n + 4)
    for share in (estimate.of_share(successes, n), Share(successes, n)):
        assert share.value == successes / n
        assert share.standard_error == pytest.approx(math.sqrt(centre * (1 - centre) / n))
        assert share.standard_error > 0.0


def test_z_uses_the_error_once():
    assert Mean(2.0, 0.25).z(1.5) == 2.0
    assert Mean(2.0, 0.25).z() == 8.0
    assert Mean(2.0, 0.0).z(2.0) == 0.0


def test_minus_adds_variances():
    difference = Mean(5.0, 3.0).minus(Mean(1.0, 4.0))
    assert (difference.value, difference.standard_error) == (4.0, 5.0)
    assert math.isinf(difference.degrees)


@pytest.mark.parametrize("sizes", [(4, 9), (20, 20), (3, 200)])
def test_degrees_of_a_difference_are_welchs(sizes):
    """scipy's test of two samples of unequal variances has the same degrees and interval."""
    rng = np.random.default_rng(5)
    a, b = rng.normal(1.0, 3.0, sizes[0]), rng.normal(0.0, 0.7, sizes[1])
    difference = estimate.of_replicates(a).minus(estimate.of_replicates(b))
    theirs = stats.ttest_ind(a, b, equal_var=False)
    assert difference.degrees == pytest.approx(theirs.df)
    interval = theirs.confidence_interval(1.0 - LEVELS[1])
    assert difference.interval(LEVELS[1]) == pytest.approx((interval.low, interval.high), rel=1e-6)


def test_degrees_of_a_difference_by_hand():
    """(1 + 4)**2 / (1/9 + 16/19); of an exact value those of the other, whatever the units."""
    assert Mean(0.0, 1.0, 9).minus(Mean(0.0, 2.0, 19)).degrees == pytest.approx(
        25 / (1 / 9 + 16 / 19)
    )
    tiny = Mean(0.0, 1e-40, 9).minus(Mean(0.0, 2e-40, 19))
    assert tiny.degrees == pytest.approx(25 / (1 / 9 + 16 / 19))
    assert Mean(3.0, 0.2, 9).minus(Mean(1.0, 0.0)).degrees == pytest.approx(9)
    assert math.isinf(Mean(3.0, 0.2).minus(Mean(1.0, 0.1)).degrees)


def test_a_difference_to_one_without_an_error_has_no_interval():
    difference = Mean(3.0, 0.2, 9).minus(Mean(1.0, math.nan))
    assert all(math.isnan(end) for end in difference.interval(0.05))


def test_over_is_in_other_units():
    assert Mean(6.0, 0.3, 9).over(3.0) == Mean(2.0, pytest.approx(0.1), 9)


def test_a_departure_within_rounding_is_told_without_its_digits():
    assert estimate.within(7.3e-14, 1e-12) == estimate.within(7.5e-14, 1e-12) == "within 1e-12"
    assert estimate.within(3.2e-9, 1e-12) == "3.2e-09"
