"""The Poisson algorithm with the rate that the text prints (Kac paper, 4.3).

The other N - 1 particles collide among themselves at the rate (N - 1)/2, in units of the collision
rate, i.e. 1/(N - 2) for each of their pairs: not Kac's process.
"""

import numpy as np
from scipy import linalg

from kacsim.kac.moments import INITIAL_PRODUCT, INITIAL_SQUARE
from kacsim.kac.poisson import ancestral, forward

__all__ = ["ancestral", "arguments", "forward", "fourth_moment"]


def arguments(*, n_particles, time, collision_rate):
    """Return the kernels' parameters, as `kacsim.kac.poisson.arguments`."""
    pair_rate = 0.0 if n_particles == 2 else 1.0 / (n_particles - 2)
    return n_particles, collision_rate * time, pair_rate


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
