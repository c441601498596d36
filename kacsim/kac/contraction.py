"""How fast corner points come together: the mean over pairs and angles (Kac paper, section 5)."""

import math

from kacsim.kac.constants import MEAN_ENERGY


def contraction_rate(n_particles):
    """Return by how much E sum (x_j - y_j)**2 of two energy vectors falls per step, relatively.

    A step replaces (d_p, d_q) by (a, 1 - a)(d_p + d_q) with E a**2 = 3/8; averaged over pairs,
    with sum d = 0, the square sum falls by the share (N + 2) / (2 N (N - 1)).
    """
    return (n_particles + 2.0) / (2.0 * n_particles * (n_particles - 1.0))


def predicted_steps(n_particles, tolerance, energy=None):
    """Return the steps after which the mean squared distance reaches tolerance**2.

    The distance of energies stands for that of velocities (D**2 ~ sum d**2 / (4 x), x ~ E/N),
    and the mean for the typical value; by Jensen's inequality the slope in log(1/tolerance)
    bounds that of the true coupling time from above.

    Parameters
    ----------
    n_particles : int >= 3; two particles meet in one step
    tolerance : float, distance of two corner points
    energy : float, the sphere's sum of v**2, 3 N / 2 by default
    """
    total = MEAN_ENERGY * n_particles if energy is None else energy
    start = n_particles * total / 2.0  # two corners: d = +-E, x = E/N
    return math.log(start / tolerance**2) / -math.log1p(-contraction_rate(n_particles))


def chosen_block(n_particles):
    """Return how many random steps a block of the perfect sampler has, the fewer the more fail.

    Any number is right. After this one the mean square distance of two energy vectors has fallen to
    about 2700 N**-9.4 of what it was; for N from 3 to 1000 a draw takes at most 7 % more steps than
    it has to by `blocks_per_draw`, and at most 2 % more from N = 7 on.
    """
    if n_particles == 2:
        return 0  # the sweep's only pair has all the energy
    needed = 9.4 * math.log(n_particles) - 7.9
    return math.ceil(needed / -math.log1p(-contraction_rate(n_particles)))


def blocks_per_draw(n_particles, block):
    """Return about the mean number of blocks per block that succeeds.

    The chance of failing is a sum over the sweep of roots of relative distances, so that it falls
    with a quarter of the contraction rate or, the distance being what it is for most inputs and not
    on average, a little faster. The numbers were fitted to trials with N from 3 to 140, within 10 %
    where fewer than half of the blocks fail.
    """
    if n_particles == 2:
        return 1.0
    n, fall = float(n_particles), -math.log1p(-contraction_rate(n_particles)) * block
    part = 0.2566 + 0.146 / n + 2.26 / (n * n)
    return math.exp(min(700.0, math.exp(1.9 * math.log(n) - 1.85 - part * fall)))
