"""What the public estimators share: realizations streamed into an `Estimate`."""

import math
from dataclasses import dataclass

import numpy as np

from kacsim import checks
from kacsim.mckean.choice import BRANCHING
from kacsim.streams import CHUNK, new_stream
from kacsim.sums import add_powers

SMALLEST = float(np.finfo(float).tiny)
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
    method : str, how: "branching" by the papers' trees, others by McKean's
    """

    mean: float
    standard_error: float
    variance: float
    mean_recursion: float
    n_realizations: int
    largest_share: float
    method: str = BRANCHING


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


def estimate_from(draw, factor, n_realizations, seed, name, method=BRANCHING):
    """Return the Estimate of factor times the drawn values."""
    sums, largest, nodes = np.zeros(2), 0.0, 0
    for values, counts in chunks(draw, n_realizations, new_stream(seed, name)):
        add_powers(values, sums)
        largest = max(largest, float(np.abs(values).max()))
        nodes += int(counts.sum())
    total, square = map(float, sums)
    mean = total / n_realizations
    # A product below the smallest normal number has lost its digits, a factor of 0 everything.
    # Only branching can end with nothing but zeros.
    lost = factor == 0.0 or ((mean != 0.0 or method != BRANCHING) and abs(factor * mean) < SMALLEST)
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
        method=method,
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


def product(a, b):
    """Return the scalar product of two vectors: a library's has another order of its sums."""
    return float(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


def length(vector):
    """Return the length of a vector, float64[3]."""
    return math.sqrt(product(vector, vector))


def sizes(n_realizations, seed):
    """Yield the problems of the size and the seed of an estimate."""
    yield from checks.count("n_realizations", n_realizations, least=2)
    yield from checks.count("seed", seed, least=0)
