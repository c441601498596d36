"""The public estimators: checked arguments, physical units, streamed sums."""

import math
from dataclasses import dataclass

import numpy as np

from kacsim import checks
from kacsim.boltzmann import bkw, bkw_tree, null_collisions
from kacsim.streams import new_stream

CHUNK = 8192
SMALLEST = float(np.finfo(float).tiny)
MAX_NODES = checks.MAX_NODES
BudgetError = checks.BudgetError


@dataclass(frozen=True)
class Estimate:
    """An estimate from independent realizations.

    Attributes
    ----------
    mean, standard_error : of the probed quantity, in its physical unit
    variance : of one realization; estimates nothing finite where the exact one is infinite
    mean_recursion : mean number of t' drawings of one realization
    n_realizations : int
    largest_share : share of the largest realization in the sum; near 1 the bars say nothing
    """

    mean: float
    standard_error: float
    variance: float
    mean_recursion: float
    n_realizations: int
    largest_share: float


def chunks(draw, n_realizations, stream):
    """Yield (values, nodes) of successive chunks of realizations.

    Parameters
    ----------
    draw : callable(values, nodes, stream) -> bool, a kernel with its parameters bound

    Raises
    ------
    BudgetError
        If a tree exceeds the budget of nodes.
    """
    for start in range(0, n_realizations, CHUNK):
        values = np.empty(min(CHUNK, n_realizations - start))
        nodes = np.empty(values.size, np.int64)
        if not draw(values, nodes, stream):
            raise BudgetError(
                "max_nodes: a tree has grown past the budget of nodes; allow more nodes, "
                "or probe an earlier time"
            )
        yield values, nodes


def estimate_from(draw, factor, n_realizations, seed, name):
    """Return the Estimate of factor times the drawn values."""
    total, square, largest, nodes = 0.0, 0.0, 0.0, 0
    for values, counts in chunks(draw, n_realizations, new_stream(seed, name)):
        total += values.sum()
        square += (values * values).sum()
        largest = max(largest, float(np.abs(values).max()))
        nodes += int(counts.sum())
    mean = total / n_realizations
    # A product below the smallest normal number has lost its digits, a factor of 0 everything.
    lost = factor == 0.0 or (mean != 0.0 and abs(factor * mean) < SMALLEST)
    if lost or not math.isfinite(factor * mean):
        raise ValueError("the probe lies where double precision holds no value: bring it nearer")
    spread = max(0.0, square - n_realizations * mean * mean) / (n_realizations - 1)
    return Estimate(
        mean=float(factor * mean),
        standard_error=float(factor * math.sqrt(spread / n_realizations)),
        variance=float(factor * factor * spread),
        mean_recursion=nodes / n_realizations,
        n_realizations=n_realizations,
        largest_share=largest / abs(total) if total else 0.0,
    )


def vector_of(name, value):
    """Return a float64[3]; a number stands for a vector along one axis."""
    try:
        vector = np.asarray(value, dtype=float)
    except (TypeError, ValueError, OverflowError):
        vector = np.array([np.nan])
    vector = np.array([float(vector), 0.0, 0.0]) if vector.ndim == 0 else vector
    if vector.shape != (3,) or not (np.abs(vector) < checks.LARGEST).all():
        raise ValueError(f"{name} = {value!r}: must be a finite number or three of them")
    return vector


def check(*problems):
    """Raise ValueError with the first problem of several groups."""
    checks.raise_problems(problem for group in problems for problem in group)


def sizes(n_realizations, seed, max_nodes):
    """Yield the problems of the size, the seed and the budget of an estimate."""
    yield from checks.count("n_realizations", n_realizations, least=2)
    yield from checks.count("seed", seed, least=0)
    yield from checks.count("max_nodes", max_nodes)


def estimate_bkw(
    velocity,
    time,
    *,
    n_realizations,
    seed,
    rms_velocity=1.0,
    oversampling=1.0,
    onset=0.0,
    max_nodes=MAX_NODES,
):
    """Estimate f(c; t) of the BKW mode by Algorithm 2 (Boltzmann paper, section II).

    Parameters
    ----------
    velocity : float (a speed) or float64[3], in the unit of rms_velocity
    time : float >= 0, in mean collision times
    n_realizations : int >= 2
    seed : int >= 0
    rms_velocity : float > 0, c_q, per axis
    oversampling : float >= 1, mean number of sub-estimates that replace each one; 1 as published
    onset : float >= 0, collisions before this time are not oversampled
    max_nodes : int, budget of one tree

    Returns
    -------
    Estimate, per unit of velocity cubed

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    BudgetError
        If a tree exceeds max_nodes.
    """
    speed = float(np.linalg.norm(vector_of("velocity", velocity)))
    check(
        checks.not_negative("time", time),
        checks.positive("rms_velocity", rms_velocity),
        checks.at_least("oversampling", oversampling, 1.0),
        checks.not_negative("onset", onset),
        sizes(n_realizations, seed, max_nodes),
    )

    def draw(values, nodes, stream):
        reduced = speed / rms_velocity
        return bkw_tree.estimate(
            values,
            nodes,
            reduced,
            float(time),
            float(oversampling),
            float(onset),
            max_nodes,
            stream,
        )

    factor = float(bkw.maxwellian(speed, rms_velocity))
    return estimate_from(draw, factor, n_realizations, seed, "boltzmann.estimate_bkw")


def estimate_bkw_fraction(
    threshold,
    time,
    *,
    n_realizations,
    seed,
    rms_velocity=1.0,
    oversampling=1.0,
    onset=0.0,
    max_nodes=MAX_NODES,
):
    """Estimate the fraction of particles with |c| > threshold by Algorithm 3 and eq. (19).

    Parameters, result and errors as `estimate_bkw`, with threshold >= 0 in place of velocity.
    """
    check(
        checks.not_negative("threshold", threshold),
        checks.not_negative("time", time),
        checks.positive("rms_velocity", rms_velocity),
        checks.at_least("oversampling", oversampling, 1.0),
        checks.not_negative("onset", onset),
        sizes(n_realizations, seed, max_nodes),
    )

    def draw(values, nodes, stream):
        reduced = threshold / rms_velocity
        return bkw_tree.estimate_fraction(
            values,
            nodes,
            reduced,
            float(time),
            float(oversampling),
            float(onset),
            max_nodes,
            stream,
        )

    return estimate_from(draw, 1.0, n_realizations, seed, "boltzmann.estimate_bkw_fraction")


def estimate_extinction(
    time, *, n_realizations, seed, rate, initial, majorant, max_nodes=MAX_NODES
):
    """Estimate f(t) of f' = -rate f**2, f(0) = initial, by Algorithm 4 (section III).

    Parameters
    ----------
    time : float >= 0
    n_realizations, seed, max_nodes : as `estimate_bkw`
    rate, initial : float > 0, alpha and f0
    majorant : float > 0, the raised frequency; the variance is finite for all times from
        rate * initial on

    Returns
    -------
    Estimate, in the unit of initial

    Raises
    ------
    ValueError, BudgetError
        As `estimate_bkw`.
    """
    check(
        checks.not_negative("time", time),
        checks.positive("rate", rate),
        checks.positive("initial", initial),
        checks.positive("majorant", majorant),
        sizes(n_realizations, seed, max_nodes),
    )
    scale = rate * initial

    def draw(values, nodes, stream):
        return null_collisions.estimate(
            values, nodes, float(scale * time), majorant / scale, max_nodes, stream
        )

    return estimate_from(draw, initial, n_realizations, seed, "boltzmann.estimate_extinction")
