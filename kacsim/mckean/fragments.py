"""Random fragmentations: the leaves of a tilted tree of McKean's, drawn from the root.

Under the native law a node splits at rate 1. The tilted law has the density prod(1 + b rho_i) /
Q(b, t) with respect to it: a node of share rho with s still to go splits at the native rate with
the native U, and in addition at rate kappa x**2 / (1 + x), x = b rho exp(-kappa s), with U of
density proportional to U (1 - U) times the native one.
"""

import math

import numpy as np

from kacsim.elementary.exponential import exp, expm1
from kacsim.elementary.logarithm import log1p
from kacsim.kernels.jit import allocating, inlined
from kacsim.mckean.constants import BKW
from kacsim.mckean.laws import KAPPA
from kacsim.variates import exponential, squared_cosine, uniform, unit_circle

DEPTH = 4096  # nodes that wait; a path of so many splits does not occur
SHARE, LEFT = range(2)  # columns of the nodes that wait


@inlined
def native(u, law, stream):
    """Return the part of a native split; u is uniform, and is used where the part is."""
    return u if law == BKW else squared_cosine(stream)


@inlined
def biased(law, stream):
    """Return the part of an additional split: Beta(2, 2), or Beta(3/2, 3/2) for Kac's law."""
    if law == BKW:  # the middle one of three
        a, b, c = uniform(stream), uniform(stream), uniform(stream)
        return max(min(a, b), min(max(a, b), c))
    # A coordinate of a uniform point in the disc.
    cos, _ = unit_circle(stream)
    return 0.5 + 0.5 * cos * math.sqrt(uniform(stream))


@inlined
def splits(share, left, u, b, law, stream):
    """Return the part of a split at a candidate of the rate `most_splits`; 0 if there is none.

    u is uniform up to that rate: the native rate is 1.
    """
    if u < 1.0:
        return native(u, law, stream)
    kappa = KAPPA[law]
    x = b * share * exp(-kappa * left)
    return biased(law, stream) if (u - 1.0) * (1.0 + x) < kappa * x * x else 0.0


@inlined
def most_splits(share, b, law):
    """Return the largest rate of splits in the life of a node: x grows to b rho."""
    most = b * share
    return 1.0 + KAPPA[law] * most * most / (1.0 + most)


@allocating
def waiting_nodes():
    """Return the nodes that wait for their turn, float64[DEPTH, 2]: share, time still to go."""
    return np.empty((DEPTH, 2))


@inlined
def first_split(time, b, law, waiting, stream):
    """Put the two nodes after the first split into `waiting`, given that there is one; return 2.

    The first candidate comes from the exponential law that is cut at `time` > 0.
    """
    rate = most_splits(1.0, b, law)
    happens = expm1(-rate * time)
    while True:
        left = time + log1p(uniform(stream) * happens) / rate
        while left > 0.0:
            part = splits(1.0, left, uniform(stream) * rate, b, law, stream)
            if part > 0.0:
                waiting[0, SHARE], waiting[1, SHARE] = 1.0 - part, part
                waiting[0, LEFT], waiting[1, LEFT] = left, left
                return 2
            left -= exponential(stream) / rate


@inlined
def next_end(level, b, law, cut, waiting, stream):
    """Follow the last waiting node to an end of the tree.

    Parameters
    ----------
    level : number of nodes that wait, >= 1
    b, law : of the tilt
    cut : a node of a smaller share ends where it is
    waiting : of `waiting_nodes`, changed

    Returns
    -------
    (number of nodes that wait or -1 if there is no room, share of the end, time still to go there:
    0 at a leaf)
    """
    level -= 1
    share, left = waiting[level, SHARE], waiting[level, LEFT]
    while share >= cut:
        rate = most_splits(share, b, law)
        left -= exponential(stream) / rate
        if left <= 0.0:
            return level, share, 0.0
        part = splits(share, left, uniform(stream) * rate, b, law, stream)
        if part > 0.0:
            if level >= DEPTH:
                return -1, share, left
            waiting[level, SHARE], waiting[level, LEFT] = share - share * part, left
            level += 1
            share *= part
    return level, share, left
