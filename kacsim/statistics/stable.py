"""Intervals for the mean of positive values whose variance is infinite, their tail index known.

With P(X > x) ~ C x**-index, 1 < index < 2, the sum of n values less n times their mean is, for many
n, a stable variate of the same index, skewed to the right all it can be, of scale
(n C / c)**(1 / index), c = (1 - index) / (Gamma(2 - index) cos(pi index / 2)).
"""

import functools
import math

import numpy as np

LEVEL = math.erf(math.sqrt(0.5))  # of one standard deviation


def frechet_constant(maxima, block, index):
    """Return C from the largest values of disjoint blocks, float64[...].

    block * C * maximum**-index is a standard exponential variate, about: this is the most likely C.

    Parameters
    ----------
    maxima : float64[..., blocks]
    block : int, values in each
    index : float, of the tail
    """
    return 1.0 / (block * (maxima**-index).mean(axis=-1))


@functools.cache
def quantiles(index, level=LEVEL):
    """Return the two quantiles of the standard stable law, of mean 0, that hold `level` between."""
    from scipy import stats

    ends = (0.5 - level / 2.0, 0.5 + level / 2.0)
    return tuple(float(one) for one in stats.levy_stable.ppf(ends, index, 1.0))


def stable_interval(mean, n, constant, index, level=LEVEL):
    """Return (low, high) around means of n values, by the stable law.

    Parameters
    ----------
    mean, constant : float64[...]
    """
    unit = (1.0 - index) / (math.gamma(2.0 - index) * math.cos(0.5 * math.pi * index))
    scale = (n * constant / unit) ** (1.0 / index) / n
    below, above = quantiles(index, level)
    return mean - above * scale, mean - below * scale


def blocked_interval(mean, mean_square, block, level=LEVEL):
    """Return (low, high) around the mean over disjoint blocks, by the law of Student's ratio.

    That of a block about the mean of all stands for that of the whole about the exact one: it needs
    neither an index nor a scale.

    Parameters
    ----------
    mean, mean_square : float64[..., blocks]
    block : int, values in each
    """
    n_blocks = mean.shape[-1]
    whole = mean.mean(axis=-1)
    spread = np.sqrt(np.maximum(mean_square - mean**2, 1e-300) / (block - 1))
    ratios = (mean - whole[..., None]) / spread
    below, above = np.quantile(ratios, (0.5 - level / 2.0, 0.5 + level / 2.0), axis=-1)
    variance = np.maximum(mean_square.mean(axis=-1) - whole**2, 0.0)
    error = np.sqrt(variance / (n_blocks * block - 1))
    return whole - above * error, whole - below * error
