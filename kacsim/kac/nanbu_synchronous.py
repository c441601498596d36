"""Nanbu's algorithm, synchronous: partners are read at the old time level (Kac paper, 4.1)."""

import numpy as np
from numba import int64

from kacsim.kac.model import (
    copy_state,
    deflect,
    growing,
    initial_energy,
    initial_velocity,
    signed_root,
)
from kacsim.kac.moments import INITIAL_PRODUCT, INITIAL_SQUARE
from kacsim.kac.nanbu import arguments, leave_step, partner_of
from kacsim.kernels.jit import inlined, kernel
from kacsim.variates import failures_before_success, gap_scale, squared_cosine, uniform

__all__ = ["ancestral", "arguments", "forward", "fourth_moment"]


@kernel
def forward(velocities, own, n_particles, steps, probability, stream):
    """Draw v_1(t) from whole ensembles, partners read at the old time level.

    Parameters and result as `kacsim.kac.nanbu_sequential.forward`.
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


@growing
@kernel
def ancestral(velocities, own, n_particles, steps, probability, stream, first, second, energy):
    """Draw v_1(t) from the ancestors only; same law and parameters as `forward`.

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
