"""Probing the Kac equation by branching: densities where no histogram has a draw."""

import math

from kacsim import checks
from kacsim.boltzmann import estimators
from kacsim.boltzmann.constants import MAX_NODES
from kacsim.kac import probe_tree
from kacsim.kac.constants import RATE
from kacsim.samplers import declared

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
    tree = {"oversampling": oversampling, "onset": onset, "max_nodes": max_nodes}
    checks.raise_problems(
        checks.finite("v", v),
        checks.not_negative("time", time),
        declared("kac_probe", tree),
        checks.positive("collision_rate", collision_rate),
        estimators.sizes(n_realizations, seed),
    )

    draw = probe_tree.kac_probe(
        v,
        time,
        collision_rate=collision_rate,
        **tree,
    )
    factor = math.exp(-v * v / 3.0) / math.sqrt(3.0 * math.pi)
    return estimators.estimate_from(draw, factor, n_realizations, seed, "kac.estimate_density")
