"""Kernels whose arguments a page can give: addresses of arrays, and numbers.

Each entry runs the kernel of its name as it stands: what it draws has the same bits. Nothing here
draws anything itself.
"""

import numba
import numpy as np
from numba import carray, types

from kacsim.elementary.gaussian import normal_cumulative
from kacsim.kac import model, perfect, samplers
from kacsim.kac.constants import RATE
from kacsim.kac.tape import LEAST, MOST_DRAWS, Tape
from kacsim.kernels.jit import ERROR_MODEL
from kacsim.kernels.lookup import named
from kacsim.mckean import constants, free_leaf
from kacsim.mckean.contour import SHELL
from kacsim.mckean.probing import LOG_MAXWELLIAN
from kacsim.streams import END

FLOATS, INTEGERS, WORDS = map(types.CPointer, (types.float64, types.int64, types.uint64))
ARRAYS = (FLOATS, INTEGERS, types.int64, WORDS)  # values, counts, how many draws, stream
LOG_BKW = LOG_MAXWELLIAN[constants.BKW]
LAW = constants.BKW
MAX_NODES = 10_000_000

compiled = numba.njit(error_model=ERROR_MODEL)


def without_cache(kernel):
    """Return a kernel as numba compiles it here and now."""
    return compiled(kernel.py_func)


def kac_entry(algorithm):
    """Return draws of v_1(t) by the ancestral engine of an algorithm."""
    attempt = without_cache(named("kacsim.kac", algorithm, "ancestral").__wrapped__)
    new_state = compiled(model.new_state)

    @compiled
    def draw(velocities, own, n, stream, arguments):
        done, capacity = 0, LEAST
        v, counts, words = carray(velocities, (n,)), carray(own, (n,)), carray(stream, (END,))
        while done < n:
            slots = np.empty(capacity, np.uint64), np.empty(capacity, np.uint64)
            mark, root = np.empty(capacity, np.int64), np.empty(MOST_DRAWS, np.uint64)
            tape = Tape(slots[0], slots[1], mark, root)
            state = new_state(capacity, capacity + MOST_DRAWS)
            more, _ = attempt(v[done:], counts[done:], arguments, words, tape, state)
            done += more
            capacity *= 2
        return done

    return draw


def kac_types(algorithm):
    """Return the types of what an algorithm's ``arguments`` give."""
    step = {"time_step": 0.5} if algorithm in samplers.STEPPED else {}
    given = named("kacsim.kac", algorithm, "arguments")
    values = given(n_particles=5, time=1.0, collision_rate=RATE, **step)
    return tuple(types.int64 if isinstance(value, int) else types.float64 for value in values)


_couple = without_cache(perfect.couple)
_estimate = without_cache(free_leaf.estimate)


@compiled
def perfect_entry(velocities, times, n, stream, n_particles, energy, tolerance):
    """Draw v_1 at equilibrium with coupling times; returns the steps applied."""
    v, counts = carray(velocities, (n,)), carray(times, (n,))
    return _couple(v, counts, n_particles, energy, tolerance, carray(stream, (END,)))


@compiled
def bkw_entry(values, nodes, n, stream, speed, time):
    """Draw realizations of f(c; t) / M(c) of the BKW mode; returns 1, or 0 past the budget."""
    scale = LOG_BKW - 0.5 * speed * speed
    found, ends = carray(values, (n,)), carray(nodes, (n,))
    words = carray(stream, (END,))
    return int(_estimate(found, ends, SHELL, speed, time, scale, LAW, MAX_NODES, words))


@compiled
def cumulative_entry(values, nodes, n, stream):
    """Replace values by the standard normal cumulative there."""
    x = carray(values, (n,))
    for k in range(n):
        x[k] = normal_cumulative(x[k])
    return n


def entries():
    """Return name -> (function, types of its arguments) of all that the page calls."""
    found = {
        f"kac_{name}": (kac_entry(name), (*ARRAYS, types.Tuple(kac_types(name))))
        for name in samplers.ON_PAGE
    }
    numbers = (types.int64, types.float64, types.float64)
    return found | {
        "perfect": (perfect_entry, ARRAYS + numbers),
        "bkw": (bkw_entry, ARRAYS + numbers[1:]),
        "cumulative": (cumulative_entry, ARRAYS),
    }
