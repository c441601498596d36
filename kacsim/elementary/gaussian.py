"""The error function's complement and what is made of it.

erfc(x) = exp(-x**2) w(x) for x >= 0, where w varies slowly. It is expanded about the nearest
multiple of 1/8; its Taylor coefficients a_n obey (n + 1) a_(n+1) = 2 c a_n + 2 a_(n-1), since
w' = 2 x w - 2 / sqrt(pi).
"""

import math
from decimal import Decimal

import numpy as np

from kacsim.elementary.bits import ROUNDER
from kacsim.elementary.decimals import PI, precise
from kacsim.elementary.exponential import exp_of_square
from kacsim.kernels.jit import inlined

CELLS = 8  # in 1
LARGEST = 28  # beyond 27.3 erfc is below the smallest number
_ORDER = 13
_CARRIED = 45  # terms that carry the value from cell to cell, downward, where errors shrink


def _coefficients(c, value, n):
    """Return a_0 to a_n at c of the solution with this value there."""
    found = [value, 2 * (c * value - 1 / PI.sqrt())]
    for k in range(1, n):
        found.append(2 * (c * found[k] + found[k - 1]) / (k + 1))
    return found


def _sum(coefficients, d):
    total = Decimal(0)
    for a in reversed(coefficients):
        total = total * d + a
    return total


@precise
def _table():
    """Return float64[cells, 14], the coefficients of each cell, of the highest power first."""
    fraction = Decimal(LARGEST)
    for n in range(200, 0, -1):  # Laplace's continued fraction
        fraction = LARGEST + n / (2 * fraction)
    rows, value = [], 1 / (PI.sqrt() * fraction)
    for k in range(LARGEST * CELLS, -1, -1):
        found = _coefficients(Decimal(k) / CELLS, value, _CARRIED)
        rows.append([float(a) for a in found[_ORDER::-1]])
        value = _sum(found, -1 / Decimal(CELLS))
    return np.array(rows[::-1])


_TAYLOR = _table()


@inlined
def scaled_erfc(x):
    """Return exp(x**2) erfc(x) for 0 <= x <= 28."""
    whole = x * CELLS + ROUNDER
    c = whole - ROUNDER
    k, d = np.int64(c), x - c * (1.0 / CELLS)
    total = _TAYLOR[k, 0]
    for n in range(1, _ORDER + 1):
        total = total * d + _TAYLOR[k, n]
    return total


@inlined
def erfc(x):
    """Return 1 - erf(x)."""
    if not abs(x) <= LARGEST:
        return x if x != x else (0.0 if x > 0.0 else 2.0)
    tail = exp_of_square(x, -1.0) * scaled_erfc(abs(x))
    return tail if x >= 0.0 else 2.0 - tail


@inlined
def normal_cumulative(x):
    """Return the probability that a standard normal variate is below x."""
    if not abs(x) <= LARGEST * math.sqrt(2.0):
        return x if x != x else (1.0 if x > 0.0 else 0.0)
    tail = 0.5 * exp_of_square(x, -0.5) * scaled_erfc(abs(x) * math.sqrt(0.5))
    return tail if x <= 0.0 else 1.0 - tail
