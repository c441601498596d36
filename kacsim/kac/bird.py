"""Bird's DSMC algorithm: a fixed number of collisions, pairs with replacement (Kac paper, 4.2)."""

import math

import numpy as np

from kacsim.jit import inlined, kernel
from kacsim.kac.model import (
    collide,
    fill_initial_energies,
    grown,
    initial_velocity,
    share,
    signed_root,
)
from kacsim.variates import failures_before_success, gap_scale, index_below, pair_below, uniform


def arguments(*, n_particles, time, collision_rate, **_):
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


@kernel
def ancestral(velocities, own, n_particles, n_collisions, stream):
    """Draw v_1(t) from the ancestors of particle 1 only; same law and parameters as `forward`."""
    scales = touch_scales(n_particles)
    first, second = np.empty(64, np.int64), np.empty(64, np.int64)
    energy = np.empty(64)
    simulated = 0
    for draw in range(velocities.size):
        n, members, touched, left = 0, 1, 0, n_collisions
        while True:
            scale = scales[members] if members < scales.size else touch_scale(members, n_particles)
            left -= failures_before_success(scale, stream) + 1
            if left < 0:
                break
            i = index_below(members, stream)
            if uniform(stream) * (2.0 * n_particles - members - 1) < members - 1:
                j = index_below(members - 1, stream)
                j += j >= i
            else:
                j = members
                members += 1
            if n == first.size:
                first, second = grown(first), grown(second)
            first[n], second[n] = i, j
            touched += (i == 0) + (j == 0)
            n += 1
        energy = fill_initial_energies(energy, members, stream)
        for event in range(n - 1, -1, -1):
            share(energy, first[event], second[event], stream)
        velocities[draw] = signed_root(energy[0], stream)
        own[draw] = touched
        simulated += n
    return simulated


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
