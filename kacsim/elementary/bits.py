"""The bits of numbers."""

import numpy as np

from kacsim.kernels.jit import inlined

UPPER_HALF = np.int64(-(2**32))  # mask of 21 bits of a float64's 53
UPPER_26 = np.int64(-(2**27))  # of 26
# Added to a number below 2**51 it rounds it to a whole one, which its low bits then are.
ROUNDER = 1.5 * 2.0**52


@inlined
def bits_of(x):
    """Return the bits of a float64 as an int64."""
    return np.float64(x).view(np.int64)


@inlined
def float_of(bits):
    """Return the float64 of an int64's bits."""
    return np.int64(bits).view(np.float64)


@inlined
def power_of_two(n):
    """Return 2.0**n for -1022 <= n <= 1023."""
    return float_of((n + np.int64(1023)) << np.int64(52))
