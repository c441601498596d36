"""Sums in the order of the values: numpy adds in an order of its own choice."""

import numpy as np

from kacsim.kernels.jit import kernel


@kernel
def add_powers(values, sums):
    """Add up the powers 1, 2, ... of values.

    Parameters
    ----------
    values : float64[n]
    sums : float64[m], one for each power, modified in place
    """
    total = np.zeros(sums.size)
    for value in values:
        power = 1.0
        for k in range(sums.size):
            power *= value
            total[k] += power
    for k in range(sums.size):
        sums[k] += total[k]
