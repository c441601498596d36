"""Bins, the total variation norm over them, and its noise floor (Kac paper, eq. 11)."""

import numpy as np

# Samplers keep counts at this width out to +-FINE_LIMIT; every wider bin is a whole number of
# them.
FINE_WIDTH = 0.05
FINE_LIMIT = 8.0
FINE_BINS = round(2 * FINE_LIMIT / FINE_WIDTH)


def fine_edges():
    """Return the float64[FINE_BINS + 1] edges between the two outermost (tail) bins."""
    return np.linspace(-FINE_LIMIT, FINE_LIMIT, FINE_BINS + 1)


def coarsen(counts, bin_width):
    """Return counts over bins of a wider constant width, symmetric about 0.

    Parameters
    ----------
    counts : int[..., FINE_BINS + 2], the first and last being the tails
    bin_width : float, a whole multiple of `FINE_WIDTH` that divides `FINE_LIMIT`

    Returns
    -------
    (int[..., n + 2], float64[n + 1]), counts with their tails, and edges

    Raises
    ------
    ValueError
        If fine bins cannot be merged into this width.
    """
    factor = round(bin_width / FINE_WIDTH)
    if factor < 1 or not np.isclose(factor * FINE_WIDTH, bin_width) or FINE_BINS % factor:
        raise ValueError(
            f"bin_width = {bin_width!r}: must be a multiple of {FINE_WIDTH} "
            f"that divides {FINE_LIMIT}"
        )
    counts = np.asarray(counts)
    inner = counts[..., 1:-1]
    merged = inner.reshape(*inner.shape[:-1], FINE_BINS // factor, factor).sum(axis=-1)
    whole = np.concatenate([counts[..., :1], merged, counts[..., -1:]], axis=-1)
    return whole, fine_edges()[::factor]


def probabilities(cumulative, edges):
    """Return the bin probabilities, both tails included, of a cumulative function."""
    inside = cumulative(np.asarray(edges))
    return np.diff(inside, prepend=0.0, append=1.0)


def total_variation(counts, expected):
    """Return TVN = 1/2 sum |p_hat - p| for each histogram (Kac paper, eq. 11).

    Parameters
    ----------
    counts : int[..., bins]
    expected : float64[bins], probabilities of the same bins
    """
    counts = np.asarray(counts)
    share = counts / counts.sum(axis=-1, keepdims=True)
    return 0.5 * np.abs(share - expected).sum(axis=-1)


def noise_floor(expected, n_draws):
    """Return E[TVN] of n_draws exact draws: half the binomial mean absolute deviations, summed.

    De Moivre: E|X - n p| = 2 m (1 - p) P(X = m), m = floor(n p) + 1. For n p large this is the
    familiar sqrt(2 n p (1 - p) / pi).
    """
    from scipy import stats  # half a second to import, which samplers should not pay

    expected = np.clip(np.asarray(expected, dtype=float), 0.0, 1.0)
    mode = np.floor(n_draws * expected) + 1.0
    mass = np.where(mode <= n_draws, stats.binom.pmf(mode, n_draws, expected), 0.0)
    deviation = 2.0 * mode * (1.0 - expected) * mass
    return float(0.5 * deviation.sum() / n_draws)


def noise_spread(expected, n_draws):
    """Return the standard deviation of the TVN of n_draws exact draws.

    Each bin's deviation is taken as half-normal and independent of the others; the correlations,
    left out, lower the spread a little.
    """
    expected = np.asarray(expected, dtype=float)
    variance = (1.0 - 2.0 / np.pi) * (expected * (1.0 - expected)).sum() / n_draws
    return float(0.5 * np.sqrt(variance))
