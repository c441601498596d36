"""What one call of a variate or of an elementary function costs, timed apart from any kernel.

Each is called in a long loop that stores what it gives, so that no call waits for another: a kernel
in which calls wait for each other takes longer than the sum of its pieces.
"""

import numpy as np

from kacsim import variates
from kacsim.benchmark.timing import draws_for, medians
from kacsim.elementary.circular import cos_sin
from kacsim.elementary.exponential import exp
from kacsim.elementary.logarithm import log
from kacsim.kernels.jit import inlined, kernel
from kacsim.streams import BLOCK, new_stream, next_block

FEW = 50  # what indices are drawn below: a power of two would cost no less
RANGE = 1.0 / 512.0  # of the arguments of elementary functions: 0 to 8
PLACES = 4096


def _stored(one):
    """Return a kernel that calls `one`, a function (k, stream) -> number, n times."""

    @kernel
    def repeat(out, n, stream):
        for k in range(n):
            out[k % PLACES] = one(k % PLACES, stream)

    return repeat


@inlined
def _index_below(k, stream):
    return float(variates.index_below(FEW, stream))


@inlined
def _two_below(k, stream):
    i, j = variates.two_below(FEW, FEW, stream)
    return float(i + j)


@inlined
def _pair_below(k, stream):
    i, j = variates.pair_below(FEW, stream)
    return float(i + j)


@inlined
def _uniform(k, stream):
    return variates.uniform(stream)


@inlined
def _random_sign(k, stream):
    return variates.random_sign(stream)


@inlined
def _exponential(k, stream):
    return variates.exponential(stream)


@inlined
def _failures_before_success(k, stream):
    return float(variates.failures_before_success(10.0, stream))


@inlined
def _half_normal(k, stream):
    return variates.half_normal(stream)


@inlined
def _normal(k, stream):
    return variates.normal(stream)


@inlined
def _maxwell_speed(k, stream):
    return variates.maxwell_speed(stream)


@inlined
def _unit_circle(k, stream):
    cos, sin = variates.unit_circle(stream)
    return cos + sin


@inlined
def _squared_cosine(k, stream):
    return variates.squared_cosine(stream)


@inlined
def _exp(k, stream):
    return exp(-RANGE * k)


@inlined
def _log(k, stream):
    return log(RANGE * (k + 1))


@inlined
def _cos_sin(k, stream):
    cos, sin = cos_sin(RANGE * k)
    return cos + sin


@kernel
def _maxwell_energies(out, n, stream):
    missed = np.empty(BLOCK, np.uint64)
    for start in range(0, n, PLACES):
        variates.maxwell_energies(out, missed, min(PLACES, n - start), stream)


@kernel
def _squared_cosines(out, n, stream):
    for start in range(0, n, PLACES):
        variates.squared_cosines(out, min(PLACES, n - start), stream)


ONES = (
    _index_below,
    _two_below,
    _pair_below,
    _uniform,
    _random_sign,
    _exponential,
    _failures_before_success,
    _half_normal,
    _normal,
    _maxwell_speed,
    _unit_circle,
    _squared_cosine,
    _exp,
    _log,
    _cos_sin,
)
PIECES = {one.py_func.__name__[1:]: _stored(one) for one in ONES}
PIECES |= {"maxwell_energies": _maxwell_energies, "squared_cosines": _squared_cosines}


@kernel
def _words(n, stream):
    words, done = np.empty(n, np.uint64), 0
    while done < n:
        start, stop = next_block(n - done, stream)
        words[done : done + stop - start] = stream[start:stop]
        done += stop - start
    return words


@kernel
def _count_odd(words, counts):
    for word in words:
        if word & np.uint64(1):
            counts[word >> np.uint64(60)] += 1


def wrong_guess(repeats):
    """Return the seconds that a wrongly guessed branch costs: of random words, every second one.

    The same words are counted in random order, and the even ones before the odd ones.
    """
    stream = new_stream(1, "benchmark")
    random = _words(2**16, stream)
    orders = {"random": random, "sorted": random[np.argsort(random & np.uint64(1), kind="stable")]}
    counts = np.zeros(16, np.int64)
    _count_odd(random[:2], counts)
    taken = medians(
        {name: lambda words=words: _count_odd(words, counts) for name, words in orders.items()},
        10 * repeats,
    )
    return (taken["random"] - taken["sorted"]) / (random.size / 2)


def costs(repeats):
    """Return name of a function -> seconds of one call (of one value, if it fills an array)."""
    stream, out = new_stream(1, "benchmark"), np.empty(PLACES)
    calls = {
        name: lambda n, repeat=repeat: repeat(out, n, stream) for name, repeat in PIECES.items()
    }
    n_calls = {name: draws_for(call, 0.01) for name, call in calls.items()}
    taken = medians({name: lambda name=name: calls[name](n_calls[name]) for name in calls}, repeats)
    return {name: seconds / n_calls[name] for name, seconds in taken.items()}
