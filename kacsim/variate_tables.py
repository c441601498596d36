"""Tables that variates are looked up in, made with decimals: the same bits on every machine."""

import itertools
from decimal import Decimal

import numpy as np

from kacsim.elementary.decimals import cosines, precise

LAYERS = 256
UNIT = 2.0**-53


@precise
def ziggurat(density, inverse, tail, area):
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
    return edge, edge * UNIT, (edge[1:] / edge[:-1] * 2.0**53).astype(np.int64), height


E_TAIL = 7.69711747013104972
EXPONENTIAL = ziggurat(lambda x: (-x).exp(), lambda y: -y.ln(), E_TAIL, 3.9496598225815571993e-3)
N_TAIL = 3.6541528853610088
NORMAL = ziggurat(
    lambda x: (-x * x / 2).exp(), lambda y: (-2 * y.ln()).sqrt(), N_TAIL, 4.92867323399e-3
)


def speed_density(x):
    """Return x**2 exp(1 - x**2), which is 1 at its mode, 1."""
    return x * x * (1 - x * x).exp()


@precise
def strips(area):
    """Cut the line into strips whose hats, the largest density times the width, have one area.

    Parameters
    ----------
    area : the one for which the tail beyond the last of the `LAYERS` - 1 strips has it too

    Returns
    -------
    edges, least and largest densities of the strips, the tail's being 0, and widths, the tail's
    being 0 : float64[LAYERS]
    """
    area, edges, hats, width = Decimal(area), [Decimal(0)], [], None
    while len(edges) < LAYERS:
        left = edges[-1]
        if 1 - left < area:  # it has the mode, or is beyond
            hats.append(Decimal(1) if left < 1 else speed_density(left))
            width = area / hats[-1]
        else:
            width = _width(left, area, width or (area / Decimal(1).exp()) ** (1 / Decimal(3)))
            hats.append(speed_density(left + width))
        edges.append(left + width)
    ends = [speed_density(x) for x in edges]
    least = [*map(min, ends[:-1], ends[1:]), Decimal(0)]
    widths = [right - left for left, right in itertools.pairwise(edges)]
    columns = (edges, least, [*hats, Decimal(0)], [*widths, Decimal(0)])
    return [np.array(column, dtype=float) for column in columns]


def _width(left, area, guess):
    """Return w with speed_density(left + w) w = area, left + w <= 1, by Newton's method."""
    while True:
        x = left + guess
        slope = 2 / x - 2 * x + 1 / guess
        change = (area / (speed_density(x) * guess)).ln() / slope
        guess = guess + change if change > -guess else guess / 2
        if abs(change) < guess * Decimal("1e-25"):
            return guess


SPEED_EDGE, SPEED_LEAST, SPEED_LARGEST, SPEED_WIDTH = strips("4.777807814937680158829998e-3")
SPEED_SURE = np.append(SPEED_LEAST[:-1] / SPEED_LARGEST[:-1] * 2.0**53, 0.0).astype(np.int64)
SPEED_SCALE = SPEED_WIDTH / np.maximum(SPEED_SURE, 1)
SPEED_TAIL = float(SPEED_EDGE[-1])

POINTS = 1024  # on the circle, at the multiples of an angle from 0 on
COS = np.array(cosines(POINTS), dtype=float)
COS_SIN = np.stack([COS, np.roll(COS, POINTS // 4)], axis=1).ravel()
