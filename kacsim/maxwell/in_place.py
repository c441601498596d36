"""Means of Nanbu's sequential algorithm, whose particles are not exchangeable.

All E (v_a.v_b)(v_c.v_d), N**4 of them, are updated in the order of the algorithm; for infinitely
many particles E |v|**4 depends on the place in that order only.
"""

import functools
import itertools

import numpy as np

from kacsim.maxwell.contractions import EQUILIBRIUM, INITIAL

TERMS = 40  # of a power series in the place


@functools.cache
def in_place(n_particles, probability, steps):
    """Return A of particle 1 after steps in which particles 1..N are updated in place."""
    n = n_particles
    # [a, b, c, d] is E (v_a.v_b)(v_c.v_d).
    means = np.zeros((n, n, n, n))
    for i, k in itertools.product(range(n), repeat=2):
        means[i, i, k, k] = INITIAL[1]
        if i != k:
            means[i, k, i, k] = means[i, k, k, i] = INITIAL[2]
    for i in range(n):
        means[i, i, i, i] = INITIAL[0]
    for _ in range(steps):
        for i in range(n):
            means += probability * (_after(means, i) - means)
    return float(means[0, 0, 0, 0])


def _after(means, i):
    """Return all means after particle i has collided with a uniform partner, which stays."""
    n = len(means)
    weights = np.full(n, 1.0 / (n - 1.0))
    weights[i] = 0.0
    partner = np.tensordot(weights, means, 1)  # mean over j of [j, b, c, d]
    both = np.einsum("j,jjcd->cd", weights, means)
    apart = np.einsum("j,jbjd->bd", weights, means)
    here, crossed = means[i], means[i, :, i, :] + partner[:, i, :] + partner[:, i, :].T + apart
    single = 0.5 * (here + partner)
    double = 0.5 * (here[i] + both)  # of |v_i|**2 v_c.v_d
    split = 0.25 * crossed + (here[i] + both - 2.0 * partner[i]) / 12.0
    # E |v_i|**2 v_i.v_d and |v_i|**4, with S = |v_i|**2 + |v_j|**2 and q = v_i.v_j
    cubes = np.einsum("j,jjjd->d", weights, means)
    squares = here[i, i] + partner[:, i, i] + both[i] + cubes
    products = partner[i, i] + np.einsum("j,jjd->d", weights, here)
    triple = squares / 3.0 - products / 6.0
    fourth = here[i, i, i] + 2.0 * both[i, i] + np.einsum("j,jjjj", weights, means)
    fourth = (fourth - apart[i, i]) / 3.0
    after = means.copy()
    after[i], after[:, i] = single, single
    after[:, :, i], after[:, :, :, i] = single.transpose(1, 2, 0), single.transpose(1, 2, 0)
    after[i, i], after[:, :, i, i] = double, double
    after[i, :, i], after[i, :, :, i], after[:, i, i], after[:, i, :, i] = (split,) * 4
    after[i, i, i], after[i, i, :, i], after[i, :, i, i], after[:, i, i, i] = (triple,) * 4
    after[i, i, i, i] = fourth
    return after


def endless_in_place(probability, steps):
    """Return E |v|**4 against the place x in the order, 0 <= x < 1, of infinitely many particles.

    With d = 15 - A a step gives d'(x) = (1 - 2 p / 3) d(x) + p / 3 D(x), D(x) the mean of d' below
    x and of d above: D' = d' - d. All are power series in x.

    Returns
    -------
    float64[TERMS], coefficients of the powers of x; the first is particle 1's
    """
    p = probability
    deficit = np.zeros(TERMS)
    deficit[0] = EQUILIBRIUM - INITIAL[0]
    for _ in range(steps):
        mean = np.zeros(TERMS)
        mean[0] = (deficit / np.arange(1, TERMS + 1)).sum()
        for k in range(TERMS - 1):
            mean[k + 1] = p / 3.0 * (mean[k] - 2.0 * deficit[k]) / (k + 1)
        deficit = (1.0 - 2.0 * p / 3.0) * deficit + p / 3.0 * mean
    deficit[0] -= EQUILIBRIUM
    return -deficit
