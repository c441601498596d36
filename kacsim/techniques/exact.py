"""Exact results of the chapter: its laws, areas under envelopes, volumes of spheres, exercise 3."""

import math

import numpy as np
from scipy import special

from kacsim.techniques.constants import SUPPORT

CUMULATIVES = {
    "kac_initial": lambda v: 0.5 * special.erfc(-v) - v * np.exp(-v * v) / math.sqrt(math.pi),
    "exponential": lambda v: -np.expm1(-v),
    "ramp": lambda v: (2.0 + v) * v / 3.0,
    "triangle": lambda v: v * v,
}
DENSITIES = {
    "kac_initial": lambda v: 2.0 / math.sqrt(math.pi) * v * v * np.exp(-v * v),
    "exponential": lambda v: np.exp(-v),
    "ramp": lambda v: (2.0 + 2.0 * v) / 3.0,
    "triangle": lambda v: 2.0 * v,
}
# Largest value of each law's density on its support.
TOPS = {
    "kac_initial": 2.0 / math.sqrt(math.pi) / math.e,
    "exponential": 1.0,
    "ramp": 4.0 / 3.0,
    "triangle": 2.0,
}
# |v| exp(-2 v**2 / 3) is the nearest of the |v| exp(-b v**2) above f0: least area at b = 2/3.
NARROW = 2.0 / 3.0
CLOSER_TOP = 2.0 / math.sqrt(math.pi * math.e * 2.0 * (1.0 - NARROW))


def closer_envelope(v):
    """Return the closer envelope of f0 under which `kacsim.techniques.rejection` proposes."""
    return CLOSER_TOP * np.abs(v) * np.exp(-NARROW * np.asarray(v) ** 2)


def envelope_area(law, envelope):
    """Return the area under the envelope: trials per accepted value (chapter, Fig. 11.2)."""
    if envelope == "closer":
        return CLOSER_TOP / NARROW
    low, high = SUPPORT[law]
    return TOPS[law] * (high - low)


def ball_volume(dimension):
    """Return the volume of the unit sphere's part in the unit cube, 2**-d of the whole."""
    return math.pi ** (dimension / 2.0) / math.gamma(dimension / 2.0 + 1.0) / 2.0**dimension


def point_error(dimension):
    """Return the relative error of the volume from one random point; of N points 1/sqrt(N)."""
    share = ball_volume(dimension)
    return math.sqrt((1.0 - share) / share)


def area(exponent):
    """Return the integral of (1 - x**2)**exponent over [-1, 1] (chapter, exercise 3)."""
    return math.sqrt(math.pi) * math.gamma(exponent + 1.0) / math.gamma(exponent + 1.5)


def area_error(exponent, method):
    """Return the relative error of the area from one random point.

    Parameters
    ----------
    exponent : float >= 0
    method : "hits" (share of the points of a rectangle below the curve) or "heights" (mean height)
    """
    share = area(exponent) / 2.0
    square = share if method == "hits" else area(2.0 * exponent) / 2.0
    return math.sqrt(square - share**2) / share


def poisson(mean, most):
    """Return float64[most + 1], p_n of eq. (11.15), from logarithms: exp(-mean) may be lost."""
    n = np.arange(most + 1)
    return np.exp(n * math.log(mean) - mean - special.gammaln(n + 1.0))


def poisson_most(mean):
    """Return a number of particles beyond which eq. (11.15) has less than 1e-15."""
    return math.ceil(mean + 10.0 * math.sqrt(mean) + 30.0)


def binomial(n_samples, share):
    """Return (successes, their probabilities) of a two-valued sample, far tails left out.

    Parameters
    ----------
    n_samples : int >= 2
    share : float, probability of the value 1; the other value is 0
    """
    middle, reach = n_samples * share, 10.0 * math.sqrt(n_samples) + 30.0
    k = np.arange(max(0, math.floor(middle - reach)), min(n_samples, math.ceil(middle + reach)) + 1)
    n = float(n_samples)
    ways = special.gammaln(n + 1.0) - special.gammaln(k + 1.0) - special.gammaln(n - k + 1.0)
    return k, np.exp(ways + k * math.log(share) + (n - k) * math.log1p(-share))


def sample_variance(n_samples, share):
    """Return E S_N**2 / S**2 of a two-valued sample, S_N**2 by eq. (11.7)."""
    k, probability = binomial(n_samples, share)
    mean = k / n_samples
    squares = n_samples / (n_samples - 1.0) * mean * (1.0 - mean)
    return float((probability * squares).sum() / (share * (1.0 - share)))


def coverage(n_samples, share, width):
    """Return the probability that a two-valued sample's mean is near the distribution's.

    Nearer than `width` standard errors S_N / sqrt(N), S_N**2 by eq. (11.7).
    """
    k, probability = binomial(n_samples, share)
    mean = k / n_samples
    error = np.sqrt(mean * (1.0 - mean) / (n_samples - 1.0))
    return float(probability[np.abs(mean - share) <= width * error].sum())


def share_error(n_samples, share):
    """Return the relative root mean square error of a share of independent points, summed up."""
    k, probability = binomial(n_samples, share)
    return float(np.sqrt((probability * (k / n_samples - share) ** 2).sum()) / share)


def step_error(edge, n_places=1000):
    """Return the rms error of the midpoint sum of a step from 1 to 0, over all its places.

    Parameters
    ----------
    edge : int, M, points k - 1/2 over M of the unit interval
    n_places : int, places of the step per cell
    """
    place = (np.arange(edge * n_places) + 0.5) / (edge * n_places)
    return float(np.sqrt(np.mean((np.floor(place * edge + 0.5) / edge - place) ** 2)))
