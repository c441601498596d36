"""Random variates drawn inside kernels, each from a stream of `kacsim.streams`.

Exponential and normal variates use the ziggurat of Marsaglia and Tsang (J. Stat. Softw. 5(8),
2000) with 256 layers; one call of the generator gives the layer (8 low bits) and the abscissa (53
high bits). Points on the circle use Marsaglia's polar method: no sine or cosine.
"""

from decimal import Decimal

import numpy as np
from numba import int64, uint64

from kacsim.elementary.decimals import precise
from kacsim.elementary.exponential import exp
from kacsim.elementary.logarithm import log, log1p
from kacsim.kernels.jit import inlined
from kacsim.streams import next_bits

LAYERS = 256
MOST_FAILURES = 2**62  # of trials that hardly ever succeed
_UNIT = 2.0**-53


@precise
def _ziggurat(density, inverse, tail, area):
    """Return the layers' right edges, widths of the sure part and densities.

    Parameters
    ----------
    density, inverse : decreasing function of decimals with density(0) = 1, and its inverse
    tail : abscissa where the tail begins
    area : common area of the layers, the lowest one including the tail
    """
    tail, area = Decimal(tail), Decimal(area)
    edges = [area / density(tail), tail]
    while len(edges) < LAYERS:
        edges.append(inverse(area / edges[-1] + density(edges[-1])))
    edges.append(Decimal(0))
    edge, height = np.array(edges, dtype=float), np.array([float(density(x)) for x in edges])
    return edge, edge * _UNIT, (edge[1:] / edge[:-1] * 2.0**53).astype(np.int64), height


_E_TAIL = 7.69711747013104972
_E_EDGE, _E_SCALE, _E_SURE, _E_HEIGHT = _ziggurat(
    lambda x: (-x).exp(), lambda y: -y.ln(), _E_TAIL, 3.9496598225815571993e-3
)
_N_TAIL = 3.6541528853610088
_N_EDGE, _N_SCALE, _N_SURE, _N_HEIGHT = _ziggurat(
    lambda x: (-x * x / 2).exp(),
    lambda y: (-2 * y.ln()).sqrt(),
    _N_TAIL,
    4.92867323399e-3,
)


@inlined
def uniform(stream):
    """Return a uniform float64 on [0, 1), a multiple of 2**-53."""
    return int64(next_bits(stream) >> uint64(11)) * _UNIT


@inlined
def index_below(n, stream):
    """Return a uniform integer 0..n-1, for 1 <= n < 2**53 (bias below n * 2**-53)."""
    return int64(uniform(stream) * n)


@inlined
def pair_below(n, stream):
    """Return an ordered pair of distinct uniform indices below n >= 2."""
    i = index_below(n, stream)
    j = index_below(n - 1, stream)
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
            return _E_TAIL - log(1.0 - uniform(stream))
        step = _E_HEIGHT[layer + 1] - _E_HEIGHT[layer]
        if _E_HEIGHT[layer] + uniform(stream) * step < exp(-x):
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
                x = -log(1.0 - uniform(stream)) / _N_TAIL
                if -2.0 * log(1.0 - uniform(stream)) > x * x:
                    return _N_TAIL + x
        step = _N_HEIGHT[layer + 1] - _N_HEIGHT[layer]
        if _N_HEIGHT[layer] + uniform(stream) * step < exp(-0.5 * x * x):
            return x


@inlined
def normal(stream):
    """Return a standard normal variate."""
    return half_normal(stream) * random_sign(stream)


@inlined
def unit_circle(stream):
    """Return (cos, sin) of a uniform angle (polar method, angle doubled; 2.55 uniforms)."""
    while True:
        x = 2.0 * uniform(stream) - 1.0
        y = uniform(stream)
        q = x * x + y * y
        if 0.0 < q <= 1.0:
            twice = 2.0 / q
            return 1.0 - y * y * twice, x * y * twice


@inlined
def squared_cosine(stream):
    """Return cos(theta)**2 of a uniform angle, i.e. a Beta(1/2, 1/2) variate (2.55 uniforms)."""
    while True:
        x = uniform(stream)
        y = uniform(stream)
        x *= x
        q = x + y * y
        if 0.0 < q <= 1.0:
            return x / q


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
