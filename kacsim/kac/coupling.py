"""Samplers about coupling: other readings of its times, and other directions (section 5)."""

import numpy as np

from kacsim.kac import forward, readings
from kacsim.kac.constants import RULES, SINGLE
from kacsim.statistics.histogram import FINE_BINS, fine_edges
from kacsim.store import described
from kacsim.streams import CHUNK, new_stream
from kacsim.sums import add_powers

WAYS = ("backward", "forward")
ERRORS = ("doubled", "limit")


def sample_kac_readings(case, progress):
    """Draw coupling times under many rules of stopping (readings of Fig. 9).

    Returns
    -------
    dict of mean, variance, third (central moments), least and most[rule, tolerance, replicate]
    """
    single = case.parameters["walk"] == SINGLE
    rules = RULES[:1] if single else RULES
    tolerance = np.array(case.parameters["tolerance"], dtype=float)
    if single:
        draw, bound = readings.stopping_times_single, (case.parameters["n_particles"], tolerance)
    else:
        draw, bound = readings.stopping_times, readings.arguments(**case.parameters)
    shape = (len(rules), tolerance.size, len(case.replicates))
    sums = np.zeros((*shape, 3))
    least, most = np.full(shape, np.inf), np.zeros(shape)
    for row, replicate in enumerate(case.replicates):
        stream = new_stream(case.seed, case.id, replicate)
        for start in range(0, case.n_draws, CHUNK):
            size = min(CHUNK, case.n_draws - start)
            times = np.empty((size, *shape[:2]), np.int64)
            draw(times, *bound, stream)
            for place in np.ndindex(shape[:2]):
                add_powers(times[:, *place].astype(float), sums[*place, row])
            least[..., row] = np.minimum(least[..., row], times.min(axis=0))
            most[..., row] = np.maximum(most[..., row], times.max(axis=0))
            progress(row * case.n_draws + start + size)
    mean, square, cube = np.moveaxis(sums, -1, 0) / case.n_draws
    dims = ("rule", "tolerance", "replicate")
    return {
        "mean": described(mean, dims, "mean coupling time", "steps"),
        "variance": described(square - mean**2, dims, "variance of the coupling time", "steps2"),
        "third": described(
            cube - 3.0 * mean * square + 2.0 * mean * mean * mean,
            dims,
            "its third central moment",
            "steps3",
        ),
        "least": described(least, dims, "smallest coupling time", "steps"),
        "most": described(most, dims, "largest coupling time", "steps"),
        "tolerance": described(tolerance, ("tolerance",), "tolerance over the sphere's radius"),
    }


def sample_kac_forward(case, progress):
    """Draw mean corners coupled from the past and forward on the same inputs (section 5.1).

    Returns
    -------
    dict of counts[way, replicate, bin] (of all coordinates, without signs), fourth and
    fourth_square[way, replicate] (mean over particles of v**4, and its square),
    steps[way, replicate], n_far[error, replicate] (draws at least epsilon away from where doubling
    and the limit take them), largest_error[error, replicate] (in units of epsilon)
    """
    arguments = forward.arguments(**case.parameters)
    n, _, tolerance = arguments
    rows = len(case.replicates)
    counts = np.zeros((len(WAYS), rows, FINE_BINS + 2), np.int64)
    fourths, steps = np.zeros((len(WAYS), rows, 2)), np.zeros((len(WAYS), rows))
    n_far, largest = np.zeros((len(ERRORS), rows), np.int64), np.zeros((len(ERRORS), rows))
    edges = np.r_[-np.inf, fine_edges(), np.inf]
    for row, replicate in enumerate(case.replicates):
        stream = new_stream(case.seed, case.id, replicate)
        for start in range(0, case.n_draws, CHUNK):
            size = min(CHUNK, case.n_draws - start)
            corners = np.empty((len(WAYS), size, n))
            errors, times = np.empty((size, 2)), np.empty((size, 2), np.int64)
            forward.couple_both_ways(*corners, errors, times, *arguments, stream)
            steps[:, row] += times.sum(axis=0)
            errors /= tolerance
            n_far[:, row] += (errors >= 1.0).sum(axis=0)
            largest[:, row] = np.maximum(largest[:, row], errors.max(axis=0))
            for way in range(len(WAYS)):
                add_powers(mean_fourth(corners[way]), fourths[way, row])
                counts[way, row] += np.histogram(corners[way], edges)[0]
            progress(row * case.n_draws + start + size)
    fourth, square = np.moveaxis(fourths, -1, 0)
    dims, units = ("way", "replicate"), "steps"
    return {
        "counts": described(counts, (*dims, "bin"), "coordinates per bin, first and last: tails"),
        "fourth": described(fourth / case.n_draws, dims, "mean over particles of v**4"),
        "fourth_square": described(square / case.n_draws, dims, "mean square of that"),
        "steps": described(steps / case.n_draws, dims, "mean coupling time", units),
        "n_far": described(n_far, ("error", "replicate"), "draws an epsilon away or more"),
        "largest_error": described(largest, ("error", "replicate"), "largest distance / epsilon"),
        "edge": described(fine_edges(), ("edge",), "bin edges of v"),
    }


def mean_fourth(velocities):
    """Return float64[draw], the mean over particles of v**4 in float64[draw, particle]."""
    total = 0.0
    for v in velocities.T:
        total = total + (v * v) * (v * v)
    return total / velocities.shape[1]
