"""Exact results on extinction alone (Boltzmann paper, section III)."""

import numpy as np


def density(time, rate, initial):
    """Return f(t) = f0 / (1 + alpha f0 t), eq. (21)."""
    return initial / (1.0 + rate * initial * np.asarray(time, dtype=float))


def mean_recursion(time, majorant):
    """Return 2 exp(majorant t) - 1, eq. (28)."""
    return 2.0 * np.exp(majorant * np.asarray(time, dtype=float)) - 1.0


def variance(time, rate, initial, majorant):
    """Return the variance of one realization, eq. (29); infinite where that diverges."""
    scaled = rate * initial * np.asarray(time, dtype=float)
    ratio = majorant / (rate * initial)
    denominator = ratio + (ratio - 1.0) * scaled
    with np.errstate(divide="ignore"):
        relative = np.where(denominator > 0.0, scaled / denominator, np.inf)
    return relative * density(time, rate, initial) ** 2
