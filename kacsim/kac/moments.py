"""Exact fourth moments of every algorithm at finite N and finite step.

Second-order moments of the energies x_i = v_i**2 obey linear recursions. A rotation by a uniform
angle shares S = x_i + x_j so that E x_i'**2 = 3/8 E S**2, E x_i' x_j' = 1/8 E S**2 and
E x_i' x_k = 1/2 E S x_k. Unknowns: a = E x_i**2 and b = E x_i x_j; they start at 15/4 and 9/4.
"""

import math

import numpy as np
from scipy import linalg

from kacsim import checks
from kacsim.checks import RATE, n_steps

INITIAL_SQUARE = 15.0 / 4.0
INITIAL_PRODUCT = 9.0 / 4.0


def fourth_moment(
    time, n_particles=math.inf, *, algorithm="poisson", time_step=None, collision_rate=RATE
):
    """Return E v_1**4 at time t, exactly, for one algorithm at finite N and finite step.

    Parameters
    ----------
    time : float >= 0
    n_particles : int >= 2, or math.inf for the Kac equation (any algorithm but with a step)
    algorithm : name as in `kac.draw`; "poisson" is Kac's N-particle process itself
    time_step : float, for the Nanbu family

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    checks.raise_problems(checks.moment(algorithm, time, n_particles, time_step, collision_rate))
    if time == 0:
        return INITIAL_SQUARE
    if n_particles == math.inf:
        return INITIAL_SQUARE + 3.0 * -math.expm1(-collision_rate * time / 4.0)
    if algorithm == "poisson":
        rate = collision_rate * (n_particles + 2) / (4.0 * (n_particles - 1))
        return INITIAL_SQUARE + _limit(n_particles) * -math.expm1(-rate * time)
    if algorithm == "poisson_printed":
        return _poisson_printed(n_particles, collision_rate * time)
    if algorithm == "bird":
        return _bird(n_particles, math.ceil(collision_rate * n_particles * time / 2))
    recursion = {
        "nanbu_sequential": nanbu_sequential,
        "nanbu_synchronous": nanbu_synchronous,
        "nanbu_babovsky": nanbu_babovsky,
    }[algorithm]
    return recursion(n_particles, n_steps(time, time_step), collision_rate * time_step)


def _limit(n):
    return 3.0 * (n - 1.0) / (n + 2.0)


def _bird(n, collisions):
    """Return the moment after a fixed number of collisions of uniform pairs."""
    ratio = 1.0 - (n + 2.0) / (2.0 * n * (n - 1.0))
    return INITIAL_SQUARE + _limit(n) * (1.0 - ratio**collisions)


def _poisson_printed(n, mean_own):
    """Return the moment when the other N - 1 particles collide at the rate (N - 1)/2.

    Unknowns: particle 1's E x_1**2, E x_1 x_j, and the others' E x_j**2, E x_j x_k.
    """
    own = 1.0 / (n - 1.0)
    pair = 1.0 / (n - 2.0) if n > 2 else 0.0
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
    return float((linalg.expm(matrix * mean_own) @ start)[0])


def nanbu_babovsky(n, steps, probability, *, replacement=False):
    """Return the moment of disjoint pairs; linear in their number, so its mean is enough.

    With `replacement` the pairs of a step are drawn one after another, as the text once says.
    """
    pairs = n * probability / 2.0
    if replacement:
        return _with_replacement(n, steps, pairs)
    a, b = INITIAL_SQUARE, INITIAL_PRODUCT
    together = pairs / (n * (n - 1.0) / 2.0)
    for _ in range(steps):
        change = 0.75 * (a + b) - a
        a, b = a + probability * change, b + together * (0.25 * (a + b) - b)
    return a


def _with_replacement(n, steps, pairs):
    """Return the moment when each step makes Round[pairs] collisions of uniform pairs."""
    ratio = 1.0 - (n + 2.0) / (2.0 * n * (n - 1.0))
    whole = math.floor(pairs)
    more = pairs - whole
    per_step = ratio**whole * (1.0 - more + more * ratio)
    return INITIAL_SQUARE + _limit(n) * (1.0 - per_step**steps)


def nanbu_synchronous(n, steps, probability):
    """Return the moment when all partners are read at the old time level."""
    a, b = INITIAL_SQUARE, INITIAL_PRODUCT
    p, other = probability, 1.0 / (n - 1.0)
    common = (n - 2.0) * other**2
    for _ in range(steps):
        one = other * 0.5 * (a + b) + (1.0 - other) * b
        crossed = other * a + (1.0 - other) * b
        both = 0.25 * (b + 2.0 * crossed + common * a + (1.0 - common) * b)
        new_a = (1.0 - p) * a + 0.75 * p * (a + b)
        b = (1.0 - p) ** 2 * b + 2.0 * p * (1.0 - p) * one + p**2 * both
        a = new_a
    return a


def nanbu_sequential(n, steps, probability):
    """Return the moment when particles 1..N are updated in place, O(N**2) per step."""
    p, other = probability, 1.0 / (n - 1.0)
    moments = np.full((n, n), INITIAL_PRODUCT)
    np.fill_diagonal(moments, INITIAL_SQUARE)
    sums = moments.sum(axis=0)
    trace = moments.trace()
    for _ in range(steps):
        for i in range(n):
            row, square = moments[i].copy(), moments[i, i]
            mixed = 0.5 * (row + other * (sums - row))
            new = (1.0 - p) * row + p * mixed
            partners = other * (trace - square + 2.0 * (sums[i] - square))
            new[i] = (1.0 - p) * square + 3.0 / 8.0 * p * (square + partners)
            moments[i], moments[:, i] = new, new
            sums += new - row
            sums[i] = new.sum()
            trace += new[i] - square
    return float(moments[0, 0])
