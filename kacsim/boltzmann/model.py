"""What the trees of all estimators share: leaves, collisions, and the walk over a tree.

Algorithm 1 of the Boltzmann paper is the general form. Its collisions keep the product of the
equilibrium M over the pair, so that an estimate is M at the probe times the product over the
leaves of f(0) / M (the text's own argument for the null variance): no weight can overflow.

Two laws are known: `BKW_LAW`, Maxwell molecules in three dimensions with the sampling laws of
eq. (10), and `KAC_LAW`, the one-dimensional Kac equation. The initial conditions and the
collisions are isotropic, so that a node needs only its energy x, in units of that of a standard
normal velocity per axis.
"""

import math

import numpy as np
from numba import int64

from kacsim.elementary.exponential import exp
from kacsim.kernels.jit import allocating, inlined
from kacsim.variates import exponential, half_normal, squared_cosine, uniform

BKW_LAW, KAC_LAW = 0, 1
MOST_COPIES = 2.0**53  # whole numbers of sub-estimates, more than any budget
DEPTH = 4096  # levels of the stack; a path of so many collisions within the time does not occur
# Columns of the two workspaces of `tree`, a row per level.
SECOND, WHEN, ENERGY, SUM, FIRST_MEAN = range(5)
SIDE, LEFT, COPIES = range(3)
BKW_LEAF = 25.0 / 27.0 * math.sqrt(5.0 / 3.0)
KAC_LEAF = 3.0 * math.sqrt(3.0)


@inlined
def bkw_leaf(x):
    """Return f(c; 0) / M(c) of the BKW mode, x = c**2 / c_q**2 (Boltzmann paper, eq. 18)."""
    return BKW_LEAF * x * exp(-x / 3.0)


@inlined
def kac_leaf(x):
    """Return f0 / M of the Kac paper, x = v**2 / (3/2), M of eq. (9): 3 sqrt(3) x exp(-x)."""
    return KAC_LEAF * x * exp(-x)


@inlined
def bkw_scatter(x, stream):
    """Return (x', x'*) after an isotropic collision with a Maxwellian partner.

    With T = x + x* and z the component of c* along c, x' = T/2 + mu sqrt(T**2 - 4 x z**2) / 2 and
    x'* = T - x', mu uniform on (-1, 1).
    """
    z = half_normal(stream)
    total = x + z * z + 2.0 * exponential(stream)
    reach = 0.5 * math.sqrt(max(0.0, total * total - 4.0 * x * z * z))
    after = 0.5 * total + (2.0 * uniform(stream) - 1.0) * reach
    return after, total - after


@inlined
def kac_scatter(x, stream):
    """Return (x', w') after a rotation with a Maxwellian partner by a uniform angle."""
    z = half_normal(stream)
    total = x + z * z
    after = total * squared_cosine(stream)
    return after, total - after


@inlined
def copies(oversampling, stream):
    """Return a number of sub-estimates, floor(m) or one more, of mean m."""
    whole = int64(min(oversampling, MOST_COPIES))
    return whole + int64(uniform(stream) < oversampling - whole)


@allocating
def workspace():
    """Return what `tree` keeps of every level.

    Returns
    -------
    (float64[DEPTH, 5], int64[DEPTH, 3]): energy x'* of the second side, time, energy of the side
    under way, sum of its sub-estimates, mean of the first side; side, sub-estimates left, and
    their number
    """
    return np.empty((DEPTH, 5)), np.empty((DEPTH, 3), np.int64)


@inlined
def tree(law, x, time, oversampling, onset, max_nodes, stack, counts, stream):
    """Return (F / M, nodes) of one realization; nodes is -1 if the budget is exceeded.

    Parameters
    ----------
    law : BKW_LAW or KAC_LAW
    x, time : energy of the probe, and t in mean collision times
    oversampling : m >= 1, mean number of sub-estimates behind each side of a collision
    onset : collisions before this time are not oversampled; 0 oversamples everywhere
    max_nodes : int, budget
    stack, counts : of `workspace`, overwritten
    """
    level, nodes = 0, 0
    while True:
        nodes += 1
        time -= exponential(stream)
        if time > 0.0:
            if nodes >= max_nodes or level >= DEPTH:
                return 0.0, -1
            if law == BKW_LAW:
                first, second = bkw_scatter(x, stream)
            else:
                first, second = kac_scatter(x, stream)
            stack[level, SECOND], stack[level, WHEN], stack[level, ENERGY] = second, time, first
            stack[level, SUM] = 0.0
            counts[level, SIDE] = 0
            more = oversampling if time > onset else 1.0
            counts[level, LEFT] = counts[level, COPIES] = copies(more, stream)
            level += 1
            x = first
            continue
        value = bkw_leaf(x) if law == BKW_LAW else kac_leaf(x)
        while level > 0:
            top = level - 1
            stack[top, SUM] += value
            counts[top, LEFT] -= 1
            if counts[top, LEFT] > 0:
                break
            value = stack[top, SUM] / counts[top, COPIES]
            if counts[top, SIDE] == 0:
                stack[top, FIRST_MEAN], stack[top, SUM] = value, 0.0
                stack[top, ENERGY] = stack[top, SECOND]
                counts[top, SIDE] = 1
                more = oversampling if stack[top, WHEN] > onset else 1.0
                counts[top, LEFT] = counts[top, COPIES] = copies(more, stream)
                break
            value *= stack[top, FIRST_MEAN]
            level -= 1
        if level == 0:
            return value, nodes
        x, time = stack[level - 1, ENERGY], stack[level - 1, WHEN]


@inlined
def speed_beyond(threshold, stream):
    """Return (c_f, c_f**2 / p(c_f)) with c_f drawn from p of eq. (19), c_q = 1.

    Its cumulative function is inverted: c_f - c0 = width (1/u - 1) with p = width / (width + x)**2.
    """
    width = threshold / (threshold * threshold - 2.0) if threshold > 2.0 else 2.0
    u = 1.0 - uniform(stream)
    beyond = width * (1.0 / u - 1.0)
    speed = threshold + beyond
    return speed, speed * speed * (width + beyond) ** 2 / width


@inlined
def shell(radius, variance):
    """Return 4 pi times the normal density of a variance per axis at a radius."""
    bell = exp(-0.5 * radius * radius / variance)
    return math.sqrt(2.0 / math.pi) * bell / (variance * math.sqrt(variance))
