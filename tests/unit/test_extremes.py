"""Extremes foreseen from three moments: against scipy, the normal law and simulation."""

import math

import numpy as np
import pytest
from scipy import stats

from kacsim.statistics import extremes


@pytest.mark.parametrize("skewness", [0.05, 0.33, 1.7, -0.33, -1.7])
@pytest.mark.parametrize("probability", [1e-9, 1e-5, 0.2, 0.5, 0.97])
def test_quantiles_are_those_of_pearsons_third_law(skewness, probability):
    law = stats.pearson3(skewness, loc=300.0, scale=20.0)
    below = extremes.quantile(300.0, 20.0, skewness, below=probability)
    above = extremes.quantile(300.0, 20.0, skewness, above=probability)
    assert below == pytest.approx(law.ppf(probability), rel=1e-6)
    assert above == pytest.approx(law.isf(probability), rel=1e-6)


def test_without_skewness_it_is_the_normal_law():
    for skewness in (0.0, 1e-6, -1e-6):
        found = extremes.quantile(5.0, 2.0, skewness, above=1e-5)
        assert found == pytest.approx(5.0 + 2.0 * stats.norm.isf(1e-5), rel=1e-9)


def test_extremes_of_gamma_draws_fall_inside_as_often_as_said():
    """Exactly, by the law of the extremes: 10 % outside each interval, half at either end."""
    shape, n = 9.0, 5000
    law = stats.gamma(shape)
    least, most = extremes.expected(shape, 3.0, 2.0 / 3.0, n, 0.1)
    outside_low = 1.0 - law.sf(np.array(least)) ** n
    outside_high = law.cdf(np.array(most)) ** n
    assert outside_low == pytest.approx([0.05, 0.95], rel=1e-6)
    assert outside_high == pytest.approx([0.05, 0.95], rel=1e-6)


def test_intervals_widen_with_the_error_of_the_moments():
    """By three standard errors: of a quantile z deviations out of normal draws, z = 4.3."""
    exactly = extremes.expected(100.0, 10.0, 0.0, 10**5, 1e-3)
    widened = extremes.expected(100.0, 10.0, 0.0, 10**5, 1e-3, 400)
    z = (exactly[0][0] - 100.0) / 10.0
    error = 10.0 * math.sqrt((1.0 + z**2 / 2.0 + (z**2 - 1.0) ** 2 / 6.0) / 400.0)
    assert widened[0][0] == pytest.approx(exactly[0][0] - 3.0 * error)
    assert widened[1][1] > exactly[1][1]
    assert widened[0][1] > exactly[0][1]


def test_the_error_of_a_quantile_is_that_of_normal_draws():
    """Simulated: 3000 samples of 400 normal draws, the quantile at 1e-5 from their moments."""
    drawn = np.random.default_rng(4).normal(size=(3000, 400))
    mean, spread = drawn.mean(axis=1), drawn.std(axis=1)
    third = ((drawn - mean[:, None]) ** 3).mean(axis=1) / spread**3
    found = [
        extremes.quantile(*moments, below=1e-5) for moments in zip(mean, spread, third, strict=True)
    ]
    z = stats.norm.ppf(1e-5)
    said = math.sqrt((1.0 + z**2 / 2.0 + (z**2 - 1.0) ** 2 / 6.0) / 400.0)
    assert np.std(found) == pytest.approx(said, rel=0.15)


def test_a_constant_has_its_value_at_both_ends():
    assert extremes.expected(7.0, 0.0, 0.0, 100, 0.01, 5) == ((7.0, 7.0), (7.0, 7.0))
