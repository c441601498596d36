"""Algorithms 5, 6 and 7 of the Boltzmann paper: the harmonic trap (sections IV and V).

A realization is the breathing state (31) times W, and a collision keeps the product of the
breathing state over the pair, so that the algorithm becomes W = W1 + q (W3 W4 - W1 W2), with
q = kappa eta / majorant for the sampling laws of the text. A leaf gives W = f(0) / breathing state.
Nodes and their trajectories are those of `kacsim.boltzmann.trap_node`.
"""

import math
from typing import NamedTuple

import numpy as np

from kacsim.boltzmann.model import DEPTH, shell, speed_beyond
from kacsim.boltzmann.trap import MAJORANT
from kacsim.boltzmann.trap_node import (
    breathing_state,
    node_at,
    squared_radius,
    start_ratio,
    swelling,
    trajectory,
)
from kacsim.elementary.circular import cos_sin
from kacsim.elementary.exponential import exp
from kacsim.kernels.jit import allocating, inlined, kernel
from kacsim.variates import exponential, half_normal, normal, uniform, unit_circle

# Columns of a level of the stack of `tree`: phase of a collision, its cosine and sine, the radius,
# the weight q, the radial components of the three new velocities, each followed by the tangential
# one, and W1 to W4.
WHEN, COS, SIN, WHERE, WEIGHT = range(5)
PARTNER, AFTER, PARTNER_AFTER = range(5, 11, 2)
W1, W2, W3, W4 = range(11, 15)


class Laws(NamedTuple):
    """The sampling laws of a tree.

    Attributes
    ----------
    span : mean span between collisions at the inner majorant
    thinnest : cube of the least 1 + eps sin(phi), where the cloud is densest
    ratio : q, the real frequency over the raised one
    spread, anisotropy : of the laws of c* and u', as in `collide`
    start : 1.0 for the BKW start and 0.0 for the breathing state
    """

    span: float
    thinnest: float
    ratio: float
    spread: float
    anisotropy: float
    start: float


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
    x, y, z = normal(stream), normal(stream), half_normal(stream)
    weight = 1.0
    if spread != 1.0:
        square = spread * spread * (x * x + y * y + z * z)
        weight = spread**3 * exp(-0.5 * square * (1.0 - 1.0 / (spread * spread)))
    width *= spread
    x, y, z = flow + width * x, width * y, width * z
    mu = 2.0 * uniform(stream) - 1.0
    if anisotropy != 0.0:
        mu = (math.sqrt((1.0 - anisotropy) ** 2 + 2.0 * anisotropy * (1.0 + mu)) - 1.0) / anisotropy
        weight /= 1.0 + anisotropy * mu
    # Half of the relative velocity turned to u', and the mean one: squares of what is across.
    z_square, sum_y = z * z, tangential + y
    gap = 0.25 * ((radial - x) ** 2 + (tangential - y) ** 2 + z_square)
    half, mean = math.sqrt(gap) * mu, 0.5 * (radial + x)
    turned, still = gap * max(0.0, 1.0 - mu * mu), 0.25 * (sum_y * sum_y + z_square)
    cos, _ = unit_circle(stream)
    both, mixed = turned + still, 2.0 * math.sqrt(turned * still) * cos
    here[PARTNER], here[PARTNER + 1] = x, math.sqrt(y * y + z_square)
    here[AFTER], here[AFTER + 1] = mean + half, math.sqrt(max(0.0, both + mixed))
    here[PARTNER_AFTER] = mean - half
    here[PARTNER_AFTER + 1] = math.sqrt(max(0.0, both - mixed))
    return weight


