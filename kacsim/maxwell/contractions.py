"""Means of products of two scalar products of velocities, and what collisions make of them.

Seven such means close for exchangeable particles: with different indices those of

    A = |v_1|**4, B = |v_1|**2 |v_2|**2, C = (v_1.v_2)**2, D = |v_1|**2 v_1.v_2,
    F = (v_1.v_2)(v_1.v_3), H = |v_1|**2 v_2.v_3, J = (v_1.v_2)(v_3.v_4).

A collision of i and j gives m + r u and, if it changes both, m - r u, with m = (v_i + v_j) / 2,
r**2 = |v_i - v_j|**2 / 4 and u uniform on the sphere, independent of the velocities: the mean over
u of a product of scalar products is one of scalar products again, for E u_a u_b = delta_ab / 3 and
odd powers of u vanish.
"""

import collections
import itertools

SMALLEST = (
    ((0, 0), (0, 0)),
    ((0, 0), (1, 1)),
    ((0, 1), (0, 1)),
    ((0, 0), (0, 1)),
    ((0, 1), (0, 2)),
    ((0, 0), (1, 2)),
    ((0, 1), (2, 3)),
)
EQUILIBRIUM = 15.0  # A of a Maxwellian of unit variance per axis
INITIAL = (12.6, 9.0, 3.0, 0.0, 0.0, 0.0, 0.0)  # of independent velocities of the BKW mode


def kind(product):
    """Return the place among A..J of a product of two scalar products, ((a, b), (c, d))."""
    (a, b), (c, d) = product
    if a == b and c == d:
        return 0 if a == c else 1
    if a == b or c == d:
        return 3 if {a, b} & {c, d} else 5
    return {2: 2, 1: 4, 0: 6}[len({a, b} & {c, d})]


def scattered(polynomial, signs, i, j):
    """Return the mean over u of a polynomial in which some velocities are those after a collision.

    Parameters
    ----------
    polynomial : dict, product of two scalar products of labels -> coefficient
    signs : dict, label -> s: its velocity is m + s r u of the labels i and j
    """
    found = collections.Counter()
    for ((a, b), (c, d)), coefficient in polynomial.items():
        slots = [
            ((0, i), (0, j), (signs[x], None)) if x in signs else ((0, x),) for x in (a, b, c, d)
        ]
        halves = 0.5 ** sum(x in signs for x in (a, b, c, d))
        for chosen in itertools.product(*slots):
            along = [sign for sign, label in chosen if label is None]
            factor = coefficient * halves
            for sign in along:
                factor *= 2.0 * sign
            for product, weight in _mean_over_sphere([label for _, label in chosen], i, j):
                found[product] += factor * weight
    return found


def _mean_over_sphere(labels, i, j):
    """Yield (product, weight) of one product in which None stands for r u."""
    a, b, c, d = labels
    square = (((i, i), 0.25), ((j, j), 0.25), ((i, j), -0.5))  # r**2
    unknown = labels.count(None)
    if unknown == 0:
        yield ((a, b), (c, d)), 1.0
    elif unknown == 4:
        for (first, x), (second, y) in itertools.product(square, square):
            yield (first, second), x * y
    elif unknown == 2:
        rest = tuple(label for label in labels if label is not None)
        share = 1.0 if (a is None) == (b is None) else 1.0 / 3.0
        for pair, weight in square:
            yield (pair, rest), share * weight
