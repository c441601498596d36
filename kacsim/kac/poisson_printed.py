"""The Poisson algorithm with the rate that the text prints (Kac paper, 4.3).

The other N - 1 particles collide among themselves at the rate (N - 1)/2, in units of the collision
rate, i.e. 1/(N - 2) for each of their pairs: not Kac's process.
"""

import numpy as np
from numba import int64
from scipy import linalg

from kacsim.kac import model, own_law
from kacsim.kac.moments import INITIAL_PRODUCT, INITIAL_SQUARE
from kacsim.kac.poisson import forward, own_forward
from kacsim.kac.tape import ancestral_draws
from kacsim.kernels.jit import allocating, inlined
from kacsim.variates import exponential, two_below, uniform

__all__ = ["ancestral", "arguments", "forward", "fourth_moment", "own_ancestral", "own_forward"]


def arguments(*, n_particles, time, collision_rate):
    """Return the kernels' parameters, as `kacsim.kac.poisson.arguments`."""
    pair_rate = 0.0 if n_particles == 2 else 1.0 / (n_particles - 2)
    return n_particles, collision_rate * time, pair_rate


@allocating
def prepare(arguments, most):
    """Return the mean time between collisions that touch particle 1 or one of s others, s < `most`.

    Rates: 1 for particle 1, then every pair that touches one of the others.
    """
    n_particles, _, pair_rate = arguments
    pauses = np.empty(most)
    for s in range(most):
        pauses[s] = 1.0 / (1.0 + 0.5 * pair_rate * s * (2.0 * (n_particles - 1.0) - s - 1.0))
    return pauses


@inlined
def history(arguments, pauses, tape, start, root, stream):
    """Find the collisions of one draw, from one to the one before it through exponential pauses."""
    n_particles, left, _ = arguments
    n, others, own = start, 0, 0
    while True:
        left -= exponential(stream) * pauses[others]
        if left < 0.0:
            return n, others + 1, own
        if n == tape.first.size or others + 1 == pauses.size:
            return -1, others + 1, own
        # N - 1 partners for particle 1; for others as in `kacsim.kac.poisson`, N less by one.
        alone = uniform(stream) < pauses[others]
        ways = n_particles - 1 if alone else 2 * (n_particles - 1) - others - 1
        i, j = two_below(1 if alone else others, ways, stream)
        if j < others - int64(not alone):
            j += int64(j >= i and not alone)
        else:
            j = others
            others += 1
        i = 0 if alone else 1 + i
        tape.first[n], tape.second[n] = root + i, root + 1 + j
        own += int64(alone)
        n += 1


ancestral = ancestral_draws(model, prepare, history)
own_ancestral = ancestral_draws(own_law, prepare, history)


def fourth_moment(*, n_particles, time, collision_rate, pair_rate=None):
    """Return E v_1**4.

    Unknowns: particle 1's E x_1**2, E x_1 x_j, and the others' E x_j**2, E x_j x_k.

    Parameters
    ----------
    pair_rate : rate of each pair of the other particles, in units of the collision rate; that of
        the text if not given
    """
    n = n_particles
    own = 1.0 / (n - 1.0)
    printed = 1.0 / (n - 2.0) if n > 2 else 0.0
    pair = printed if pair_rate is None else pair_rate
    others = n - 2.0
    shared = np.array([1.0, 2.0, 1.0, 0.0])
    matrix = np.zeros((4, 4))
    matrix[0] = 3.0 / 8.0 * shared - [1.0, 0.0, 0.0, 0.0]
    matrix[1] = own * (shared / 8.0 - [0.0, 1.0, 0.0, 0.0])
    matrix[1] += own * others * np.array([0.0, -0.5, 0.0, 0.5])
    matrix[2] = own * (3.0 / 8.0 * shared - [0.0, 0.0, 1.0, 0.0])
    matrix[2] += pair * others * np.array([0.0, 0.0, -0.25, 0.75])
    matrix[3] = 2.0 * own * np.array([0.0, 0.5, 0.0, -0.5])
    matrix[3] += pair * np.array([0.0, 0.0, 0.25, -0.75])
    start = [INITIAL_SQUARE, INITIAL_PRODUCT, INITIAL_SQUARE, INITIAL_PRODUCT]
    return float((linalg.expm(matrix * (collision_rate * time)) @ start)[0])
