"""Random variates drawn inside kernels, each from a stream of `kacsim.streams`.

Exponential and normal variates use the ziggurat of Marsaglia and Tsang (J. Stat. Softw. 5(8),
2000) with 256 layers; one call of the generator gives the layer (8 low bits), a sign (the next)
and the abscissa (53 high bits). Points on the circle are one of 256 fixed ones turned by a small
angle (8 low bits and 53 high bits of one call): no rejection, no library's sine.
"""

import math

from numba import int64, uint64

from kacsim.elementary.exponential import exp
from kacsim.elementary.logarithm import log, log1p
from kacsim.kernels.jit import apart, inlined
from kacsim.kernels.wide import product
from kacsim.streams import next_bits, next_block
from kacsim.variate_tables import (
    COS_SIN,
    E_TAIL,
    EXPONENTIAL,
    LAYERS,
    N_TAIL,
    NORMAL,
    POINTS,
    SPEED_EDGE,
    SPEED_LARGEST,
    SPEED_LEAST,
    SPEED_SCALE,
    SPEED_SURE,
    SPEED_TAIL,
    SPEED_WIDTH,
    UNIT,
)

_, E_SCALE, E_SURE, E_HEIGHT = EXPONENTIAL
_, N_SCALE, N_SURE, N_HEIGHT = NORMAL

MOST_FAILURES = 2**62  # of trials that hardly ever succeed


@inlined
def uniform(stream):
    """Return a uniform float64 on [0, 1), a multiple of 2**-53."""
    return int64(next_bits(stream) >> uint64(11)) * UNIT


@inlined
def index_below(n, stream):
    """Return a uniform integer 0..n-1, for 1 <= n < 2**63 (bias below n * 2**-64)."""
    return int64(product(next_bits(stream), uint64(n))[0])


@inlined
def two_below(n, m, stream):
    """Return independent uniform integers 0..n-1 and 0..m-1 from one call.

    The product of the bits with n has the first above the point; what is below it gives the second
    in the same way (bias below n * m * 2**-64).
    """
    above, below = product(next_bits(stream), uint64(n))
    return int64(above), int64(product(below, uint64(m))[0])


@inlined
def pair_below(n, stream):
    """Return an ordered pair of distinct uniform indices below n >= 2."""
    i, j = two_below(n, n - 1, stream)
    return i, j + int64(j >= i)


@inlined
def random_sign(stream):
    """Return +1.0 or -1.0."""
    return 1.0 - 2.0 * int64(next_bits(stream) >> uint64(63))


@inlined
def exponential(stream):
    """Return a standard exponential variate, strictly positive tail included."""
    bits = next_bits(stream)
    layer, position = bits & uint64(LAYERS - 1), int64(bits >> uint64(11))
    if position < E_SURE[layer]:
        return position * E_SCALE[layer]
    return _exponential_beside(layer, position, stream)


@apart
def _exponential_beside(layer, position, stream):
    """Return the variate for a position that is not surely under the density."""
    while position >= E_SURE[layer]:
        if layer == 0:
            return E_TAIL - log(1.0 - uniform(stream))
        x = position * E_SCALE[layer]
        low, high = E_HEIGHT[layer], E_HEIGHT[layer + uint64(1)]
        if low + uniform(stream) * (high - low) < exp(-x):
            return x
        bits = next_bits(stream)
        layer, position = bits & uint64(LAYERS - 1), int64(bits >> uint64(11))
    return position * E_SCALE[layer]


@inlined
def half_normal(stream):
    """Return the absolute value of a standard normal variate."""
    bits = next_bits(stream)
    layer, position = bits & uint64(LAYERS - 1), int64(bits >> uint64(11))
    if position < N_SURE[layer]:
        return position * N_SCALE[layer]
    return _half_normal_beside(layer, position, stream)


@apart
def _half_normal_beside(layer, position, stream):
    """Return the variate for a position that is not surely under the density."""
    while position >= N_SURE[layer]:
        if layer == 0:
            while True:
                x = -log(1.0 - uniform(stream)) / N_TAIL
                if -2.0 * log(1.0 - uniform(stream)) > x * x:
                    return N_TAIL + x
        x = position * N_SCALE[layer]
        low, high = N_HEIGHT[layer], N_HEIGHT[layer + uint64(1)]
        if low + uniform(stream) * (high - low) < exp(-0.5 * x * x):
            return x
        bits = next_bits(stream)
        layer, position = bits & uint64(LAYERS - 1), int64(bits >> uint64(11))
    return position * N_SCALE[layer]


@inlined
def normal(stream):
    """Return a standard normal variate."""
    return half_normal(stream) * random_sign(stream)


@inlined
def maxwell_speed(stream):
    """Return a variate of density 4 / sqrt(pi) x**2 exp(-x**2), x > 0.

    One call of the generator gives the strip and a height; one below the strip's least density is
    as good as a place.
    """
    bits = next_bits(stream)
    strip, height = bits & uint64(LAYERS - 1), int64(bits >> uint64(11))
    if height < SPEED_SURE[strip]:
        return SPEED_EDGE[strip] + height * SPEED_SCALE[strip]
    return _speed_beside(strip, stream)


