"""Plain-Python twins of the Boltzmann kernels: recursion, and the same variates one at a time.

Nodes are as in the kernels (an energy; a radius and two components of the velocity), but a leaf is
the ratio of two densities, a collision is drawn as vectors, and every sub-estimate is a call.
"""

import math

import numpy as np

from kacsim import variates as random
from kacsim.boltzmann import bkw, trap

TILTED = 1e-300  # below it an anisotropy counts as none


def normal(stream):
    size = random.half_normal(stream)
    return size * random.random_sign(stream)


def bkw_leaf(x):
    """Return eq. (18) over eq. (11), c_q = 1."""
    prefactors = 5 * x / 9 / math.sqrt(1.2 * math.pi) ** 3, 1 / math.sqrt(2 * math.pi) ** 3
    return prefactors[0] / prefactors[1] * math.exp(-x / 1.2 - -x / 2)


def bkw_scatter(x, stream):
    """Return both energies, from c along an axis, c* = (z, y, 0) and u' at an angle of c + c*."""
    z = random.half_normal(stream)
    y = math.sqrt(2 * random.exponential(stream))
    total = np.array([math.sqrt(x) + z, y])
    gap = np.linalg.norm([math.sqrt(x) - z, y])
    mu = 2 * random.uniform(stream) - 1
    product = 2 * np.linalg.norm(total) * gap * mu
    squares = total @ total + gap * gap
    return (squares + product) / 4, (squares - product) / 4


def kac_leaf(x):
    """Return f0 over eq. (9), v**2 = 3/2 x."""
    square = 1.5 * x
    prefactors = 2 / math.sqrt(math.pi) * square, 1 / math.sqrt(3 * math.pi)
    return prefactors[0] / prefactors[1] * math.exp(-square - -square / 3)


def kac_scatter(x, stream):
    z = random.half_normal(stream)
    share = random.squared_cosine(stream)
    return (x + z * z) * share, (x + z * z) * (1 - share)


def tree(law, x, time, oversampling, onset, stream):
    """Return (F / M, t' drawings)."""
    leaf, scatter = law
    time -= random.exponential(stream)
    if time <= 0:
        return leaf(x), 1
    value, nodes = 1.0, 1
    mean = oversampling if time > onset else 1.0
    for side in scatter(x, stream):
        n = int(mean) + (random.uniform(stream) < mean - int(mean))
        estimates = [tree(law, side, time, oversampling, onset, stream) for _ in range(n)]
        value *= sum(estimate for estimate, _ in estimates) / n
        nodes += sum(count for _, count in estimates)
    return value, nodes


BKW, KAC = (bkw_leaf, bkw_scatter), (kac_leaf, kac_scatter)


def probe(law, speed, time, oversampling, onset, stream):
    return tree(law, speed**2, time, oversampling, onset, stream)


def moment(oversampling, time, onset, stream):
    z = random.half_normal(stream)
    return tree(BKW, z**2 + 2 * random.exponential(stream), time, oversampling, onset, stream)


def beyond(threshold, stream):
    """Return (c_f, c_f**2 4 pi / p) of eq. (19), c_q = 1."""
    u = random.uniform(stream)
    if threshold > 2:
        m = threshold**2 - 2
        gap = (threshold / (1 - u) - threshold) / m
        p = threshold * m / (m * gap + threshold) ** 2
    else:
        gap = 2 / (1 - u) - 2
        p = 2 / (2 + gap) ** 2
    return threshold + gap, 4 * math.pi * (threshold + gap) ** 2 / p


def fraction(threshold, time, oversampling, onset, stream):
    speed, weight = beyond(threshold, stream)
    ratio, nodes = tree(BKW, speed**2, time, oversampling, onset, stream)
    return weight * bkw.maxwellian(speed) * ratio, nodes


def extinction(time, ratio, stream):
    """Return (f / f0, t' drawings) of Algorithm 4 with alpha = f0 = 1."""
    time -= random.exponential(stream) / ratio
    if time <= 0:
        return 1.0, 1
    first, n_first = extinction(time, ratio, stream)
    second, n_second = extinction(time, ratio, stream)
    return first * (1 - second / ratio), 1 + n_first + n_second


def vector_collision(c, other, mu, cos, sin):
    """Return eq. (6) for vectors of which the first axis is radial.

    Across it the angle of u' is counted from the direction of c + c*.
    """
    level = math.sqrt(1 - mu * mu)
    first = (c + other)[1:] / np.linalg.norm((c + other)[1:])
    across = level * (cos * first + sin * np.array([-first[1], first[0]]))
    u = np.array([mu, *across])
    gap = np.linalg.norm(c - other)
    return (c + other + gap * u) / 2, (c + other - gap * u) / 2


