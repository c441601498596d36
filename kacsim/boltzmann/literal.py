"""Algorithm 2 as printed: plain recursion, vectors and weights of the Boltzmann paper's section II.

The reference of `bkw_tree`: slower, but with nothing worked out beforehand. It shows the null
variance at equilibrium, is the baseline of the benchmark, and records trees for Fig. 2.
"""

import math

import numpy as np

from kacsim.elementary.circular import cos_sin
from kacsim.elementary.exponential import exp
from kacsim.kernels.jit import inlined, kernel
from kacsim.variates import exponential, normal, uniform

# Columns of a recorded branch; velocity and position take three each.
START, STOP, VELOCITY, POSITION, PARENT = 0, 1, 2, 5, 8


@inlined
def start(square, equilibrium):
    """Return f(c; 0) for c**2, c_q = 1: the equilibrium (eq. 11) or the BKW mode (eq. 18)."""
    if equilibrium:
        return exp(-0.5 * square) / math.sqrt(2.0 * math.pi) ** 3
    return 5.0 / 9.0 * square * exp(-square / 1.2) / math.sqrt(1.2 * math.pi) ** 3


@inlined
def isotropic(stream):
    """Return a uniform point of the unit sphere."""
    z = 2.0 * uniform(stream) - 1.0
    cos, sin = cos_sin(2.0 * math.pi * uniform(stream))
    level = math.sqrt(1.0 - z * z)
    return level * cos, level * sin, z


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
    stream : from `new_stream`, advanced
    """
    nodes[0] += 1
    time -= exponential(stream)
    if time <= 0.0:
        return start(x * x + y * y + z * z, equilibrium)
    ax, ay, az, bx, by, bz, square = collision(x, y, z, stream)
    first = probe(ax, ay, az, time, equilibrium, nodes, stream)
    second = probe(bx, by, bz, time, equilibrium, nodes, stream)
    return math.sqrt(2.0 * math.pi) ** 3 * exp(0.5 * square) * first * second


@kernel
def estimate(values, nodes, speed, time, equilibrium, stream):
    """Draw realizations of f / M at a probe on the x axis; arrays as in `bkw_tree.estimate`.

    Returns
    -------
    bool, True: there is no budget
    """
    maxwellian = exp(-0.5 * speed * speed) / math.sqrt(2.0 * math.pi) ** 3
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
    float64[branches, 9]: at `START`, at `STOP` the drawn t' (zero or less at a leaf), at `VELOCITY`
    and at `POSITION`, where the branch begins, three each, at `PARENT` its row (-1 at the root); no
    rows if the tree exceeds max_nodes
    """
    rows, waiting = np.empty((max_nodes, 9)), np.empty((max_nodes, 9))
    waiting[0] = 0.0
    waiting[0, START], waiting[0, VELOCITY], waiting[0, PARENT] = time, speed, -1.0
    n_waiting, n = 1, 0
    while n_waiting > 0:
        if n == max_nodes:
            return rows[:0]
        n_waiting -= 1
        here = rows[n]
        here[:] = waiting[n_waiting]
        here[STOP] = here[START] - exponential(stream)
        n += 1
        if here[STOP] > 0.0:
            if n_waiting + 2 > max_nodes:
                return rows[:0]
            x, y, z = here[VELOCITY:POSITION]
            ax, ay, az, bx, by, bz, _ = collision(x, y, z, stream)
            span = here[START] - here[STOP]
            for velocity in ((bx, by, bz), (ax, ay, az)):
                branch = waiting[n_waiting]
                branch[START], branch[PARENT] = here[STOP], float(n - 1)
                for axis in range(3):
                    branch[VELOCITY + axis] = velocity[axis]
                    branch[POSITION + axis] = here[POSITION + axis] - span * here[VELOCITY + axis]
                n_waiting += 1
    return rows[:n]


def bkw_literal(speed, time, *, initial):
    """Return the printed algorithm at one probe: callable(values, nodes, stream)."""
    fixed = float(speed), float(time), initial == "equilibrium"
    return lambda values, nodes, stream: estimate(values, nodes, *fixed, stream)
