"""log, log1p and powers.

log(x) = k log(2) - log(c_i) + log(1 + f) with x = 2**k z, c_i from a table, near 1 / z, and
f = z c_i - 1, which is exact as a sum of two numbers since c_i has nine bits.
"""

from decimal import Decimal

import numpy as np

from kacsim.elementary.bits import UPPER_26, UPPER_HALF, bits_of, float_of
from kacsim.elementary.decimals import LN2, cut, precise
from kacsim.elementary.exponential import exp_of_sum
from kacsim.kernels.jit import apart, inlined

PARTS = 128  # of the interval of z, from 11/16 to 11/8: 1 is inside
_LOWEST = 0x3FE6000000000000  # bits of 11/16
_LN2_HIGH, _LN2_LOW = cut(LN2, 2.0**-42)
_LEAST_NORMAL, _LARGEST = 2.0**-1022, 2.0**1023 * (2.0 - 2.0**-52)


@precise
def _tables():
    """Return float64[PARTS] of c_i, and of -log(c_i) in two parts."""
    middles = [np.int64(_LOWEST + ((2 * i + 1) << 44)).view(np.float64) for i in range(PARTS)]
    # 1 on both sides of x = 1, so that f is exact and small there.
    inverses = [round(512.0 / z) / 512.0 if abs(z - 1.0) > 2.0**-7 else 1.0 for z in middles]
    logs = [cut(-Decimal(c).ln(), 2.0**-42) for c in inverses]
    return np.array(inverses), *np.array(logs).T.copy()


_INVERSE, _LOG, _LOG_LOW = _tables()


@inlined
def parts_of_log(x):
    """Return (f, log(x) in two parts but for the series in f, what f lacks), x > 0 and normal."""
    bits = bits_of(x)
    place = bits - np.int64(_LOWEST)
    i, k = (place >> np.int64(45)) & np.int64(PARTS - 1), place >> np.int64(52)
    z_bits = bits - (k << np.int64(52))
    z, upper, c = float_of(z_bits), float_of(z_bits & UPPER_HALF), _INVERSE[i]
    one, two = upper * c - 1.0, (z - upper) * c
    f, many = one + two, float(k)
    whole = many * _LN2_HIGH + _LOG[i]  # exact: both have no bits below 2**-42
    total = whole + f
    return f, total, ((whole - total) + f) + (many * _LN2_LOW + _LOG_LOW[i]), two - (f - one)


@inlined
def curved(f):
    """Return log(1 + f) - f for |f| < 2**-7."""
    square = f * f
    last = (-1.0 / 6.0 + f * (1.0 / 7.0)) - square * 0.125
    return square * ((-0.5 + f * (1.0 / 3.0)) + square * ((-0.25 + f * 0.2) + square * last))


@inlined
def log(x):
    """Return the natural logarithm: -inf at 0, nan below."""
    if not _LEAST_NORMAL <= x <= _LARGEST:
        return _log_at_the_ends(x)
    f, total, lost, _ = parts_of_log(x)
    return total + (lost + curved(f))


@apart
def _log_at_the_ends(x):
    """Return the same of what is no normal number above 0."""
    if not 0.0 < x <= _LARGEST:
        return -np.inf if x == 0.0 else (x if x > 0.0 else np.nan)
    f, total, lost, _ = parts_of_log(x * 2.0**54)
    total -= 54.0 * _LN2_HIGH
    return total + (lost + curved(f) - 54.0 * _LN2_LOW)


@inlined
def log1p(x):
    """Return log(1 + x) without cancellation: -inf at -1, nan below."""
    if not -1.0 < x <= 2.0**53:
        return log(1.0 + x)
    y = 1.0 + x
    lacking = x - (y - 1.0) if x < 1.0 else 1.0 - (y - x)
    f, total, lost, _ = parts_of_log(y)
    return total + (lost + (curved(f) + lacking / y))


@inlined
def power(x, y):
    """Return x**y for x >= 0 and |y| <= 256."""
    if not _LEAST_NORMAL <= x <= _LARGEST:
        return _power_at_the_ends(x, y)
    f, total, lost, lacking = parts_of_log(x)
    return exp_of_product(y, total, lost + (curved(f) + lacking))


@apart
def _power_at_the_ends(x, y):
    """Return the same of what is no normal number above 0."""
    if y == 0.0:
        return 1.0
    if not 0.0 < x <= _LARGEST:
        if not x >= 0.0:
            return np.nan
        return np.inf if (x == 0.0) == (y < 0.0) else 0.0
    f, total, lost, lacking = parts_of_log(x * 2.0**54)
    total -= 54.0 * _LN2_HIGH
    return exp_of_product(y, total, lost + (curved(f) + lacking) - 54.0 * _LN2_LOW)


@inlined
def exp_of_product(y, high, low):
    """Return e**(y (high + low)), the product of y and their sum being exact to two numbers."""
    whole = high + low
    high, low = whole, low - (whole - high)
    y_upper, upper = float_of(bits_of(y) & UPPER_26), float_of(bits_of(high) & UPPER_26)
    y_lower, lower = y - y_upper, high - upper
    product = y * high
    lost = ((y_upper * upper - product) + y_upper * lower + y_lower * upper) + y_lower * lower
    return exp_of_sum(product, lost + y * low)
