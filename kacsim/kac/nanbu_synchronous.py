"""Nanbu's algorithm, synchronous: partners are read at the old time level (Kac paper, 4.1)."""

import numpy as np
from numba import int64

from kacsim.kac import model, own_law
from kacsim.kac.moments import INITIAL_PRODUCT, INITIAL_SQUARE
from kacsim.kac.nanbu import arguments, leave_step, partner_of
from kacsim.kac.tape import ancestral_draws
from kacsim.kernels.jit import inlined, kernel
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
        """Draw v_1(t) from whole ensembles, partners read at the old time level.

        Parameters and result as `kacsim.kac.nanbu_sequential.forward`.
        """
        v = ensemble(n_particles, tables)
        changed, new = np.empty(n_particles, np.int64), ensemble(n_particles, tables)
        scale = gap_scale(probability)
        simulated = 0
        for draw in range(len(velocities)):
            for i in range(n_particles):
                start(v, i, stream)
            touched, pending, step = 0, 0, 0
            trial = int64(failures_before_success(scale, stream))
            while trial < n_particles * steps:
                if trial // n_particles > step:
                    for k in range(pending):
                        copy(v, changed[k], new, k)
                    pending, step = 0, trial // n_particles
                i = trial - step * n_particles
                changed[pending] = i
                deflect(new, pending, v, i, partner_of(i, n_particles, stream), stream)
                pending += 1
                touched += i == 0
                simulated += 1
                trial += 1 + int64(failures_before_success(scale, stream))
            for k in range(pending):
                copy(v, changed[k], new, k)
            copy(velocities, draw, v, 0)
            own[draw] = touched
        return simulated

    return forward


@inlined
def prepare(arguments, most):
    """Return the scale of the gaps between collisions."""
    return gap_scale(arguments[2])


@inlined
def history(arguments, scale, tape, start, root, stream):
    """Find the collisions of one draw, step by step backward.

    Ancestors found during a step are needed at its old level only: they take part from the
    next step backward on. Labels are not needed: the other particles are exchangeable.
    """
    n_particles, left, _ = arguments
    n, members, old, own, place = start, 1, 1, 0, 0
    gap = int64(failures_before_success(scale, stream))
    while True:
        if gap >= old - place:
            left, gap = leave_step(left, gap - (old - place), members)
            old, place = members, 0
            if left <= 0:
                return n, members, own
        if n == tape.first.size:
            return -1, members, own
        place += gap
        j = partner_of(place, n_particles, stream)
        if j >= members:
            j = members
            members += 1
        tape.first[n], tape.second[n] = root + place, root + j
        tape.mark[n] = left
        own += int64(place == 0)
        n += 1
        place += 1
        gap = int64(failures_before_success(scale, stream))


def at_old_level(law):
    """Return the replay of collisions that change the first of the pair only, by whole steps.

    Two draws' collisions share no slot, so that it does no harm if a step runs into another draw's.
    """
    receive, foresee, settle = law.receive, law.foresee, law.settle

    @inlined
    def replay(tape, state, n_events):
        last = n_events - 1
        while last >= 0:
            first = last
            while first > 0 and tape.mark[first - 1] == tape.mark[last]:
                first -= 1
            if first == last:
                receive(state, tape.first[last], tape.second[last], last)
            else:
                for event in range(first, last + 1):
                    foresee(state, tape.first[event], tape.second[event], event)
                for event in range(first, last + 1):
                    settle(state, tape.first[event], event)
            last = first - 1

    return replay


forward = forward_draws(model)
ancestral = ancestral_draws(model, prepare, history, at_old_level)
own_forward = forward_draws(own_law)
own_ancestral = ancestral_draws(own_law, prepare, history, at_old_level)


def fourth_moment(**process):
    """Return E v_1**4 when all partners are read at the old time level."""
    return second_moments(**process)[0]


def second_moments(*, n_particles, time, time_step, collision_rate):
    """Return (E x_i**2, E x_i x_j) of the energies x = v**2."""
    n, steps, p = arguments(
        n_particles=n_particles, time=time, time_step=time_step, collision_rate=collision_rate
    )
    other = 1.0 / (n - 1.0)
    a, b = INITIAL_SQUARE, INITIAL_PRODUCT
    common = (n - 2.0) * other**2
    for _ in range(steps):
        one = other * 0.5 * (a + b) + (1.0 - other) * b
        crossed = other * a + (1.0 - other) * b
        both = 0.25 * (b + 2.0 * crossed + common * a + (1.0 - common) * b)
        new_a = (1.0 - p) * a + 0.75 * p * (a + b)
        b = (1.0 - p) ** 2 * b + 2.0 * p * (1.0 - p) * one + p**2 * both
        a = new_a
    return a, b
