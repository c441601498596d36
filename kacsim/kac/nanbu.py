"""Nanbu's algorithm in its two readings, sequential and synchronous (Kac paper, 4.1).

At each step every particle i collides with probability p = rate * step; it draws a partner j
and becomes v_i cos(theta) + v_j sin(theta), v_j is unchanged. *Synchronous*, as the formulas are
printed, reads v_j at the old time level; *sequential* updates in place for i = 1..N.

Particles that do not collide are skipped: over the N * steps trials in order, the gaps between
collisions are geometric, which is the law of independent trials.
"""

import numpy as np
from numba import int64

from kacsim.checks import n_steps
from kacsim.jit import inlined, kernel
from kacsim.kac.model import (
    copy_state,
    deflect,
    growing,
    initial_energy,
    initial_velocity,
    signed_root,
)
from kacsim.variates import (
    failures_before_success,
    gap_scale,
    index_below,
    squared_cosine,
    uniform,
)


def arguments(*, n_particles, time, time_step, collision_rate, **_):
    """Return the kernels' parameters: particles, steps, and collision probability of a step."""
    return n_particles, n_steps(time, time_step), collision_rate * time_step


@inlined
def partner_of(i, n_particles, stream):
    """Return a uniform index below n_particles other than i."""
    j = index_below(n_particles - 1, stream)
    return j + int64(j >= i)


@kernel
def forward_sequential(velocities, own, n_particles, steps, probability, stream):
    """Draw v_1(t) from whole ensembles, updated in place for i = 1..N.

    Parameters
    ----------
    velocities : float64[n], overwritten by independent draws of v_1
    own : int64[n], overwritten by the number of velocity changes of particle 1
    n_particles, steps, probability : from `arguments`
    stream : uint64[4], advanced

    Returns
    -------
    int, collisions simulated
    """
    v = np.empty(n_particles)
    scale = gap_scale(probability)
    simulated = 0
    for draw in range(velocities.size):
        for i in range(n_particles):
            v[i] = initial_velocity(stream)
        touched = 0
        trial = int64(failures_before_success(scale, stream))
        while trial < n_particles * steps:
            i = trial % n_particles
            v[i] = deflect(v[i], v[partner_of(i, n_particles, stream)], stream)
            touched += i == 0
            simulated += 1
            trial += 1 + int64(failures_before_success(scale, stream))
        velocities[draw] = v[0]
        own[draw] = touched
    return simulated


@kernel
def forward_synchronous(velocities, own, n_particles, steps, probability, stream):
    """Draw v_1(t) from whole ensembles, partners read at the old time level.

    Parameters and result as `forward_sequential`.
    """
    v = np.empty(n_particles)
    changed, new = np.empty(n_particles, np.int64), np.empty(n_particles)
    scale = gap_scale(probability)
    simulated = 0
    for draw in range(velocities.size):
        for i in range(n_particles):
            v[i] = initial_velocity(stream)
        touched, pending, step = 0, 0, 0
        trial = int64(failures_before_success(scale, stream))
        while trial < n_particles * steps:
            if trial // n_particles > step:
                for k in range(pending):
                    v[changed[k]] = new[k]
                pending, step = 0, trial // n_particles
            i = trial - step * n_particles
            changed[pending] = i
            new[pending] = deflect(v[i], v[partner_of(i, n_particles, stream)], stream)
            pending += 1
            touched += i == 0
            simulated += 1
            trial += 1 + int64(failures_before_success(scale, stream))
        for k in range(pending):
            v[changed[k]] = new[k]
        velocities[draw] = v[0]
        own[draw] = touched
    return simulated


@inlined
def place_of(label, labels, members):
    """Return the first place in the descending labels whose label is at most the given one."""
    place = 0
    while place < members and labels[place] > label:
        place += 1
    return place


@inlined
def insert(array, place, length, value):
    """Insert the value at the place of an array that holds `length` values."""
    for k in range(length, place, -1):
        array[k] = array[k - 1]
    array[place] = value


