"""Samplers of the Kac paper."""

import math

import numpy as np
from numba import int64

from kacsim.boltzmann.sampling import sample as sample_kac_probe
from kacsim.kac import draws, perfect, perfect_blocks
from kacsim.kac.constants import LAGS, LEVELS
from kacsim.kac.coupling import sample_kac_forward, sample_kac_readings
from kacsim.kac.replicates import KEPT, algorithm_sums, value_sums
from kacsim.kernels.jit import kernel
from kacsim.store import described
from kacsim.streams import new_stream

__all__ = [
    "KEPT",
    "sample_kac",
    "sample_kac_corners",
    "sample_kac_equilibrium",
    "sample_kac_forward",
    "sample_kac_perfect",
    "sample_kac_probe",
    "sample_kac_readings",
]


def sample_kac(case, progress):
    """Draw v_1(t) by one algorithm on one engine (Kac paper, section 4).

    Returns
    -------
    dict as of `kacsim.kac.replicates.algorithm_sums`
    """
    draw_kernel, arguments = draws.kernel_of(case.parameters)

    def fill(velocities, own, row, stream):
        return draw_kernel(velocities, own, *arguments, stream)

    return algorithm_sums(case, fill, progress)


def sample_kac_equilibrium(case, progress):
    """Draw epsilon-perfect values of v_1 with their coupling times (Kac paper, section 5).

    Returns
    -------
    dict of as `sample_kac`, with coupling_time[draw] in place of collisions
    """
    arguments = perfect.arguments(**case.parameters)
    rows = len(case.replicates)
    kept = np.empty(min(KEPT, case.n_draws * rows), np.int64)
    lowest = np.full(rows, np.iinfo(np.int64).max)
    highest = np.zeros(rows, np.int64)
    sums = np.zeros((2, rows))
    filled = 0

    def fill(velocities, row, stream):
        nonlocal filled
        times = np.empty(velocities.size, np.int64)
        perfect.couple(velocities, times, *arguments, stream)
        lowest[row] = min(lowest[row], times.min())
        highest[row] = max(highest[row], times.max())
        sums[:, row] += times.sum(), (times * times).sum()
        room = min(times.size, kept.size - filled)
        kept[filled : filled + room] = times[:room]
        filled += room

    variables = value_sums(case, fill, progress)
    mean, square = sums / case.n_draws
    dims, units = ("replicate",), "steps"
    return variables | {
        "coupling_time": described(kept, ("draw",), "coupling time of the first draws", units),
        "coupling_mean": described(mean, dims, "mean coupling time", units),
        "coupling_variance": described(
            square - mean**2, dims, "variance of the coupling time", "steps2"
        ),
        "coupling_min": described(lowest, dims, "smallest coupling time", units),
        "coupling_max": described(highest, dims, "largest coupling time", units),
    }


@kernel
def count_levels(velocities, energy, n_particles, levels, products):
    """Add draws to counts over the range of v_1, and products of near ones to their sums.

    Parameters
    ----------
    velocities : float64[n], draws, at most sqrt(energy) in size
    levels : int64[LEVELS], counts in equal bins from -sqrt(energy) to it, modified in place
    products : float64[LAGS], sums of the products of v**2 / energy - 1 / N with that of the first
        to the last later draw, modified in place
    """
    radius, mean = math.sqrt(energy), 1.0 / n_particles
    for k, v in enumerate(velocities):
        place = int64((v / radius + 1.0) * (0.5 * LEVELS))
        levels[min(max(place, 0), LEVELS - 1)] += 1
        here = v * v / energy - mean
        for lag in range(1, LAGS + 1):
            if k + lag < velocities.size:
                later = velocities[k + lag]
                products[lag - 1] += here * (later * later / energy - mean)


def sample_kac_perfect(case, progress):
    """Draw v_1 at equilibrium with epsilon = 0 (docs/perfect.md).

    Returns
    -------
    dict of counts, moment and kept_velocity as `sample_kac`, level_counts[replicate, level] and
    lag_product[replicate, lag] of `count_levels` (a mean), blocks[replicate] (a mean per draw)
    """
    arguments = perfect_blocks.arguments(**case.parameters)
    n, energy, _ = arguments
    rows = len(case.replicates)
    levels, products = np.zeros((rows, LEVELS), np.int64), np.zeros((rows, LAGS))
    blocks, pairs = np.zeros(rows), np.zeros((rows, LAGS))

    def fill(velocities, row, stream):
        blocks[row] += perfect_blocks.draw_beginnings(velocities, *arguments, stream)
        count_levels(velocities, energy, n, levels[row], products[row])
        pairs[row] += np.maximum(0, velocities.size - np.arange(1, LAGS + 1))

    variables = value_sums(case, fill, progress)
    products /= np.maximum(1.0, pairs)
    dims = ("replicate",)
    return variables | {
        "level_counts": described(levels, (*dims, "level"), "draws per bin of the range of v_1"),
        "lag_product": described(
            products, (*dims, "lag"), "mean product of v_1**2 / E - 1 / N with that of a later draw"
        ),
        "blocks": described(blocks / case.n_draws, dims, "blocks per draw"),
    }


def sample_kac_corners(case, progress):
    """Record epsilon-perfect runs from time -n to 0, every corner at every step (Figs. 6 to 8).

    Returns
    -------
    dict of corner[step, corner, particle] of the first run from its coupling time -n to
    0, its inputs first, second, squared_sine[step]; for all runs diameter[run, step], forward
    from step 0, nan after coupling, and same_pair[run, step]
    """
    runs = [_one_run(case, k) for k in range(case.n_draws)]
    progress(case.n_draws)
    longest = max(run["diameter"].size for run in runs)
    diameter = np.full((len(runs), longest), np.nan)
    same = np.zeros((len(runs), longest), bool)
    for k, one in enumerate(runs):
        diameter[k, : one["diameter"].size] = one["diameter"]
        same[k, : one["same"].size] = one["same"]
    head = runs[0]
    return {
        "corner": described(
            head["corner"], ("time", "corner_index", "particle"), "corner points' velocities"
        ),
        "first": described(head["first"], ("step",), "index p of the pair"),
        "second": described(head["second"], ("step",), "index q of the pair"),
        "squared_sine": described(head["part"], ("step",), "sin(theta) squared"),
        "diameter": described(diameter, ("run", "after"), "largest distance D after a step"),
        "same_pair": described(
            same.astype(np.int8), ("run", "after"), "1 if the step repeats the pair before it"
        ),
    }


def _one_run(case, index):
    """Return one coupled run: corner points at times -n..0, D after each step, repeated pairs."""
    velocities, times = np.empty(1), np.empty(1, np.int64)
    n, energy, tolerance = perfect.arguments(**case.parameters)
    perfect.couple(velocities, times, n, energy, tolerance, new_stream(case.seed, case.id, index))
    steps = int(times[0])
    inputs = perfect.record(n, steps, new_stream(case.seed, case.id, index))
    first, second, part = (values[::-1].copy() for values in inputs)
    path = perfect.trajectory(n, energy, first, second, part)
    pairs = np.sort(np.stack([first, second]), axis=0)
    same = np.r_[False, (pairs[:, 1:] == pairs[:, :-1]).all(axis=0)]
    diameter = np.array([perfect.diameter(points) for points in path[1:]])
    return {
        "corner": path,
        "first": first,
        "second": second,
        "part": part,
        "diameter": diameter,
        "same": same,
    }
