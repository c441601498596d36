"""Other readings of the coupling time of Fig. 9 (Kac paper, section 5.2).

One process of the corner points, going back one step at a time as in `kacsim.kac.perfect`, and
the number of steps at which each of many rules would have stopped it. The rules share the inputs,
so that one pass serves them all. The sphere has radius 1; tolerances are in units of the radius.
"""

import math

import numpy as np

from kacsim.kac.constants import (
    DISTINCT,
    HALF,
    LIMIT_STEPS,
    RULES,
    UNIFORM_SHARE,
    UNIFORM_SINE,
    WALKS,
    WITH_FIRST,
)
from kacsim.kac.perfect import copy_images
from kacsim.kernels.jit import inlined, kernel
from kacsim.variates import index_below, pair_below, squared_cosine, uniform

(
    LARGEST,
    CONSECUTIVE,
    FIRST_TWO,
    MEAN_SQUARE,
    COORDINATE,
    FIRST_COORDINATE,
    ENERGIES,
    SETTLED,
) = range(len(RULES))
REFRESHED = 64  # steps after which the reference point of the mean square is set anew


def arguments(*, n_particles, walk, tolerance):
    """Return the kernel's parameters: particles, codes of pairs and shares, tolerances."""
    return n_particles, *WALKS[walk], np.array(tolerance, dtype=float)


@inlined
def pair_of(pairs, n, stream):
    """Return the pair of a step, by the code of the reading."""
    if pairs == DISTINCT:
        return pair_below(n, stream)
    if pairs == WITH_FIRST:
        return 0, 1 + index_below(n - 1, stream)
    return index_below(n, stream), index_below(n, stream)


@inlined
def share_of(shares, stream):
    """Return the share of the pair's energy that the first one takes, by the reading's code."""
    if shares == HALF:
        return 0.5
    if shares == UNIFORM_SHARE:
        return uniform(stream)
    if shares == UNIFORM_SINE:
        return uniform(stream) ** 2
    return squared_cosine(stream)


@inlined
def gap(points, i, j):
    """Return the squared distance of two rows: O(N)."""
    total = 0.0
    for k in range(points.shape[1]):
        part = points[i, k] - points[j, k]
        total += part * part
    return total


@inlined
def apart(points, goal, pair, radii):
    """Tell whether two rows have a squared distance of at least `goal`, and note them in `pair`.

    Parameters
    ----------
    points : float64[N, N], points in rows
    goal : float
    pair : int64[3], the last two that were that far apart, tried first
    radii : float64[2, N], workspace: the centre of all, and the distances from it
    """
    if gap(points, pair[0], pair[1]) >= goal:
        return True
    n = points.shape[0]
    centre, far = radii
    centre[:] = 0.0
    for i in range(n):
        centre += points[i]
    centre /= n
    widest = 0.0
    for i in range(n):
        total = 0.0
        for k in range(n):
            part = points[i, k] - centre[k]
            total += part * part
        far[i] = math.sqrt(total)
        widest = max(widest, far[i])
    if 2.0 * widest < math.sqrt(goal):
        return False
    for i in range(n):
        if far[i] + widest >= math.sqrt(goal):
            largest = -1.0
            for j in range(n):
                here = gap(points, i, j)
                if here > largest:
                    largest, other = here, j
            if largest >= goal:
                pair[0], pair[1] = i, other
                return True
    return False


@inlined
def columns_apart(points, n_columns, goal, pair):
    """Tell whether the entries of one of the first columns differ by `goal`, and note where."""
    for k in range(n_columns):
        high, low = 0, 0
        for i in range(points.shape[0]):
            if points[i, k] > points[high, k]:
                high = i
            if points[i, k] < points[low, k]:
                low = i
        if points[high, k] - points[low, k] >= goal:
            pair[0], pair[1], pair[2] = high, low, k
            return True
    return False


@inlined
def still_apart(rule, goal, images, roots, pair, radii, spread, moved):
    """Tell whether a rule lets the process go on: what it looks at is not below the tolerance.

    Parameters
    ----------
    rule : int, place in RULES
    goal : float, the tolerance
    images, roots : float64[N, N], row i the image of corner i in energies and in velocities
    pair : int64[3], what showed it last: two corners, and a coordinate
    radii : float64[2, N], workspace
    spread, moved : float, mean squared distance of two images, and the mean's last displacement
    """
    n = roots.shape[0]
    if rule == LARGEST:
        return apart(roots, goal * goal, pair, radii)
    if rule == ENERGIES:
        return apart(images, goal * goal, pair, radii)
    if rule == FIRST_TWO:
        return gap(roots, 0, 1) >= goal * goal
    if rule == MEAN_SQUARE:
        return spread >= goal * goal
    if rule == SETTLED:
        return moved >= goal
    if rule == CONSECUTIVE:
        if gap(roots, pair[0], pair[0] + 1) >= goal * goal:
            return True
        for i in range(n - 1):
            if gap(roots, i, i + 1) >= goal * goal:
                pair[0], pair[1] = i, i + 1
                return True
        return False
    if roots[pair[0], pair[2]] - roots[pair[1], pair[2]] >= goal:
        return True
    return columns_apart(roots, 1 if rule == FIRST_COORDINATE else n, goal, pair)