@inlined
def is_raised(square, size, thinnest, stream):
    """Tell whether a collision at the inner majorant is one at the raised frequency, eq. (36).

    The chance is the ratio of both, (least size / size)**1.5 exp(-r**2 / (2 size)): two trials.
    """
    u = uniform(stream)
    return u * u * size * size * size < thinnest and square < 2.0 * size * exponential(stream)


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
    cos, sin = cos_sin(time)
    x, y, u, v = trajectory(radius, radial, tangential, cos, sin)
    while True:
        nodes += 1
        while True:
            drawn += 1
            if drawn > max_nodes:
                return 0.0, -1
            time -= exponential(stream) * laws.span
            if time <= 0.0:
                break
            cos, sin = cos_sin(time)
            size, turning = swelling(cos, sin, state)
            if is_raised(squared_radius(x, y, u, v, cos, sin), size, laws.thinnest, stream):
                break
        if time > 0.0:
            if level >= DEPTH:
                return 0.0, -1
            radius, radial, tangential = node_at(x, y, u, v, cos, sin)
            flow = turning / size * radius
            width = math.sqrt((1.0 - state.amplitude * state.amplitude) / size)
            here = stack[level]
            here[WHEN], here[COS], here[SIN], here[WHERE] = time, cos, sin, radius
            here[WEIGHT] = laws.ratio * collide(
                radial, tangential, flow, width, laws.spread, laws.anisotropy, here, stream
            )
            places[level] = 0
            level += 1
            continue
        value = start_ratio(x, y, u, v, state) if laws.start == 1.0 else 1.0
        while level > 0:
            here = stack[level - 1]
            here[W1 + places[level - 1]] = value
            places[level - 1] += 1
            if places[level - 1] < 4:
                break
            value = here[W1] + here[WEIGHT] * (here[W3] * here[W4] - here[W1] * here[W2])
            level -= 1
        if level == 0:
            return value, nodes
        here, place = stack[level - 1], PARTNER + 2 * (places[level - 1] - 1)
        time = here[WHEN]
        x, y, u, v = trajectory(here[WHERE], here[place], here[place + 1], here[COS], here[SIN])


@allocating
def prepared(physics, choices):
    """Return (laws, state, stack, places) of `tree` from what the kernels are given.

    The inner majorant is the densest that the cloud ever is.
    """
    coupling, breathing, start_phase, start = physics
    majorant, spread, anisotropy = choices
    least = 1.0 - breathing
    room = 2.0 * math.pi * least
    span = room * math.sqrt(room) / (majorant * coupling)
    laws = Laws(span, least**3, 1.0 / majorant, spread, anisotropy, start)
    state = breathing_state(breathing, start_phase)
    return laws, state, np.empty((DEPTH, 15)), np.empty(DEPTH, np.int64)


@kernel
def start_flow(breathing, start_phase):
    """Return the flow over the radius at time 0, eq. (31b)."""
    return breathing_state(breathing, start_phase).flow


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
    stream : from `new_stream`, advanced

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


@allocating
def beyond(values, nodes, threshold, time, physics, choices, max_nodes, energy, stream):
    """Fill the realizations of Algorithm 7; the velocity is from the local Maxwellian of (31).

    Parameters
    ----------
    energy : bool, multiply by the energy (r**2 + c**2) / 2 of the probe
    """
    laws, state, stack, places = prepared(physics, choices)
    size, turning = swelling(*cos_sin(time), state)
    flow = turning / size
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
    flow = start_flow(float(parameters["breathing"]), float(parameters["start_phase"]))
    return at(radius, flow * radius, 0.0, time, **parameters)


def trap_fraction(radius, time, *, max_nodes, **laws):
    """Return Algorithm 7 at one radius: callable(values, nodes, stream)."""
    fixed = float(radius), float(time), *_laws(**laws), max_nodes
    return lambda values, nodes, stream: estimate_fraction(values, nodes, *fixed, stream)


def trap_energy(radius, time, *, max_nodes, **laws):
    """Return the mechanical energy beyond a radius: callable(values, nodes, stream)."""
    fixed = float(radius), float(time), *_laws(**laws), max_nodes
    return lambda values, nodes, stream: estimate_energy(values, nodes, *fixed, stream)
