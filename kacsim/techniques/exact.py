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
CLOSER_TOP = 2.0 / math.sqrt(math.pi) * math.exp(-0.5) / math.sqrt(2.0 * (1.0 - NARROW))


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
