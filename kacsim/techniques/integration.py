"""Integration on a lattice and with random points (worked example, Fig. 11.4, exercise 3)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numba import int64, uint64

from kacsim import checks
from kacsim.elementary.logarithm import power
from kacsim.kernels.jit import inlined, kernel
from kacsim.samplers import declared
from kacsim.streams import new_stream, next_bits
from kacsim.techniques.constants import BLOCK
from kacsim.typed import ArrayLike, Floats
from kacsim.variates import uniform

# A bad generator: independent numbers, but a counter of 20 bits, so that they run out.
EXHAUSTED = 1 << 20
# Another one: a linear congruential generator of the old textbooks, all residues of 714025.
PERIOD, FACTOR, SHIFT = 714025, 1366, 150889


@kernel
def count_lattice(inside, edge):
    """Count the lattice points inside the unit sphere, in 1 to inside.size dimensions.

    Twice the coordinates times the edge are odd numbers, so a point is inside if its odd squares
    add up to 4 edge**2 at most. Every point is counted, by convolution over the sum so far: the
    memory is 4 edge**2 integers, not edge**d.

    Parameters
    ----------
    inside : int64[d], overwritten by the numbers in 1..d dimensions
    edge : int, M points per edge; M**d < 2**63
    """
    most = 4 * edge * edge
    ways, more = np.zeros(most + 1, np.int64), np.empty(most + 1, np.int64)
    ways[0] = 1
    for axis in range(inside.size):
        more[:] = 0
        for k in range(edge):
            square = (2 * k + 1) ** 2
            for total in range(most - square + 1):
                more[total + square] += ways[total]
        ways[:] = more
        inside[axis] = ways.sum()


@kernel
def count_good(inside, n_points, dimension, stream):
    """Count random points of the unit cube inside the sphere, noting the count now and then.

    Parameters
    ----------
    inside : int64[n], overwritten by the counts after n_points[k] points
    n_points : int64[n], growing
    dimension : int
    stream : from `new_stream`, advanced
    """
    done, hits = 0, 0
    for place in range(n_points.size):
        for _ in range(n_points[place] - done):
            square = 0.0
            for _ in range(dimension):
                x = uniform(stream)
                square += x * x
            hits += int64(square <= 1.0)
        done = n_points[place]
        inside[place] = hits


@inlined
def mixed(word):
    """Return 64 bits from a counter times an odd constant (SplitMix64, Steele et al., 2014)."""
    word = (word ^ (word >> uint64(30))) * uint64(0xBF58476D1CE4E5B9)
    word = (word ^ (word >> uint64(27))) * uint64(0x94D049BB133111EB)
    return word ^ (word >> uint64(31))


@inlined
def cycle_of(period, dimension):
    """Return after how many points the same points come again."""
    return period // math.gcd(period, dimension)


@inlined
def count_again(inside, n_points, hits, cycle):
    """Fill in the counts from those of the first points, which come again cycle after cycle.

    Parameters
    ----------
    inside, n_points : int64[n]
    hits : int64[m + 1], those of the first k points; m is the cycle, or all points if fewer
    cycle : int
    """
    for place in range(n_points.size):
        whole, rest = n_points[place] // cycle, n_points[place] % cycle
        inside[place] = whole * hits[-1] + hits[rest]


@kernel
def count_exhausted(inside, n_points, dimension, stream):
    """Do as `count_good` with a generator whose `EXHAUSTED` numbers come again and again.

    Only the first cycle is drawn: the others are the same.
    """
    key, counter, cycle = next_bits(stream), 0, cycle_of(EXHAUSTED, dimension)
    hits = np.zeros(min(cycle, n_points[-1]) + 1, np.int64)
    for k in range(hits.size - 1):
        square = 0.0
        for _ in range(dimension):
            word = mixed(key + uint64(counter) * uint64(0x9E3779B97F4A7C15))
            x = int64(word >> uint64(11)) * 2.0**-53
            counter = (counter + 1) & (EXHAUSTED - 1)
            square += x * x
        hits[k + 1] = hits[k] + int64(square <= 1.0)
    count_again(inside, n_points, hits, cycle)


@kernel
def count_congruential(inside, n_points, dimension, stream):
    """Do as `count_exhausted` with a generator that takes each of `PERIOD` values once."""
    state, cycle = int64(uniform(stream) * PERIOD), cycle_of(PERIOD, dimension)
    hits = np.zeros(min(cycle, n_points[-1]) + 1, np.int64)
    for k in range(hits.size - 1):
        square = 0.0
        for _ in range(dimension):
            state = (state * FACTOR + SHIFT) % PERIOD
            x = state / PERIOD
            square += x * x
        hits[k + 1] = hits[k] + int64(square <= 1.0)
    count_again(inside, n_points, hits, cycle)


@kernel
def sum_area(sums, n_points, exponent, stream):
    """Integrate (1 - x**2)**exponent over [-1, 1], noting the sums now and then (exercise 3).

    Parameters
    ----------
    sums : float64[2, n], overwritten: points below the curve, and sum of the curve's height, of the
        first n_points[k] points
    n_points : int64[n], growing
    stream : from `new_stream`, advanced
    """
    done, below, heights = 0, 0, 0.0
    for place in range(n_points.size):
        for _ in range(n_points[place] - done):
            x = 2.0 * uniform(stream) - 1.0
            height = power(1.0 - x * x, exponent)
            below += int64(uniform(stream) < height)
            heights += height
        done = n_points[place]
        sums[0, place] = below
        sums[1, place] = heights


def count_sobol(inside, n_points, dimension, stream):
    """Do as `count_good` with a scrambled Sobol sequence.

    Parameters
    ----------
    stream : from `new_stream`, the seed of the scrambling
    """
    from scipy.stats import qmc  # a second to import, which the other generators should not pay

    engine = qmc.Sobol(dimension, scramble=True, rng=np.random.default_rng(stream))
    done, hits = 0, 0
    for place, n in enumerate(n_points):
        while done < n:
            points = engine.random(int(min(BLOCK, n - done)))
            square = np.zeros(points.shape[0])
            for axis in range(dimension):
                square += points[:, axis] * points[:, axis]
            hits += int((square <= 1.0).sum())
            done += square.size
        inside[place] = hits


def lattice_count(dimension: int, edge: int) -> int:
    """Return the lattice points k - 1/2 over M inside the unit sphere, of the M**d in the cube.

    Parameters
    ----------
    dimension : int, 1 to 8
    edge : int, M, 1 to 400 with M**d < 2**63

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    checks.raise_problems(declared("sphere_lattice", {"dimension": [dimension], "edge": [edge]}))
    if edge**dimension >= 2**63:
        raise ValueError(f"edge = {edge!r}: edge**dimension must be below 2**63")
    inside = np.empty(dimension, np.int64)
    count_lattice(inside, edge)
    return int(inside[-1])


