"""Algorithms 5, 6 and 7 of the Boltzmann paper: the harmonic trap (sections IV and V).

A realization is the breathing state (31) times W, and a collision keeps the product of the
breathing state over the pair, so that the algorithm becomes W = W1 + q (W3 W4 - W1 W2), with
q = kappa eta / majorant for the sampling laws of the text. A leaf gives W = f(0) / breathing state.
By symmetry a node is its radius, and the radial and tangential components of its velocity.
Units as in `kacsim.boltzmann.trap`.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import int64

from kacsim.boltzmann.model import DEPTH, bkw_leaf, shell, speed_beyond
from kacsim.boltzmann.trap import MAJORANT, flow
from kacsim.kernels.jit import inlined, kernel
from kacsim.variates import exponential, normal, uniform

# Columns of a level of the stack of `tree`: phase and radius of a collision, its weight q, the
# radial components of the four velocities, each followed by the tangential one, and W1 to W4.
WHEN, WHERE, WEIGHT = range(3)
BEFORE, PARTNER, AFTER, PARTNER_AFTER = range(3, 11, 2)
W1, W2, W3, W4 = range(11, 15)


class Laws(NamedTuple):
    """The sampling laws of a tree.

    Attributes
    ----------
    rate : of the inner majorant
    ratio : q, the real frequency over the raised one
    spread, anisotropy : of the laws of c* and u', as in `collide`
    start : 1.0 for the BKW start and 0.0 for the breathing state
    """

    rate: float
    ratio: float
    spread: float
    anisotropy: float
    start: float


class Breathing(NamedTuple):
    """The breathing state: eps, phi0, and at time 0 flow / r and the thermal speed squared."""

    amplitude: float
    phase: float
    flow: float
    square: float


@inlined
def back(radius, radial, tangential, angle):
    """Return (r, radial, tangential) an angle omega (t - t') earlier on the free trajectory."""
    cos, sin = math.cos(angle), math.sin(angle)
    along, across = radius * cos - radial * sin, -tangential * sin
    speed_along, speed_across = radial * cos + radius * sin, tangential * cos
    there = math.sqrt(along * along + across * across)
    if there == 0.0:
        return 0.0, math.hypot(speed_along, speed_across), 0.0
    inward = (along * speed_along + across * speed_across) / there
    return there, inward, abs(radius * tangential) / there


@inlined
def start_ratio(radius, radial, tangential, state):
    """Return W of a leaf at time 0: the BKW start over its Maxwellian."""
    gap = radial - state.flow * radius
    return bkw_leaf((gap * gap + tangential * tangential) / state.square)


@inlined
def collide(radial, tangential, flow, width, spread, anisotropy, here, stream):
    """Draw c* and u'; write the new velocities into a level; return the weight of the laws.

    Parameters
    ----------
    radial, tangential : velocity at the collision
    flow, width : peculiar velocity (radial) and RMS velocity of the breathing state there
    spread : c* is drawn with the RMS velocity spread * width; 1 in the text
    anisotropy : u' has the density (1 + anisotropy mu) / 4 pi, mu the radial component
    here : float64[15], a level of the stack, overwritten from `PARTNER` to `W1`
    """
    x, y, z = normal(stream), normal(stream), normal(stream)
    square = spread * spread * (x * x + y * y + z * z)
    weight = spread**3 * math.exp(-0.5 * square * (1.0 - 1.0 / (spread * spread)))
    x, y, z = flow + width * spread * x, width * spread * y, width * spread * z
    mu = 2.0 * uniform(stream) - 1.0
    if anisotropy != 0.0:
        mu = (math.sqrt((1.0 - anisotropy) ** 2 + 2.0 * anisotropy * (1.0 + mu)) - 1.0) / anisotropy
        weight /= 1.0 + anisotropy * mu
    angle = 2.0 * math.pi * uniform(stream)
    level = math.sqrt(max(0.0, 1.0 - mu * mu))
    gap = math.sqrt((radial - x) ** 2 + (tangential - y) ** 2 + z * z)
    half_x, half_y, half_z = (
        0.5 * gap * mu,
        0.5 * gap * level * math.cos(angle),
        0.5 * gap * level * math.sin(angle),
    )
    mean_x, mean_y, mean_z = 0.5 * (radial + x), 0.5 * (tangential + y), 0.5 * z
    here[PARTNER], here[PARTNER + 1] = x, math.sqrt(y * y + z * z)
    here[AFTER] = mean_x + half_x
    here[AFTER + 1] = math.sqrt((mean_y + half_y) ** 2 + (mean_z + half_z) ** 2)
    here[PARTNER_AFTER] = mean_x - half_x
    here[PARTNER_AFTER + 1] = math.sqrt((mean_y - half_y) ** 2 + (mean_z - half_z) ** 2)
    return weight


@inlined
def tree(radius, radial, tangential, time, laws, state, stack, places, max_nodes, stream):
    """Return (W, nodes) of one realization; nodes is -1 if the budget is exceeded.

    Parameters
    ----------
    radius, radial, tangential, time : probe; time is the phase omega t
    laws, state : Laws, Breathing
    stack, places : float64[DEPTH, 15], overwritten; int64[DEPTH], per level the branch under way
    """
    level, nodes, drawn = 0, 0, 0
    while True:
        nodes += 1
        collided = False
        while True:
            drawn += 1
            if drawn > max_nodes:
                return 0.0, -1
            span = exponential(stream) / laws.rate
            if span >= time:
                radius, radial, tangential = back(radius, radial, tangential, time)
                break
            time -= span
            radius, radial, tangential = back(radius, radial, tangential, span)
            size = 1.0 + state.amplitude * math.sin(2.0 * time + state.phase)
            chance = math.exp(-0.5 * radius * radius / size)
            chance *= ((1.0 - state.amplitude) / size) ** 1.5
            if uniform(stream) < chance:
                collided = True
                break
        if collided:
            if level >= DEPTH:
                return 0.0, -1
            phi = 2.0 * time + state.phase
            flow = state.amplitude * math.cos(phi) / size * radius
            width = math.sqrt((1.0 - state.amplitude * state.amplitude) / size)
            here = stack[level]
            here[WHEN], here[WHERE] = time, radius
            here[BEFORE], here[BEFORE + 1] = radial, tangential
            here[WEIGHT] = laws.ratio * collide(
                radial, tangential, flow, width, laws.spread, laws.anisotropy, here, stream
            )
            places[level] = 0
            level += 1
            continue
        value = start_ratio(radius, radial, tangential, state) if laws.start == 1.0 else 1.0
        while level > 0:
            here = stack[level - 1]
            here[W1 + places[level - 1]] = value
            places[level - 1] += int64(1)
            if places[level - 1] < 4:
                break
            value = here[W1] + here[WEIGHT] * (here[W3] * here[W4] - here[W1] * here[W2])
            level -= 1
        if level == 0:
            return value, nodes
        here, place = stack[level - 1], BEFORE + 2 * places[level - 1]
        time, radius, radial, tangential = here[WHEN], here[WHERE], here[place], here[place + 1]


@inlined
def prepared(physics, choices):
    """Return (laws, state, stack, places) of `tree` from what the kernels are given.

    The inner majorant is the densest that the cloud ever is.
    """
    coupling, breathing, start_phase, start = physics
    majorant, spread, anisotropy = choices
    densest = (2.0 * math.pi * (1.0 - breathing)) ** -1.5
    laws = Laws(majorant * coupling * densest, 1.0 / majorant, spread, anisotropy, start)
    size = 1.0 + breathing * math.sin(start_phase)
    flow = breathing * math.cos(start_phase) / size
    state = Breathing(breathing, start_phase, flow, (1.0 - breathing * breathing) / size)
    return laws, state, np.empty((DEPTH, 15)), np.empty(DEPTH, np.int64)


@kernel
def estimate(values, nodes, radius, radial, tangential, time, physics, choices, max_nodes, stream):
    """Draw realizations of f / breathing state by Algorithms 5 and 6.

    Parameters
    ----------
    values : float64[n], overwritten
    nodes : int64[n], overwritten by the numbers of calls; -1 marks an exceeded budget
    radius, radial, tangential, time : probe
    physics : (coupling, breathing, start_phase, start), start 1.0 for BKW, 0.0 for breathing
    choices : (majorant / (kappa eta), spread, anisotropy); (`trap.MAJORANT`, 1, 0) in the text
    max_nodes : int, budget of t' drawings of one realization, inner null collisions included
    stream : uint64[4], advanced

    Returns
    -------
    bool, False if a realization exceeded the budget
    """
    laws, state, stack, places = prepared(physics, choices)
    for k in range(values.size):
        values[k], nodes[k] = tree(
            radius, radial, tangential, time, laws, state, stack, places, max_nodes, stream
        )
        if nodes[k] < 0:
            return False
    return True


@kernel
def estimate_fraction(values, nodes, threshold, time, physics, choices, max_nodes, stream):
    """Draw realizations of the fraction with |r| > threshold by Algorithm 7 and eq. (40).

    Parameters and result as `estimate`.
    """
    return beyond(values, nodes, threshold, time, physics, choices, max_nodes, False, stream)


@kernel
def estimate_energy(values, nodes, threshold, time, physics, choices, max_nodes, stream):
    """Draw realizations of the mechanical energy of the matter with |r| > threshold.

    Parameters and result as `estimate_fraction`; the whole cloud has 3 c_eq**2 per particle.
    """
    return beyond(values, nodes, threshold, time, physics, choices, max_nodes, True, stream)


@inlined
def beyond(values, nodes, threshold, time, physics, choices, max_nodes, energy, stream):
    """Fill the realizations of Algorithm 7; the velocity is from the local Maxwellian of (31).

    Parameters
    ----------
    energy : bool, multiply by the energy (r**2 + c**2) / 2 of the probe
    """
    laws, state, stack, places = prepared(physics, choices)
    phi = 2.0 * time + state.phase
    size = 1.0 + state.amplitude * math.sin(phi)
    flow = state.amplitude * math.cos(phi) / size
    width = math.sqrt((1.0 - state.amplitude**2) / size)
    for k in range(values.size):
        radius, weight = speed_beyond(threshold, stream)
        radial = flow * radius + width * normal(stream)
        tangential = width * math.sqrt(2.0 * exponential(stream))
        if energy:
            weight *= 0.5 * (radius**2 + radial**2 + tangential**2)
        ratio, nodes[k] = tree(
            radius, radial, tangential, time, laws, state, stack, places, max_nodes, stream
        )
        values[k] = weight * shell(radius, size) * ratio
        if nodes[k] < 0:
            return False
    return True


def _laws(initial, breathing, start_phase, coupling, majorant_factor, spread, anisotropy):
    """Return the kernels' physics and choices from the sampler's parameters."""
    start = 1.0 if initial == "bkw" else 0.0
    physics = float(coupling), float(breathing), float(start_phase), start
    return physics, (MAJORANT * majorant_factor, float(spread), float(anisotropy))


def at(radius, radial, tangential, time, *, max_nodes, **laws):
    """Return Algorithms 5 and 6 at one probe, in units of the breathing state."""
    fixed = float(radius), float(radial), float(tangential), float(time), *_laws(**laws), max_nodes
    return lambda values, nodes, stream: estimate(values, nodes, *fixed, stream)


def trap(radius, time, **parameters):
    """Return `at` with the velocity that the flow has at the radius at time 0."""
    speed = flow(radius, 0.0, float(parameters["breathing"]), float(parameters["start_phase"]))
    return at(radius, float(speed), 0.0, time, **parameters)


def trap_fraction(radius, time, *, max_nodes, **laws):
    """Return Algorithm 7 at one radius: callable(values, nodes, stream)."""
    fixed = float(radius), float(time), *_laws(**laws), max_nodes
    return lambda values, nodes, stream: estimate_fraction(values, nodes, *fixed, stream)


def trap_energy(radius, time, *, max_nodes, **laws):
    """Return the mechanical energy beyond a radius: callable(values, nodes, stream)."""
    fixed = float(radius), float(time), *_laws(**laws), max_nodes
    return lambda values, nodes, stream: estimate_energy(values, nodes, *fixed, stream)
