"""Ancestral kernels with one line that can be made wrong.

Each takes the arguments of the kernel it copies and a flag: False must pass the law tests, so
that True is caught for its mutation alone.
"""

import numba
import numpy as np

from kacsim.kac import model
from kacsim.variates import (
    exponential,
    failures_before_success,
    gap_scale,
    index_below,
    maxwell_speed,
    pair_below,
    squared_cosine,
    uniform,
)

MOST = 4096  # collisions and ancestors of one history
compiled = numba.njit(error_model="numpy")


@compiled
def share(energy, i, j, stream):
    """Share the energy of a pair as a rotation by a uniform angle does."""
    total = energy[i] + energy[j]
    energy[i] = total * squared_cosine(stream)
    energy[j] = total - energy[i]


@compiled
def poisson(velocities, own, n_particles, mean_own, pair_rate, stream, forget_inner):
    """Poisson, exact, for few particles: every collision is looked at, most touch no ancestor.

    Mutation: collisions between two ancestors are forgotten.
    """
    known = np.empty(n_particles, np.bool_)
    first, second = np.empty(MOST, np.int64), np.empty(MOST, np.int64)
    energy = np.empty(n_particles)
    total = 1.0 + pair_rate * (n_particles - 1) * (n_particles - 2) / 2
    for draw in range(velocities.size):
        known[:] = False
        known[0] = True
        n, touched, left = 0, 0, mean_own - exponential(stream) / total
        while left > 0.0:
            if uniform(stream) * total < 1.0:
                i, j = 0, 1 + index_below(n_particles - 1, stream)
                touched += 1
            else:
                i, j = pair_below(n_particles - 1, stream)
                i, j = i + 1, j + 1
            if (known[i] or known[j]) and not (forget_inner and known[i] and known[j]):
                known[i] = known[j] = True
                first[n], second[n] = i, j
                n += 1
            left -= exponential(stream) / total
        for i in range(n_particles):
            energy[i] = maxwell_speed(stream) ** 2
        for event in range(n - 1, -1, -1):
            share(energy, first[event], second[event], stream)
        velocities[draw] = model.signed_root(energy[0], stream)
        own[draw] = touched


@compiled
def nanbu_sequential(velocities, own, n_particles, steps, probability, stream, forget_order):
    """Nanbu, sequential: trials of all particles, from N to 1 at each step backward.

    Mutation: the order within a step is forgotten, i.e. partners found during a step are not
    looked at before the next one.
    """
    known, found = np.empty(n_particles, np.bool_), np.empty(n_particles, np.bool_)
    first, second = np.empty(MOST, np.int64), np.empty(MOST, np.int64)
    energy = np.empty(n_particles)
    for draw in range(velocities.size):
        known[:] = False
        known[0] = True
        n, touched = 0, 0
        for _ in range(steps):
            found[:] = known
            for i in range(n_particles - 1, -1, -1):
                if (known if forget_order else found)[i] and uniform(stream) < probability:
                    j = index_below(n_particles - 1, stream)
                    j += int(j >= i)
                    first[n], second[n] = i, j
                    found[j] = True
                    touched += int(i == 0)
                    n += 1
            known[:] = found
        for i in range(n_particles):
            energy[i] = maxwell_speed(stream) ** 2
        for event in range(n - 1, -1, -1):
            i, j = first[event], second[event]
            energy[i] = (energy[i] + energy[j]) * squared_cosine(stream)
        velocities[draw] = model.signed_root(energy[0], stream)
        own[draw] = touched


@compiled
def bird(velocities, own, n_particles, n_collisions, stream, long_gap):
    """Bird: geometric gaps between the collisions that touch an ancestor.

    Mutation: every gap is one collision too long.
    """
    first, second = np.empty(MOST, np.int64), np.empty(MOST, np.int64)
    energy = np.empty(n_particles)
    pairs = n_particles * (n_particles - 1) / 2
    for draw in range(velocities.size):
        n, members, touched, left = 0, 1, 0, n_collisions
        while True:
            inner = members * (members - 1) / 2
            outer = members * (n_particles - members)
            scale = gap_scale((inner + outer) / pairs)
            left -= failures_before_success(scale, stream) + 1 + int(long_gap)
            if left < 0:
                break
            i = index_below(members, stream)
            j = members
            if uniform(stream) * (inner + outer) < inner:
                j = index_below(members - 1, stream)
                j += int(j >= i)
            else:
                members += 1
            first[n], second[n] = i, j
            touched += int(i == 0) + int(j == 0)
            n += 1
        for i in range(members):
            energy[i] = maxwell_speed(stream) ** 2
        for event in range(n - 1, -1, -1):
            share(energy, first[event], second[event], stream)
        velocities[draw] = model.signed_root(energy[0], stream)
        own[draw] = touched
