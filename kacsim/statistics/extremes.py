"""Smallest and largest of many draws, foreseen from the first three moments of fewer."""

import math

import numpy as np
from scipy import special

WIDENED = 3.0  # standard errors of the moments, which come from few draws


def quantile(mean, spread, skewness, *, below=None, above=None):
    """Return a quantile of the Pearson law of type III (a shifted gamma law) of three moments.

    Parameters
    ----------
    mean, spread, skewness : float; no skewness is the normal law
    below, above : float, the probability below the quantile, or above it
    """
    if skewness < 0.0:
        below, above = above, below
    sign = -1.0 if skewness < 0.0 else 1.0
    if abs(skewness) < 1e-4:
        normal = -special.ndtri(above) if below is None else special.ndtri(below)
        return mean + sign * spread * float(normal)
    shape = 4.0 / skewness**2
    if below is None:
        drawn = special.gammainccinv(shape, above)
    else:
        drawn = special.gammaincinv(shape, below)
    return mean + sign * spread * float(drawn - shape) / math.sqrt(shape)


def expected(mean, spread, skewness, n_draws, chance, n_measured=math.inf):
    """Return where the smallest and the largest of n_draws fall, but for a small chance each.

    Parameters
    ----------
    mean, spread, skewness : float, moments of one draw
    n_draws : int, draws that the extremes are of
    chance : float, of an extreme outside its interval
    n_measured : draws that the moments were measured from; the intervals are widened by
        `WIDENED` standard errors of the moments, those of normal draws

    Returns
    -------
    ((low, high) of the smallest, (low, high) of the largest)
    """
    rare = -math.expm1(math.log1p(-chance / 2.0) / n_draws)
    often = -math.expm1(math.log(chance / 2.0) / n_draws)
    least = [quantile(mean, spread, skewness, below=p) for p in (rare, often)]
    most = [quantile(mean, spread, skewness, above=p) for p in (often, rare)]

    def widened(ends):
        z = (np.array(ends) - mean) / spread if spread > 0.0 else np.zeros(2)
        error = spread * np.sqrt((1.0 + z**2 / 2.0 + (z**2 - 1.0) ** 2 / 6.0) / n_measured)
        return float(ends[0] - WIDENED * error[0]), float(ends[1] + WIDENED * error[1])

    return widened(least), widened(most)
