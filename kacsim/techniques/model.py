"""Named laws of the chapter's examples, for kernels, and the count of uniforms that draws take."""

import math

from kacsim.elementary.exponential import exp, exp_of_square, expm1
from kacsim.elementary.gaussian import scaled_erfc
from kacsim.elementary.logarithm import log1p
from kacsim.kernels.jit import inlined, kernel
from kacsim.streams import next_bits, same_state
from kacsim.techniques.constants import EXPONENTIAL, KAC_INITIAL, RAMP

TWO_OVER_ROOT_PI = 2.0 / math.sqrt(math.pi)
ROOT_PI = math.sqrt(math.pi)
FARTHEST = 28.0  # of f0, beyond which its tails are below the smallest number


@inlined
def density(law, v):
    """Return p(v): f0 of the Kac paper, exp(-v), (2/3)(1 + v) or 2 v on [0, 1]."""
    if law == KAC_INITIAL:
        return TWO_OVER_ROOT_PI * v * v * exp(-v * v)
    if law == EXPONENTIAL:
        return exp(-v)
    if law == RAMP:
        return (2.0 + 2.0 * v) / 3.0
    return 2.0 * v


@inlined
def cumulative(law, v):
    """Return P(v), the integral of `density` up to v (chapter, section 11.1.1)."""
    if law == KAC_INITIAL:
        away = min(abs(v), FARTHEST)
        tail = exp_of_square(away, -1.0) * (0.5 * scaled_erfc(away) + away / ROOT_PI)
        return tail if v <= 0.0 else 1.0 - tail
    if law == EXPONENTIAL:
        return -expm1(-v)
    if law == RAMP:
        return (2.0 + v) * v / 3.0
    return v * v


@inlined
def inverse(law, u):
    """Return the v with P(v) = u (chapter, eq. 11.12) of a law other than f0."""
    if law == EXPONENTIAL:
        return -log1p(-u)
    if law == RAMP:
        return math.sqrt(1.0 + 3.0 * u) - 1.0
    return math.sqrt(u)


@kernel
def fill_cumulative(shares, law, values):
    """Set float64[n] to P at n values."""
    for k in range(values.size):
        shares[k] = cumulative(law, values[k])


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
    """Return the words taken between two states of one stream.

    Parameters
    ----------
    before : from `new_stream`, overwritten by `after`
    after : a later state; the count takes as many steps
    """
    n = 0
    while not same_state(before, after):
        next_bits(before)
        n += 1
    return n
