"""The Kac equation by McKean's trees: f and its tail at any time, with a finite variance."""

from kacsim.mckean.constants import KAC
from kacsim.mckean.contour import DENSITY, TAIL
from kacsim.mckean.probing import bound


def kac_ancestral(speed, time, *, collision_rate, **tree):
    """Return the kernel at one speed, in units of M(v): callable(values, nodes, stream)."""
    return bound(DENSITY, abs(speed), collision_rate * time, KAC, relative=True, **tree)


def kac_tail_ancestral(threshold, time, *, collision_rate, **tree):
    """Return the kernel at one threshold v >= 0, P(v_1 > v): callable(values, nodes, stream)."""
    return bound(TAIL, threshold, collision_rate * time, KAC, **tree)
