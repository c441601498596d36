"""The rejection method under a constant and under a closer envelope (chapter, section 11.2)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from kacsim import checks
from kacsim.elementary.exponential import exp
from kacsim.elementary.logarithm import log1p
from kacsim.kernels.jit import inlined, kernel
from kacsim.streams import new_stream
from kacsim.techniques import model
from kacsim.techniques.constants import BLOCK, LAWS, SUPPORT
from kacsim.techniques.exact import CLOSER_TOP, NARROW, TOPS
from kacsim.typed import ArrayLike, Floats
from kacsim.variates import uniform


@inlined
def propose(closer, low, width, top, stream):
    """Return (value, height of the envelope there), from one uniform."""
    u = uniform(stream)
    if not closer:
        return low + width * u, top
    u = 2.0 * u - 1.0
    v = math.copysign(math.sqrt(-log1p(-abs(u)) / NARROW), u)
    return v, CLOSER_TOP * abs(v) * exp(-NARROW * v * v)


@kernel
def draw(values, law, closer, low, width, top, stream):
    """Draw values by rejection; two uniforms per trial.

    Parameters
    ----------
    values : float64[n], overwritten by accepted values
    law : int, place in `LAWS`
    closer : bool, the envelope of `CLOSER_TOP` in place of the constant `top` on [low, low + width]
    stream : from `new_stream`, advanced

    Returns
    -------
    int, number of trials
    """
    trials = 0
    for k in range(values.size):
        while True:
            trials += 1
            v, height = propose(closer, low, width, top, stream)
            if uniform(stream) * height < model.density(law, v):
                break
        values[k] = v
    return trials


@kernel
def record(points, law, closer, low, width, top, stream):
    """Record trials: float64[n, 3] of value, height below the envelope, 1 if accepted."""
    for k in range(points.shape[0]):
        v, height = propose(closer, low, width, top, stream)
        height *= uniform(stream)
        points[k, 0], points[k, 1] = v, height
        points[k, 2] = 1.0 if height < model.density(law, v) else 0.0


def arguments(law, envelope):
    """Return the kernels' arguments for a law and an envelope that are checked."""
    low, high = SUPPORT[law]
    return LAWS.index(law), envelope == "closer", low, high - low, TOPS[law]


def draw_by_rejection(
    density: Callable[[Floats], ArrayLike],
    envelope: Callable[[Floats], ArrayLike],
    propose: Callable[[Floats], ArrayLike],
    *,
    n_draws: int,
    seed: int,
) -> tuple[Floats, int]:
    """Draw values with a density known up to a factor, by rejection under any envelope.

    Parameters
    ----------
    density : callable, array -> array, zero or positive
    envelope : callable, array -> array, nowhere below the density
    propose : callable, uniforms on [0, 1) -> values distributed as the envelope
    n_draws : int >= 1
    seed : int >= 0; the same arguments give the same bits

    Returns
    -------
    (float64[n_draws], int), values, and the uniforms of all trials that were looked at

    Raises
    ------
    ValueError
        Names the argument and what is allowed; an envelope below the density is found at the
        first trial that falls where it is.
    """
    checks.raise_problems(checks.amount(n_draws=n_draws, n_replicates=1, seed=seed))
    stream = new_stream(seed, "techniques.draw_by_rejection")
    values, filled, used = np.empty(n_draws), 0, 0
    while filled < n_draws:
        u = np.empty((2, BLOCK))
        fill_uniforms(u, stream)
        tried = np.asarray(propose(u[0]), dtype=float)
        wanted, height = (np.asarray(f(tried), dtype=float) for f in (density, envelope))
        if not (wanted >= 0.0).all():
            place = tried[~(wanted >= 0.0)][0]
            raise ValueError(f"density = {density!r}: must be zero or positive, as not at {place}")
        low = wanted > height * (1.0 + 1e-12)
        if low.any():
            place = tried[low][0]
            raise ValueError(
                f"envelope = {envelope!r}: must not be below the density, as at {place}"
            )
        if not (wanted > 0.0).any():
            raise ValueError(f"density = {density!r}: must be positive where values are proposed")
        found = np.flatnonzero(u[1] * height < wanted)[: n_draws - filled]
        values[filled : filled + found.size] = tried[found]
        filled += found.size
        used += 2 * (int(found[-1]) + 1 if filled == n_draws else BLOCK)
    return values, used


@kernel
def fill_uniforms(u, stream):
    """Fill float64[2, n] with uniforms, pair by pair."""
    for k in range(u.shape[1]):
        u[0, k] = uniform(stream)
        u[1, k] = uniform(stream)