def trap_tree(node, time, physics, choices, stream):
    """Return (f / breathing state, calls) of Algorithm 6, node = (r, radial, tangential)."""
    coupling, eps, phase, start = physics
    majorant, spread, anisotropy = choices
    densest = -math.pi / 4 - phase / 2  # sin(phi) = -1
    cloud = trap.cloud(0.0, densest, eps, phase)
    while True:
        span = random.exponential(stream) / (majorant * coupling * cloud)
        if span >= time:
            at_start = trap.ballistic(*node, time)
            return (trap.relative_start(*at_start, eps, phase) if start else 1.0), 1
        time, node = time - span, trap.ballistic(*node, span)
        middle = trap.cloud(0.0, time, eps, phase)
        if random.uniform(stream) * cloud >= middle:
            continue
        if middle * math.exp(-random.exponential(stream)) < trap.cloud(node[0], time, eps, phase):
            break
    flow = float(trap.flow(node[0], time, eps, phase))
    width = float(trap.thermal_speed(time, eps, phase))
    gauss = np.array([normal(stream), normal(stream), random.half_normal(stream)])
    c = np.array([node[1], node[2], 0.0])
    other = np.array([flow, 0.0, 0.0]) + width * spread * gauss
    mu = 2 * random.uniform(stream) - 1
    if anisotropy > TILTED:  # invert the cumulative (1 + mu) / 2 + anisotropy (mu**2 - 1) / 4
        mu = np.roots([anisotropy, 2, 1 - anisotropy - (1 + mu) - mu])
        mu = float(mu[np.argmin(abs(mu))])
    after, other_after = vector_collision(c, other, mu, *random.unit_circle(stream))
    drawn = math.exp(-gauss @ gauss / 2) / spread**3
    printed = math.exp(-(spread**2) * (gauss @ gauss) / 2)
    weight = printed / drawn / (1 + anisotropy * mu) / majorant
    estimates, nodes = [], 1
    for velocity in (c, other, after, other_after):
        place = node[0], velocity[0], math.hypot(velocity[1], velocity[2])
        estimate, calls = trap_tree(place, time, physics, choices, stream)
        estimates.append(estimate)
        nodes += calls
    one, two, three, four = estimates
    return one + weight * (three * four - one * two), nodes


def trap_probe(radius, radial, tangential, time, physics, choices, stream):
    return trap_tree((radius, radial, tangential), time, physics, choices, stream)


def trap_beyond(threshold, time, physics, choices, stream, *, energy):
    """Return (share or its mechanical energy, calls) of Algorithm 7, positions in c_eq / omega."""
    _, eps, phase, _ = physics
    radius, weight = beyond(threshold, stream)
    width = float(trap.thermal_speed(time, eps, phase))
    radial = float(trap.flow(radius, time, eps, phase)) + width * normal(stream)
    tangential = width * math.sqrt(2 * random.exponential(stream))
    ratio, calls = trap_tree((radius, radial, tangential), time, physics, choices, stream)
    share = weight * float(trap.cloud(radius, time, eps, phase)) * ratio
    return share * ((radius**2 + radial**2 + tangential**2) / 2 if energy else 1), calls


def literal(c, time, equilibrium, stream):
    """Return (f, t' drawings) of Algorithm 2 with vectors, c_q = 1."""
    time -= random.exponential(stream)
    square = c @ c
    if time <= 0:
        m = math.exp(-square / 2) / math.sqrt(2 * math.pi) ** 3
        return m * (1.0 if equilibrium else bkw_leaf(square)), 1
    other = np.array([normal(stream) for _ in range(3)])
    z, angle = 2 * random.uniform(stream) - 1, 2 * math.pi * random.uniform(stream)
    level = math.sqrt(1 - z * z)
    u = np.array([level * math.cos(angle), level * math.sin(angle), z])
    gap = np.linalg.norm(c - other)
    first, n_first = literal((c + other + gap * u) / 2, time, equilibrium, stream)
    second, n_second = literal((c + other - gap * u) / 2, time, equilibrium, stream)
    weight = math.sqrt(2 * math.pi) ** 3 * math.exp(other @ other / 2)
    return weight * first * second, 1 + n_first + n_second
