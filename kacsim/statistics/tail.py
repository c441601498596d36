"""Tail counts with exact binomial intervals."""

import numpy as np
from scipy import special

from kacsim.statistics.histogram import FINE_WIDTH, fine_edges


def counts_beyond(counts, threshold, *, both_sides=False):
    """Return the number of draws above a threshold that is a fine bin edge.

    Parameters
    ----------
    counts : int[FINE_BINS + 2]
    threshold : float >= 0, a multiple of the fine width
    both_sides : count |v| > threshold instead of v > threshold

    Raises
    ------
    ValueError
        If the threshold is not an edge.
    """
    edges = fine_edges()
    place = int(np.argmin(np.abs(edges - threshold)))
    if abs(edges[place] - threshold) > 1e-9:
        raise ValueError(
            f"threshold = {threshold!r}: must be a multiple of {FINE_WIDTH} up to {edges[-1]}"
        )
    counts = np.asarray(counts)
    above = int(counts[place + 1 :].sum())
    return above + int(counts[: counts.size - place - 1].sum()) if both_sides else above


def clopper_pearson(successes, n_draws, confidence=0.95):
    """Return the exact binomial interval (low, high) of a share."""
    rest = (1.0 - confidence) / 2.0
    low = special.betaincinv(successes, n_draws - successes + 1, rest) if successes else 0.0
    full = successes == n_draws
    high = 1.0 if full else special.betaincinv(successes + 1, n_draws - successes, 1.0 - rest)
    return float(low), float(high)
