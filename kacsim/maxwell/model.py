"""Maxwell molecules: the BKW mode at time 0, and the collision that scatters isotropically.

A law of collisions, as `kacsim.kac.model`, of velocities with three components. After a collision
v', w' = (v + w)/2 + and - |v - w|/2 u, u a uniform direction: momentum and energy are conserved.
The density of the BKW mode at time 0 is proportional to c**2 exp(-c**2/1.2), so that |v|**2 / 1.2
is a Gamma(5/2) variate: that of a `maxwell_speed`'s square, Gamma(3/2), and an exponential one.
"""

import math
from typing import NamedTuple

import numpy as np

from kacsim.kernels.jit import allocating, inlined
from kacsim.maxwell.constants import INITIAL_SCALE
from kacsim.streams import BLOCK
from kacsim.variates import (
    direction,
    directions,
    exponential,
    maxwell_energies,
    maxwell_speed,
)


@allocating
def ensemble(n_particles, tables):
    """Return an array for the velocities of particles; this law has no tables."""
    return np.empty((n_particles, 3))


@inlined
def start(v, i, stream):
    """Set v_i to a velocity of the BKW mode at time 0."""
    square = maxwell_speed(stream) ** 2 + exponential(stream)
    speed = math.sqrt(INITIAL_SCALE * square)
    x, y, z = direction(stream)
    v[i, 0], v[i, 1], v[i, 2] = speed * x, speed * y, speed * z


@inlined
def copy(values, k, v, i):
    """Set a velocity, at place k, to v_i."""
    values[k, 0], values[k, 1], values[k, 2] = v[i, 0], v[i, 1], v[i, 2]


@inlined
def half_distance(dx, dy, dz):
    """Return half the length of a vector."""
    return 0.5 * math.sqrt(dx * dx + dy * dy + dz * dz)


@inlined
def scattered(v, i, j, stream):
    """Return the mean velocity of a pair, and its half relative velocity after a collision."""
    x, y, z = direction(stream)
    half = half_distance(v[i, 0] - v[j, 0], v[i, 1] - v[j, 1], v[i, 2] - v[j, 2])
    mean = 0.5 * (v[i, 0] + v[j, 0]), 0.5 * (v[i, 1] + v[j, 1]), 0.5 * (v[i, 2] + v[j, 2])
    return mean, (half * x, half * y, half * z)


@inlined
def collide(v, i, j, stream):
    """Scatter a pair.

    Parameters
    ----------
    v : float64[N, 3], velocities, overwritten at i and j
    i, j : distinct indices below N
    stream : from `new_stream`, advanced
    """
    mean, turned = scattered(v, i, j, stream)
    v[i, 0], v[i, 1], v[i, 2] = mean[0] + turned[0], mean[1] + turned[1], mean[2] + turned[2]
    v[j, 0], v[j, 1], v[j, 2] = mean[0] - turned[0], mean[1] - turned[1], mean[2] - turned[2]


@inlined
def deflect(values, k, v, i, j, stream):
    """Set values[k] to what v_i is after a collision that leaves v_j as it is (Nanbu)."""
    mean, turned = scattered(v, i, j, stream)
    values[k, 0], values[k, 1] = mean[0] + turned[0], mean[1] + turned[1]
    values[k, 2] = mean[2] + turned[2]


class Velocities(NamedTuple):
    """What histories on a tape are replayed with.

    Attributes
    ----------
    x, y, z : float64[slots], velocity of the ancestor in each slot
    to_x, to_y, to_z : float64[events], direction of each collision
    new_x, new_y, new_z : float64[events], workspace
    square : float64[slots], workspace
    missed : uint64[BLOCK], workspace
    """

    x: object
    y: object
    z: object
    to_x: object
    to_y: object
    to_z: object
    new_x: object
    new_y: object
    new_z: object
    square: object
    missed: object


def new_state(n_events, n_slots):
    """Return `Velocities` for so many collisions and ancestors."""
    slots, events = np.empty((4, n_slots)), np.empty((6, n_events))
    return Velocities(*slots[:3], *events, slots[3], np.empty(BLOCK, np.uint64))


@inlined
def fill(state, n_events, n_slots, stream):
    """Draw velocities at time 0 for the ancestors, and a direction for every collision."""
    maxwell_energies(state.square, state.missed, n_slots, stream)
    for k in range(n_slots):
        state.square[k] += exponential(stream)
    directions(state.x, state.y, state.z, n_slots, stream)
    for k in range(n_slots):
        speed = math.sqrt(INITIAL_SCALE * state.square[k])
        state.x[k] *= speed
        state.y[k] *= speed
        state.z[k] *= speed
    directions(state.to_x, state.to_y, state.to_z, n_events, stream)


@inlined
def half_relative(state, i, j):
    """Return half the relative speed of two ancestors."""
    return half_distance(state.x[i] - state.x[j], state.y[i] - state.y[j], state.z[i] - state.z[j])


@inlined
def share(state, i, j, event):
    """Make the collision that scatters both ancestors."""
    half = half_relative(state, i, j)
    x, y, z = half * state.to_x[event], half * state.to_y[event], half * state.to_z[event]
    mean_x, mean_y = 0.5 * (state.x[i] + state.x[j]), 0.5 * (state.y[i] + state.y[j])
    mean_z = 0.5 * (state.z[i] + state.z[j])
    state.x[i], state.y[i], state.z[i] = mean_x + x, mean_y + y, mean_z + z
    state.x[j], state.y[j], state.z[j] = mean_x - x, mean_y - y, mean_z - z


@inlined
def receive(state, i, j, event):
    """Make the collision that changes ancestor i only."""
    half = half_relative(state, i, j)
    state.x[i] = 0.5 * (state.x[i] + state.x[j]) + half * state.to_x[event]
    state.y[i] = 0.5 * (state.y[i] + state.y[j]) + half * state.to_y[event]
    state.z[i] = 0.5 * (state.z[i] + state.z[j]) + half * state.to_z[event]


@inlined
def foresee(state, i, j, event):
    """Note what ancestor i has after a collision that changes it only."""
    half = half_relative(state, i, j)
    state.new_x[event] = 0.5 * (state.x[i] + state.x[j]) + half * state.to_x[event]
    state.new_y[event] = 0.5 * (state.y[i] + state.y[j]) + half * state.to_y[event]
    state.new_z[event] = 0.5 * (state.z[i] + state.z[j]) + half * state.to_z[event]


@inlined
def settle(state, i, event):
    """Give ancestor i what was noted."""
    state.x[i], state.y[i], state.z[i] = state.new_x[event], state.new_y[event], state.new_z[event]


@inlined
def read(velocities, draw, state, slot, stream):
    """Set the velocity of a draw to that of the ancestor in a slot."""
    velocities[draw, 0] = state.x[slot]
    velocities[draw, 1] = state.y[slot]
    velocities[draw, 2] = state.z[slot]
