"""The Boltzmann paper's algorithms as printed, with lines that can be made wrong.

Vectors, physical units and the printed weights, where the package's kernels know only reduced
scalars and ratios. AS_PRINTED must pass the law tests, so that a mutation is caught for itself.
"""

import math

import numba
import numpy as np

from kacsim.variates import exponential, half_normal, random_sign, uniform

AS_PRINTED = 0
OLD_VELOCITY = 1  # f / M of the first branch is taken at c in place of c'
ONE_FOR_TWO = 2  # one sub-estimate of f / M serves both branches (once: a square of squares
# of squares would have no mean)
FORGET_4_PI = 3  # weight of Algorithm 3 without 1 / p_U
ALWAYS_ACCEPT = 4  # no null collisions: every raised one is taken for a real one
UNWEIGHTED_SPREAD = 5  # c* from a wider law, weighted as if it were the Maxwellian
UNSAMPLED_TILT = 6  # u' isotropic, weighted as if it were from (1 + 0.7 mu) / 4 pi
UNWEIGHTED_MAJORANT = 7  # collisions twice as often, weighted as if they were not
FORGET_LOSS = 8  # collisions bring particles and take none away
compiled = numba.njit(error_model="numpy")


@compiled
def normal(stream):
    return half_normal(stream) * random_sign(stream)


@compiled
def isotropic(stream):
    z, angle = 2.0 * uniform(stream) - 1.0, 2.0 * math.pi * uniform(stream)
    level = math.sqrt(1.0 - z * z)
    return np.array([level * math.cos(angle), level * math.sin(angle), z])


@compiled
def normals(stream):
    return np.array([normal(stream), normal(stream), normal(stream)])


@compiled
def length(vector):
    return math.sqrt((vector * vector).sum())


@compiled
def bell(c, q):
    """Return the normal density of a vector, q per axis."""
    return math.exp(-0.5 * (c * c).sum() / q**2) / (math.sqrt(2.0 * math.pi) * q) ** 3


@compiled
def bkw_start(c, q):
    """Return eq. (18)."""
    square = (c * c).sum()
    width = math.sqrt(6.0 * math.pi / 5.0) * q
    return 5.0 * square / (9.0 * q * q) / width**3 * math.exp(-square / (1.2 * q * q))


@compiled
def bkw(c, time, q, mutation, stream):
    """Return one estimate of f(c; t) by Algorithm 2."""
    time -= exponential(stream)
    if time <= 0.0:
        return bkw_start(c, q)
    inner = AS_PRINTED if mutation == ONE_FOR_TWO else mutation
    other, u = q * normals(stream), isotropic(stream)
    gap = length(c - other)
    after = 0.5 * (c + other + gap * u)
    other_after = 0.5 * (c + other - gap * u)
    if mutation == OLD_VELOCITY:
        first = bkw(c, time, q, mutation, stream) * bell(after, q) / bell(c, q)
    else:
        first = bkw(after, time, q, inner, stream)
    if mutation == ONE_FOR_TWO:
        second = first * bell(other_after, q) / bell(after, q)
    else:
        second = bkw(other_after, time, q, mutation, stream)
    weight = (math.sqrt(2.0 * math.pi) * q) ** 3 * math.exp(0.5 * (other * other).sum() / q**2)
    return weight * first * second


@compiled
def bkw_values(values, c, time, q, mutation, stream):
    for k in range(values.size):
        values[k] = bkw(c, time, q, mutation, stream)


@compiled
def bkw_fraction_values(values, threshold, time, q, mutation, stream):
    """Fill with estimates by Algorithm 3 and eq. (19)."""
    for k in range(values.size):
        u = uniform(stream)
        if threshold > 2.0 * q:
            m = (threshold / q) ** 2 - 2.0
            c = threshold + threshold / m * u / (1.0 - u)
            p = threshold * m / (m * (c - threshold) + threshold) ** 2
        else:
            c = threshold + 2.0 * q * u / (1.0 - u)
            p = 2.0 * q / (2.0 * q + c - threshold) ** 2
        f = bkw(c * isotropic(stream), time, q, mutation, stream)
        values[k] = c * c * f / p * (1.0 if mutation == FORGET_4_PI else 4.0 * math.pi)


@compiled
def bkw_moment_values(values, time, mutation, stream):
    """Fill with F / M, c drawn from M, c_q = 1."""
    for k in range(values.size):
        c = normals(stream)
        values[k] = bkw(c, time, 1.0, mutation, stream) / bell(c, 1.0)


@compiled
def kac(v, time, rate, mutation, stream):
    """Return one estimate of f(v; t) of the Kac equation."""
    time -= exponential(stream) / rate
    if time <= 0.0:
        return 2.0 / math.sqrt(math.pi) * v * v * math.exp(-v * v)
    inner = AS_PRINTED if mutation == ONE_FOR_TWO else mutation
    w, angle = math.sqrt(1.5) * normal(stream), 2.0 * math.pi * uniform(stream)
    after = v * math.cos(angle) + w * math.sin(angle)
    other_after = w * math.cos(angle) - v * math.sin(angle)
    if mutation == OLD_VELOCITY:
        first = kac(v, time, rate, mutation, stream) * math.exp((v * v - after * after) / 3.0)
    else:
        first = kac(after, time, rate, inner, stream)
    if mutation == ONE_FOR_TWO:
        second = first * math.exp((after * after - other_after * other_after) / 3.0)
    else:
        second = kac(other_after, time, rate, mutation, stream)
    return first * second * math.sqrt(3.0 * math.pi) * math.exp(w * w / 3.0)


