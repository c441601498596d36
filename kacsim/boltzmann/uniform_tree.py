"""Algorithm 6 in a uniform gas: null collisions at a raised frequency (Boltzmann paper, section V).

What is left of it without the trap: W = W1 + a (W3 W4 - W1 W2), a node is its energy.
"""

import numpy as np

from kacsim.boltzmann.model import DEPTH, bkw_leaf, bkw_scatter
from kacsim.kernels.jit import kernel
from kacsim.variates import exponential, half_normal

PARTNER, AFTER, PARTNER_AFTER, WHEN, W1, W2, W3 = range(7)  # columns of the stack
BRANCHES = 4


@kernel
def estimate_moment(values, nodes, ratio, time, max_nodes, stream):
    """Draw realizations of f / M at velocities drawn from M: mean 1, mean square G(t).

    Parameters
    ----------
    values : float64[n], overwritten
    nodes : int64[n], overwritten by the numbers of t' drawings; -1 marks an exceeded budget
    ratio : raised frequency over kappa eta
    time : in mean collision times
    max_nodes : int, budget of one realization
    stream : from `new_stream`, advanced

    Returns
    -------
    bool, False if a realization exceeded the budget
    """
    stack, branches = np.empty((DEPTH, 7)), np.empty(DEPTH, np.int64)
    share = 1.0 / ratio
    for k in range(values.size):
        z = half_normal(stream)
        x, here, level = z * z + 2.0 * exponential(stream), time, 0
        nodes[k] = 0
        while True:
            nodes[k] += 1
            here -= exponential(stream) * share
            if here > 0.0:
                if nodes[k] >= max_nodes or level >= DEPTH:
                    nodes[k] = -1
                    return False
                after, partner_after = bkw_scatter(x, stream)
                stack[level, PARTNER] = after + partner_after - x
                stack[level, AFTER], stack[level, PARTNER_AFTER] = after, partner_after
                stack[level, WHEN], branches[level] = here, 0
                level += 1
                continue
            value = bkw_leaf(x)
            while level > 0:
                row, branch = stack[level - 1], branches[level - 1] + 1
                if branch < BRANCHES:
                    branches[level - 1] = branch
                    row[W1 + branch - 1] = value
                    x, here = row[branch - 1], row[WHEN]
                    break
                value = row[W1] + share * (row[W3] * value - row[W1] * row[W2])
                level -= 1
            if level == 0:
                break
        values[k] = value
    return True


def uniform_moment(majorant, time, *, max_nodes):
    """Return the kernel at one raised frequency and time: callable(values, nodes, stream)."""
    fixed = float(majorant), float(time), max_nodes
    return lambda values, nodes, stream: estimate_moment(values, nodes, *fixed, stream)
