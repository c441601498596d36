"""Exact moments of v_1 for any initial law, any law of the angle and any algorithm at finite N.

A collision maps a monomial of velocities to a polynomial of the same order, so that the means of
all monomials of one order, over labelled particles, obey linear equations. Nothing is taken from
the package: the means of cos**a sin**b come from quadrature of the density.
"""

import functools
import itertools
import math

import numpy as np
from scipy import linalg


class Angles:
    """Means of cos**a sin**b of an angle of density rho or, as likely, of its negative.

    Parameters
    ----------
    rho : callable, array of angles -> array; any total
    edges : places between which rho is smooth, rising
    """

    def __init__(self, rho, edges):
        nodes, weights = np.polynomial.legendre.leggauss(200)
        half = np.diff(edges)[:, None] / 2.0
        self.theta = (np.asarray(edges[:-1])[:, None] + half * (1.0 + nodes)).ravel()
        self.weight = (half * weights).ravel() * rho(self.theta)
        self.weight /= self.weight.sum()

    @functools.cache  # noqa: B019
    def mean(self, a, b):
        if b % 2:
            return 0.0
        return float((np.cos(self.theta) ** a * np.sin(self.theta) ** b * self.weight).sum())


def monomials(n, order):
    """Return the exponents of all monomials of an order in n variables."""
    found = []
    for chosen in itertools.combinations_with_replacement(range(n), order):
        found.append(tuple(chosen.count(i) for i in range(n)))
    return found


class Moments:
    """The means of all monomials of one order of the velocities of n particles."""

    def __init__(self, n, order, angles):
        self.n, self.order, self.angles = n, order, angles
        self.exponents = monomials(n, order)
        self.place = {one: k for k, one in enumerate(self.exponents)}

    def start(self, single):
        """Return the moments of independent velocities, single[k] = E v**k."""
        return np.array([math.prod(single[k] for k in one) for one in self.exponents])

    def _powers(self, k, other):
        """Yield (power of v, of w, coefficient) of E (v cos + w sin)**k (w cos - v sin)**other."""
        for a, b in itertools.product(range(k + 1), range(other + 1)):
            sign = (-1.0) ** b
            number = math.comb(k, a) * math.comb(other, b)
            mean = self.angles.mean(k - a + other - b, a + b)
            yield k - a + b, a + other - b, number * sign * mean

    @functools.cache  # noqa: B019
    def collision(self, i, j):
        """Return the map of the moments by a collision of i and j, the first either of them."""
        found = np.zeros((len(self.exponents),) * 2)
        for row, one in enumerate(self.exponents):
            for a, b, coefficient in self._powers(one[i], one[j]):
                new = list(one)
                new[i], new[j] = a, b
                found[row, self.place[tuple(new)]] += coefficient
        return found

    def pairs(self):
        return list(itertools.combinations(range(self.n), 2))

    def mean_collision(self, pairs=None):
        return np.mean([self.collision(*pair) for pair in pairs or self.pairs()], axis=0)

    def _changed(self, i, k, probability):
        """Yield (other label or None, power of v_i, power of v_j, coefficient) of E v_i'**k."""
        yield None, k, 0, 1.0 - probability
        for j in range(self.n):
            if j != i:
                for a in range(k + 1):
                    mean = math.comb(k, a) * self.angles.mean(k - a, a)
                    yield j, k - a, a, probability / (self.n - 1) * mean

    def nanbu(self, labels, probability):
        """Return the map of Nanbu's collisions of some particles, all at the old level."""
        found = np.zeros((len(self.exponents),) * 2)
        for row, one in enumerate(self.exponents):
            touched = [i for i in labels if one[i]]
            ways = [list(self._changed(i, one[i], probability)) for i in touched]
            for chosen in itertools.product(*ways):
                new, coefficient = list(one), 1.0
                for i in touched:
                    new[i] = 0
                for i, (j, own, lent, factor) in zip(touched, chosen, strict=True):
                    new[i] += own
                    if j is not None:
                        new[j] += lent
                    coefficient *= factor
                found[row, self.place[tuple(new)]] += coefficient
        return found


def matchings(n, number):
    """Yield all sets of so many disjoint pairs."""
    for chosen in itertools.combinations(itertools.combinations(range(n), 2), number):
        if len({label for pair in chosen for label in pair}) == 2 * number:
            yield chosen


def step_map(m, algorithm, *, n_particles, time, collision_rate, time_step=None):
    """Return (map of the moments by a step, or by all of the time; number of such steps)."""
    n, span = n_particles, collision_rate * time
    one = np.eye(len(m.exponents))
    if algorithm == "poisson":
        return linalg.expm(0.5 * n * span * (m.mean_collision() - one)), 1
    if algorithm == "poisson_printed":
        own = m.mean_collision([(0, j) for j in range(1, n)]) - one
        others = m.mean_collision(list(itertools.combinations(range(1, n), 2))) - one
        return linalg.expm(span * (own + 0.5 * (n - 1) * others)), 1
    if algorithm == "bird":
        return m.mean_collision(), math.ceil(0.5 * n * span)
    steps, probability = round(time / time_step), collision_rate * time_step
    if algorithm == "nanbu_synchronous":
        return m.nanbu(range(n), probability), steps
    if algorithm == "nanbu_sequential":
        maps = [m.nanbu([i], probability) for i in range(n)]
        return functools.reduce(lambda done, one: one @ done, maps), steps
    pairs = 0.5 * n * probability
    whole = math.floor(pairs)
    found = 0.0 * one
    for number, chance in ((whole, 1.0 - (pairs - whole)), (whole + 1, pairs - whole)):
        if chance:
            all_of = [
                functools.reduce(np.matmul, [m.collision(*pair) for pair in chosen], one)
                for chosen in matchings(n, number)
            ]
            found += chance * np.mean(all_of, axis=0)
    return found, steps


def moment(order, single, angles, algorithm, **process):
    """Return E v_1**order.

    Parameters
    ----------
    single : sequence, E v**k at time 0 for k = 0..order
    angles : `Angles`
    process : n_particles, time, collision_rate and, of the algorithms in steps, time_step
    """
    m = Moments(process["n_particles"], order, angles)
    step, steps = step_map(m, algorithm, **process)
    means = np.linalg.matrix_power(step, steps) @ m.start(single)
    return float(means[m.place[(order,) + (0,) * (m.n - 1)]])
