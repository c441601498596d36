"""The perfect sampler's blocks with one line that can be made wrong.

A copy of the kernel that takes a flaw: NONE must pass the law tests, so that the others are caught
for what they change alone.
"""

import math

import numba
import numpy as np

from kacsim.kac import perfect_blocks
from kacsim.variates import random_sign, squared_cosine, uniform

NONE, AT_THE_END, OWN_LAW, NEVER_FAILS, STATE_KEPT = range(5)
compiled = numba.njit(error_model="numpy")


@compiled
def sweep(images, state, bounds, stream, flaw):
    """Do as `perfect_blocks.sweep`; `bounds` is float64[3, N + 1], workspace."""
    n = state.size
    rest, least, most = bounds
    perfect_blocks.set_rests(images, rest, least[:n], most[:n], 0.0)
    energy = 1.0
    for k in range(n - 1):
        low, high = energy - most[k], energy - least[k]
        x = high * squared_cosine(stream)
        if x > low and not (flaw == NEVER_FAILS and x < energy):
            s = energy
            for j in range(k + 1, n - 1):
                state[j] = images[j, n]
                s -= state[j]
            x = s * squared_cosine(stream)
            while x <= low and flaw != OWN_LAW:
                if uniform(stream) >= math.sqrt((s - x) / (high - x)):
                    break
                x = s * squared_cosine(stream)
            state[k], state[n - 1] = x, s - x
            for j in range(k + 1, n - 1):
                total, share = state[j] + state[n - 1], squared_cosine(stream)
                state[j], state[n - 1] = share * total, (1.0 - share) * total
            return False
        state[k] = x
        energy -= x
    state[n - 1] = energy
    return True


@compiled
def draw(velocities, n, energy, block, stream, flaw):
    """Do as `perfect_blocks.draw_beginnings`.

    Flaws: the state at the block's end; a block that fails draws from the followed state's whole
    law; it takes what only some states can have in common; a block that fails leaves the state as
    it was.
    """
    images, state, bounds = np.empty((n, n + 1)), np.zeros(n), np.empty((3, n + 1))
    pairs = np.empty((perfect_blocks.STEPS, 2), np.int64)
    shares, before = np.empty(perfect_blocks.STEPS), np.empty(n)
    state[0] = 1.0
    found = -1
    while found < velocities.size:
        before[:] = state
        perfect_blocks.start_block(images, state)
        perfect_blocks.move(images, block, pairs, shares, stream)
        if sweep(images, state, bounds, stream, flaw):
            if found >= 0:
                here = state[0] if flaw == AT_THE_END else before[0]
                velocities[found] = math.sqrt(energy * here) * random_sign(stream)
            found += 1
        elif flaw == STATE_KEPT:
            state[:] = before


@compiled
def shares(values, s, low, high, stream, flaw):
    """Fill with x_k of a state of sum s: what all have in common, or what is left of its law."""
    for k in range(values.size):
        values[k] = high * squared_cosine(stream)
        if values[k] > low:
            if flaw == NONE:
                values[k] = perfect_blocks.left_over(s, low, high, stream)
            else:
                values[k] = s * squared_cosine(stream)
