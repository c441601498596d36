"""The inverse transform: u = P(v), by a table equally spaced in u, or in closed form (11.2)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from kacsim import checks
from kacsim.kernels.jit import kernel
from kacsim.streams import new_stream
from kacsim.techniques import model
from kacsim.techniques.constants import CLOSED, LAWS, SUPPORT
from kacsim.techniques.exact import CUMULATIVES
from kacsim.typed import ArrayLike, Floats
from kacsim.variates import uniform

BISECTIONS = 64
CHECKED = 4096  # places where a cumulative function is checked to rise, beside the table's own


@kernel
def through_table(values, table, stream):
    """Draw values by interpolation in a table (chapter, section 11.2); one uniform each.

    Parameters
    ----------
    values : float64[n], overwritten
    table : float64[N_t + 1], v at u = 0, 1/N_t, ..., 1
    stream : from `new_stream`, advanced

    Returns
    -------
    int, draws in the last interval: those that need the value at u = 1
    """
    n_intervals = table.size - 1
    last = 0
    for k in range(values.size):
        place = uniform(stream) * n_intervals
        i = int(place)
        values[k] = table[i] + (place - i) * (table[i + 1] - table[i])
        last += int(i == n_intervals - 1)
    return last


@kernel
def closed_form(values, law, stream):
    """Draw values of a law whose cumulative function has a known inverse; one uniform each."""
    for k in range(values.size):
        values[k] = model.inverse(law, uniform(stream))


def tabulate(
    cumulative: Callable[[Floats], ArrayLike], low: float, high: float, n_table: int
) -> Floats:
    """Return the table of a cumulative function, equally spaced in u (chapter, Fig. 11.1).

    Parameters
    ----------
    cumulative : callable, array of values -> array; continuous, never falling, any total
    low, high : float, where it begins and ends
    n_table : int >= 1, intervals; linear interpolation leaves an error in P of the order of
        n_table**-2 where the density is smooth and positive, n_table**-1 at ends where it vanishes

    Returns
    -------
    float64[n_table + 1], by bisection: the first is low, the last high

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    checks.raise_problems(checks.count("n_table", n_table))
    for name, value in (("low", low), ("high", high)):
        checks.raise_problems(checks.finite(name, value))
    if not high > low:
        raise ValueError(f"high = {high!r}: must be greater than low = {low!r}")
    grid = np.linspace(low, high, CHECKED)
    at_grid = np.asarray(cumulative(grid), dtype=float)
    if at_grid.shape != grid.shape or not np.isfinite(at_grid).all():
        raise ValueError(f"cumulative = {cumulative!r}: must give one finite number per value")
    fall = np.flatnonzero(np.diff(at_grid) < 0.0)
    if fall.size:
        raise ValueError(f"cumulative = {cumulative!r}: must never fall, as at {grid[fall[0]]:g}")
    start, total = at_grid[0], at_grid[-1] - at_grid[0]
    if not total > 0.0:
        raise ValueError(f"cumulative = {cumulative!r}: must rise between low and high")
    wanted = start + total * np.arange(n_table + 1) / n_table
    left, right = np.full(n_table + 1, float(low)), np.full(n_table + 1, float(high))
    for _ in range(BISECTIONS):
        middle = 0.5 * (left + right)
        below = np.asarray(cumulative(middle)) < wanted
        left, right = np.where(below, middle, left), np.where(below, right, middle)
    table = 0.5 * (left + right)
    table[0], table[-1] = low, high
    if (np.diff(table) < 0.0).any():
        raise ValueError(f"cumulative = {cumulative!r}: must never fall")
    return table


def law_table(law, n_table):
    """Return the table of one of `LAWS` over its support."""

    def cumulative(values):
        shares = np.empty(values.size)
        model.fill_cumulative(shares, LAWS.index(law), values)
        return shares

    return tabulate(cumulative, *SUPPORT[law], n_table)


def table_error(law, table, places):
    """Return the error in P of the law that a table gives: its own cumulative function less P.

    Parameters
    ----------
    law : one of `LAWS`
    table : float64[N_t + 1]
    places : float64[n], values between the table's ends
    """
    steps = np.linspace(0.0, 1.0, table.size)
    return np.interp(places, table, steps) - CUMULATIVES[law](np.asarray(places))


def draw_from_table(table: ArrayLike, *, n_draws: int, seed: int) -> Floats:
    """Draw values through a table of `tabulate`, one uniform each.

    Parameters
    ----------
    table : float64[N_t + 1], never falling
    n_draws : int >= 1
    seed : int >= 0; the same arguments give the same bits

    Returns
    -------
    float64[n_draws]

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    checks.raise_problems(checks.amount(n_draws=n_draws, n_replicates=1, seed=seed))
    known = np.ascontiguousarray(table, dtype=float)
    if known.ndim != 1 or known.size < 2 or not np.isfinite(known).all():
        raise ValueError(f"table = {table!r}: must be two or more finite numbers")
    if (np.diff(known) < 0.0).any():
        raise ValueError(f"table = {table!r}: must never fall")
    values = np.empty(n_draws)
    through_table(values, known, new_stream(seed, "techniques.draw_from_table"))
    return values


def draw_by_inversion(law: str, *, n_draws: int, seed: int, rate: float = 1.0) -> Floats:
    """Draw values by a cumulative function inverted in closed form (chapter, exercise 1).

    Parameters
    ----------
    law : "exponential", "ramp" or "triangle"
    n_draws : int >= 1
    seed : int >= 0
    rate : float > 0, values are divided by it; for the exponential p(x) = rate exp(-rate x)

    Returns
    -------
    float64[n_draws]

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    checks.raise_problems(checks.one_of("law", law, CLOSED))
    checks.raise_problems(checks.positive("rate", rate))
    checks.raise_problems(checks.amount(n_draws=n_draws, n_replicates=1, seed=seed))
    values = np.empty(n_draws)
    closed_form(values, LAWS.index(law), new_stream(seed, f"techniques.draw_by_inversion {law}"))
    return values / rate
