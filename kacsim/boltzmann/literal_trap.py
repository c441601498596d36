"""Algorithm 6 as printed: plain recursion with vectors and weights (Boltzmann paper, section V).

The baseline of the benchmark, and a reference for tests: nothing is worked out beforehand. Units
as in `kacsim.boltzmann.trap`.
"""

import math

import numpy as np

from kacsim.boltzmann.literal import isotropic
from kacsim.boltzmann.trap import MAJORANT
from kacsim.elementary.circular import cos_sin
from kacsim.elementary.exponential import exp
from kacsim.kernels.jit import allocating, inlined, kernel
from kacsim.variates import exponential, normal, uniform


@inlined
def maxwellian(square, width):
    """Return the normal density in three dimensions at a squared distance."""
    return exp(-0.5 * square / width**2) / (math.sqrt(2.0 * math.pi) * width) ** 3


@inlined
def state(time, breathing):
    """Return (variance of positions, flow / r, thermal speed) of eq. (31), phi0 = 0."""
    cos, sin = cos_sin(2.0 * time)
    size = 1.0 + breathing * sin
    return size, breathing * cos / size, math.sqrt((1.0 - breathing**2) / size)


@inlined
def start(point, breathing, relaxed):
    """Return f(r; c; 0): eq. (31) itself, or the BKW start at every place, scaled to it."""
    size, flow, width = state(0.0, breathing)
    radius, square = 0.0, 0.0
    for k in range(3):
        radius += point[k] ** 2
        square += (point[3 + k] - flow * point[k]) ** 2
    if relaxed:
        return maxwellian(radius, math.sqrt(size)) * maxwellian(square, width)
    s = square / width**2
    shape = 5.0 / 9.0 * s * exp(-s / 1.2) / (math.sqrt(1.2 * math.pi) * width) ** 3
    return maxwellian(radius, math.sqrt(size)) * shape


@allocating
def back(point, span):
    """Return the place and velocity a phase earlier on the free trajectory, float64[6]."""
    cos, sin = cos_sin(span)
    earlier = np.empty(6)
    for k in range(3):
        earlier[k] = point[k] * cos - point[3 + k] * sin
        earlier[3 + k] = point[3 + k] * cos + point[k] * sin
    return earlier


@allocating
def placed(point, x, y, z):
    """Return the same place with another velocity, float64[6]."""
    other = point.copy()
    other[3], other[4], other[5] = x, y, z
    return other


@kernel
def probe(point, time, coupling, breathing, relaxed, nodes, stream):
    """Return one estimate of f(r; c; t) by Algorithm 6, calling itself.

    Parameters
    ----------
    point : float64[6], place and velocity
    time : phase omega t
    coupling, breathing : n kappa omega**2 / c_eq**3 and eps
    relaxed : bool, start from the breathing state (Algorithm 5) in place of the BKW one
    nodes : int64[1], raised by the number of calls
    stream : from `new_stream`, advanced
    """
    nodes[0] += 1
    densest = maxwellian(0.0, math.sqrt(1.0 - breathing))
    while True:
        span = exponential(stream) / (MAJORANT * coupling * densest)
        if span >= time:
            return start(back(point, time), breathing, relaxed)
        time -= span
        point = back(point, span)
        size, flow, width = state(time, breathing)
        radius = point[0] ** 2 + point[1] ** 2 + point[2] ** 2
        density = maxwellian(radius, math.sqrt(size))
        if uniform(stream) * densest < density:
            break
    dx, dy, dz = normal(stream), normal(stream), normal(stream)
    ox = flow * point[0] + width * dx
    oy = flow * point[1] + width * dy
    oz = flow * point[2] + width * dz
    ux, uy, uz = isotropic(stream)
    gap = math.sqrt((point[3] - ox) ** 2 + (point[4] - oy) ** 2 + (point[5] - oz) ** 2)
    mx, my, mz = 0.5 * (point[3] + ox), 0.5 * (point[4] + oy), 0.5 * (point[5] + oz)
    hx, hy, hz = 0.5 * gap * ux, 0.5 * gap * uy, 0.5 * gap * uz
    one = probe(point, time, coupling, breathing, relaxed, nodes, stream)
    two = probe(placed(point, ox, oy, oz), time, coupling, breathing, relaxed, nodes, stream)
    three = probe(
        placed(point, mx + hx, my + hy, mz + hz), time, coupling, breathing, relaxed, nodes, stream
    )
    four = probe(
        placed(point, mx - hx, my - hy, mz - hz), time, coupling, breathing, relaxed, nodes, stream
    )
    weight = coupling / (MAJORANT * coupling * density)
    weight *= (math.sqrt(2.0 * math.pi) * width) ** 3
    weight *= exp(0.5 * (dx * dx + dy * dy + dz * dz))
    return one + weight * (three * four - one * two)


@kernel
def estimate(values, nodes, radius, radial, time, coupling, breathing, relaxed, stream):
    """Draw realizations of f / breathing state at a probe on the x axis, velocity along it.

    Returns
    -------
    bool, True: there is no budget
    """
    size, flow, width = state(time, breathing)
    now = maxwellian(radius * radius, math.sqrt(size))
    now *= maxwellian((radial - flow * radius) ** 2, width)
    point, count = np.zeros(6), np.zeros(1, np.int64)
    for k in range(values.size):
        count[0] = 0
        point[0], point[3] = radius, radial
        values[k] = probe(point, time, coupling, breathing, relaxed, count, stream) / now
        nodes[k] = count[0]
    return True


def trap_literal(radius, time, *, initial, breathing, coupling):
    """Return the printed algorithm where the flow has the probe's velocity at time 0."""
    speed = float(breathing) * float(radius)
    fixed = float(radius), speed, float(time), float(coupling), float(breathing)
    relaxed = initial == "breathing"
    return lambda values, nodes, stream: estimate(values, nodes, *fixed, relaxed, stream)