@compiled
def kac_values(values, v, time, rate, mutation, stream):
    for k in range(values.size):
        values[k] = kac(v, time, rate, mutation, stream)


@compiled
def extinction(time, rate, start, majorant, mutation, stream):
    """Return one estimate of f(t) by Algorithm 4."""
    time -= exponential(stream) / majorant
    if time <= 0.0:
        return start
    if mutation == ALWAYS_ACCEPT:
        return 0.0
    first = extinction(time, rate, start, majorant, mutation, stream)
    second = first
    if mutation != ONE_FOR_TWO:
        second = extinction(time, rate, start, majorant, mutation, stream)
    return first * (1.0 - rate * second / majorant)


@compiled
def extinction_values(values, time, rate, start, majorant, mutation, stream):
    for k in range(values.size):
        values[k] = extinction(time, rate, start, majorant, mutation, stream)


@compiled
def trap(r, c, time, gas, mutation, nodes, stream):
    """Return one estimate of f(r; c; t) by Algorithm 6.

    gas holds (n, kappa, omega, c_eq, eps, phi0); nodes int64[1] counts the calls.
    """
    n, kappa, omega, q, eps, phase = gas
    nodes[0] += 1
    factor = (5.0 / 3.0) ** 2.5 / math.e * kappa
    highest = factor * n * (omega / (math.sqrt(2.0 * math.pi) * math.sqrt(1.0 - eps) * q)) ** 3
    if mutation == UNWEIGHTED_MAJORANT:
        highest *= 2.0
    before = time
    while True:
        before = max(0.0, before - exponential(stream) / highest)
        angle = omega * (time - before)
        place = r * math.cos(angle) - c / omega * math.sin(angle)
        speed = c * math.cos(angle) + r * omega * math.sin(angle)
        phi = 2.0 * omega * before + phase
        size = 1.0 + eps * math.sin(phi)
        spread = math.sqrt(size) * q / omega
        cloud = n * bell(place, spread)
        flow = eps * math.cos(phi) / size * omega * place
        width = math.sqrt((1.0 - eps * eps) / size) * q
        if before == 0.0:
            return cloud * bkw_start(speed - flow, width)
        majorant = factor * cloud
        if mutation == UNWEIGHTED_MAJORANT:
            majorant *= 2.0
        if mutation == ALWAYS_ACCEPT or uniform(stream) * highest < majorant:
            break
    other = flow + width * normals(stream) * (1.2 if mutation == UNWEIGHTED_SPREAD else 1.0)
    u = isotropic(stream)
    gap = length(speed - other)
    after, other_after = 0.5 * (speed + other + gap * u), 0.5 * (speed + other - gap * u)
    f1 = trap(place, speed, before, gas, mutation, nodes, stream)
    f2 = trap(place, other, before, gas, mutation, nodes, stream)
    if mutation == OLD_VELOCITY:
        f3 = trap(place, speed, before, gas, mutation, nodes, stream)
        f3 *= bell(after - flow, width) / bell(speed - flow, width)
    else:
        f3 = trap(place, after, before, gas, mutation, nodes, stream)
    if mutation == ONE_FOR_TWO:
        f4 = f3 * bell(other_after - flow, width) / bell(after - flow, width)
    else:
        f4 = trap(place, other_after, before, gas, mutation, nodes, stream)
    if mutation == UNWEIGHTED_MAJORANT:
        majorant *= 0.5
    weight = kappa * (math.sqrt(2.0 * math.pi) * width) ** 3 / majorant
    weight *= math.exp(0.5 * ((other - flow) ** 2).sum() / width**2)
    if mutation == UNSAMPLED_TILT:
        weight /= 1.0 + 0.7 * (u * place).sum() / length(place)
    if mutation == FORGET_LOSS:
        f2 = 0.0
    return f1 + weight * (f3 * f4 - f1 * f2)


@compiled
def trap_values(values, calls, r, c, time, gas, mutation, stream):
    count = np.zeros(1, np.int64)
    for k in range(values.size):
        count[0] = 0
        values[k] = trap(r, c, time, gas, mutation, count, stream)
        calls[k] = count[0]


@compiled
def trap_fraction_values(values, threshold, time, gas, energy, mutation, stream):
    """Fill with estimates by Algorithm 7 and the second law of eq. (40), for r0 <= 2 c_eq / omega.

    With `energy`, of the mechanical energy beyond r0 in place of the share, in c_eq**2.
    """
    _, _, omega, q, eps, phase = gas
    phi = 2.0 * omega * time + phase
    size, count = 1.0 + eps * math.sin(phi), np.zeros(1, np.int64)
    width = math.sqrt((1.0 - eps * eps) / size) * q
    for k in range(values.size):
        u, scale = uniform(stream), 2.0 * q / omega
        radius = threshold + scale * u / (1.0 - u)
        p_radius = scale / (scale + radius - threshold) ** 2
        r = radius * isotropic(stream)
        peculiar = width * normals(stream)
        p_speed = bell(peculiar, width)
        c = eps * math.cos(phi) / size * omega * r + peculiar
        f = trap(r, c, time, gas, mutation, count, stream)
        share = radius * radius * f / (p_radius * p_speed * gas[0])
        if energy:
            share *= 0.5 * ((omega * radius) ** 2 + (c * c).sum()) / q**2
        values[k] = share * (1.0 if mutation == FORGET_4_PI else 4.0 * math.pi)
