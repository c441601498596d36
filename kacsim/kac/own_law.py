"""Kac's model with an initial law and a law of the scattering angle of one's own, from tables.

A law of collisions, as `kacsim.kac.model`, whose ``tables`` are two `Drawn`: of the velocity at
time 0 and of the angle theta, with which a pair becomes (Kac paper, section 2.1)

    v' = v cos(theta) + w sin(theta),    w' = w cos(theta) - v sin(theta).

Tables reach the kernels as arguments and lie in the ensemble or in the state of a tape: the kernels
of an algorithm are compiled once for all tables. A general angle ties the signs of velocities to
their sizes, so that velocities are replayed and not energies.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import int64, types
from numba.extending import overload

from kacsim.elementary.circular import cos_sin
from kacsim.kac.model import initial_velocity
from kacsim.kernels.jit import allocating, inlined
from kacsim.variates import normal, uniform


class Drawn(NamedTuple):
    """A law on the line: one of several pieces, by Walker's aliases, and what is added to it.

    Attributes
    ----------
    start, width : float64[k], where each piece begins and how far it reaches, to the left if
        negative; without pieces the value is 0
    tilt : float64[k], 0 to 1, the density rises from its start from 1 - tilt to 1 + tilt times its
        mean
    cut : float64[k], the chance that piece i, chosen among k alike, is taken; else other[i] is
    other : int64[k]
    spread : float, standard deviation of a normal variate that is added
    paper : bool, whether a velocity under the paper's f0 is added
    """

    start: object
    width: object
    tilt: object
    cut: object
    other: object
    spread: float
    paper: bool


@inlined
def in_piece(law, stream):
    """Return a value of the pieces of a `Drawn`; two uniforms."""
    place = uniform(stream) * law.start.size
    k = int64(place)
    if place - k >= law.cut[k]:
        k = law.other[k]
    # Not 0, at which a density that begins with 0 would give 0 / 0.
    u = 1.0 - uniform(stream)
    left = 1.0 - law.tilt[k]
    root = math.sqrt(left * left + 4.0 * law.tilt[k] * u)
    return law.start[k] + law.width[k] * (2.0 * u / (left + root))


@inlined
def velocity_at_start(law, stream):
    """Return a velocity at time 0."""
    velocity = 0.0
    if law.start.size > 0:
        velocity = in_piece(law, stream)
    if law.spread > 0.0:
        velocity += law.spread * normal(stream)
    if law.paper:
        velocity += initial_velocity(stream)
    return velocity


class Ensemble(NamedTuple):
    """Velocities of particles, float64[N], and the laws that they are drawn by."""

    velocity: object
    initial: object
    angle: object


@allocating
def ensemble(n_particles, tables):
    """Return an `Ensemble` of particles."""
    return Ensemble(np.empty(n_particles), tables[0], tables[1])


@inlined
def start(v, i, stream):
    """Set v_i to a velocity of time 0."""
    v.velocity[i] = velocity_at_start(v.initial, stream)


def put(values, k, velocity):
    """Set a velocity, at place k of an array or of an ensemble."""
    (values.velocity if isinstance(values, Ensemble) else values)[k] = velocity


@overload(put, inline="always")
def _(values, k, velocity):
    def into_ensemble(values, k, velocity):
        values.velocity[k] = velocity

    def into_array(values, k, velocity):
        values[k] = velocity

    return into_ensemble if isinstance(values, types.BaseTuple) else into_array


@inlined
def copy(values, k, v, i):
    """Set a velocity, at place k of an array or of an ensemble, to v_i."""
    put(values, k, v.velocity[i])


@inlined
def collide(v, i, j, stream):
    """Rotate the pair (v_i, v_j) by an angle of the law."""
    cos, sin = cos_sin(in_piece(v.angle, stream))
    vi, vj = v.velocity[i], v.velocity[j]
    v.velocity[i] = vi * cos + vj * sin
    v.velocity[j] = vj * cos - vi * sin


@inlined
def deflect(values, k, v, i, j, stream):
    """Set value k to v_i cos(theta) + v_j sin(theta): Nanbu's collision, v_j stays."""
    cos, sin = cos_sin(in_piece(v.angle, stream))
    values.velocity[k] = v.velocity[i] * cos + v.velocity[j] * sin


class Histories(NamedTuple):
    """What histories on a tape are replayed with.

    Attributes
    ----------
    velocity : float64[slots], of the ancestor in each slot
    cos, sin, new : float64[events], of the angle of each collision; workspace
    initial, angle : `Drawn`
    """

    velocity: object
    cos: object
    sin: object
    new: object
    initial: object
    angle: object


def new_state(n_events, n_slots, initial, angle):
    """Return `Histories` for so many collisions and ancestors."""
    return Histories(np.empty(n_slots), *np.empty((3, n_events)), initial, angle)


@inlined
def fill(state, n_events, n_slots, stream):
    """Draw velocities at time 0 for the ancestors, and an angle for every collision."""
    for k in range(n_slots):
        state.velocity[k] = velocity_at_start(state.initial, stream)
    for event in range(n_events):
        state.cos[event], state.sin[event] = cos_sin(in_piece(state.angle, stream))


@inlined
def deflected(state, i, j, event):
    """Return the velocity of ancestor i after its collision with j."""
    return state.velocity[i] * state.cos[event] + state.velocity[j] * state.sin[event]


@inlined
def share(state, i, j, event):
    """Make the collision that rotates both ancestors."""
    turned = deflected(state, i, j, event)
    across = state.velocity[j] * state.cos[event] - state.velocity[i] * state.sin[event]
    state.velocity[i], state.velocity[j] = turned, across


@inlined
def receive(state, i, j, event):
    """Make the collision that changes ancestor i only."""
    state.velocity[i] = deflected(state, i, j, event)


@inlined
def foresee(state, i, j, event):
    """Note what ancestor i has after a collision that changes it only."""
    state.new[event] = deflected(state, i, j, event)


@inlined
def settle(state, i, event):
    """Give ancestor i what was noted."""
    state.velocity[i] = state.new[event]


@inlined
def read(velocities, draw, state, slot, stream):
    """Set the velocity of a draw to that of the ancestor in a slot."""
    velocities[draw] = state.velocity[slot]
