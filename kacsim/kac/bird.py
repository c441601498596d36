"""Bird's DSMC algorithm: a fixed number of collisions, pairs with replacement (Kac paper, 4.2)."""

import math

import numpy as np
from numba import int64

from kacsim.kac import model, own_law
from kacsim.kac.moments import INITIAL_SQUARE, gain
from kacsim.kac.tape import ancestral_draws
from kacsim.kernels.jit import allocating, inlined, kernel
from kacsim.variates import failures_before_success, gap_scale, pair_below, two_below


def arguments(*, n_particles, time, collision_rate):
    """Return the kernels' parameters: the particles and the collisions of one ensemble.

    One collision per 2 / (rate N) until the clock reaches t: ceil(rate N t / 2) of them.
    """
    return n_particles, math.ceil(collision_rate * n_particles * time / 2)


def forward_draws(law):
    """Return the kernel that draws v_1(t) from whole ensembles.

    Parameters
    ----------
    law : module of the law of collisions, such as `kacsim.kac.model`
    """
    ensemble, start, collide, copy = law.ensemble, law.start, law.collide, law.copy

    @kernel
    def forward(velocities, own, n_particles, n_collisions, stream, tables=()):
        """Draw v_1(t) from whole ensembles, as published.

        Parameters
        ----------
        velocities : float64[n] or float64[n, 3], overwritten by independent draws of v_1
        own : int64[n], overwritten by the number of collisions of particle 1
        n_particles, n_collisions : int, from `arguments`
        stream : from `new_stream`, advanced
        tables : what the law of collisions draws from, if it has tables

        Returns
        -------
        int, collisions simulated
        """
        v = ensemble(n_particles, tables)
        for draw in range(len(velocities)):
            for i in range(n_particles):
                start(v, i, stream)
            touched = 0
            for _ in range(n_collisions):
                i, j = pair_below(n_particles, stream)
                collide(v, i, j, stream)
                touched += (i == 0) + (j == 0)
            copy(velocities, draw, v, 0)
            own[draw] = touched
        return len(velocities) * n_collisions

    return forward


@inlined
def touch_scale(members, n_particles):
    """Return the `gap_scale` of the chance that a uniform pair touches the ancestors.

    s of N particles are touched by s (N - s) + s (s - 1) / 2 of the N (N - 1) / 2 pairs.
    """
    size = float(n_particles)
    return gap_scale(members * (2.0 * size - members - 1.0) / (size * (size - 1.0)))


@allocating
def prepare(arguments, most):
    """Return `touch_scale` of s < `most` ancestors, then 0: it saves a logarithm a collision."""
    n_particles = arguments[0]
    scales = np.zeros(min(n_particles + 1, most) + 1)
    for members in range(1, scales.size - 1):
        scales[members] = touch_scale(members, n_particles)
    return scales


@inlined
def history(arguments, scales, tape, start, root, stream):
    """Find the collisions of one draw, from the last of the ensemble's back to the first.

    Those that touch no ancestor are skipped: their number before the next one is geometric.
    """
    n_particles, left = arguments
    n, members, own = start, 1, 0
    while True:
        left -= failures_before_success(scales[members], stream) + 1
        if n == tape.first.size or members == scales.size - 1:
            return -1, members, own
        if left < 0:
            return n, members, own
        # Of the 2 N - s - 1 ways to touch one of s ancestors, s - 1 have another one as partner.
        i, j = two_below(members, 2 * n_particles - members - 1, stream)
        if j < members - 1:
            j += int64(j >= i)
        else:
            j = members
            members += 1
        tape.first[n], tape.second[n] = root + i, root + j
        own += int64(i == 0) + int64(j == 0)
        n += 1


forward = forward_draws(model)
ancestral = ancestral_draws(model, prepare, history)
own_forward = forward_draws(own_law)
own_ancestral = ancestral_draws(own_law, prepare, history)


def fourth_moment(*, n_particles, time, collision_rate):
    """Return E v_1**4 after a fixed number of collisions of uniform pairs."""
    n, collisions = arguments(n_particles=n_particles, time=time, collision_rate=collision_rate)
    lost = (n + 2.0) / (2.0 * n * (n - 1.0))
    left = math.expm1(collisions * math.log1p(-lost)) if lost < 1.0 else -1.0
    return INITIAL_SQUARE - gain(n) * left