@inlined
def set_reference(roots, reference, sums):
    """Set the point from which squares are taken to the mean of all; return their sum."""
    n = roots.shape[0]
    reference[:] = 0.0
    for i in range(n):
        reference += roots[i]
    reference /= n
    sums[:] = 0.0
    squares = 0.0
    for i in range(n):
        for k in range(n):
            part = roots[i, k] - reference[k]
            sums[k] += part
            squares += part * part
    return squares


@kernel
def stopping_times(times, n_particles, pairs, shares, tolerance, stream):
    """Draw the numbers of steps at which each rule stops at each tolerance.

    Parameters
    ----------
    times : int64[draw, rule, tolerance], overwritten
    n_particles : int >= 2
    pairs, shares : int, codes of how pairs and angles are drawn
    tolerance : float64[k] below 1, falling, in units of the sphere's radius
    stream : from `new_stream`, advanced

    Returns
    -------
    int, steps of all draws
    """
    n, n_rules = n_particles, times.shape[1]
    images, roots = np.empty((n, n)), np.empty((n, n))
    radii, reference, sums = np.empty((2, n)), np.empty(n), np.empty(n)
    pair, level = np.empty((n_rules, 3), np.int64), np.empty(n_rules, np.int64)
    applied = 0
    for draw in range(times.shape[0]):
        images[:] = 0.0
        for i in range(n):
            images[i, i] = 1.0
        copy_images(images, roots)
        pair[:, 0], pair[:, 1], pair[:, 2], level[:] = 0, 1, 0, 0
        steps, squares = 0, set_reference(roots, reference, sums)
        while level.min() < tolerance.size:
            steps += 1
            p, q = pair_of(pairs, n, stream)
            a = share_of(shares, stream)
            if steps % REFRESHED == 0:
                squares = set_reference(roots, reference, sums)
            moved, length = 0.0, 0.0
            for k in range(n):
                merged = a * images[p, k] + (1.0 - a) * images[q, k]
                root = math.sqrt(merged)
                here = root - reference[k]
                old_p, old_q = roots[p, k] - reference[k], roots[q, k] - reference[k]
                change = 2.0 * here - old_p - old_q
                squares += 2.0 * here * here - old_p * old_p - old_q * old_q
                sums[k] += change
                length += sums[k] * sums[k]
                moved += change * change
                images[p, k] = images[q, k] = merged
                roots[p, k] = roots[q, k] = root
            moved = math.sqrt(moved) / n
            spread = 2.0 * (n * squares - length) / (n * (n - 1.0))
            for rule in range(n_rules):
                # What showed two images apart stays as it was unless the step touched them.
                i, j = pair[rule, 0], pair[rule, 1]
                of_pair = rule != MEAN_SQUARE and rule != SETTLED
                if of_pair and p not in (i, j) and q not in (i, j):
                    continue
                while level[rule] < tolerance.size:
                    goal = tolerance[level[rule]]
                    if still_apart(rule, goal, images, roots, pair[rule], radii, spread, moved):
                        break
                    times[draw, rule, level[rule]] = steps
                    level[rule] += 1
        applied += steps
    return applied


@kernel
def stopping_times_single(times, n_particles, tolerance, stream):
    """Do as `stopping_times` in single precision, forward as printed, by the largest distance.

    Energies of a pair that rounding makes negative count as zero. A draw ends after LIMIT_STEPS.

    Parameters
    ----------
    times : int64[draw, 1, tolerance], overwritten
    """
    n = n_particles
    corners = np.empty((n, n), np.float32)
    radii, pair = np.empty((2, n), np.float32), np.empty(3, np.int64)
    applied = 0
    for draw in range(times.shape[0]):
        corners[:] = 0.0
        for i in range(n):
            corners[i, i] = 1.0
        pair[:] = 0, 1, 0
        steps, level = 0, 0
        while level < tolerance.size and steps < LIMIT_STEPS:
            steps += 1
            p, q = pair_below(n, stream)
            sine = np.float32(math.sqrt(squared_cosine(stream)))
            for i in range(n):
                energy = corners[i, p] * corners[i, p] + corners[i, q] * corners[i, q]
                corners[i, p] = math.sqrt(energy) * sine
                rest = energy - corners[i, p] * corners[i, p]
                corners[i, q] = math.sqrt(max(rest, np.float32(0.0)))
            while level < tolerance.size and not apart(corners, tolerance[level] ** 2, pair, radii):
                times[draw, 0, level] = steps
                level += 1
        times[draw, 0, level:] = LIMIT_STEPS
        applied += steps
    return applied
