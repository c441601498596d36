"""Samples of the chapter's samplers made by hand; see `fabricated`."""

import fabricated
import numpy as np

from kacsim import items
from kacsim.statistics import verdict

CELLS, N_BINS = 40, 80  # cells of equal probability; bins of the normal velocity
WHAT = ("number", "speed", "speed_2", "speed_4", "tangent_1", "tangent_2", "product", "squares")
ALPHA = 1e-4


def word(found, claim):
    """Return the verdict on a finding, by its own row of reports/published/."""
    return verdict.judge(found[claim], items.published()[claim], ALPHA)[0]


def values(found, claim):
    """Return [(label, value, standard error, degrees)] of a finding's parts."""
    rows = []
    for part in found[claim].parts:
        one = part.measured
        rows.append((part.label, one.value, one.standard_error, getattr(one, "degrees", None)))
    return rows


def sets(found, claim):
    """Return [(printed, rival, corrected)] of a finding's parts."""
    return [(part.printed, part.rival, part.corrected) for part in found[claim].parts]


def law(case, mean=0.0, square=1.5, uniforms=1.0, trials=1.0, counts=None):
    """Return a sample of a law without tables: float64[replicate] each, or what broadcasts."""
    n = case.n_replicates
    if counts is None:
        counts = np.full((n, CELLS), case.n_draws // CELLS)
    moment = np.zeros((n, 4))
    moment[:, 0], moment[:, 1] = mean, square
    return fabricated.variables(
        counts=(("replicate", "cell"), counts),
        moment=(("replicate", "power"), moment),
        uniforms=(("replicate",), np.broadcast_to(uniforms, n)),
        trials=(("replicate",), np.broadcast_to(trials, n)),
        point=(("trial", "part"), np.zeros((5, 3))),
    )


def tables(case, uniforms=1.0, last=0.0, counts=None, square=1.5):
    """Return a sample of a law through tables: float64[table, replicate] each."""
    shape = len(case.parameters["n_table"]), case.n_replicates
    if counts is None:
        counts = np.full((*shape, CELLS), case.n_draws // CELLS)
    moment = np.zeros((*shape, 4))
    moment[..., 1] = square
    return fabricated.variables(
        counts=(("n_table", "replicate", "cell"), counts),
        moment=(("n_table", "replicate", "power"), moment),
        uniforms=(("n_table", "replicate"), np.broadcast_to(uniforms, shape)),
        last=(("n_table", "replicate"), np.broadcast_to(last, shape)),
    )


def entering(case, steps, **means):
    """Return a sample of particles that enter through six faces.

    Parameters
    ----------
    steps : int[replicate, face, number], steps by their number of particles
    means : float64[replicate, face] each, means over the particles of what `WHAT` names
    """
    steps = np.asarray(steps, dtype=float)
    number = (steps * np.arange(steps.shape[-1])).sum(axis=-1)
    sums = np.zeros((*number.shape, len(WHAT)))
    sums[..., 0] = number
    for name, mean in means.items():
        sums[..., WHAT.index(name)] = np.asarray(mean) * number
    speeds = np.zeros((*number.shape, N_BINS))
    speeds[..., 3] = number
    return fabricated.variables(
        steps=(("replicate", "face", "number"), steps),
        sum=(("replicate", "face", "what"), sums),
        speeds=(("replicate", "face", "bin"), speeds),
        speed_edge=(("edge",), 0.1 * np.arange(N_BINS)),
        kept=(("kept", "part"), np.zeros((2, 7))),
    )


def points(case, errors, volumes):
    """Return a sample of points in spheres.

    Parameters
    ----------
    errors : float64[dimension, replicate, points], fractional errors
    volumes : dimension -> volume
    """
    n = np.array(case.parameters["n_points"], dtype=float)
    dimension = case.parameters["dimension"]
    whole = np.array([volumes[d] for d in dimension])[:, None, None] * n
    return fabricated.variables(
        inside=(("dimension", "replicate", "points"), whole * (1.0 + errors)),
        dimension=(("dimension",), dimension),
        points=(("points",), case.parameters["n_points"]),
    )
