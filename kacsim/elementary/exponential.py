"""exp and expm1.

exp(x) = 2**e T_j exp(r) with x = (128 e + j) log(2) / 128 + r, T_j = 2**(j / 128) from a table and
|r| <= log(2) / 256, whose powers to the fifth are enough.
"""

import numpy as np

from kacsim.elementary.bits import ROUNDER, UPPER_26, bits_of, float_of, power_of_two
from kacsim.elementary.decimals import LN2, cut, precise, rounded
from kacsim.kernels.jit import apart, inlined

PARTS = 128  # of a power of two
_ROUNDER_BITS = int(np.float64(ROUNDER).view(np.int64))
LARGEST_EXPONENT, LEAST_EXPONENT = 709.782712893384, -745.1332191019412


@precise
def _tables():
    """Return log(2) / 128 in two parts, its inverse, float64[128] of T_j in two parts."""
    step = LN2 / PARTS
    powers = [(step * j).exp() for j in range(PARTS)]
    return (*cut(step, 2.0**-40), float(1 / step), *map(np.array, rounded(powers)))


_STEP, _STEP_LOW, _STEPS, _POWER, _POWER_LOW = _tables()
_POWER_BITS, _RELATIVE_LOW = _POWER.view(np.int64), _POWER_LOW / _POWER


@inlined
def reduced(x):
    """Return (128 e + j, r) of an argument of exp."""
    whole = x * _STEPS + ROUNDER
    many = whole - ROUNDER
    return bits_of(whole) - np.int64(_ROUNDER_BITS), (x - many * _STEP) - many * _STEP_LOW


@inlined
def curved(r):
    """Return exp(r) - 1 - r for |r| <= log(2) / 256."""
    square = r * r
    return square * ((0.5 + r * (1.0 / 6.0)) + square * (1.0 / 24.0 + r * (1.0 / 120.0)))


@inlined
def exp(x):
    """Return e**x."""
    return exp_of_sum(x, 0.0)


@inlined
def exp_of_sum(x, more):
    """Return e**(x + more) for a `more` that is small beside x or 1."""
    if not -708.0 <= x <= 709.0:
        return _exp_at_the_ends(x, more)
    k, r = reduced(x)
    r += more
    j, e = k & np.int64(PARTS - 1), k >> np.int64(7)
    power = float_of(_POWER_BITS[j] + (e << np.int64(52)))
    return power + power * ((r + _RELATIVE_LOW[j]) + curved(r))


@apart
def _exp_at_the_ends(x, more):
    """Return the same where it, or 2**e, is beyond the range of normal numbers."""
    if not LEAST_EXPONENT <= x <= LARGEST_EXPONENT:
        return x if x != x else (np.inf if x > 0.0 else 0.0)
    k, r = reduced(x)
    r += more
    j, e = k & np.int64(PARTS - 1), k >> np.int64(7)
    y = _POWER[j] + _POWER[j] * ((r + _RELATIVE_LOW[j]) + curved(r))
    half = e >> np.int64(1)
    return y * power_of_two(half) * power_of_two(e - half)


@inlined
def exp_of_square(x, factor):
    """Return e**(factor x**2) for a power of two or its negative: the square rounds nothing."""
    upper = float_of(bits_of(x) & UPPER_26)
    return exp_of_sum(factor * (upper * upper), factor * ((x - upper) * (x + upper)))


@inlined
def expm1(x):
    """Return e**x - 1 without cancellation."""
    if not -40.0 <= x <= 700.0:
        return exp(x) - 1.0
    if abs(x) < 2.0**-7:  # too near 0 for a difference with 1
        square = x * x
        tail = 1.0 / 24.0 + x * (1.0 / 120.0 + x * (1.0 / 720.0 + x * (1.0 / 5040.0)))
        return x + square * (0.5 + x * (1.0 / 6.0 + x * tail))
    k, r = reduced(x)
    j, scale = k & np.int64(PARTS - 1), power_of_two(k >> np.int64(7))
    cube = r * r * r
    high, low, rest = scale * _POWER[j], scale * _POWER_LOW[j], curved(r) + cube * cube / 720.0
    less = high - 1.0
    if 0.5 <= high <= 2.0:  # so that `less` is exact: add r to it exactly, then what is small
        total = less + r
        part = total - less
        lost = (less - (total - part)) + (r - part)
        return total + (lost + (less * r + (low + high * rest)))
    lost = (high - less) - 1.0 if high > 1.0 else high - (less + 1.0)
    return less + (lost + (low + high * (r + rest)))
