"""The Nanbu-Babovsky algorithm: disjoint pairs, both partners updated (Kac paper, 4.1)."""

import math

import numpy as np
from numba import int64

from kacsim.kac.constants import n_steps
from kacsim.kac.model import collide, initial_velocity
from kacsim.kac.moments import INITIAL_PRODUCT, INITIAL_SQUARE, gain
from kacsim.kac.tape import ancestral_draws
from kacsim.kernels.jit import allocating, inlined, kernel
from kacsim.variates import failures_before_success, gap_scale, index_below, uniform


def arguments(*, n_particles, time, time_step, collision_rate):
    """Return the kernels' parameters: particles, steps, and mean number of pairs of a step."""
    return n_particles, n_steps(time, time_step), collision_rate * n_particles * time_step / 2


@kernel
def forward(velocities, own, n_particles, steps, mean_pairs, stream):
    """Draw v_1(t) from whole ensembles, as published.

    At each step Round[mean_pairs] pairs are drawn without replacement, by a partial shuffle.

    Parameters
    ----------
    velocities : float64[n], overwritten by independent draws of v_1
    own : int64[n], overwritten by the number of collisions of particle 1
    n_particles, steps, mean_pairs : from `arguments`
    stream : uint64[4], advanced

    Returns
    -------
    int, collisions simulated
    """
    v = np.empty(n_particles)
    order = np.arange(n_particles)
    whole = int64(mean_pairs)
    simulated = 0
    for draw in range(velocities.size):
        for i in range(n_particles):
            v[i] = initial_velocity(stream)
        touched = 0
        for _ in range(steps):
            pairs = whole + int64(uniform(stream) < mean_pairs - whole)
            for k in range(2 * pairs):
                chosen = k + index_below(n_particles - k, stream)
                order[k], order[chosen] = order[chosen], order[k]
            for k in range(pairs):
                i, j = order[2 * k], order[2 * k + 1]
                collide(v, i, j, stream)
                touched += (i == 0) + (j == 0)
            simulated += pairs
        velocities[draw] = v[0]
        own[draw] = touched
    return simulated


@inlined
def spared(members, n_particles, pairs):
    """Return the chance that a matching of `pairs` disjoint pairs leaves all members alone."""
    chance = 1.0
    for k in range(members):
        chance *= max(0.0, 1.0 - 2.0 * pairs / (n_particles - k))
    return chance


@inlined
def touch_scale(members, n_particles, mean_pairs):
    """Return the `gap_scale` of the chance that a step touches at least one ancestor."""
    whole = int64(mean_pairs)
    more = mean_pairs - whole
    few = spared(members, n_particles, whole)
    return gap_scale(1.0 - few + more * (few - spared(members, n_particles, whole + 1)))


@allocating
def touch_scales(n_particles, mean_pairs):
    """Return `touch_scale` for 0..255 members (a product over the members saved per step)."""
    scales = np.empty(min(n_particles + 1, 256))
    for members in range(scales.size):
        scales[members] = touch_scale(members, n_particles, mean_pairs)
    return scales


@inlined
def reveal(tape, n, root, members, n_particles, mean_pairs, taken, stream):
    """Record the pairs of one step that touch the ancestors, given that at least one does.

    Parameters
    ----------
    tape : written from place n on, at most at `members` places; root : slot of particle 1
    taken : bool[n_particles], all False, also on return: members paired as a partner

    Returns
    -------
    (int, int), the numbers of pairs recorded and of ancestors
    """
    whole = int64(mean_pairs)
    more = mean_pairs - whole
    touch_few = (1.0 - more) * (1.0 - spared(members, n_particles, whole))
    touch_more = more * (1.0 - spared(members, n_particles, whole + 1))
    pairs = whole + int64(uniform(stream) * (touch_few + touch_more) >= touch_few)
    # The first member touched, by inversion of its conditional law.
    target = uniform(stream) * (1.0 - spared(members, n_particles, pairs))
    lead, alone = 0, 1.0 - 2.0 * pairs / n_particles
    while lead < members - 1 and 1.0 - alone <= target:
        lead += 1
        alone *= 1.0 - 2.0 * pairs / (n_particles - lead)
    known, unseen, free = members, n_particles - lead, members - lead
    for i in range(lead, known):
        if taken[i]:
            continue
        # `unseen` particles, `free` of them members from i on, hold the remaining pairs.
        if i == lead or uniform(stream) * unseen < 2.0 * pairs:
            if uniform(stream) * (unseen - 1) < free - 1:
                j = untaken(i, index_below(free - 1, stream), taken)
                taken[j] = True
                free -= 1
            else:
                j = members
                members += 1
            tape.first[n], tape.second[n] = root + i, root + j
            n += 1
            pairs -= 1
            unseen -= 1
        unseen -= 1
        free -= 1
    taken[:known] = False
    return n, members


@inlined
def untaken(i, rank, taken):
    """Return the member after i that has `rank` members not yet taken between them."""
    j = i + 1
    while taken[j] or rank > 0:
        rank -= not taken[j]
        j += 1
    return j


@allocating
def prepare(arguments):
    """Return `touch_scales`, and marks of the members that have been paired as a partner."""
    n_particles, _, mean_pairs = arguments
    return touch_scales(n_particles, mean_pairs), np.zeros(n_particles, np.bool_)


@inlined
def history(arguments, prepared, tape, start, root, stream):
    """Find the collisions of one draw, step by step backward.

    Steps whose pairs leave all ancestors alone are skipped geometrically; in the others the
    ancestors' partners are revealed one after another.
    """
    (n_particles, left, mean_pairs), (scales, taken) = arguments, prepared
    n, members, own = start, 1, 0
    while True:
        if members < scales.size:
            scale = scales[members]
        else:
            scale = touch_scale(members, n_particles, mean_pairs)
        left -= failures_before_success(scale, stream) + 1
        if left < 0:
            return n, members, own
        if n + members > tape.first.size:
            return -1, members, own
        before = n
        n, members = reveal(tape, n, root, members, n_particles, mean_pairs, taken, stream)
        for event in range(before, n):
            own += int64(tape.first[event] == root) + int64(tape.second[event] == root)


ancestral = ancestral_draws(prepare, history)


def fourth_moment(*, n_particles, time, time_step, collision_rate):
    """Return E v_1**4 of disjoint pairs; linear in their number, so its mean is enough."""
    n, steps, pairs = arguments(
        n_particles=n_particles, time=time, time_step=time_step, collision_rate=collision_rate
    )
    probability = 2.0 * pairs / n
    a, b = INITIAL_SQUARE, INITIAL_PRODUCT
    together = pairs / (n * (n - 1.0) / 2.0)
    for _ in range(steps):
        change = 0.75 * (a + b) - a
        a, b = a + probability * change, b + together * (0.25 * (a + b) - b)
    return a


def fourth_moment_with_replacement(*, n_particles, time, time_step, collision_rate):
    """Return E v_1**4 when the pairs of a step are drawn one after another, as the text once says.

    Each step then makes Round[rate N step / 2] collisions of uniform pairs.
    """
    n, steps, pairs = arguments(
        n_particles=n_particles, time=time, time_step=time_step, collision_rate=collision_rate
    )
    ratio = 1.0 - (n + 2.0) / (2.0 * n * (n - 1.0))
    whole = math.floor(pairs)
    more = pairs - whole
    per_step = ratio**whole * (1.0 - more + more * ratio)
    return INITIAL_SQUARE + gain(n) * (1.0 - per_step**steps)
