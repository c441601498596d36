"""The mean TVN of n draws from many times n: over all ways to deal the draws into replicates.

Independent draws may be dealt anew, and the mean over all ways is the expected TVN given what was
drawn: it has the mean of the TVN of a replicate and less scatter than the mean of those that were
dealt, ten times less where a law is nearly the one that it is compared with.
"""

import math

import numpy as np

from kacsim.statistics import estimate

REACH = 12.0  # standard deviations beyond which a bin's count is not looked for
MARGIN = 30  # draws besides, for bins that expect few


def mean_variation(counts, expected):
    """Return the mean TVN of as many draws as a replicate has, with its standard error.

    The value is exact: a bin that holds K of all M draws holds a hypergeometric number of n. For
    the error each replicate is left out in turn, with normal laws in place of those; where the
    TVN is all noise the error is up to one and a half times too large.

    Parameters
    ----------
    counts : int[replicate, bin], replicates of equal size, at least two
    expected : float64[bin], probabilities

    Returns
    -------
    estimate.Mean
    """
    counts = np.asarray(counts)
    n_replicates, n_draws = counts.shape[0], int(counts[0].sum())
    whole = counts.sum(axis=0)
    value = 0.5 * sum(
        _deviation(int(held), n_replicates * n_draws, n_draws, p)
        for held, p in zip(whole, expected, strict=True)
    )
    left = _nearly(whole - counts, (n_replicates - 1) * n_draws, n_draws, np.asarray(expected))
    error = math.sqrt((n_replicates - 1) / n_replicates * ((left - left.mean()) ** 2).sum())
    return estimate.Mean(value, error, n_replicates - 1)


def _spread(share, n_all, n_draws):
    """Return the standard deviation of a bin's share of n of all draws."""
    return np.sqrt(share * (1.0 - share) / n_draws * (n_all - n_draws) / (n_all - 1))


def _deviation(held, n_all, n_draws, expected):
    """Return E|X/n - p| of one bin, X hypergeometric."""
    from scipy import stats  # half a second to import, which samplers should not pay

    middle = n_draws * held / n_all
    reach = REACH * n_draws * float(_spread(held / n_all, n_all, n_draws)) + MARGIN
    first = max(0, held + n_draws - n_all, math.floor(middle - reach))
    number = np.arange(first, min(held, n_draws, math.ceil(middle + reach)) + 1)
    chance = stats.hypergeom.pmf(number, n_all, held, n_draws)
    return float((np.abs(number / n_draws - expected) * chance).sum())


def _nearly(held, n_all, n_draws, expected):
    """Return the TVN of each row of counts, float64[row], with normal laws."""
    from scipy import special

    spread, gap = _spread(held / n_all, n_all, n_draws), held / n_all - expected
    ratio = np.divide(gap, spread, out=np.zeros_like(gap), where=spread > 0.0)
    noise = spread * math.sqrt(2.0 / math.pi) * np.exp(-0.5 * ratio**2)
    bias = np.where(spread > 0.0, gap * special.erf(ratio / math.sqrt(2.0)), np.abs(gap))
    return 0.5 * (noise + bias).sum(axis=-1)
