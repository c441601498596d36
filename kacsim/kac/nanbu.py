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
    deflect,
    fill_initial_energies,
    grown,
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


@kernel
def ancestral_sequential(velocities, own, n_particles, steps, probability, stream):
    """Draw v_1(t) from the ancestors only; same law and parameters as `forward_sequential`.

    A step backward visits the ancestors from the highest label to the lowest. A new ancestor of
    lower label is visited later in the same step, one of higher label was read before its turn.
    """
    scale = gap_scale(probability)
    first, second = np.empty(64, np.int64), np.empty(64, np.int64)
    labels, slots = np.empty(n_particles, np.int64), np.empty(n_particles, np.int64)
    energy = np.empty(64)
    simulated = 0
    for draw in range(velocities.size):
        labels[0], slots[0] = 0, 0
        n, members, touched, left, place = 0, 1, 0, steps, 0
        gap = int64(failures_before_success(scale, stream))
        while True:
            if gap >= members - place:
                # No further collision in this step: end it, then leave out whole steps.
                gap -= members - place
                whole = gap // members
                left -= 1 + whole
                gap -= whole * members
                place = 0
                if left <= 0:
                    break
            place += gap
            i, slot = labels[place], slots[place]
            j = partner_of(i, n_particles, stream)
            found = place_of(j, labels, members)
            if found == members or labels[found] != j:
                insert(labels, found, members, j)
                insert(slots, found, members, members)
                members += 1
                place += found <= place
            if n == first.size:
                first, second = grown(first), grown(second)
            first[n], second[n] = slot, slots[found]
            touched += i == 0
            n += 1
            place += 1
            gap = int64(failures_before_success(scale, stream))
        energy = fill_initial_energies(energy, members, stream)
        for event in range(n - 1, -1, -1):
            total = energy[first[event]] + energy[second[event]]
            energy[first[event]] = total * squared_cosine(stream)
        velocities[draw] = signed_root(energy[0], stream)
        own[draw] = touched
        simulated += n
    return simulated


@kernel
def ancestral_synchronous(velocities, own, n_particles, steps, probability, stream):
    """Draw v_1(t) from the ancestors only; same law and parameters as `forward_synchronous`.

    Ancestors found during a step are needed at its old level only: they take part from the
    next step backward on. Labels are not needed: the other particles are exchangeable.
    """
    scale = gap_scale(probability)
    first, second = np.empty(64, np.int64), np.empty(64, np.int64)
    step_of, new = np.empty(64, np.int64), np.empty(64)
    energy = np.empty(64)
    simulated = 0
    for draw in range(velocities.size):
        n, members, old, touched, left, place = 0, 1, 1, 0, steps, 0
        gap = int64(failures_before_success(scale, stream))
        while True:
            if gap >= old - place:
                gap -= old - place
                old = members
                whole = gap // old
                left -= 1 + whole
                gap -= whole * old
                place = 0
                if left <= 0:
                    break
            place += gap
            j = members
            if uniform(stream) * (n_particles - 1) < members - 1:
                j = partner_of(place, members, stream)
            else:
                members += 1
            if n == first.size:
                first, second, step_of, new = grown(first), grown(second), grown(step_of), grown(new)
            first[n], second[n], step_of[n] = place, j, left
            touched += place == 0
            n += 1
            place += 1
            gap = int64(failures_before_success(scale, stream))
        energy = fill_initial_energies(energy, members, stream)
        replay_steps(energy, first, second, step_of, new, n, stream)
        velocities[draw] = signed_root(energy[0], stream)
        own[draw] = touched
        simulated += n
    return simulated


@inlined
def replay_steps(energy, first, second, step_of, new, n, stream):
    """Replay n recorded collisions from the earliest step on, each step at its old level."""
    event = n - 1
    while event >= 0:
        last = event
        while event >= 0 and step_of[event] == step_of[last]:
            total = energy[first[event]] + energy[second[event]]
            new[event] = total * squared_cosine(stream)
            event -= 1
        for k in range(event + 1, last + 1):
            energy[first[k]] = new[k]
