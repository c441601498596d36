"""The second moment of Algorithm 2 at a given speed, against what it must be without its series.

No random numbers, no false alarms.
"""

import math

import numpy as np
import pytest
from scipy import integrate

from kacsim import boltzmann
from kacsim.boltzmann import bkw, second_moment

# Relative deviations of one realization at c = 0, 1, 2, 4, 6, of an independent prototype.
PROTOTYPE = {
    1.0: [1.4498, 0.5999, 0.4784, 1.3012, 5.102],
    2.0: [2.1669, 1.6023, 1.3972, 2.9469, 14.469],
    2.3: [5.533, 4.334, 3.762, 8.599, 64.89],
}


@pytest.mark.parametrize("time", PROTOTYPE)
def test_relative_deviation(time):
    found = second_moment.relative_deviation(np.array([0.0, 1.0, 2.0, 4.0, 6.0]), time)
    np.testing.assert_allclose(found, PROTOTYPE[time], rtol=2e-4)


def test_starts_without_variance():
    speed = np.linspace(0.0, 5.0, 11)
    square = bkw.relative_density(speed, 0.0) ** 2
    np.testing.assert_allclose(second_moment.at_speed(speed, 0.0), square, atol=1e-11)


@pytest.mark.parametrize("time", [0.3, 1.0, 2.2])
def test_mean_over_the_maxwellian_is_the_closed_form(time):
    def shell(c):
        return 4.0 * math.pi * c * c * bkw.maxwellian(c) * second_moment.at_speed(c, time)

    found = integrate.quad(lambda c: float(shell(np.array(c))), 0.0, 7.0, epsabs=1e-12)[0]
    assert found == pytest.approx(float(bkw.second_moment(time)), rel=1e-8)


@pytest.mark.parametrize("speed", [0.4, 1.7, 3.1])
def test_obeys_its_own_equation(speed):
    """d g / dt = -g + mean of g(c') g(c'*) over c* and u': central difference and quadrature."""
    time, step = 1.1, 1e-3
    c = np.array(speed)
    slope = second_moment.at_speed(c, time + step) - second_moment.at_speed(c, time - step)
    radial, w_radial = np.polynomial.hermite_e.hermegauss(24)
    level, w_level = np.polynomial.laguerre.laggauss(24)
    cosine, w_cosine = np.polynomial.legendre.leggauss(24)
    z, e, mu = np.meshgrid(radial, level, cosine, indexing="ij")
    weight = w_radial[:, None, None] * w_level[:, None] * w_cosine / math.sqrt(8.0 * math.pi)
    total = speed**2 + z**2 + 2.0 * e
    reach = mu * np.sqrt(np.maximum(0.0, total**2 - 4.0 * (speed * z) ** 2))
    pair = [np.sqrt(np.maximum(0.0, (total + one) / 2.0)) for one in (reach, -reach)]
    near = np.maximum(*pair) < second_moment.FARTHEST  # beyond, the weight is below 1e-10
    first, second = (second_moment.at_speed(np.where(near, one, 1.0), time) for one in pair)
    gain = (weight * first * second * near).sum()
    wanted = gain - float(second_moment.at_speed(c, time))
    assert float(slope) / (2.0 * step) == pytest.approx(wanted, rel=1e-4)


def test_sampling_density_and_its_integral():
    for threshold in (0.0, 1.3, 2.0, 2.1, 6.0):
        wanted = integrate.quad(
            lambda x, c=threshold: second_moment.sampling_density(c + x, c), 0.0, np.inf
        )[0]
        assert wanted == pytest.approx(1.0, rel=1e-7)
        assert second_moment.normalization(threshold) == pytest.approx(1.0, rel=1e-6)


@pytest.mark.parametrize("threshold", [2.0, 4.0, 6.0])
def test_fraction_deviation(threshold):
    """Algorithm 3's weight c² F/(p_C p_U) by an adaptive quadrature."""
    time = 1.0

    def square(c):
        density = float(second_moment.sampling_density(c, threshold))
        weight = 4.0 * math.pi * c * c * float(bkw.maxwellian(c)) / density
        return weight**2 * float(second_moment.at_speed(np.array(c), time)) * density

    second = integrate.quad(square, threshold, threshold + 3.0, epsabs=0.0)[0]
    relative = math.sqrt(second / float(bkw.fraction(threshold, time)) ** 2 - 1.0)
    found = second_moment.fraction_deviation(threshold, time)
    assert found == pytest.approx(relative, rel=1e-6)


def test_growth_over_fall_ends_where_the_density_has_fallen():
    starts = np.array([0.0, 1.0, 2.0])
    there, factor = second_moment.growth_over_fall(1e6, starts, 1.0)
    fall = bkw.density(starts, 1.0) / bkw.density(there, 1.0)
    np.testing.assert_allclose(fall, 1e6, rtol=2e-4)
    ends = [second_moment.relative_deviation(c, 1.0) for c in (starts, there)]
    np.testing.assert_allclose(factor, ends[1] / ends[0])


@pytest.mark.parametrize("time", [0.0, 0.7, 3.0])
def test_change_of_the_density(time):
    speed, step = np.array([0.0, 0.8, 2.0, 4.5]), 1e-4
    points = [bkw.density(speed, time + k * step) for k in (-2, -1, 1, 2)]
    slope = (points[0] - 8 * points[1] + 8 * points[2] - points[3]) / (12 * step)
    np.testing.assert_allclose(bkw.change(speed, time), slope, rtol=1e-6, atol=1e-14)


def test_gain_of_an_equilibrium_is_its_loss():
    """At a late time f is the Maxwellian, and gain and loss are equal."""
    for speed in (0.3, 2.0, 4.0):
        assert bkw.gain(speed, 300.0) == pytest.approx(float(bkw.maxwellian(speed)), rel=1e-9)


@pytest.mark.parametrize(
    ("speed", "time", "sentence"),
    [
        (1.0, 2.4, "time = 2.4: must be before 2.358"),
        (1.0, -0.1, "time = -0.1"),
        (7.5, 1.0, "speed = .*: must be from 0 to 7"),
        (-1.0, 1.0, "speed = .*: must be from 0 to 7"),
    ],
)
def test_a_deviation_out_of_reach_is_refused(speed, time, sentence):
    with pytest.raises(ValueError, match=sentence):
        boltzmann.relative_deviation(speed, time)


def test_the_public_deviation_is_the_square_root_of_the_variance():
    """Values of another program: those at t = 1 and 2.3."""
    wanted = [1.4498, 0.5999, 0.4784, 1.3012, 5.102]
    found = boltzmann.relative_deviation(np.array([0.0, 1.0, 2.0, 4.0, 6.0]), 1.0)
    np.testing.assert_allclose(found, wanted, rtol=2e-4)
    assert boltzmann.relative_deviation(2.0, 2.3) == pytest.approx(3.762, rel=2e-4)
