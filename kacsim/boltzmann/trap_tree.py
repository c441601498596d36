"""Algorithms 5, 6 and 7 of the Boltzmann paper: the harmonic trap (sections IV and V).

A realization is the breathing state (31) times W, and a collision keeps the product of the
breathing state over the pair, so that the algorithm becomes W = W1 + q (W3 W4 - W1 W2), with
q = kappa eta / majorant for the sampling laws of the text. A leaf gives W = f(0) / breathing state.
By symmetry a node is its radius, and the radial and tangential components of its velocity.
Units as in `kacsim.boltzmann.trap`.
"""

import math

import numpy as np
from numba import int64

from kacsim.boltzmann.model import DEPTH, bkw_leaf, shell, speed_beyond
from kacsim.boltzmann.trap import MAJORANT, flow
from kacsim.kernels.jit import inlined, kernel
from kacsim.variates import exponential, half_normal, random_sign, uniform


@inlined
def normal(stream):
    """Return a standard normal variate."""
    return half_normal(stream) * random_sign(stream)


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
    gap = radial - state[2] * radius
    return bkw_leaf((gap * gap + tangential * tangential) / state[3])


@inlined
def collide(radial, tangential, flow, width, spread, anisotropy, out, stream):
    """Draw c* and u'; write the three new velocities; return the weight of the laws.

    Parameters
    ----------
    radial, tangential : velocity at the collision
    flow, width : peculiar velocity (radial) and RMS velocity of the breathing state there
    spread : c* is drawn with the RMS velocity spread * width; 1 in the text
    anisotropy : u' has the density (1 + anisotropy mu) / 4 pi, mu the radial component
    out : float64[6], overwritten: (radial, tangential) of c*, c' and c'*
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
    out[0], out[1] = x, math.sqrt(y * y + z * z)
    out[2] = mean_x + half_x
    out[3] = math.sqrt((mean_y + half_y) ** 2 + (mean_z + half_z) ** 2)
    out[4] = mean_x - half_x
    out[5] = math.sqrt((mean_y - half_y) ** 2 + (mean_z - half_z) ** 2)
    return weight


@inlined
def tree(radius, radial, tangential, time, laws, state, stack, places, max_nodes, stream):
    """Return (W, nodes) of one realization; nodes is -1 if the budget is exceeded.

    Parameters
    ----------
    radius, radial, tangential, time : probe; time is the phase omega t
    laws : float64[5], rate of the inner majorant, q, spread, anisotropy, 1 for the BKW start and
        0 for the breathing state
    state : float64[4], eps, phi0, and at time 0 flow / r and the thermal speed squared
    stack : float64[DEPTH, 15], per level: time, radius, weight, the branches' four velocities (8)
        and results (4)
    places : int64[DEPTH], the branch under way
    """
    level, nodes, drawn = 0, 0, 0
    while True:
        nodes += 1
        collided = False
        while True:
            drawn += 1
            if drawn > max_nodes:
                return 0.0, -1
            span = exponential(stream) / laws[0]
            if span >= time:
                radius, radial, tangential = back(radius, radial, tangential, time)
                break
            time -= span
            radius, radial, tangential = back(radius, radial, tangential, span)
            size = 1.0 + state[0] * math.sin(2.0 * time + state[1])
            chance = math.exp(-0.5 * radius * radius / size) * ((1.0 - state[0]) / size) ** 1.5
            if uniform(stream) < chance:
                collided = True
                break
        if collided:
            if level >= DEPTH:
                return 0.0, -1
            phi = 2.0 * time + state[1]
            flow = state[0] * math.cos(phi) / size * radius
            width = math.sqrt((1.0 - state[0] * state[0]) / size)
            here = stack[level]
            here[0], here[1], here[3], here[4] = time, radius, radial, tangential
            here[2] = laws[1] * collide(
                radial, tangential, flow, width, laws[2], laws[3], here[5:11], stream
            )
            places[level] = 0
            level += 1
            continue
        value = start_ratio(radius, radial, tangential, state) if laws[4] == 1.0 else 1.0
        while level > 0:
            here = stack[level - 1]
            here[11 + places[level - 1]] = value
            places[level - 1] += int64(1)
            if places[level - 1] < 4:
                break
            value = here[11] + here[2] * (here[13] * here[14] - here[11] * here[12])
            level -= 1
        if level == 0:
            return value, nodes
        here, place = stack[level - 1], 3 + 2 * places[level - 1]
        time, radius, radial, tangential = here[0], here[1], here[place], here[place + 1]


@inlined
def frozen_state(breathing, start_phase):
    """Return `state` of `tree`."""
    size = 1.0 + breathing * math.sin(start_phase)
    flow = breathing * math.cos(start_phase) / size
    return np.array([breathing, start_phase, flow, (1.0 - breathing * breathing) / size])


@inlined
def sampling_laws(coupling, breathing, majorant, spread, anisotropy, start):
    """Return `laws` of `tree`: the inner majorant is the densest the cloud ever is."""
    densest = (2.0 * math.pi * (1.0 - breathing)) ** -1.5
    return np.array([majorant * coupling * densest, 1.0 / majorant, spread, anisotropy, start])


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
    stack, places = np.empty((DEPTH, 15)), np.empty(DEPTH, np.int64)
    state = frozen_state(physics[1], physics[2])
    laws = sampling_laws(physics[0], physics[1], choices[0], choices[1], choices[2], physics[3])
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
    stack, places = np.empty((DEPTH, 15)), np.empty(DEPTH, np.int64)
    state = frozen_state(physics[1], physics[2])
    laws = sampling_laws(physics[0], physics[1], choices[0], choices[1], choices[2], physics[3])
    phi = 2.0 * time + physics[2]
    size = 1.0 + physics[1] * math.sin(phi)
    flow = physics[1] * math.cos(phi) / size
    width = math.sqrt((1.0 - physics[1] ** 2) / size)
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
