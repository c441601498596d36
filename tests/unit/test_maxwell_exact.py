"""The law of the speed of the BKW mode, against quadrature and moments of f. No z tests."""

import math

import numpy as np
import pytest
from scipy import integrate, stats

from kacsim import maxwell
from kacsim.boltzmann import bkw
from kacsim.maxwell import exact

RATE = 0.9


@pytest.mark.parametrize("time", [0.0, 1.7, math.inf])
def test_the_density_is_that_of_the_cumulative_function(time):
    places = np.array([0.0, 1e-3, 0.4, 1.3, 2.9, 5.0])
    below = [integrate.quad(maxwell.density, 0.0, c, (time, RATE), epsabs=1e-14)[0] for c in places]
    assert maxwell.cumulative(places, time, RATE) == pytest.approx(below, rel=1e-9, abs=1e-18)
    above = maxwell.survival(places, time, RATE)
    assert maxwell.cumulative(places, time, RATE) + above == pytest.approx(1.0, abs=1e-15)


def test_tails_keep_their_digits():
    """P(|v| > 12) at the start, 1e-24, and P(|v| < 1e-6), 1e-30, by their leading terms."""
    y = 12.0 / math.sqrt(0.6)
    tail, _ = integrate.quad(lambda x: stats.chi2.pdf(x, 5), y**2, y**2 + 200.0, epsabs=0.0)
    assert maxwell.survival(12.0, 0.0) == pytest.approx(tail, rel=1e-8, abs=0.0)
    low = 4.0 / 3.0 * math.pi * 1e-18 * bkw.density(0.0, RATE * 2.0)
    assert maxwell.cumulative(1e-6, 2.0, RATE) == pytest.approx(low, rel=1e-9, abs=0.0)


def test_no_speed_is_negative():
    assert maxwell.cumulative([-1.0, 0.0], 1.0).tolist() == [0.0, 0.0]
    assert maxwell.survival([-1.0, 0.0], 1.0).tolist() == [1.0, 1.0]
    assert maxwell.density(-1.0, 1.0) == 0.0


@pytest.mark.parametrize("order", [1, 2, 4, 8])
def test_moments(order):
    found, _ = integrate.quad(lambda c: c**order * maxwell.density(c, 1.7, RATE), 0.0, 20.0)
    assert exact.speed_moment(order, 1.7, RATE) == pytest.approx(found, rel=1e-9)


def test_energy_and_fourth_moment():
    assert exact.speed_moment(2, 0.7) == pytest.approx(3.0, rel=1e-14)
    fourth = maxwell.fourth_moment(1.7, collision_rate=RATE)
    assert exact.speed_moment(4, 1.7, RATE) == pytest.approx(fourth, rel=1e-14)
    assert exact.speed_moment(4, math.inf) == pytest.approx(15.0, rel=1e-14)


@pytest.mark.parametrize("time", [-1.0, math.nan])
def test_a_wrong_time_is_named(time):
    for function in (maxwell.density, maxwell.cumulative, maxwell.survival):
        with pytest.raises(ValueError, match=r"\Atime = "):
            function(1.0, time)