@apart
def _speed_beside(strip, stream):
    """Return the speed for a height above the least density of a strip."""
    while strip < uint64(LAYERS - 1):
        x = SPEED_EDGE[strip] + uniform(stream) * SPEED_WIDTH[strip]
        step = SPEED_LARGEST[strip] - SPEED_LEAST[strip]
        if SPEED_LEAST[strip] + uniform(stream) * step < x * x * exp(1.0 - x * x):
            return x
        bits = next_bits(stream)
        strip, height = bits & uint64(LAYERS - 1), int64(bits >> uint64(11))
        if height < SPEED_SURE[strip]:
            return SPEED_EDGE[strip] + height * SPEED_SCALE[strip]
    while True:
        # The square beyond the tail's: sqrt(1 + y) exp(-y / 2) is largest at 0.
        y = exponential(stream) / (SPEED_TAIL * SPEED_TAIL - 0.5)
        if uniform(stream) < math.sqrt(1.0 + y) * exp(-0.5 * y):
            return SPEED_TAIL * math.sqrt(1.0 + y)


@inlined
def maxwell_energies(values, missed, n, stream):
    """Set the first n values to independent squares of `maxwell_speed`.

    Parameters
    ----------
    missed : uint64[>= BLOCK], workspace: what was above the least density of its strip
    """
    done = 0
    while done < n:
        start, stop = next_block(n - done, stream)
        words, block = stream[start:stop], values[done : done + stop - start]
        n_missed = 0
        for k in range(block.size):
            strip, height = words[k] & uint64(LAYERS - 1), int64(words[k] >> uint64(11))
            x = SPEED_EDGE[strip] + height * SPEED_SCALE[strip]
            block[k] = x * x
            missed[n_missed] = uint64(k * LAYERS) | strip
            n_missed += int64(height >= SPEED_SURE[strip])
        for m in range(n_missed):
            strip = missed[m] & uint64(LAYERS - 1)
            block[missed[m] // uint64(LAYERS)] = _speed_beside(strip, stream) ** 2
        done += block.size


@inlined
def _turned(bits):
    """Return (place of a uniform fixed point, cos, sin of a uniform turn within half a step)."""
    turn = (int64(bits) >> int64(11)) * (2.0 * math.pi / POINTS * UNIT)  # signed, of 53 bits
    square = turn * turn
    cos = 1.0 - square * (0.5 - square * (1.0 / 24.0))
    sin = turn * (1.0 - square * (1.0 / 6.0))
    return uint64(2) * (bits & uint64(POINTS - 1)), cos, sin


@inlined
def unit_circle(stream):
    """Return (cos, sin) of a uniform angle."""
    place, cos, sin = _turned(next_bits(stream))
    x, y = COS_SIN[place], COS_SIN[place + uint64(1)]
    return x * cos - y * sin, y * cos + x * sin


@inlined
def direction(stream):
    """Return (x, y, z) of a uniform point on the sphere: z is uniform (Archimedes)."""
    z = _height(next_bits(stream))
    cos, sin = unit_circle(stream)
    radius = math.sqrt(1.0 - z * z)
    return radius * cos, radius * sin, z


@inlined
def _height(bits):
    """Return a uniform float64 on [-1, 1), a multiple of 2**-52."""
    return int64(bits >> uint64(11)) * (2.0 * UNIT) - 1.0


@inlined
def directions(x, y, z, n, stream):
    """Set the first n places to independent `direction`s: all z first, then all angles."""
    done = 0
    while done < n:
        start, stop = next_block(n - done, stream)
        words, block = stream[start:stop], z[done : done + stop - start]
        for k in range(block.size):
            block[k] = _height(words[k])
        done += block.size
    done = 0
    while done < n:
        start, stop = next_block(n - done, stream)
        end = done + stop - start
        words, at_x, at_y, at_z = stream[start:stop], x[done:end], y[done:end], z[done:end]
        for k in range(at_z.size):
            place, cos, sin = _turned(words[k])
            radius = math.sqrt(1.0 - at_z[k] * at_z[k])
            x0, y0 = COS_SIN[place], COS_SIN[place + uint64(1)]
            at_x[k] = radius * (x0 * cos - y0 * sin)
            at_y[k] = radius * (y0 * cos + x0 * sin)
        done = end


@inlined
def squared_cosine(stream):
    """Return cos(theta)**2 of a uniform angle, (1 + cos(2 theta)) / 2: a Beta(1/2, 1/2) variate."""
    return _squared(next_bits(stream))


@inlined
def _squared(bits):
    place, cos, sin = _turned(bits)
    cos_twice = COS_SIN[place] * cos - COS_SIN[place + uint64(1)] * sin
    return max(0.0, 0.5 + 0.5 * cos_twice)


@inlined
def squared_cosines(values, n, stream):
    """Set the first n values to independent `squared_cosine`s."""
    done = 0
    while done < n:
        start, stop = next_block(n - done, stream)
        words, block = stream[start:stop], values[done : done + stop - start]
        for k in range(block.size):
            block[k] = _squared(words[k])
        done += block.size


@inlined
def failures_before_success(scale, stream):
    """Return a geometric variate: failures before the first success of probability p.

    Parameters
    ----------
    scale : -1 / log(1 - p) from `gap_scale`; 0 for p = 1
    """
    gap = exponential(stream) * scale
    return int64(gap) if gap < MOST_FAILURES else MOST_FAILURES


@inlined
def gap_scale(probability):
    """Return the scale of `failures_before_success` for 0 <= p <= 1 (inf for p = 0)."""
    return 1.0 / abs(log1p(-probability))
