"""Bird's DSMC algorithm: a fixed number of collisions, pairs with replacement (Kac paper, 4.2)."""

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
from kacsim.kernels.jit import inlined, kernel
from kacsim.variates import failures_before_success, gap_scale, index_below, pair_below, uniform


def arguments(*, n_particles, time, collision_rate):
    """Return the kernels' parameters: the particles and the collisions of one ensemble.

    One collision per 2 / (rate N) until the clock reaches t: ceil(rate N t / 2) of them.
    """
    return n_particles, math.ceil(collision_rate * n_particles * time / 2)


@kernel
def forward(velocities, own, n_particles, n_collisions, stream):
    """Draw v_1(t) from whole ensembles, as published.

    Parameters
    ----------
    velocities : float64[n], overwritten by independent draws of v_1
    own : int64[n], overwritten by the number of collisions of particle 1
    n_particles, n_collisions : int, from `arguments`
    stream : uint64[4], advanced

    Returns
    -------
    int, collisions simulated
    """
    v = np.empty(n_particles)
    for draw in range(velocities.size):
        for i in range(n_particles):
            v[i] = initial_velocity(stream)
        touched = 0
        for _ in range(n_collisions):
            i, j = pair_below(n_particles, stream)
            collide(v, i, j, stream)
            touched += (i == 0) + (j == 0)
        velocities[draw] = v[0]
        own[draw] = touched
    return velocities.size * n_collisions


@growing
@kernel
def ancestral(velocities, own, n_particles, n_collisions, stream, first, second, energy):
    """Draw v_1(t) from the ancestors of particle 1 only; same law and parameters as `forward`."""
    scales = touch_scales(n_particles)
    start = stream.copy()
    simulated = 0
    for draw in range(velocities.size):
        copy_state(stream, start)
        n, members, touched, left = 0, 1, 0, n_collisions
        while True:
            scale = scales[members] if members < scales.size else touch_scale(members, n_particles)
            left -= failures_before_success(scale, stream) + 1
            if left < 0:
                break
            if n == first.size:
                copy_state(start, stream)
                return draw, simulated
            i = index_below(members, stream)
            j = members
            if uniform(stream) * (2.0 * n_particles - members - 1) < members - 1:
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


@inlined
def touch_scale(members, n_particles):
    """Return the `gap_scale` of the chance that a uniform pair touches the ancestors.

    s of N particles are touched by s (N - s) + s (s - 1) / 2 of the N (N - 1) / 2 pairs.
    """
    size = float(n_particles)
    return gap_scale(members * (2.0 * size - members - 1.0) / (size * (size - 1.0)))


@inlined
def touch_scales(n_particles):
    """Return `touch_scale` for 0..255 members (a logarithm saved per collision)."""
    scales = np.empty(min(n_particles + 1, 256))
    for members in range(scales.size):
        scales[members] = touch_scale(members, n_particles)
    return scales


def fourth_moment(*, n_particles, time, collision_rate):
    """Return E v_1**4 after a fixed number of collisions of uniform pairs."""
    n, collisions = arguments(n_particles=n_particles, time=time, collision_rate=collision_rate)
    ratio = 1.0 - (n + 2.0) / (2.0 * n * (n - 1.0))
    return INITIAL_SQUARE + gain(n) * (1.0 - ratio**collisions)