def sphere_volume(dimension: int, n_points: int, *, seed: int) -> tuple[float, float]:
    """Estimate the share of the unit cube inside the unit sphere with random points (Fig. 11.4).

    Parameters
    ----------
    dimension : int, 1 to 8
    n_points : int >= 1; memory does not grow with it
    seed : int >= 0; the same arguments give the same bits

    Returns
    -------
    (float, float), estimate and its standard error; times 2**d it is the volume of the sphere

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    checks.raise_problems(
        declared("sphere_points", {"dimension": [dimension], "n_points": [n_points]})
    )
    checks.raise_problems(checks.amount(n_draws=1, n_replicates=1, seed=seed))
    inside = np.empty(1, np.int64)
    stream = new_stream(seed, "techniques.sphere_volume")
    count_good(inside, np.array([n_points]), dimension, stream)
    share = inside[0] / n_points
    return share, math.sqrt(share * (1.0 - share) / n_points)


def integrate(
    function: Callable[[Floats], ArrayLike], low: float, high: float, *, n_points: int, seed: int
) -> tuple[float, float]:
    """Integrate a function of one variable with random points (chapter, section 11.2).

    Parameters
    ----------
    function : callable, array -> array
    low, high : float
    n_points : int >= 2
    seed : int >= 0; the same arguments give the same bits

    Returns
    -------
    (float, float), estimate and its standard error

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    for name, value in (("low", low), ("high", high)):
        checks.raise_problems(checks.finite(name, value))
    checks.raise_problems(checks.count("n_points", n_points, least=2))
    checks.raise_problems(checks.amount(n_draws=1, n_replicates=1, seed=seed))
    if not high > low:
        raise ValueError(f"high = {high!r}: must be greater than low = {low!r}")
    stream = new_stream(seed, "techniques.integrate")
    total = square = 0.0
    for start in range(0, n_points, BLOCK):
        u = np.empty(min(BLOCK, n_points - start))
        _uniforms(u, stream)
        heights = np.asarray(function(low + (high - low) * u), dtype=float)
        if heights.shape != u.shape or not np.isfinite(heights).all():
            raise ValueError(f"function = {function!r}: must give one finite number per value")
        total += heights.sum()
        square += (heights**2).sum()
    mean = total / n_points
    variance = max(0.0, square / n_points - mean**2) * n_points / (n_points - 1)
    return (high - low) * mean, (high - low) * math.sqrt(variance / n_points)


@kernel
def _uniforms(u, stream):
    for k in range(u.size):
        u[k] = uniform(stream)
