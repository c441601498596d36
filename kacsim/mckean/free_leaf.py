"""The same by trees whose leaves keep their values: one leaf, the largest, is integrated out.

For comparison with `contour`: what each step of the way there buys.
"""

import math

import numpy as np

from kacsim.elementary.exponential import exp
from kacsim.elementary.gaussian import normal_cumulative
from kacsim.elementary.logarithm import log1p
from kacsim.kernels.jit import inlined, kernel
from kacsim.mckean import constants
from kacsim.mckean.contour import BEYOND, DENSITY, TAIL
from kacsim.mckean.fragments import LEFT, SHARE, native, next_end, waiting_nodes
from kacsim.mckean.laws import BETA, ELL, KAPPA, product_mean, saddle_point
from kacsim.variates import (
    failures_before_success,
    gap_scale,
    index_below,
    maxwell_speed,
    normal,
    uniform,
)

ROOT_2PI = math.sqrt(2.0 * math.pi)
CONSTANT, SQUARE = np.array(constants.CONSTANT), np.array(constants.SQUARE)
VARIANCE_0 = 2.0 * ELL  # of the normal factor of one component's initial law


@inlined
def leaf_value(theta, law, stream):
    """Return x of density proportional to g0(x) exp(theta x), g0 one component's initial law."""
    variance = VARIANCE_0[law]
    mean, deviation = variance * theta, math.sqrt(variance)
    constant = CONSTANT[law]
    if uniform(stream) * (constant + SQUARE[law] * (mean * mean + variance)) < constant:
        return mean + deviation * normal(stream)
    # Of density (mean + deviation z)**2: |z| from the even part, then its sign.
    if uniform(stream) * (mean * mean + variance) < mean * mean:
        part = deviation * normal(stream)
    else:
        part = deviation * math.sqrt(2.0) * maxwell_speed(stream)
    plus, minus = (mean + part) ** 2, (mean - part) ** 2
    return mean + part if uniform(stream) * (plus + minus) < plus else mean - part


@inlined
def of_last(quantity, v, rest, share, law):
    """Return the quantity at v for a sum of `rest` and one leaf of a share."""
    a, variance = math.sqrt(share), VARIANCE_0[law]
    y = (v - rest) / a
    bell = exp(-0.5 * y * y / variance) / (ROOT_2PI * math.sqrt(variance))
    polynomial = CONSTANT[law] + SQUARE[law] * y * y
    if quantity == DENSITY:
        return bell * polynomial / a
    tail = normal_cumulative(-y / math.sqrt(variance)) + SQUARE[law] * variance * y * bell
    if quantity == TAIL:
        return tail
    if quantity == BEYOND:
        return 2.0 * (tail + v * bell * polynomial / a)
    slope = bell * y * (2.0 * SQUARE[law] - polynomial / variance)
    return -slope / (share * 2.0 * math.pi * v)


@inlined
def add(share, largest, rest, eta, law, stream):
    """Return (largest share so far, sum of the values of the others) with one more leaf."""
    drawn, largest = min(share, largest), max(share, largest)
    if drawn > 0.0:
        a = math.sqrt(drawn)
        rest += a * leaf_value(eta * a, law, stream)
    return largest, rest


@kernel
def estimate(values, nodes, quantity, v, time, scale, law, max_nodes, stream):
    """Draw realizations by tilted trees with leaf values; arguments as `contour.estimate`."""
    eta = saddle_point(v, time, law)
    b = BETA[law] * eta * eta
    waiting = waiting_nodes()
    gathered, mean = product_mean(b, time, law)
    for k in range(values.size):
        waiting[0, SHARE], waiting[0, LEFT] = 1.0, time
        level, ends, largest, rest = 1, 0, 0.0, 0.0
        while level > 0:
            level, share, _ = next_end(level, b, law, 0.0, waiting, stream)
            ends += 1
            if level < 0 or ends + level > max_nodes:
                nodes[k] = -1
                return False
            largest, rest = add(share, largest, rest, eta, law, stream)
        growth = gathered + ELL[law] * eta * eta * (1.0 - largest) - eta * rest - scale
        weight = mean * exp(growth) / (1.0 + b * largest)
        values[k], nodes[k] = weight * of_last(quantity, v, rest, largest, law), ends
    return True


@inlined
def next_of_counted(level, law, waiting, stream):
    """Follow the last waiting node, of a share and a number of leaves, to a leaf.

    A uniform one of the leaves splits each time: so the number on one side is uniform.

    Returns
    -------
    (number of nodes that wait, share)
    """
    level -= 1
    share, leaves = waiting[level, SHARE], waiting[level, LEFT]
    while leaves > 1.0:
        one = 1.0 + index_below(int(leaves) - 1, stream)
        part = native(uniform(stream), law, stream)
        fewer = min(one, leaves - one)
        # The larger side waits, so that few do.
        waiting[level, SHARE], waiting[level, LEFT] = share - share * part, leaves - fewer
        level, share, leaves = level + 1, share * part, fewer
    return level, share


@kernel
def estimate_geometric(values, nodes, quantity, v, time, scale, law, max_nodes, stream):
    """Draw realizations by trees of the native law, the number of leaves geometric.

    Its mean is that of the tilted tree; arguments as `contour.estimate`.
    """
    eta = saddle_point(v, time, law)
    b = BETA[law] * eta * eta
    x = b * exp(-KAPPA[law] * time)
    native_p = exp(-time)
    p = 1.0 / (1.0 + (1.0 / native_p - 1.0) * (1.0 + KAPPA[law] * x * x / (1.0 + x)))
    scale_of_gap, waiting = gap_scale(p), waiting_nodes()
    more = log1p(-native_p) - log1p(-p) if time > 0.0 else 0.0
    for k in range(values.size):
        leaves = 1 + (failures_before_success(scale_of_gap, stream) if time > 0.0 else 0)
        if leaves > max_nodes:
            nodes[k] = -1
            return False
        waiting[0, SHARE], waiting[0, LEFT] = 1.0, float(leaves)
        level, largest, rest, product = 1, 0.0, 0.0, 1.0
        while level > 0:
            level, share = next_of_counted(level, law, waiting, stream)
            product *= 1.0 + b * share
            largest, rest = add(share, largest, rest, eta, law, stream)
        growth = ELL[law] * eta * eta * (1.0 - largest) - eta * rest - scale
        weight = native_p / p * exp((leaves - 1) * more + growth) * product / (1.0 + b * largest)
        values[k], nodes[k] = weight * of_last(quantity, v, rest, largest, law), leaves
    return True
