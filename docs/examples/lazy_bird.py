"""Bird's algorithm with lazy pairs: for each that collides, some are passed over.

An example of a new algorithm of Kac's model: docs/architecture.md walks through it.
"""

import math

import numpy as np

from kacsim.kac import bird, model
from kacsim.kac.moments import INITIAL_SQUARE, gain
from kacsim.kac.tape import ancestral_draws
from kacsim.kernels.jit import allocating, inlined, kernel
from kacsim.variates import gap_scale, pair_below, uniform


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
            model.start(v, i, stream)
        touched = 0
        for _ in range(n_picked):
            if uniform(stream) < chance:
                i, j = pair_below(n_particles, stream)
                model.collide(v, i, j, stream)
                touched += (i == 0) + (j == 0)
                simulated += 1
        velocities[draw] = v[0]
        own[draw] = touched
    return simulated


@allocating
def prepare(arguments, most):
    """Return the scales of the gaps between collisions that touch s < `most` ancestors, then 0.

    A pick does so with the chance of a collision times that of the pair.
    """
    n_particles, _, chance = arguments
    size = float(n_particles)
    scales = np.zeros(min(n_particles + 1, most) + 1)
    for s in range(1, scales.size - 1):
        scales[s] = gap_scale(chance * s * (2.0 * size - s - 1.0) / (size * (size - 1.0)))
    return scales


@inlined
def history(arguments, scales, tape, start, root, stream):
    """Find the collisions of one draw: Bird's, with longer gaps between them."""
    n_particles, n_picked, _ = arguments
    return bird.history((n_particles, n_picked), scales, tape, start, root, stream)


ancestral = ancestral_draws(model, prepare, history)


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
