"""The BKW mode by McKean's trees: f and fractions at any time, with a finite variance."""

from kacsim.mckean.constants import BKW
from kacsim.mckean.contour import BEYOND, SHELL
from kacsim.mckean.probing import bound


def bkw_ancestral(speed, time, **tree):
    """Return the kernel at one speed, in units of M(c): callable(values, nodes, stream)."""
    return bound(SHELL, speed, time, BKW, relative=True, **tree)


def bkw_fraction_ancestral(threshold, time, **tree):
    """Return the kernel at one threshold: callable(values, nodes, stream)."""
    return bound(BEYOND, threshold, time, BKW, **tree)
