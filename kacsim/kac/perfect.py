"""The epsilon-perfect sampler of the N-particle equilibrium (Kac paper, section 5).

Coupling from the past on the positive part of the sphere sum v**2 = E. In energies x = v**2 a
step (p, q, a = sin(theta)**2) is linear: x_p <- a (x_p + x_q), x_q <- (1 - a)(x_p + x_q). The
images of the N corners are therefore the columns of a product of stochastic matrices, and going
one step further into the past replaces columns p and q, both, by a col_p + (1 - a) col_q: O(N).
The largest distance D between two corner images never grows with n, so that it needs checking
only now and then, and the exact first n with D < tolerance is found by bisection.
"""

import math

import numpy as np

from kacsim.elementary.logarithm import log
from kacsim.kac.constants import MEAN_ENERGY
from kacsim.kernels.jit import allocating, inlined, kernel
from kacsim.variates import pair_below, random_sign, squared_cosine

# Contraction of D per step is about RATE / N: a guess that sets when D is checked, nothing else.
CONTRACTION_RATE = 0.3
BLOCK = 4096


def arguments(*, n_particles, tolerance, energy=None):
    """Return the kernel's parameters: particles, energy (3 N / 2 by default) and tolerance."""
    total = MEAN_ENERGY * n_particles if energy is None else energy
    return n_particles, float(total), float(tolerance)


@inlined
def draw_steps(first, second, part, n_steps, n_particles, stream):
    """Draw n_steps random inputs (p, q, sin(theta)**2) with theta uniform on (0, pi/2)."""
    for k in range(n_steps):
        first[k], second[k] = pair_below(n_particles, stream)
        part[k] = squared_cosine(stream)


@inlined
def apply_steps(images, first, second, part, start, stop):
    """Go back by the steps start..stop-1: O(N) each.

    Parameters
    ----------
    images : float64[N, N], row i the image of corner i in energies (of sum 1), overwritten
    """
    for k in range(start, stop):
        p, q, a = first[k], second[k], part[k]
        b = 1.0 - a
        for i in range(images.shape[1]):
            merged = a * images[p, i] + b * images[q, i]
            images[p, i] = merged
            images[q, i] = merged


@inlined
def copy_images(images, copy):
    """Make an array of the same shape a copy of the images."""
    for i in range(images.shape[0]):
        for k in range(images.shape[1]):
            copy[i, k] = images[i, k]


@inlined
def squared_gap(images, i, j):
    """Return the squared distance of two corner images, in units of the energy: O(N)."""
    total = 0.0
    for k in range(images.shape[1]):
        gap = math.sqrt(images[i, k]) - math.sqrt(images[j, k])
        total += gap * gap
    return total


@inlined
def squared_gaps(roots, point, gaps):
    """Compute the squared distances of all corner images from a point.

    Parameters
    ----------
    roots : float64[N, N], column i the image of corner i in velocities
    point : float64[N]
    gaps : float64[N], overwritten
    """
    gaps[:] = 0.0
    for k in range(roots.shape[0]):
        here = point[k]
        for i in range(roots.shape[1]):
            gap = roots[k, i] - here
            gaps[i] += gap * gap


@allocating
def farthest_pair(images, roots, centre, radii, gaps, goal, pair):
    """Return D**2, the largest squared distance of two corner images, in units of the energy.

    A pair that shows D**2 >= goal ends the search, the last farthest pair being tried first: the
    result is then a lower bound of D**2, at least `goal`. Below `goal` the result may be an upper
    bound. Only corners far enough from the centre of all are compared with the others.

    Parameters
    ----------
    images, roots, centre, radii, gaps : the images, and workspace that is overwritten
    pair : int64[2], the last farthest pair, replaced by the one found
    """
    n = images.shape[0]
    last = squared_gap(images, pair[0], pair[1])
    if last >= goal:
        return last
    for i in range(n):
        for k in range(n):
            gaps[k] = math.sqrt(images[i, k])
        for k in range(n):
            roots[k, i] = gaps[k]
    for k in range(n):
        centre[k] = roots[k].sum() / n
    squared_gaps(roots, centre, radii)
    widest = math.sqrt(radii.max())
    if 4.0 * widest * widest < goal:
        return 4.0 * widest * widest
    largest, least = 0.0, math.sqrt(goal) - widest
    for i in range(n):
        if math.sqrt(radii[i]) >= least:
            squared_gaps(roots, roots[:, i], gaps)
            j = gaps.argmax()
            if gaps[j] > largest:
                largest = gaps[j]
                pair[0], pair[1] = i, j
                if largest >= goal:
                    break
    return largest


