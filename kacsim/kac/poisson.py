"""The Poisson algorithm, exact for the N-particle process (Kac paper, 4.3).

The ensemble's rate N/2 less particle 1's own 1 (in units of the collision rate) leaves (N - 2)/2
for the other N - 1 particles, i.e. 1/(N - 1) for each of their pairs. The text prints another rate:
`kacsim.kac.poisson_printed` runs these kernels with it.
"""

import math

import numpy as np
from numba import int64

from kacsim.elementary.exponential import expm1
from kacsim.kac import model, own_law
from kacsim.kac.moments import INITIAL_SQUARE, gain
from kacsim.kac.tape import ancestral_draws
from kacsim.kernels.jit import allocating, inlined, kernel
from kacsim.variates import exponential, index_below, pair_below, two_below

# Two of the ancestors among so many meet in less than one collision of 1e15.
INFINITELY_MANY = 2**61


def arguments(*, n_particles, time, collision_rate):
    """Return the kernels' parameters: particles, mean collisions of particle 1, rate of a pair.

    The pair's rate is that of two particles other than particle 1, in units of the collision rate;
    two particles leave no such pair.
    """
    if math.isinf(n_particles):
        return INFINITELY_MANY, collision_rate * time, 0.0
    pair_rate = 0.0 if n_particles == 2 else 1.0 / (n_particles - 1)
    return n_particles, collision_rate * time, pair_rate


@inlined
def unit_arrivals(mean, stream):
    """Return a Poisson variate by counting unit-rate arrivals before `mean`."""
    number = 0
    clock = exponential(stream)
    while clock < mean:
        number += 1
        clock += exponential(stream)
    return number


def forward_draws(law):
    """Return the kernel that draws v_1(t) from whole ensembles.

    Parameters
    ----------
    law : module of the law of collisions, such as `kacsim.kac.model`
    """
    ensemble, start, collide, copy = law.ensemble, law.start, law.collide, law.copy

    @kernel
    def forward(velocities, own, n_particles, mean_own, pair_rate, stream, tables=()):
        """Draw v_1(t) from whole ensembles, as published.

        The sorted uniform times of particle 1's K collisions are drawn one after another: the first
        of k uniform times on a span ends at the fraction 1 - U**(1/k) of it.

        Parameters
        ----------
        velocities : float64[n] or float64[n, 3], overwritten by independent draws of v_1
        own : int64[n], overwritten by the number of collisions of particle 1
        n_particles, mean_own, pair_rate : from `arguments`
        stream : from `new_stream`, advanced
        tables : what the law of collisions draws from, if it has tables

        Returns
        -------
        int, collisions simulated
        """
        v = ensemble(n_particles, tables)
        others = n_particles - 1
        others_rate = pair_rate * others * (others - 1) / 2
        simulated = 0
        for draw in range(len(velocities)):
            for i in range(n_particles):
                start(v, i, stream)
            n_own = unit_arrivals(mean_own, stream)
            span = mean_own
            for k in range(n_own, 0, -1):
                gap = -span * expm1(-exponential(stream) / k)
                span -= gap
                clock = exponential(stream)
                while clock < others_rate * gap:
                    i, j = pair_below(others, stream)
                    collide(v, i + 1, j + 1, stream)
                    simulated += 1
                    clock += exponential(stream)
                collide(v, 0, index_below(others, stream) + 1, stream)
            copy(velocities, draw, v, 0)
            own[draw] = n_own
            simulated += n_own
        return simulated

    return forward


@allocating
def prepare(arguments, most):
    """Return the mean time between collisions that touch one of s ancestors, 0 < s < `most`, and 0.

    s of N particles are touched by s (N - s) + s (s - 1) / 2 pairs, each at the rate 1 / (N - 1).
    """
    size = float(arguments[0])
    pauses = np.zeros(min(arguments[0] + 1, most) + 1)
    for s in range(1, pauses.size - 1):
        pauses[s] = 2.0 * (size - 1.0) / (s * (2.0 * size - s - 1.0))
    return pauses


@inlined
def history(arguments, pauses, tape, start, root, stream):
    """Find the collisions of one draw, from one to the one before it through exponential pauses.

    `INFINITELY_MANY` particles give McKean's tree: exact draws of the Kac equation.
    """
    n_particles, left, _ = arguments
    n, members, own = start, 1, 0
    while True:
        left -= exponential(stream) * pauses[members]
        if n == tape.first.size or members == pauses.size - 1:
            return -1, members, own
        if left < 0.0:
            return n, members, own
        # Of the 2 N - s - 1 ways to touch one of s ancestors, s - 1 have another one as partner.
        i, j = two_below(members, 2 * n_particles - members - 1, stream)
        if j < members - 1:
            j += int64(j >= i)
        else:
            j = members
            members += 1
        tape.first[n], tape.second[n] = root + i, root + j
        own += int64(i == 0) + int64(j == 0)
        n += 1


forward = forward_draws(model)
ancestral = ancestral_draws(model, prepare, history)
own_forward = forward_draws(own_law)
own_ancestral = ancestral_draws(own_law, prepare, history)


def fourth_moment(*, n_particles, time, collision_rate):
    """Return E v_1**4 of Kac's N-particle process."""
    rate = collision_rate * (n_particles + 2) / (4.0 * (n_particles - 1))
    return INITIAL_SQUARE + gain(n_particles) * -math.expm1(-rate * time)
