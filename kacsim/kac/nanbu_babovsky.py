"""The Nanbu-Babovsky algorithm: disjoint pairs, both partners updated (Kac paper, 4.1)."""

import math

import numpy as np
from numba import int64

from kacsim.kac import model, own_law
from kacsim.kac.constants import n_steps
from kacsim.kac.moments import INITIAL_PRODUCT, INITIAL_SQUARE, gain
from kacsim.kac.tape import ancestral_draws
from kacsim.kernels.jit import allocating, inlined, kernel
from kacsim.variates import failures_before_success, gap_scale, index_below, uniform


def arguments(*, n_particles, time, time_step, collision_rate):
    """Return the kernels' parameters: particles, steps, and mean number of pairs of a step."""
    return n_particles, n_steps(time, time_step), collision_rate * n_particles * time_step / 2


def forward_draws(law):
    """Return the kernel that draws v_1(t) from whole ensembles.

    Parameters
    ----------
    law : module of the law of collisions, such as `kacsim.kac.model`
    """
    ensemble, start, collide, copy = law.ensemble, law.start, law.collide, law.copy

    @kernel
    def forward(velocities, own, n_particles, steps, mean_pairs, stream, tables=()):
        """Draw v_1(t) from whole ensembles, as published.

        At each step Round[mean_pairs] pairs are drawn without replacement, by a partial shuffle.

        Parameters
        ----------
        velocities : float64[n] or float64[n, 3], overwritten by independent draws of v_1
        own : int64[n], overwritten by the number of collisions of particle 1
        n_particles, steps, mean_pairs : from `arguments`
        stream : from `new_stream`, advanced
        tables : what the law of collisions draws from, if it has tables

        Returns
        -------
        int, collisions simulated
        """
        v = ensemble(n_particles, tables)
        order = np.arange(n_particles)
        whole = int64(mean_pairs)
        simulated = 0
        for draw in range(len(velocities)):
            for i in range(n_particles):
                start(v, i, stream)
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
            copy(velocities, draw, v, 0)
            own[draw] = touched
        return simulated

    return forward


@allocating
def prepare(arguments, most):
    """Return what all draws share.

    Returns
    -------
    scale : float64[n], `gap_scale` of the chance that a step touches one of s ancestors, s < n
    touch : float64[2, n], chances that it does with the lesser and with the greater number of
        pairs, times that number's chance
    taken : bool[n], all False: ancestors paired as a partner in a step

    n is `most`, or all particles and one.
    """
    n_particles, _, mean_pairs = arguments
    whole = int64(mean_pairs)
    chances = 1.0 - (mean_pairs - whole), mean_pairs - whole
    size = min(n_particles + 1, most)
    scale, touch = np.empty(size), np.empty((2, size))
    few, more = 1.0, 1.0
    for s in range(size):
        touch[0, s], touch[1, s] = chances[0] * (1.0 - few), chances[1] * (1.0 - more)
        scale[s] = gap_scale(touch[0, s] + touch[1, s])
        # The next one's chance to be alone, if those before are.
        few *= max(0.0, 1.0 - 2.0 * whole / (n_particles - s))
        more *= max(0.0, 1.0 - 2.0 * (whole + 1) / (n_particles - s))
    return scale, touch, np.zeros(size, np.bool_)


@inlined
def first_touched(members, touch, stream):
    """Return (lowest ancestor touched, 1 if the step has the greater number of pairs else 0)."""
    place = uniform(stream) * (touch[0, members] + touch[1, members])
    more = int64(place >= touch[0, members])
    place -= more * touch[0, members]
    lead = 0
    while lead < members - 1 and touch[more, lead + 1] <= place:
        lead += 1
    return lead, more


@inlined
def reveal(tape, n, root, members, n_particles, lead, pairs, taken, stream):
    """Record the pairs of one step that touch the ancestors.

    Parameters
    ----------
    tape : written from place n on, at most at `members` places; root : slot of particle 1
    lead, pairs : the lowest ancestor touched, the pairs of the step
    taken : bool[>= members], all False, also on return: members paired as a partner

    Returns
    -------
    (int, int), the numbers of pairs recorded and of ancestors
    """
    known, unseen, free = members, n_particles - lead, members - lead
    # By inversion: the next member touched is the first whose `alone` is not above `target`.
    alone, target, paired = 0.0, 0.0, False
    for i in range(lead, known):
        if taken[i]:
            continue
        # `unseen` particles, `free` of them members from i on, hold the remaining pairs.
        alone *= 1.0 - 2.0 * pairs / unseen
        if alone <= target:
            j = index_below(unseen - 1, stream)
            if j < free - 1:
                j = untaken(i, j, taken)
                taken[j] = True
                free -= 1
                paired = True
            else:
                j = members
                members += 1
            tape.first[n], tape.second[n] = root + i, root + j
            n += 1
            pairs -= 1
            unseen -= 1
            alone, target = 1.0, uniform(stream)
            # Most often a bound of the chance that no other one is touched is enough.
            if target < 1.0 - 2.0 * pairs * (free - 1) / (unseen - free):
                break
        unseen -= 1
        free -= 1
    if paired:
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


@inlined
def history(arguments, prepared, tape, start, root, stream):
    """Find the collisions of one draw, step by step backward.

    Steps whose pairs leave all ancestors alone are skipped geometrically; in the others the
    ancestors' partners are revealed one after another.
    """
    (n_particles, left, mean_pairs), (scale, touch, taken) = arguments, prepared
    n, members, own = start, 1, 0
    while True:
        left -= failures_before_success(scale[members], stream) + 1
        if left < 0:
            return n, members, own
        if n + members > tape.first.size or min(2 * members, n_particles) >= scale.size:
            return -1, members, own
        lead, more = first_touched(members, touch, stream)
        pairs = int64(mean_pairs) + more
        n, members = reveal(tape, n, root, members, n_particles, lead, pairs, taken, stream)
        own += int64(lead == 0)


forward = forward_draws(model)
ancestral = ancestral_draws(model, prepare, history)
own_forward = forward_draws(own_law)
own_ancestral = ancestral_draws(own_law, prepare, history)


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
