"""Coupling from the past beside forward coupling and doubling (Kac paper, section 5.1).

The same inputs, one after another, are read as steps -1, -2, ... into the past (as `perfect`
does, in O(N) a step) and as steps 1, 2, ... forward from the corners. For a few particles.
"""

import math

import numpy as np

from kacsim.kac.constants import MEAN_ENERGY
from kacsim.kac.perfect import squared_gap
from kacsim.kernels.jit import allocating, inlined, kernel
from kacsim.variates import pair_below, squared_cosine

STOPPED, DOUBLED, LIMIT = range(3)  # of the mean corner: where D < tolerance, at 2**k, at the end
FINAL = 1e-4  # of the tolerance: the distance of the corners at the end
AHEAD = 256  # inputs drawn at a time


def arguments(*, n_particles, tolerance, energy=None):
    """Return the kernel's parameters: particles, energy (3 N / 2 by default) and tolerance."""
    total = MEAN_ENERGY * n_particles if energy is None else energy
    return n_particles, float(total), float(tolerance)


@allocating
def grown(pairs, parts, n, stream):
    """Return the inputs, pairs int64[k, 2] and sin(theta)**2 float64[k], and AHEAD more."""
    known = parts.size
    more_pairs, more_parts = np.empty((known + AHEAD, 2), np.int64), np.empty(known + AHEAD)
    for k in range(known):
        more_pairs[k, 0], more_pairs[k, 1], more_parts[k] = pairs[k, 0], pairs[k, 1], parts[k]
    for k in range(known, known + AHEAD):
        more_pairs[k, 0], more_pairs[k, 1] = pair_below(n, stream)
        more_parts[k] = squared_cosine(stream)
    return more_pairs, more_parts


@inlined
def all_within(images, goal):
    """Tell whether all squared distances of two images are below `goal`: O(N**3)."""
    for i in range(images.shape[0]):
        for j in range(i):
            if squared_gap(images, i, j) >= goal:
                return False
    return True


@inlined
def set_mean(mean, images, radius):
    """Set `mean`, float64[N], to the mean corner; images are energies of sum 1 in rows."""
    n = images.shape[0]
    for k in range(n):
        total = 0.0
        for i in range(n):
            total += math.sqrt(images[i, k])
        mean[k] = radius * total / n


@inlined
def distance(a, b):
    """Return the Euclidean distance of two points."""
    total = 0.0
    for k in range(a.size):
        total += (a[k] - b[k]) ** 2
    return math.sqrt(total)


@kernel
def couple_both_ways(backward, forward, errors, times, n_particles, energy, tolerance, stream):
    """Draw mean corners, coupled from the past and forward on the same inputs.

    Parameters
    ----------
    backward, forward : float64[draw, N], overwritten by the mean corners, without signs, where
        D < tolerance first
    errors : float64[draw, 2], overwritten by how far the backward one is from the mean corner 2**k
        steps back (the first power of two that suffices), and from its limit
    times : int64[draw, 2], overwritten by the steps back and forward
    n_particles, energy, tolerance, stream : as of `kacsim.kac.perfect.couple`
    """
    n, radius = n_particles, math.sqrt(energy)
    goal = tolerance * tolerance / energy
    images, means = np.empty((n, n)), np.empty((3, n))
    for draw in range(backward.shape[0]):
        pairs, parts = grown(np.empty((0, 2), np.int64), np.empty(0), n, stream)
        images[:] = 0.0
        for i in range(n):
            images[i, i] = 1.0
        steps, stopped, power, done = 0, 0, 1, False
        while not (done and steps >= power):
            if steps == parts.size:
                pairs, parts = grown(pairs, parts, n, stream)
            p, q, a = pairs[steps, 0], pairs[steps, 1], parts[steps]
            for k in range(n):
                merged = a * images[p, k] + (1.0 - a) * images[q, k]
                images[p, k] = images[q, k] = merged
            steps += 1
            if stopped == 0 and all_within(images, goal):
                stopped = steps
                set_mean(means[STOPPED], images, radius)
                while power < stopped:
                    power *= 2
            if stopped > 0 and steps == power:
                set_mean(means[DOUBLED], images, radius)
            done = stopped > 0 and all_within(images, FINAL * FINAL * goal)
        set_mean(means[LIMIT], images, radius)
        for k in range(n):
            backward[draw, k] = means[STOPPED, k]
        times[draw, 0] = stopped
        errors[draw, 0] = distance(means[STOPPED], means[DOUBLED])
        errors[draw, 1] = distance(means[STOPPED], means[LIMIT])

        images[:] = 0.0
        for i in range(n):
            images[i, i] = 1.0
        steps, done = 0, False
        while not done:
            if steps == parts.size:
                pairs, parts = grown(pairs, parts, n, stream)
            p, q, a = pairs[steps, 0], pairs[steps, 1], parts[steps]
            for i in range(n):
                total = images[i, p] + images[i, q]
                images[i, p], images[i, q] = a * total, (1.0 - a) * total
            steps += 1
            done = all_within(images, goal)
        set_mean(forward[draw], images, radius)
        times[draw, 1] = steps
