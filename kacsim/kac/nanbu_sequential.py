"""Nanbu's algorithm, sequential: updated in place for i = 1..N (Kac paper, 4.1)."""

import numpy as np
from numba import int64

from kacsim.kac import model, own_law
from kacsim.kac.moments import INITIAL_PRODUCT, INITIAL_SQUARE
from kacsim.kac.nanbu import arguments, leave_step, partner_of
from kacsim.kac.tape import ancestral_draws
from kacsim.kernels.jit import allocating, inlined, kernel
from kacsim.variates import failures_before_success, gap_scale

__all__ = ["ancestral", "arguments", "forward", "fourth_moment", "own_ancestral", "own_forward"]


def forward_draws(law):
    """Return the kernel that draws v_1(t) from whole ensembles.

    Parameters
    ----------
    law : module of the law of collisions, such as `kacsim.kac.model`
    """
    ensemble, start, deflect, copy = law.ensemble, law.start, law.deflect, law.copy

    @kernel
    def forward(velocities, own, n_particles, steps, probability, stream, tables=()):
        """Draw v_1(t) from whole ensembles, updated in place for i = 1..N.

        Parameters
        ----------
        velocities : float64[n] or float64[n, 3], overwritten by independent draws of v_1
        own : int64[n], overwritten by the number of velocity changes of particle 1
        n_particles, steps, probability : from `arguments`
        stream : from `new_stream`, advanced
        tables : what the law of collisions draws from, if it has tables

        Returns
        -------
        int, collisions simulated
        """
        v = ensemble(n_particles, tables)
        scale = gap_scale(probability)
        simulated = 0
        for draw in range(len(velocities)):
            for i in range(n_particles):
                start(v, i, stream)
            touched = 0
            trial = int64(failures_before_success(scale, stream))
            while trial < n_particles * steps:
                i = trial % n_particles
                deflect(v, i, v, i, partner_of(i, n_particles, stream), stream)
                touched += i == 0
                simulated += 1
                trial += 1 + int64(failures_before_success(scale, stream))
            copy(velocities, draw, v, 0)
            own[draw] = touched
        return simulated

    return forward


@inlined
def seat(label, slot, labels, slots, members):
    """Return (place, members): where the label is among the descending ones, inserted if new."""
    place = members
    while place > 0 and labels[place - 1] < label:
        labels[place], slots[place] = labels[place - 1], slots[place - 1]
        place -= 1
    if place == 0 or labels[place - 1] != label:
        labels[place], slots[place] = label, slot
        return place, members + 1
    for k in range(place, members):
        labels[k], slots[k] = labels[k + 1], slots[k + 1]
    return place - 1, members


@allocating
def prepare(arguments, most):
    """Return the scale of the gaps between collisions, and `most` labels and slots."""
    return gap_scale(arguments[2]), np.empty(most, np.int64), np.empty(most, np.int64)


@inlined
def history(arguments, prepared, tape, start, root, stream):
    """Find the collisions of one draw, step by step backward.

    A step visits the ancestors from the highest label to the lowest. A new ancestor of lower label
    is visited later in the same step, one of higher label was read before its turn.
    """
    (n_particles, left, _), (scale, labels, slots) = arguments, prepared
    labels[0], slots[0] = 0, root
    n, members, own, place = start, 1, 0, 0
    gap = int64(failures_before_success(scale, stream))
    while True:
        if gap >= members - place:
            left, gap = leave_step(left, gap - (members - place), members)
            place = 0
            if left <= 0:
                return n, members, own
        if n == tape.first.size or members == labels.size:
            return -1, members, own
        place += gap
        i, slot = labels[place], slots[place]
        j = partner_of(i, n_particles, stream)
        before = members
        found, members = seat(j, root + members, labels, slots, members)
        place += int64(members > before and found <= place)
        tape.first[n], tape.second[n] = slot, slots[found]
        own += int64(i == 0)
        n += 1
        place += 1
        gap = int64(failures_before_success(scale, stream))


def in_place(law):
    """Return the replay of collisions that change the first particle of the pair only, in order."""
    receive = law.receive

    @inlined
    def replay(tape, state, n_events):
        for event in range(n_events - 1, -1, -1):
            receive(state, tape.first[event], tape.second[event], event)

    return replay


forward = forward_draws(model)
ancestral = ancestral_draws(model, prepare, history, in_place)
own_forward = forward_draws(own_law)
own_ancestral = ancestral_draws(own_law, prepare, history, in_place)


def fourth_moment(**process):
    """Return E v_1**4 when particles 1..N are updated in place."""
    return float(second_moments(**process)[0, 0])


def second_moments(*, n_particles, time, time_step, collision_rate):
    """Return E x_i x_j of the energies x = v**2, float64[N, N], in O(N**2) per step."""
    n, steps, p = arguments(
        n_particles=n_particles, time=time, time_step=time_step, collision_rate=collision_rate
    )
    other = 1.0 / (n - 1.0)
    moments = np.full((n, n), INITIAL_PRODUCT)
    np.fill_diagonal(moments, INITIAL_SQUARE)
    sums = moments.sum(axis=0)
    trace = moments.trace()
    for _ in range(steps):
        for i in range(n):
            row, square = moments[i].copy(), moments[i, i]
            mixed = 0.5 * (row + other * (sums - row))
            new = (1.0 - p) * row + p * mixed
            partners = other * (trace - square + 2.0 * (sums[i] - square))
            new[i] = (1.0 - p) * square + 3.0 / 8.0 * p * (square + partners)
            moments[i], moments[:, i] = new, new
            sums += new - row
            sums[i] = new.sum()
            trace += new[i] - square
    return moments
