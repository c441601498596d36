"""Random variates drawn inside kernels, each from a stream of `kacsim.streams`.

Exponential and normal variates use the ziggurat of Marsaglia and Tsang (J. Stat. Softw. 5(8),
2000) with 256 layers; one call of the generator gives the layer (8 low bits), a sign (the next)
and the abscissa (53 high bits). Points on the circle are one of 256 fixed ones turned by a small
angle (8 low bits and 53 high bits of one call): no rejection, no library's sine.
"""

import math

import numpy as np
from numba import int64, uint64

from kacsim.kernels.jit import inlined
from kacsim.kernels.wide import product
from kacsim.streams import next_bits

LAYERS = 256
_UNIT = 2.0**-53


def _ziggurat(density, inverse, tail, area):
    """Return the layers' right edges, widths of the sure part and densities.

    Parameters
    ----------
    density, inverse : decreasing function with density(0) = 1, and its inverse
    tail : abscissa where the tail begins
    area : common area of the layers, the lowest one including the tail
    """
    edge = np.zeros(LAYERS + 1)
    edge[0], edge[1] = area / density(tail), tail
    for i in range(2, LAYERS):
        edge[i] = inverse(area / edge[i - 1] + density(edge[i - 1]))
    sure = np.array([int(edge[i + 1] / edge[i] * 2.0**53) for i in range(LAYERS)], dtype=np.int64)
    height = np.array([density(x) for x in edge])
    return edge, edge * _UNIT, sure, height


_E_TAIL = 7.69711747013104972
_E_EDGE, _E_SCALE, _E_SURE, _E_HEIGHT = _ziggurat(
    lambda x: math.exp(-x), lambda y: -math.log(y), _E_TAIL, 3.9496598225815571993e-3
)
_N_TAIL = 3.6541528853610088
_N_EDGE, _N_SCALE, _N_SURE, _N_HEIGHT = _ziggurat(
    lambda x: math.exp(-0.5 * x * x),
    lambda y: math.sqrt(-2.0 * math.log(y)),
    _N_TAIL,
    4.92867323399e-3,
)


@inlined
def uniform(stream):
    """Return a uniform float64 on [0, 1), a multiple of 2**-53."""
    return int64(next_bits(stream) >> uint64(11)) * _UNIT


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
    while True:
        bits = next_bits(stream)
        layer = int64(bits & uint64(255))
        position = int64(bits >> uint64(11))
        x = position * _E_SCALE[layer]
        if position < _E_SURE[layer]:
            return x
        if layer == 0:
            return _E_TAIL - math.log(1.0 - uniform(stream))
        step = _E_HEIGHT[layer + 1] - _E_HEIGHT[layer]
        if _E_HEIGHT[layer] + uniform(stream) * step < math.exp(-x):
            return x


@inlined
def half_normal(stream):
    """Return the absolute value of a standard normal variate."""
    while True:
        bits = next_bits(stream)
        layer = int64(bits & uint64(255))
        position = int64(bits >> uint64(11))
        x = position * _N_SCALE[layer]
        if position < _N_SURE[layer]:
            return x
        if layer == 0:
            while True:
                x = -math.log(1.0 - uniform(stream)) / _N_TAIL
                if -2.0 * math.log(1.0 - uniform(stream)) > x * x:
                    return _N_TAIL + x
        step = _N_HEIGHT[layer + 1] - _N_HEIGHT[layer]
        if _N_HEIGHT[layer] + uniform(stream) * step < math.exp(-0.5 * x * x):
            return x


@inlined
def normal(stream):
    """Return a standard normal variate."""
    return half_normal(stream) * random_sign(stream)


# |v| under f0 of the Kac paper, density proportional to x**2 exp(-x**2): the line is cut into
# strips whose hats, the largest density times the width, have the same area. The bits of one call
# give the strip and a height; below the strip's least density the height is as good as a place.

_S_MODE = 1.0


def _strips(density, area):
    """Return the edges of all strips but the last, the tail, each with a hat of the given area."""
    edge = [0.0]
    while len(edge) < LAYERS:
        left, low, high = edge[-1], 0.0, _S_MODE - edge[-1]
        if high > 0.0 and density(_S_MODE) * high >= area:  # the hat is the density on the right
            for _ in range(64):
                middle = 0.5 * (low + high)
                less = density(left + middle) * middle < area
                low, high = (middle, high) if less else (low, middle)
            edge.append(left + high)
        else:
            edge.append(left + area / density(max(left, _S_MODE)))
    return edge


def _speed_density(x):
    return x * x * math.exp(1.0 - x * x)


