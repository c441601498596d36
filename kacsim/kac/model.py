"""Kac's model: the initial law f0 and the collision (Kac paper, sections 2.1 and 3).

A module like this one is a law of collisions. The algorithms beside it say who collides with whom,
and take the law as a parameter: `kacsim.kac.own_law`, which draws from tables that a call gives,
and `kacsim.maxwell.model` are others. A law has

- for whole ensembles `ensemble`, `start`, `collide`, `deflect` and `copy`;
- for the collisions on a tape `new_state` and `fill`, then `share`, `receive`, `foresee` and
  `settle`, which make one of them, and `read`.
"""

import math
from typing import NamedTuple

import numpy as np

from kacsim.kernels.jit import allocating, inlined
from kacsim.streams import BLOCK
from kacsim.variates import (
    maxwell_energies,
    maxwell_speed,
    random_sign,
    squared_cosines,
    unit_circle,
)


@allocating
def ensemble(n_particles, tables):
    """Return an array for the velocities of particles; this law has no tables."""
    return np.empty(n_particles)


@inlined
def initial_velocity(stream):
    """Return a velocity under f0."""
    return maxwell_speed(stream) * random_sign(stream)


@inlined
def signed_root(energy, stream):
    """Return a velocity of the given energy v**2 with a random sign."""
    return math.sqrt(energy) * random_sign(stream)


@inlined
def start(v, i, stream):
    """Set v_i to a velocity under f0."""
    v[i] = initial_velocity(stream)


@inlined
def copy(values, k, v, i):
    """Set a velocity, at place k, to v_i."""
    values[k] = v[i]


@inlined
def collide(v, i, j, stream):
    """Rotate the pair (v_i, v_j) by a uniform angle (Kac paper, section 2.1, step 3).

    Parameters
    ----------
    v : float64[N], velocities, overwritten at i and j; v_i**2 + v_j**2 is conserved
    i, j : distinct indices below N
    stream : from `new_stream`, advanced
    """
    cos, sin = unit_circle(stream)
    vi, vj = v[i], v[j]
    v[i] = vi * cos + vj * sin
    v[j] = vj * cos - vi * sin


@inlined
def deflect(values, k, v, i, j, stream):
    """Set values[k] to v_i cos(theta) + v_j sin(theta), Nanbu's collision that leaves v_j as it is.

    `values` may be v itself.
    """
    cos, sin = unit_circle(stream)
    values[k] = v[i] * cos + v[j] * sin


class Energies(NamedTuple):
    """What histories on a tape are replayed with.

    A uniform rotation makes v_i**2 = (v_i**2 + v_j**2) cos(theta)**2 with theta uniform, and both
    signs uniform and independent of all energies; the sign of v_1 is drawn once, at the end.

    Attributes
    ----------
    energy : float64[slots], of the ancestor in each slot
    part, new : float64[events], cos(theta)**2 of each collision; workspace
    missed : uint64[BLOCK], workspace
    """

    energy: object
    part: object
    new: object
    missed: object


def new_state(n_events, n_slots):
    """Return `Energies` for so many collisions and ancestors."""
    return Energies(
        np.empty(n_slots), np.empty(n_events), np.empty(n_events), np.empty(BLOCK, np.uint64)
    )


@inlined
def fill(state, n_events, n_slots, stream):
    """Draw energies at time 0 for the ancestors, and an angle for every collision."""
    maxwell_energies(state.energy, state.missed, n_slots, stream)
    squared_cosines(state.part, n_events, stream)


@inlined
def share(state, i, j, event):
    """Make the collision after which both ancestors have a part of the pair's energy."""
    total = state.energy[i] + state.energy[j]
    state.energy[i] = total * state.part[event]
    state.energy[j] = total - state.energy[i]


@inlined
def receive(state, i, j, event):
    """Make the collision that changes ancestor i only."""
    state.energy[i] = (state.energy[i] + state.energy[j]) * state.part[event]


@inlined
def foresee(state, i, j, event):
    """Note what ancestor i has after a collision that changes it only."""
    state.new[event] = (state.energy[i] + state.energy[j]) * state.part[event]


@inlined
def settle(state, i, event):
    """Give ancestor i what was noted."""
    state.energy[i] = state.new[event]


@inlined
def read(velocities, draw, state, slot, stream):
    """Set the velocity of a draw to that of the ancestor in a slot, with a random sign."""
    velocities[draw] = signed_root(state.energy[slot], stream)
