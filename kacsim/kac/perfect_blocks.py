"""The perfect sampler of the N-particle equilibrium, epsilon = 0 (Kac paper, sections 5 and 6).

Read-once coupling from the past. A block is a number of the paper's random steps, then a sweep:
steps with the pairs (k, N), k = 1 .. N - 1. In energies x = v**2 of sum 1 the random steps are
linear, so that the images of the N corners bound those of all states. In the sweep the sum
s = x_k + x_N has a least and a largest value, `low` and `high`. A share of it, s cos(theta)**2, has
a density that falls with s wherever it is not zero. Up to `low` the density for `high` is
therefore the part that all states have in common, and from it all can be given one x_k. If that
succeeds for every k, all states have become one. The state at the *beginning* of each block that
succeeds is a draw: docs/perfect.md has the proof.
"""

import math

import numpy as np

from kacsim.kac.constants import MEAN_ENERGY
from kacsim.kac.contraction import chosen_block
from kacsim.kernels.jit import inlined, kernel
from kacsim.variates import pair_below, random_sign, squared_cosine, uniform

ROUNDING = 2.0**-53
STEPS = 1024  # random steps drawn at a time


def arguments(*, n_particles, energy=None, block=None):
    """Return the kernel's parameters: particles, energy (3 N / 2 by default), steps of a block."""
    total = MEAN_ENERGY * n_particles if energy is None else energy
    return n_particles, float(total), chosen_block(n_particles) if block is None else block


@inlined
def start_block(images, state):
    """Set the images to the N corners, and the last column to the state that is followed."""
    n = state.size
    for k in range(n):
        for i in range(n):
            images[k, i] = 0.0
        images[k, k] = 1.0
        images[k, n] = state[k]


@inlined
def move(images, n_steps, pairs, shares, stream):
    """Make random steps (p, q, theta): x_p <- (x_p + x_q) cos(theta)**2, x_q <- the rest.

    Parameters
    ----------
    images : float64[N, N + 1], energies of sum 1 in columns: those that corners, and at last the
        state that is followed, have come to; overwritten
    pairs, shares : int64[STEPS, 2], float64[STEPS], workspace
    """
    n, done = images.shape[0], 0
    while done < n_steps:
        size = min(STEPS, n_steps - done)
        for k in range(size):
            pairs[k, 0], pairs[k, 1] = pair_below(n, stream)
            shares[k] = squared_cosine(stream)
        for k in range(size):
            p, q, a = pairs[k, 0], pairs[k, 1], shares[k]
            b = 1.0 - a
            for i in range(n + 1):
                total = images[p, i] + images[q, i]
                images[p, i] = a * total
                images[q, i] = b * total
        done += size


@inlined
def set_rests(images, rest, least, most, slack):
    """Set bounds of what a state has in the particles that are neither N nor among the first k.

    Parameters
    ----------
    images : as in `move`
    rest : float64[N + 1], workspace
    least, most : float64[N], overwritten: place k - 1 has the bounds for the first k particles
    slack : float, relative, by which rounding may have displaced what is added
    """
    n = images.shape[0]
    for i in range(n + 1):
        rest[i] = 0.0
    least[n - 2] = most[n - 2] = 0.0
    for k in range(n - 2, 0, -1):
        low, high = 1.0, 0.0
        for i in range(n):
            rest[i] += images[k, i]
            low, high = min(low, rest[i]), max(high, rest[i])
        least[k - 1], most[k - 1] = low * (1.0 - slack), high * (1.0 + slack)


@inlined
def left_over(s, low, high, stream):
    """Return a variate of the law of s cos(theta)**2 less the part that all sums have in common."""
    while True:
        x = s * squared_cosine(stream)
        if x > low or uniform(stream) >= math.sqrt((s - x) / (high - x)):
            return x


@inlined
def sweep(images, state, rest, least, most, slack, stream):
    """Make steps with the pairs (k, N); tell whether all states have become one.

    Parameters
    ----------
    images : as in `move`, as the random steps left them
    state : float64[N], overwritten by the state that is followed, after the sweep
    rest, least, most, slack : as in `set_rests`
    """
    n = state.size
    set_rests(images, rest, least, most, slack)
    energy, k, common = 1.0, 0, True  # of the particles from k on, and of N
    while common and k < n - 1:
        low, high = energy - most[k], energy - least[k]
        x = high * squared_cosine(stream)
        common = x <= low
        if common:
            state[k] = x
            energy -= x
            k += 1
    if common:
        state[n - 1] = energy
        return True
    s = energy
    for j in range(k + 1, n - 1):
        state[j] = images[j, n]
        s -= state[j]
    s = min(max(s, low), high)
    state[k] = left_over(s, low, high, stream)
    state[n - 1] = s - state[k]
    for j in range(k + 1, n - 1):
        total, a = state[j] + state[n - 1], squared_cosine(stream)
        state[j], state[n - 1] = a * total, (1.0 - a) * total
    return False


@kernel
def draw_beginnings(velocities, n_particles, energy, block, stream):
    """Draw independent v_1 of the equilibrium, exactly.

    Parameters
    ----------
    velocities : float64[n], overwritten
    n_particles : int >= 2
    energy : float > 0, the sphere's sum of v**2
    block : int, random steps before a sweep; below N - 2 no sweep succeeds
    stream : from `new_stream`, advanced

    Returns
    -------
    int, blocks, with those before the first that succeeded, which starts the chain
    """
    n = n_particles
    images, state, rest = np.empty((n, n + 1)), np.zeros(n), np.empty(n + 1)
    least, most = np.empty(n), np.empty(n)
    pairs, shares = np.empty((STEPS, 2), np.int64), np.empty(STEPS)
    slack = (3.0 * block + n) * ROUNDING
    state[0] = 1.0
    found, blocks = -1, 0
    while found < velocities.size:
        begun = state[0]
        start_block(images, state)
        move(images, block, pairs, shares, stream)
        blocks += 1
        if sweep(images, state, rest, least, most, slack, stream):
            if found >= 0:
                velocities[found] = math.sqrt(energy * begun) * random_sign(stream)
            found += 1
    return blocks
