"""Maps of the means A..J of exchangeable particles by the collisions of a scheme.

What a scheme does to a mean is the mean over what may happen to the at most four particles in it.
Columns and rows of all maps are A, B, C, D, F, H, J of `kacsim.maxwell.contractions`.
"""

import collections
import functools
import itertools
import math

import numpy as np
from scipy import linalg

from kacsim.maxwell.contractions import SMALLEST, kind, scattered


def _row(polynomial):
    """Return a polynomial's coefficients of A..J, float64[7]."""
    row = np.zeros(len(SMALLEST))
    for product, coefficient in polynomial.items():
        row[kind(product)] += coefficient
    return row


def _particles(product):
    """Return how many particles are in one of `SMALLEST`."""
    return 1 + max(map(max, product))


@functools.cache
def _paired(product, pairs):
    """Return the row of a product after collisions of disjoint pairs of labels."""
    polynomial = {product: 1.0}
    for i, j in pairs:
        polynomial = scattered(polynomial, {i: 1.0, j: -1.0}, i, j)
    return _row(polynomial)


def generator(n_particles):
    """Return N / 2 (M - 1), M the map of A..J by the collision of a uniform pair, float64[7, 7].

    A pair of k given particles collides at the rate 1 / (N - 1), each of them with one of the
    others at (N - k) / (N - 1).
    """
    rates = np.zeros((len(SMALLEST), len(SMALLEST)))
    for row, product in enumerate(SMALLEST):
        k = _particles(product)
        still = _row({product: 1.0})
        for pair in itertools.combinations(range(k), 2):
            rates[row] += (_paired(product, (pair,)) - still) / (n_particles - 1.0)
        for i in range(k):
            weight = max(0.0, n_particles - k) / (n_particles - 1.0)
            rates[row] += weight * (_paired(product, ((i, k),)) - still)
    return rates


def falling(x, k):
    """Return x (x - 1) ... (x - k + 1)."""
    return math.prod(x - m for m in range(k))


def disjoint_pairs(n_particles, n_pairs):
    """Return the map of A..J by the collisions of so many disjoint pairs, float64[7, 7]."""
    step = np.zeros((len(SMALLEST), len(SMALLEST)))
    for row, product in enumerate(SMALLEST):
        k = _particles(product)
        if k > n_particles:
            continue
        for pairs, alone in _pairings(tuple(range(k)), k):
            hit = len(pairs)
            chance = 2.0**hit * falling(n_pairs, hit) * falling(n_particles - 2.0 * n_pairs, alone)
            if chance > 0.0:
                step[row] += chance / falling(n_particles, k) * _paired(product, pairs)
    return step


def _pairings(left, fresh):
    """Yield (pairs, number alone): labels in pairs, with each other or with a fresh label."""
    if not left:
        yield (), 0
        return
    i, *rest = left
    for pairs, alone in _pairings(tuple(rest), fresh):
        yield pairs, alone + 1
    for pairs, alone in _pairings(tuple(rest), fresh + 1):
        yield ((i, fresh), *pairs), alone
    for j in rest:
        others = tuple(one for one in rest if one != j)
        for pairs, alone in _pairings(others, fresh):
            yield ((i, j), *pairs), alone


def old_level(n_particles, probability):
    """Return the map of A..J by a step that reads all partners at its start, float64[7, 7]."""
    step = np.zeros((len(SMALLEST), len(SMALLEST)))
    for row, product in enumerate(SMALLEST):
        k = _particles(product)
        if k > n_particles:
            continue
        for partners, row_of in _read(product):
            seen = [partner for partner in partners if partner is not None]
            fresh = len({partner for partner in seen if partner >= k})
            chance = (probability / (n_particles - 1.0)) ** len(seen)
            chance *= (1.0 - probability) ** (k - len(seen)) * falling(n_particles - k, fresh)
            step[row] += chance * row_of
    return step


@functools.cache
def _read(product):
    """Return [(partners, row)] of a product: each particle's partner, None without a collision."""
    k = _particles(product)
    found = []
    for partners in _partners(k, 0, k):
        # New velocities have labels from 100 on, so that the old ones can still be read.
        polynomial = {tuple((100 + a, 100 + b) for a, b in product): 1.0}
        for i, partner in enumerate(partners):
            if partner is None:
                polynomial = _renamed(polynomial, 100 + i, i)
            else:
                polynomial = scattered(polynomial, {100 + i: 1.0}, i, partner)
        found.append((partners, _row(polynomial)))
    return found


def _partners(k, i, fresh):
    """Yield the partners of the particles from i on; fresh labels in the order of first use."""
    if i == k:
        yield ()
        return
    for partner in (None, *(j for j in range(fresh + 1) if j != i)):
        grown = fresh + int(partner == fresh)
        for rest in _partners(k, i + 1, grown):
            yield partner, *rest


def _renamed(polynomial, old, new):
    """Return a polynomial with another label in place of one."""
    found = collections.Counter()
    for product, coefficient in polynomial.items():
        found[tuple(tuple(new if x == old else x for x in pair) for pair in product)] += coefficient
    return found


def power(change, exponent):
    """Return (1 + change)**exponent, without loss where the change is small and the power large."""
    if np.abs(change).sum(axis=1).max() > 0.05:
        return np.linalg.matrix_power(np.eye(len(change)) + change, exponent)
    logarithm, term = np.zeros_like(change), np.eye(len(change))
    for k in range(1, 16):
        term = term @ change
        logarithm += term / (k if k % 2 else -k)
    return linalg.expm(exponent * logarithm)


@functools.cache
def with_first(n_particles, pair_rate):
    """Return the means that |v_1|**4 reaches where particle 1 collides at other rates than others.

    Particle 1, here the label 0, collides with each of the others at the rate 1 / (N - 1), and each
    pair of these at `pair_rate`.

    Returns
    -------
    (products, float64[n, n]), the first being |v_1|**4, and the matrix of their change with time
    """
    products, entries = [SMALLEST[0]], {}
    for row, product in enumerate(products):
        present = {label for pair in product for label in pair}
        known, fresh = sorted({0} | present), 1 + max(present)
        pairs = [(pair, 1.0) for pair in itertools.combinations(known, 2) if present & {*pair}]
        pairs += [((i, fresh), n_particles - float(len(known))) for i in present]
        for (i, j), many in pairs:
            rate = many * (1.0 / (n_particles - 1.0) if i == 0 else pair_rate)
            if rate > 0.0:
                change = scattered({product: rate}, {i: 1.0, j: -1.0}, i, j)
                change[product] -= rate
                for one, coefficient in change.items():
                    known_as = _smallest(one)
                    if known_as not in products:
                        products.append(known_as)
                    place = row, products.index(known_as)
                    entries[place] = entries.get(place, 0.0) + coefficient
    matrix = np.zeros((len(products), len(products)))
    for place, entry in entries.items():
        matrix[place] = entry
    return tuple(products), matrix


def _smallest(product):
    """Return the first of all products that differ by the names of particles other than 0."""
    names = sorted({label for pair in product for label in pair} - {0})
    found = []
    for order in itertools.permutations(range(1, len(names) + 1)):
        new = dict(zip(names, order, strict=True)) | {0: 0}
        found.append(tuple(sorted(tuple(sorted(new[x] for x in pair)) for pair in product)))
    return min(found)