def _speed_tail(x):
    """Return the area under the density beyond x."""
    return math.e * (0.5 * x * math.exp(-x * x) + 0.25 * math.sqrt(math.pi) * math.erfc(x))


def _equal_strips():
    """Return the edges for which the tail has the area of a hat."""
    low, high = 0.5 * _speed_tail(0.0) / LAYERS, 2.0 * _speed_tail(0.0) / LAYERS
    for _ in range(64):
        area = 0.5 * (low + high)
        try:
            wide = _speed_tail(_strips(_speed_density, area)[-1]) < area
        except (OverflowError, ZeroDivisionError):
            wide = True
        low, high = (low, area) if wide else (area, high)
    return np.array(_strips(_speed_density, area))


_S_EDGE = _equal_strips()
_S_ENDS = np.array([_speed_density(x) for x in _S_EDGE])
_S_LOW = np.append(np.minimum(_S_ENDS[:-1], _S_ENDS[1:]), 0.0)
_S_HIGH = np.append(np.maximum(_S_ENDS[:-1], _S_ENDS[1:]), 0.0)
_S_HIGH[np.searchsorted(_S_EDGE, _S_MODE, side="right") - 1] = 1.0
_S_SURE = np.array([int(a / b * 2.0**53) if b else 0 for a, b in zip(_S_LOW, _S_HIGH)], dtype=np.int64)
_S_WIDTH = np.append(np.diff(_S_EDGE), 0.0)
_S_SCALE = np.array([w / s if s else 0.0 for w, s in zip(_S_WIDTH, _S_SURE)])
_S_TAIL = float(_S_EDGE[-1])


@inlined
def maxwell_speed(stream):
    """Return a variate of density 4 / sqrt(pi) x**2 exp(-x**2), x > 0."""
    while True:
        bits = next_bits(stream)
        strip = int64(bits & uint64(LAYERS - 1))
        height = int64(bits >> uint64(11))
        if height < _S_SURE[strip]:
            return _S_EDGE[strip] + height * _S_SCALE[strip]
        if strip == LAYERS - 1:
            while True:
                # The square beyond the tail's: sqrt(1 + y) exp(-y / 2) is largest at 0.
                y = exponential(stream) / (_S_TAIL * _S_TAIL - 0.5)
                if uniform(stream) < math.sqrt(1.0 + y) * math.exp(-0.5 * y):
                    return _S_TAIL * math.sqrt(1.0 + y)
        x = _S_EDGE[strip] + uniform(stream) * _S_WIDTH[strip]
        step = _S_HIGH[strip] - _S_LOW[strip]
        if _S_LOW[strip] + uniform(stream) * step < x * x * math.exp(1.0 - x * x):
            return x


_POINTS = 256  # on the circle, the first at angle 0
_TURN = 2.0 * math.pi / _POINTS
_COS_SIN = np.array([(math.cos(k * _TURN), math.sin(k * _TURN)) for k in range(_POINTS)]).ravel()


@inlined
def _turned(stream):
    """Return (place of a uniform fixed point, cos, sin of a uniform turn within half a step)."""
    bits = next_bits(stream)
    turn = (int64(bits) >> int64(11)) * (_TURN * _UNIT)  # a signed number of 53 bits
    square = turn * turn
    cos = 1.0 - square * (0.5 - square * (1.0 / 24.0 - square * (1.0 / 720.0)))
    sin = turn * (1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0)))
    return 2 * int64(bits & uint64(_POINTS - 1)), cos, sin


@inlined
def unit_circle(stream):
    """Return (cos, sin) of a uniform angle."""
    place, cos, sin = _turned(stream)
    x, y = _COS_SIN[place], _COS_SIN[place + 1]
    return x * cos - y * sin, y * cos + x * sin


@inlined
def squared_cosine(stream):
    """Return cos(theta)**2 of a uniform angle, (1 + cos(2 theta)) / 2: a Beta(1/2, 1/2) variate."""
    place, cos, sin = _turned(stream)
    return max(0.0, 0.5 + 0.5 * (_COS_SIN[place] * cos - _COS_SIN[place + 1] * sin))


@inlined
def failures_before_success(scale, stream):
    """Return a geometric variate: failures before the first success of probability p.

    Parameters
    ----------
    scale : -1 / log(1 - p) from `gap_scale`; 0 for p = 1
    """
    return math.floor(exponential(stream) * scale)


@inlined
def gap_scale(probability):
    """Return the scale of `failures_before_success` for 0 <= p <= 1 (inf for p = 0)."""
    return -1.0 / math.log1p(-probability)