@kernel
def couple(velocities, coupling_times, n_particles, energy, tolerance, stream):
    """Draw v_1 at equilibrium with coupling times (Kac paper, epsilon-perfect algorithm).

    Parameters
    ----------
    velocities : float64[n], overwritten by the first coordinate of the mean corner, signed
    coupling_times : int64[n], overwritten by the first number of steps n with D < tolerance
    n_particles : int >= 2
    energy, tolerance : float > 0, the sphere's sum of v**2 and the distance epsilon
    stream : from `new_stream`, advanced

    Returns
    -------
    int, steps applied, the repeated ones of the bisection included
    """
    n = n_particles
    images, saved, roots = np.empty((n, n)), np.empty((n, n)), np.empty((n, n))
    centre, radii, gaps = np.empty(n), np.empty(n), np.empty(n)
    pair = np.array([0, 1])
    first, second = np.empty(BLOCK, np.int64), np.empty(BLOCK, np.int64)
    part = np.empty(BLOCK)
    goal = tolerance * tolerance / energy
    applied = 0
    for draw in range(velocities.size):
        images[:] = 0.0
        for i in range(n):
            images[i, i] = 1.0
        steps = 0
        spread = 2.0
        while spread >= goal:
            expected = 0.4 * log(spread / goal) / CONTRACTION_RATE if spread > goal else 0.0
            block = min(BLOCK, max(1 + n // 3, int(min(BLOCK, n * expected))))
            draw_steps(first, second, part, block, n, stream)
            copy_images(images, saved)
            apply_steps(images, first, second, part, 0, block)
            steps += block
            applied += block
            spread = farthest_pair(images, roots, centre, radii, gaps, goal, pair)
        # D >= tolerance after `low` steps of this block, D < tolerance after `high`.
        low, high = 0, block
        while high - low > 1:
            middle = (low + high) // 2
            copy_images(saved, images)
            apply_steps(images, first, second, part, low, middle)
            applied += middle - low
            if farthest_pair(images, roots, centre, radii, gaps, goal, pair) < goal:
                high = middle
            else:
                low = middle
                copy_images(images, saved)
        copy_images(saved, images)
        apply_steps(images, first, second, part, low, high)
        total = 0.0
        for i in range(n):
            total += math.sqrt(images[i, 0])
        velocities[draw] = math.sqrt(energy) * total / n * random_sign(stream)
        coupling_times[draw] = steps - block + high
    return applied


@kernel
def record(n_particles, n_steps, stream):
    """Return the inputs (p, q, sin(theta)**2) that `couple` draws first from the same stream.

    Returns
    -------
    (int64[n_steps], int64[n_steps], float64[n_steps])
    """
    first, second = np.empty(n_steps, np.int64), np.empty(n_steps, np.int64)
    part = np.empty(n_steps)
    draw_steps(first, second, part, n_steps, n_particles, stream)
    return first, second, part


@inlined
def walk(corners, first, second, part, start):
    """Follow corner points forward through the steps -start..-1, as printed (step 2).

    Parameters
    ----------
    corners : float64[m, N], velocities, overwritten
    first, second, part : inputs of steps -1, -2, ... in this order
    start : int, how far in the past the walk begins
    """
    for t in range(start - 1, -1, -1):
        p, q, a = first[t], second[t], part[t]
        for i in range(corners.shape[0]):
            pair_energy = corners[i, p] ** 2 + corners[i, q] ** 2
            corners[i, p] = math.sqrt(pair_energy) * math.sqrt(a)
            corners[i, q] = math.sqrt(max(0.0, pair_energy - corners[i, p] ** 2))


@inlined
def diameter(corners):
    """Return the largest Euclidean distance D of two points; corners is float64[m, N]."""
    largest = 0.0
    for i in range(corners.shape[0]):
        for j in range(i):
            total = 0.0
            for k in range(corners.shape[1]):
                total += (corners[i, k] - corners[j, k]) ** 2
            largest = max(largest, total)
    return math.sqrt(largest)


@kernel
def trajectory(n_particles, energy, first, second, part):
    """Return all corner points after 0, 1, ... steps, the inputs in the order of time.

    In energies, where a step loses no digit to a difference: lengths are compared afterwards.

    Returns
    -------
    float64[steps + 1, N, N], velocities: time, corner, particle
    """
    path = np.zeros((first.size + 1, n_particles, n_particles))
    for i in range(n_particles):
        path[0, i, i] = energy
    for k in range(first.size):
        path[k + 1] = path[k]
        p, q, a = first[k], second[k], part[k]
        for i in range(n_particles):
            total = path[k, i, p] + path[k, i, q]
            path[k + 1, i, p], path[k + 1, i, q] = a * total, (1.0 - a) * total
    return np.sqrt(path)


@kernel
def couple_literally(n_particles, energy, tolerance, first, second, part):
    """Run the printed algorithm: for n = 1, 2, ... re-simulate all corners from time -n.

    The reference that `couple` is tested against, of cost O(n**2 N).

    Returns
    -------
    (int, float64[N]), coupling time and mean corner; the time is -1 if the inputs run out
    """
    corners = np.empty((n_particles, n_particles))
    mean = np.zeros(n_particles)
    for n in range(1, first.size + 1):
        corners[:] = 0.0
        for i in range(n_particles):
            corners[i, i] = math.sqrt(energy)
        walk(corners, first, second, part, n)
        if diameter(corners) < tolerance:
            for k in range(n_particles):
                mean[k] = corners[:, k].sum() / n_particles
            return n, mean
    return -1, mean
