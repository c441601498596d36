"""Bird's algorithm with lazy pairs: for each that collides, some are passed over.

An example of a new algorithm of Kac's model: docs/architecture.md walks through it.
"""

import math

import numpy as np
from numba import int64

from kacsim.kac.model import (
    collide,
    copy_state,
    growing,
    initial_velocity,
    replay,
    signed_root,
)
from kacsim.kac.moments import INITIAL_SQUARE, gain
from kacsim.kernels.jit import kernel
from kacsim.variates import failures_before_success, gap_scale, index_below, pair_below, uniform


def arguments(*, n_particles, time, collision_rate, laziness):
    """Return the kernels' parameters: particles, pairs picked, and the chance of a collision."""
    return n_particles, math.ceil(collision_rate * n_particles * time / 2), 1.0 / (1.0 + laziness)


@kernel
def forward(velocities, own, n_particles, n_picked, chance, stream):
    """Draw v_1(t) from whole ensembles.

    Parameters
    ----------
    velocities : float64[n], overwritten by independent draws of v_1
    own : int64[n], overwritten by the number of collisions of particle 1
    n_particles, n_picked, chance : from `arguments`
    stream : from `new_stream`, advanced

    Returns
    -------
    int, collisions simulated
    """
    v = np.empty(n_particles)
    simulated = 0
    for draw in range(velocities.size):
        for i in range(n_particles):
            v[i] = initial_velocity(stream)
        touched = 0
        for _ in range(n_picked):
            if uniform(stream) < chance:
                i, j = pair_below(n_particles, stream)
                collide(v, i, j, stream)
                touched += (i == 0) + (j == 0)
                simulated += 1
        velocities[draw] = v[0]
        own[draw] = touched
    return simulated


@growing
@kernel
def ancestral(velocities, own, n_particles, n_picked, chance, stream, first, second, energy):
    """Draw v_1(t) from the ancestors of particle 1 only; same law and parameters as `forward`."""
    start = stream.copy()
    pairs = 0.5 * n_particles * (n_particles - 1.0)
    simulated = 0
    for draw in range(velocities.size):
        copy_state(stream, start)
        n, members, touched, left = 0, 1, 0, n_picked
        while True:
            inner = 0.5 * members * (members - 1.0)
            reach = inner + members * float(n_particles - members)
            left -= failures_before_success(gap_scale(chance * reach / pairs), stream) + 1
            if left < 0:
                break
            if n == first.size:
                copy_state(start, stream)
                return draw, simulated
            i, j = index_below(members, stream), members
            if uniform(stream) * reach < inner:
                j = index_below(members - 1, stream)
                j += int64(j >= i)
            else:
                members += 1
            first[n], second[n] = i, j
            touched += int64(i == 0) + int64(j == 0)
            n += 1
        velocities[draw] = signed_root(replay(energy, members, first, second, n, stream), stream)
        own[draw] = touched
        simulated += n
    return velocities.size, simulated


def fourth_moment(*, n_particles, time, collision_rate, laziness):
    """Return E v_1**4 after all picks.

    Each keeps 1 - chance (N + 2) / (2 N (N - 1)) of the distance to 3/5 of the squared energy.
    """
    n = n_particles
    _, picked, chance = arguments(
        n_particles=n, time=time, collision_rate=collision_rate, laziness=laziness
    )
    ratio = 1.0 - chance * (n + 2.0) / (2.0 * n * (n - 1.0))
    return INITIAL_SQUARE + gain(n) * (1.0 - ratio**picked)
