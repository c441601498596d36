"""Probing the Kac equation by branching: densities where no histogram has a draw."""

import math

from kacsim import checks
from kacsim.boltzmann import estimators, kac_tree
from kacsim.checks import MAX_NODES, RATE

THERMAL = math.sqrt(1.5)  # RMS velocity of eq. (9)
INITIAL_SECOND_MOMENT = 27.0 * 3.0 / 5.0**2.5  # E_M[(f0 / M)**2] = 1.44897


def critical_time(collision_rate=RATE):
    """Return the time from which the variance of one realization is infinite (1.322)."""
    return math.log(INITIAL_SECOND_MOMENT / (INITIAL_SECOND_MOMENT - 1.0)) / collision_rate


def estimate_density(
    v,
    time,
    *,
    n_realizations,
    seed,
    oversampling=1.0,
    onset=0.0,
    collision_rate=RATE,
    max_nodes=MAX_NODES,
):
    """Estimate f(v, t) of the Kac equation by the Boltzmann paper's branching trees.

    Parameters
    ----------
    v : float
    time : float >= 0
    n_realizations : int >= 2
    seed : int >= 0
    oversampling, onset : float, mean number of sub-estimates that replace each one, and the time
        from which on; needed from `critical_time` on
    collision_rate : float > 0
    max_nodes : int, budget of one tree

    Returns
    -------
    kacsim.boltzmann.Estimate

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    kacsim.boltzmann.BudgetError
        If a tree exceeds max_nodes.
    """
    estimators.check(
        checks.finite("v", v),
        checks.not_negative("time", time),
        checks.at_least("oversampling", oversampling, 1.0),
        checks.not_negative("onset", onset),
        checks.positive("collision_rate", collision_rate),
        estimators.sizes(n_realizations, seed, max_nodes),
    )

    def draw(values, nodes, stream):
        probe = abs(v) / THERMAL, float(collision_rate * time)
        more = float(oversampling), float(collision_rate * onset)
        return kac_tree.estimate(values, nodes, *probe, *more, max_nodes, stream)

    factor = math.exp(-v * v / 3.0) / math.sqrt(3.0 * math.pi)
    return estimators.estimate_from(draw, factor, n_realizations, seed, "kac.estimate_density")
