"""Means and standard errors against numpy.

No z tests: the data are fixed.
"""

import math

import numpy as np
import pytest

from kacsim.statistics import estimate

VALUES = np.array([0.3, -1.7, 2.9, 0.1, 4.1, -0.6])


def test_of_replicates_is_numpys():
    mean = estimate.of_replicates(VALUES)
    assert mean.value == pytest.approx(np.mean(VALUES))
    assert mean.standard_error == pytest.approx(np.std(VALUES, ddof=1) / math.sqrt(6))


def test_one_replicate_has_no_error():
    mean = estimate.of_replicates([2.5])
    assert mean.value == 2.5
    assert math.isnan(mean.standard_error)


@pytest.mark.parametrize("order", [2, 4])
def test_of_power_is_numpys(order):
    moments = {k: np.mean(VALUES**k) for k in (2, 4, 6, 8)}
    mean = estimate.of_power(moments, order, VALUES.size)
    assert mean.value == pytest.approx(np.mean(VALUES**order))
    assert mean.standard_error == pytest.approx(np.std(VALUES**order) / math.sqrt(VALUES.size))


def test_of_power_of_a_constant_is_certain():
    """Rounding may make the variance of equal values slightly negative."""
    mean = estimate.of_power({2: 0.1, 4: 0.1**2 - 1e-18}, 2, 10)
    assert (mean.value, mean.standard_error) == (0.1, 0.0)


@pytest.mark.parametrize(("successes", "n"), [(0, 50), (13, 50), (50, 50)])
def test_of_share(successes, n):
    """The Agresti-Coull centre keeps the error positive at 0 and at n, and changes little else."""
    share = estimate.of_share(successes, n)
    centre = (successes + 2) / (n + 4)
    assert share.value == successes / n
    assert share.standard_error == pytest.approx(math.sqrt(centre * (1 - centre) / n))
    assert share.standard_error > 0.0


def test_z_uses_the_error_once():
    assert estimate.Mean(2.0, 0.25).z(1.5) == 2.0
    assert estimate.Mean(2.0, 0.25).z() == 8.0
    assert estimate.Mean(2.0, 0.0).z(2.0) == 0.0


def test_minus_adds_variances():
    difference = estimate.Mean(5.0, 3.0).minus(estimate.Mean(1.0, 4.0))
    assert (difference.value, difference.standard_error) == (4.0, 5.0)
