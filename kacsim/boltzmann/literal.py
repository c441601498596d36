"""Algorithm 2 as printed: plain recursion, vectors and weights of the Boltzmann paper's section II.

The reference of `bkw_tree`: slower, but with nothing worked out beforehand. It shows the null
variance at equilibrium, is the baseline of the benchmark, and records trees for Fig. 2.
"""

import math

import numpy as np

from kacsim.kernels.jit import inlined, kernel
from kacsim.variates import exponential, half_normal, random_sign, uniform


@inlined
def normal(stream):
    """Return a standard normal variate."""
    return half_normal(stream) * random_sign(stream)


@inlined
def start(square, equilibrium):
    """Return f(c; 0) for c**2, c_q = 1: the equilibrium (eq. 11) or the BKW mode (eq. 18)."""
    if equilibrium:
        return math.exp(-0.5 * square) / math.sqrt(2.0 * math.pi) ** 3
    return 5.0 / 9.0 * square * math.exp(-square / 1.2) / math.sqrt(1.2 * math.pi) ** 3


@inlined
def isotropic(stream):
    """Return a uniform point of the unit sphere."""
    z = 2.0 * uniform(stream) - 1.0
    angle = 2.0 * math.pi * uniform(stream)
    level = math.sqrt(1.0 - z * z)
    return level * math.cos(angle), level * math.sin(angle), z


@inlined
def collision(x, y, z, stream):
    """Return (c', c'*, c***2) of eq. (6) with c* Maxwellian and u' isotropic: seven numbers."""
    ox, oy, oz = normal(stream), normal(stream), normal(stream)
    ux, uy, uz = isotropic(stream)
    gap = math.sqrt((x - ox) ** 2 + (y - oy) ** 2 + (z - oz) ** 2)
    mx, my, mz = 0.5 * (x + ox), 0.5 * (y + oy), 0.5 * (z + oz)
    hx, hy, hz = 0.5 * gap * ux, 0.5 * gap * uy, 0.5 * gap * uz
    square = ox * ox + oy * oy + oz * oz
    return mx + hx, my + hy, mz + hz, mx - hx, my - hy, mz - hz, square


@kernel
def probe(x, y, z, time, equilibrium, nodes, stream):
    """Return one estimate of f(c; t) by Algorithm 2, calling itself.

    Parameters
    ----------
    x, y, z, time : velocity in c_q and t in mean collision times
    equilibrium : bool, start from eq. (11) in place of eq. (18)
    nodes : int64[1], raised by the number of t' drawings
    stream : uint64[4], advanced
    """
    nodes[0] += 1
    time -= exponential(stream)
    if time <= 0.0:
        return start(x * x + y * y + z * z, equilibrium)
    ax, ay, az, bx, by, bz, square = collision(x, y, z, stream)
    first = probe(ax, ay, az, time, equilibrium, nodes, stream)
    second = probe(bx, by, bz, time, equilibrium, nodes, stream)
    return math.sqrt(2.0 * math.pi) ** 3 * math.exp(0.5 * square) * first * second


@kernel
def estimate(values, nodes, speed, time, equilibrium, stream):
    """Draw realizations of f / M at a probe on the x axis; arrays as in `bkw_tree.estimate`.

    Returns
    -------
    bool, True: there is no budget
    """
    maxwellian = math.exp(-0.5 * speed * speed) / math.sqrt(2.0 * math.pi) ** 3
    count = np.zeros(1, np.int64)
    for k in range(values.size):
        count[0] = 0
        values[k] = probe(speed, 0.0, 0.0, time, equilibrium, count, stream) / maxwellian
        nodes[k] = count[0]
    return True


@kernel
def record(speed, time, max_nodes, stream):
    """Record one tree of Algorithm 1: a row per branch, in the order of the calls.

    Returns
    -------
    float64[branches, 9]: start, stop (the drawn t', zero or less at a leaf), velocity (3),
    position at the start (3), row of the parent (-1 at the root);
    no rows if the tree exceeds max_nodes
    """
    rows = np.empty((max_nodes, 9))
    waiting = np.empty((max_nodes, 8))
    waiting[0] = 0.0
    waiting[0, 0], waiting[0, 1], waiting[0, 7] = time, speed, -1.0
    n_waiting, n = 1, 0
    while n_waiting > 0:
        if n == max_nodes:
            return rows[:0]
        n_waiting -= 1
        begin, x, y, z = waiting[n_waiting, :4]
        px, py, pz, parent = waiting[n_waiting, 4:]
        stop = begin - exponential(stream)
        rows[n, 0], rows[n, 1], rows[n, 8] = begin, stop, parent
        rows[n, 2], rows[n, 3], rows[n, 4] = x, y, z
        rows[n, 5], rows[n, 6], rows[n, 7] = px, py, pz
        n += 1
        if stop > 0.0:
            if n_waiting + 2 > max_nodes:
                return rows[:0]
            ax, ay, az, bx, by, bz, _ = collision(x, y, z, stream)
            span = begin - stop
            for k in range(2):
                waiting[n_waiting, 0], waiting[n_waiting, 7] = stop, float(n - 1)
                waiting[n_waiting, 4] = px - span * x
                waiting[n_waiting, 5] = py - span * y
                waiting[n_waiting, 6] = pz - span * z
                waiting[n_waiting, 1] = bx if k == 0 else ax
                waiting[n_waiting, 2] = by if k == 0 else ay
                waiting[n_waiting, 3] = bz if k == 0 else az
                n_waiting += 1
    return rows[:n]


def bkw_literal(speed, time, *, initial):
    """Return the printed algorithm at one probe: callable(values, nodes, stream)."""
    fixed = float(speed), float(time), initial == "equilibrium"
    return lambda values, nodes, stream: estimate(values, nodes, *fixed, stream)
