"""Named laws of the chapter's examples, for kernels, and the count of uniforms that draws take."""

import math

from kacsim.kernels.jit import inlined, kernel
from kacsim.streams import next_bits
from kacsim.techniques.constants import EXPONENTIAL, KAC_INITIAL, RAMP

TWO_OVER_ROOT_PI = 2.0 / math.sqrt(math.pi)
ROOT_PI = math.sqrt(math.pi)


@inlined
def density(law, v):
    """Return p(v): f0 of the Kac paper, exp(-v), (2/3)(1 + v) or 2 v on [0, 1]."""
    if law == KAC_INITIAL:
        return TWO_OVER_ROOT_PI * v * v * math.exp(-v * v)
    if law == EXPONENTIAL:
        return math.exp(-v)
    if law == RAMP:
        return (2.0 + 2.0 * v) / 3.0
    return 2.0 * v


@inlined
def cumulative(law, v):
    """Return P(v), the integral of `density` up to v (chapter, section 11.1.1)."""
    if law == KAC_INITIAL:
        return 0.5 * math.erfc(-v) - v * math.exp(-v * v) / ROOT_PI
    if law == EXPONENTIAL:
        return -math.expm1(-v)
    if law == RAMP:
        return (2.0 + v) * v / 3.0
    return v * v


@inlined
def inverse(law, u):
    """Return the v with P(v) = u (chapter, eq. 11.12) of a law other than f0."""
    if law == EXPONENTIAL:
        return -math.log1p(-u)
    if law == RAMP:
        return math.sqrt(1.0 + 3.0 * u) - 1.0
    return math.sqrt(u)


@kernel
def fill_cells(values, law, counts, sums):
    """Count draws in cells of equal probability, and add up their powers.

    Parameters
    ----------
    values : float64[n], draws
    law : int, place in `LAWS`
    counts : int64[cells], draws by P(v), modified in place
    sums : float64[4], sums of v to v**4, modified in place
    """
    for v in values:
        place = int(cumulative(law, v) * counts.size)
        counts[min(max(place, 0), counts.size - 1)] += 1
        square = v * v
        sums[0] += v
        sums[1] += square
        sums[2] += square * v
        sums[3] += square * square


@kernel
def uniforms_between(before, after):
    """Return the calls of the generator between two states of one stream.

    Parameters
    ----------
    before : uint64[4], overwritten by `after`
    after : uint64[4], a later state; the count takes as many steps
    """
    n = 0
    while (
        before[0] != after[0]
        or before[1] != after[1]
        or before[2] != after[2]
        or before[3] != after[3]
    ):
        next_bits(before)
        n += 1
    return n