@growing
@kernel
def ancestral_sequential(
    velocities, own, n_particles, steps, probability, stream, first, second, energy
):
    """Draw v_1(t) from the ancestors only; same law and parameters as `forward_sequential`.

    A step backward visits the ancestors from the highest label to the lowest. A new ancestor of
    lower label is visited later in the same step, one of higher label was read before its turn.
    """
    scale = gap_scale(probability)
    labels, slots = np.empty(n_particles, np.int64), np.empty(n_particles, np.int64)
    start = stream.copy()
    simulated = 0
    for draw in range(velocities.size):
        copy_state(stream, start)
        labels[0], slots[0] = 0, 0
        n, members, touched, left, place = 0, 1, 0, steps, 0
        gap = int64(failures_before_success(scale, stream))
        while True:
            if gap >= members - place:
                left, gap = leave_step(left, gap - (members - place), members)
                place = 0
                if left <= 0:
                    break
            if n == first.size:
                copy_state(start, stream)
                return draw, simulated
            place += gap
            i, slot = labels[place], slots[place]
            j = partner_of(i, n_particles, stream)
            found = place_of(j, labels, members)
            if found == members or labels[found] != j:
                insert(labels, found, members, j)
                insert(slots, found, members, members)
                members += 1
                place += int64(found <= place)
            first[n], second[n] = slot, slots[found]
            touched += int64(i == 0)
            n += 1
            place += 1
            gap = int64(failures_before_success(scale, stream))
        velocities[draw] = signed_root(
            replay_in_place(energy, members, first, second, n, stream), stream
        )
        own[draw] = touched
        simulated += n
    return velocities.size, simulated


@inlined
def leave_step(left, gap, members):
    """Return (steps left, gap) after the end of a step and the whole steps that the gap spans."""
    whole = gap // members
    return left - 1 - whole, gap - whole * members


@inlined
def replay_in_place(energy, n_ancestors, first, second, n_events, stream):
    """Draw the ancestors' energies and replay their collisions in order; return that of v_1."""
    for i in range(n_ancestors):
        energy[i] = initial_energy(stream)
    for event in range(n_events - 1, -1, -1):
        total = energy[first[event]] + energy[second[event]]
        energy[first[event]] = total * squared_cosine(stream)
    return energy[0]


@growing
@kernel
def ancestral_synchronous(
    velocities, own, n_particles, steps, probability, stream, first, second, energy
):
    """Draw v_1(t) from the ancestors only; same law and parameters as `forward_synchronous`.

    Ancestors found during a step are needed at its old level only: they take part from the
    next step backward on. Labels are not needed: the other particles are exchangeable.
    """
    scale = gap_scale(probability)
    step_of, new = np.empty(first.size, np.int64), np.empty(first.size)
    start = stream.copy()
    simulated = 0
    for draw in range(velocities.size):
        copy_state(stream, start)
        n, members, old, touched, left, place = 0, 1, 1, 0, steps, 0
        gap = int64(failures_before_success(scale, stream))
        while True:
            if gap >= old - place:
                left, gap = leave_step(left, gap - (old - place), members)
                old, place = members, 0
                if left <= 0:
                    break
            if n == first.size:
                copy_state(start, stream)
                return draw, simulated
            place += gap
            j = members
            if uniform(stream) * (n_particles - 1) < members - 1:
                j = partner_of(place, members, stream)
            else:
                members += 1
            first[n], second[n], step_of[n] = place, j, left
            touched += int64(place == 0)
            n += 1
            place += 1
            gap = int64(failures_before_success(scale, stream))
        velocities[draw] = signed_root(
            replay_steps(energy, members, first, second, step_of, new, n, stream), stream
        )
        own[draw] = touched
        simulated += n
    return velocities.size, simulated


@inlined
def replay_steps(energy, n_ancestors, first, second, step_of, new, n_events, stream):
    """Draw the ancestors' energies and replay step by step, each at its old level.

    Parameters
    ----------
    step_of : int64[n_events], the step of each collision, not increasing in time
    new : float64[>= n_events], overwritten
    """
    for i in range(n_ancestors):
        energy[i] = initial_energy(stream)
    event = n_events - 1
    while event >= 0:
        last = event
        while event >= 0 and step_of[event] == step_of[last]:
            total = energy[first[event]] + energy[second[event]]
            new[event] = total * squared_cosine(stream)
            event -= 1
        for k in range(event + 1, last + 1):
            energy[first[k]] = new[k]
    return energy[0]
