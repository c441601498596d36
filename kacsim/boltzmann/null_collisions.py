"""Algorithm 4 of the Boltzmann paper: extinction alone, with null collisions (section III)."""

import numpy as np
from numba import int64

from kacsim.boltzmann.model import DEPTH
from kacsim.kernels.jit import kernel
from kacsim.variates import exponential


@kernel
def estimate(values, nodes, time, ratio, max_nodes, stream):
    """Draw realizations of f(t) / f0 by Algorithm 4.

    The stack holds, per collision under way, its time, and its first sub-estimate once known.

    Parameters
    ----------
    values : float64[n], overwritten
    nodes : int64[n], overwritten by the numbers of t' drawings; -1 marks an exceeded budget
    time : alpha f0 t
    ratio : majorant / (alpha f0)
    max_nodes : int, budget of one realization
    stream : from `new_stream`, advanced

    Returns
    -------
    bool, False if a realization exceeded the budget
    """
    times, firsts, sides = np.empty(DEPTH), np.empty(DEPTH), np.empty(DEPTH, np.int64)
    for k in range(values.size):
        level, here = 0, time
        nodes[k] = 0
        while True:
            nodes[k] += 1
            here -= exponential(stream) / ratio
            if here > 0.0:
                if nodes[k] >= max_nodes or level >= DEPTH:
                    nodes[k] = -1
                    return False
                times[level], sides[level] = here, 0
                level += 1
                continue
            value = 1.0
            while level > 0 and sides[level - 1] == 1:
                level -= 1
                value = firsts[level] * (1.0 - value / ratio)
            if level == 0:
                break
            firsts[level - 1], sides[level - 1] = value, int64(1)
            here = times[level - 1]
        values[k] = value
    return True


def extinction(majorant, time, *, max_nodes):
    """Return Algorithm 4 in units of f0 and 1 / (alpha f0): callable(values, nodes, stream)."""
    fixed = float(time), float(majorant), max_nodes
    return lambda values, nodes, stream: estimate(values, nodes, *fixed, stream)
