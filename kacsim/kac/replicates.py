"""Replicates streamed into counts, moments and a few raw values, for every law of collisions.

Memory does not grow with the number of draws: a kernel fills a buffer of `CHUNK` draws, the
buffer is added to the sums, and is filled again.
"""

import math

import numpy as np
from numba import int64

from kacsim.kernels.jit import kernel
from kacsim.statistics.histogram import FINE_BINS, FINE_LIMIT, FINE_WIDTH, fine_edges
from kacsim.store import described
from kacsim.streams import CHUNK, new_stream

ORDERS = (2, 4, 6, 8)
KEPT = 100_000


@kernel
def accumulate(values, counts, sums, kept, n_kept, keep_above):
    """Add draws to the sums of one replicate.

    Parameters
    ----------
    values : float64[n], draws
    counts : int64[FINE_BINS + 2], fine histogram with two tails, modified in place
    sums : float64[4], sums of v**2, v**4, v**6, v**8, modified in place
    kept : float64[m], raw values above `keep_above`, filled from place n_kept on
    n_kept, keep_above : int, float

    Returns
    -------
    int, the new number of kept values
    """
    scale = 1.0 / FINE_WIDTH
    for v in values:
        above = (v + FINE_LIMIT) * scale
        place = 1 + int64(min(above, FINE_BINS)) if above >= 0.0 else 0
        counts[place] += 1
        square = v * v
        sums[0] += square
        sums[1] += square**2
        sums[2] += square**3
        sums[3] += square**4
        if n_kept < kept.size and v > keep_above:
            kept[n_kept] = v
            n_kept += 1
    return n_kept


def value_sums(case, fill, progress, value="v_1", kept_name="kept_velocity"):
    """Stream all replicates through `fill(values, row, stream)`; return variables.

    Parameters
    ----------
    value, kept_name : str, what is drawn; name of the variable of raw values

    Returns
    -------
    dict of counts[replicate, bin], moment[replicate, order], the raw values [kept], order[order]
    and edge[edge]
    """
    p = case.parameters
    rows = len(case.replicates)
    counts = np.zeros((rows, FINE_BINS + 2), np.int64)
    sums = np.zeros((rows, len(ORDERS)))
    keep_above = p.get("keep_above")
    kept = np.empty(min(KEPT, case.n_draws * rows))
    n_kept, done = 0, 0
    for row, replicate in enumerate(case.replicates):
        stream = new_stream(case.seed, case.id, replicate)
        for start in range(0, case.n_draws, CHUNK):
            values = np.empty(min(CHUNK, case.n_draws - start))
            fill(values, row, stream)
            threshold = -math.inf if keep_above is None else keep_above
            n_kept = accumulate(values, counts[row], sums[row], kept, n_kept, threshold)
            done += values.size
            progress(done)
    sums /= case.n_draws
    return {
        "counts": described(counts, ("replicate", "bin"), "draws per bin, first and last: tails"),
        "moment": described(sums, ("replicate", "order"), f"mean of {value} to the power"),
        kept_name: described(
            kept[:n_kept], ("kept",), f"first values of {value} above the keeping threshold"
        ),
        "order": described(ORDERS, ("order",), "power"),
        "edge": described(fine_edges(), ("edge",), f"bin edges of {value}"),
    }


def algorithm_sums(case, fill, progress, **names):
    """Stream all replicates of an algorithm; return variables, its collisions among them.

    Parameters
    ----------
    fill : function (values, own, row, stream) -> int, sets values and numbers of own collisions of
        particle 1, and returns the collisions simulated
    names : as of `value_sums`

    Returns
    -------
    dict as of `value_sums`, with collisions and own_collisions[replicate] (means per draw),
    own_variance[replicate]
    """
    rows = len(case.replicates)
    collisions = np.zeros(rows)
    own_sums = np.zeros((2, rows))

    def fill_and_count(values, row, stream):
        own = np.empty(values.size, np.int64)
        collisions[row] += fill(values, own, row, stream)
        own_sums[:, row] += own.sum(), (own * own).sum()

    variables = value_sums(case, fill_and_count, progress, **names)
    mean, square = own_sums / case.n_draws
    dims = ("replicate",)
    return variables | {
        "collisions": described(collisions / case.n_draws, dims, "collisions simulated per draw"),
        "own_collisions": described(mean, dims, "mean collisions of particle 1"),
        "own_variance": described(
            square - mean**2, dims, "variance of the collisions of particle 1"
        ),
    }
