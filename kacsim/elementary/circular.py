"""Cosine and sine.

An angle is theta + d, theta the nearest of 256 on the circle; next to the axes, where one of the
two is small, theta is on the axis.
"""

import numpy as np

from kacsim.elementary.bits import ROUNDER, bits_of
from kacsim.elementary.decimals import PI, cosines, cut, precise, rounded
from kacsim.kernels.jit import inlined

PARTS = 256  # of the circle
LARGEST_ANGLE = 10_000.0


@precise
def _tables():
    """Return the step in three parts, its inverse, and float64[PARTS, 4].

    The columns are cosine and sine of theta, and what they lack. A whole number of steps below
    2**19 times each of the first two parts is exact.
    """
    step, turned = 2 * PI / PARTS, PARTS // 4
    high, low = map(np.array, rounded(cosines(PARTS)))
    # sin(theta) = cos(theta - pi / 2)
    circle = np.stack([high, np.roll(high, turned), low, np.roll(low, turned)], axis=1)
    return (*cut(step, 2.0**-39, 2.0**-73), float(1 / step), circle)


_STEP_1, _STEP_2, _STEP_3, _STEPS, _CIRCLE = _tables()


@inlined
def cos_sin(x):
    """Return (cos(x), sin(x)) of an angle in radians; nan beyond `LARGEST_ANGLE`."""
    if not abs(x) <= LARGEST_ANGLE:
        return np.nan, np.nan
    whole = x * _STEPS + ROUNDER
    many, k = whole - ROUNDER, bits_of(whole)
    beside = (k + np.int64(1)) & np.int64(PARTS // 4 - 1)
    if beside == 0:
        many, k = many + 1.0, k + np.int64(1)
    elif beside == 2:
        many, k = many - 1.0, k - np.int64(1)
    k &= np.int64(PARTS - 1)
    cos, sin, cos_low, sin_low = _CIRCLE[k, 0], _CIRCLE[k, 1], _CIRCLE[k, 2], _CIRCLE[k, 3]
    # d and what it lacks
    rest, second = x - many * _STEP_1, many * _STEP_2
    d = rest - second
    lacking = ((rest - d) - second) - many * _STEP_3
    # sin(d) - d and cos(d) - 1
    s = d * d
    odd = (-1.0 / 6.0 + s * (1.0 / 120.0)) + s * s * (-1.0 / 5040.0 + s * (1.0 / 362880.0))
    even = (-0.5 + s * (1.0 / 24.0)) + s * s * (-1.0 / 720.0 + s * (1.0 / 40320.0))
    odd, even = d * s * odd + lacking, s * even
    return (
        cos - (sin * d - ((cos * even - sin * odd) + cos_low)),
        sin + (cos * d + ((sin * even + cos * odd) + sin_low)),
    )
