"""Samplers of the Kac paper."""

import numpy as np

from kacsim.boltzmann.sampling import sample as sample_kac_probe
from kacsim.kac import draws, perfect
from kacsim.kac.coupling import sample_kac_forward, sample_kac_readings
from kacsim.kac.replicates import KEPT, algorithm_sums, value_sums
from kacsim.store import described
from kacsim.streams import new_stream

__all__ = [
    "KEPT",
    "sample_kac",
    "sample_kac_corners",
    "sample_kac_equilibrium",
    "sample_kac_forward",
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
