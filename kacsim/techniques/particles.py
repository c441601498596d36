"""Injection from a discrete set of weighted particles (chapter, section 11.3)."""

from __future__ import annotations

import numpy as np

from kacsim import checks
from kacsim.kernels.jit import kernel
from kacsim.streams import new_stream
from kacsim.typed import ArrayLike, Integers
from kacsim.variates import half_normal, random_sign, uniform


@kernel
def select(indices, index_range, stream):
    """Draw particles by a real index: one uniform and a bisection each.

    Parameters
    ----------
    indices : int64[n], overwritten
    index_range : float64[N + 1], r_k, never falling; particle k owns [r_k, r_(k+1))
    stream : from `new_stream`, advanced
    """
    start, width = index_range[0], index_range[-1] - index_range[0]
    for k in range(indices.size):
        r = start + uniform(stream) * width
        low, high = 0, index_range.size - 1
        while high - low > 1:
            middle = (low + high) // 2
            if index_range[middle] <= r:
                low = middle
            else:
                high = middle
        indices[k] = low


@kernel
def representatives(velocities, drift, thermal, stream):
    """Fill float64[N, 3] with velocities of a drifting Maxwellian."""
    for k in range(velocities.shape[0]):
        for axis in range(3):
            normal = random_sign(stream) * half_normal(stream)
            velocities[k, axis] = drift[axis] + thermal * normal


def index_range(velocities, weights, normal):
    """Return float64[N + 1], r_k with lengths weight * max(0, n . v_k).

    Raises
    ------
    ValueError
        Names the argument and what is allowed; no particle that moves inward is an error too.
    """
    velocities = np.asarray(velocities, dtype=float)
    if velocities.ndim != 2 or velocities.shape[1] != 3 or not np.isfinite(velocities).all():
        raise ValueError("velocities: must be N rows of three finite numbers")
    n = velocities.shape[0]
    weights = np.ones(n) if weights is None else np.asarray(weights, dtype=float)
    if weights.shape != (n,) or not np.isfinite(weights).all():
        raise ValueError(f"weights: must be {n} finite numbers, one per particle")
    if (weights < 0.0).any():
        k = int(np.argmax(weights < 0.0))
        raise ValueError(f"weights[{k}] = {float(weights[k])!r}: must be zero or positive")
    direction = np.asarray(normal, dtype=float)
    if direction.shape != (3,) or not np.isfinite(direction).all() or not direction.any():
        raise ValueError(f"normal = {normal!r}: must be three finite numbers, not all zero")
    inward = sum(velocities[:, axis] * direction[axis] for axis in range(3))
    lengths = weights * np.maximum(0.0, inward)
    total = lengths.sum()
    if not 0.0 < total < np.inf:
        raise ValueError(f"velocities: must have a flux along normal = {normal!r}; it is {total}")
    return np.concatenate([[0.0], np.cumsum(lengths)])


def inject_particles(
    velocities: ArrayLike,
    *,
    normal: ArrayLike,
    n_draws: int,
    seed: int,
    weights: ArrayLike | None = None,
) -> Integers:
    """Draw the numbers of particles that enter through a face, weighted by their flux.

    Parameters
    ----------
    velocities : float64[N, 3], representative particles of the outer gas
    normal : 3 floats, the face's normal, inward
    n_draws : int >= 1
    seed : int >= 0; the same arguments give the same bits
    weights : float64[N] >= 0, by default all equal

    Returns
    -------
    int64[n_draws], indices of particles

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    checks.raise_problems(checks.amount(n_draws=n_draws, n_replicates=1, seed=seed))
    ranges = index_range(velocities, weights, normal)
    indices = np.empty(n_draws, np.int64)
    select(indices, ranges, new_stream(seed, "techniques.inject_particles"))
    return indices
