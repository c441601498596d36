"""Exact results on the flux of a drifting Maxwellian through a face (section 11.3, exercise 2).

The normal velocity is positive inward, has mean ``drift`` and variance ``temperature``.
"""

import math

import numpy as np
from scipy import special

from kacsim.elementary.exponential import exp_of_square
from kacsim.elementary.gaussian import normal_cumulative
from kacsim.kernels.jit import kernel

ROOT_2_PI = math.sqrt(2.0 * math.pi)


@kernel
def normal_law(s):
    """Return the standard normal density and its cumulative function at s and at -|s|."""
    bell = exp_of_square(s, -0.5) / ROOT_2_PI
    return bell, normal_cumulative(s), normal_cumulative(-abs(s))


def half_moments(drift, temperature, highest):
    """Return float64[highest + 1], the integrals of v**k f(v) over v > 0, f a normal density."""
    thermal = math.sqrt(temperature)
    s = drift / thermal
    bell, below, beyond = normal_law(float(s))
    # s ndtr(s) + bell, without the cancellation of a drift far outward
    first = bell - abs(s) * beyond + max(s, 0.0)
    moments = [below, thermal * first]
    for k in range(1, highest):
        moments.append(drift * moments[k] + k * temperature * moments[k - 1])
    return np.array(moments[: highest + 1])


def flux_density(density, drift, temperature):
    """Return the particles that cross per area and time, eq. (11.13)."""
    return density * half_moments(drift, temperature, 1)[1]


def face_rates(density, temperature, drift, half_width):
    """Return float64[6], particles per time and face, eq. (11.14) with its limits right."""
    rates = np.empty(6)
    for face in range(6):
        axis, inward = face // 2, 1.0 - 2.0 * (face % 2)
        others = [half_width[k] for k in range(3) if k != axis]
        area = 4.0 * others[0] * others[1]
        rates[face] = area * flux_density(density, inward * drift[axis], temperature)
    return rates


def cumulative(v, drift, temperature):
    """Return the probability that an entering particle is slower than v (section 11.3)."""
    thermal = math.sqrt(temperature)
    s, v = drift / thermal, np.maximum(np.asarray(v, dtype=float), 0.0)
    w = v / thermal - s
    bells = (math.exp(-0.5 * s * s) - np.exp(-0.5 * w * w)) / ROOT_2_PI
    part = drift * (special.ndtr(w) - special.ndtr(-s)) + thermal * bells
    return part / half_moments(drift, temperature, 1)[1]


def moment(power, drift, temperature):
    """Return the mean of v_n**power over the entering particles."""
    moments = half_moments(drift, temperature, power + 1)
    return float(moments[power + 1] / moments[1])


def representative_error(drift, temperature, n_representatives):
    """Return the relative standard deviation of the normal velocity's mean over N representatives.

    Drawn from f and weighted by their inward velocity v they have the mean sum v**2 / sum v; to
    first order in 1/N its variance is that of v**2 - m v, m the mean, over N (sum v / N)**2.
    """
    _, first, second, third, fourth = half_moments(drift, temperature, 4)
    mean = second / first
    variance = fourth - 2.0 * mean * third + mean**2 * second
    return math.sqrt(variance / n_representatives) / first / mean
