"""A reading of the Nanbu-Babovsky algorithm (Kac paper, 4.1): no pair twice in a step.

"m pairs, without replacement, from among all possible pairs" may mean distinct pairs that may share
particles and collide one after another. `kacsim.kac.nanbu_babovsky` draws disjoint pairs.
"""

import itertools
import math

import numpy as np

from kacsim.kac.moments import INITIAL_PRODUCT, INITIAL_SQUARE
from kacsim.kac.nanbu_babovsky import arguments


def fourth_moment(*, n_particles, time, time_step, collision_rate):
    """Return E v_1**4, exactly; for few particles, since the work grows fast with their number."""
    n, steps, mean_pairs = arguments(
        n_particles=n_particles, time=time, time_step=time_step, collision_rate=collision_rate
    )
    whole = math.floor(mean_pairs)
    square, product = INITIAL_SQUARE, INITIAL_PRODUCT
    for _ in range(steps):
        few, more = (_after_distinct(n, square, product, m) for m in (whole, whole + 1))
        square, product = few + (mean_pairs - whole) * (more - few)
    return float(square)


def collided(moments, i, j):
    """Return float64[N, N], E x_k x_l of x = v**2 after a collision of the pair, from before."""
    new = moments.copy()
    half = 0.5 * (moments[i] + moments[j])
    new[[i, j]] = half
    new[:, [i, j]] = half[:, None]
    square = moments[i, i] + 2.0 * moments[i, j] + moments[j, j]
    new[i, i] = new[j, j] = 3.0 / 8.0 * square
    new[i, j] = new[j, i] = square / 8.0
    return new


def _after_distinct(n, square, product, number):
    """Return float64[2], the means of x_k**2 and x_k x_l after `number` distinct pairs.

    The mean over sequences of distinct pairs is a sum over the partitions of the sequence into
    classes of equal pairs, with the weights of Moebius inversion. All particles are alike before
    and on average after, so that the pair of the first class may be (0, 1).
    """
    if number == 0:
        return np.array([square, product])
    pairs = list(itertools.combinations(range(n), 2))
    total = np.zeros((n, n))
    for classes in _partitions(number):
        weight = math.prod((-1) ** (len(c) - 1) * math.factorial(len(c) - 1) for c in classes)
        first, *repeated = sorted(classes, key=len, reverse=True)
        repeated = [c for c in repeated if len(c) > 1]
        for chosen in itertools.product(pairs, repeat=len(repeated)):
            known = zip([first, *repeated], [(0, 1), *chosen], strict=True)
            at = {place: pair for c, pair in known for place in c}
            one = np.full((n, n), product)
            np.fill_diagonal(one, square)
            for place in range(number):
                here = [at[place]] if place in at else pairs
                one = sum(collided(one, *pair) for pair in here)
            total += weight * len(pairs) * one
    total /= math.perm(len(pairs), number)
    trace = total.trace()
    return np.array([trace / n, (total.sum() - trace) / (n * (n - 1))])


def _partitions(number):
    """Return the partitions of range(number) into classes."""
    if number == 0:
        return [[]]
    found, last = [], number - 1
    for classes in _partitions(last):
        for k, one in enumerate(classes):
            found.append([*classes[:k], [*one, last], *classes[k + 1 :]])
        found.append([*classes, [last]])
    return found
