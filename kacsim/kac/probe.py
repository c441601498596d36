"""Probing the Kac equation by branching: densities where no histogram has a draw."""

import math

from kacsim import checks
from kacsim.boltzmann import estimators
from kacsim.boltzmann.constants import MAX_NODES
from kacsim.boltzmann.estimators import Estimate
from kacsim.kac import mckean_tree, probe_tree
from kacsim.kac.constants import RATE
from kacsim.mckean import choice
from kacsim.mckean.constants import KAC, METHODS
from kacsim.samplers import declared

INITIAL_SECOND_MOMENT = 27.0 * 3.0 / 5.0**2.5  # E_M[(f0 / M)**2] = 1.44897


def critical_time(collision_rate=RATE):
    """Return the time from which the variance of one realization is infinite (1.322)."""
    return math.log(INITIAL_SECOND_MOMENT / (INITIAL_SECOND_MOMENT - 1.0)) / collision_rate


def estimate_density(
    v: float,
    time: float,
    *,
    n_realizations: int,
    seed: int,
    oversampling: float = 1.0,
    onset: float = 0.0,
    collision_rate: float = RATE,
    method: str = choice.BRANCHING,
    cut: float = 0.0,
    max_nodes: int = MAX_NODES,
) -> Estimate:
    """Estimate f(v, t) of the Kac equation, by the Boltzmann paper's branching trees or others.

    It is for the paper's f0 and uniform angles: `estimate_relaxation` takes any symmetric one.

    Parameters
    ----------
    v : float
    time : float >= 0
    n_realizations : int >= 2
    seed : int >= 0
    oversampling, onset : float, mean number of sub-estimates that replace each one, and the time
        from which on; needed from `critical_time` on
    collision_rate : float > 0
    method, cut : as `kacsim.boltzmann.estimate_bkw`
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
        choice.problems(method, cut, tree),
        estimators.sizes(n_realizations, seed),
    )
    span = collision_rate * time
    method, own = choice.chosen(method, {"v": abs(v)}, span, KAC, cut, tree)

    bind = probe_tree.kac_probe if method == choice.BRANCHING else mckean_tree.kac_ancestral
    draw = bind(v, time, collision_rate=collision_rate, **own)
    factor = math.exp(-v * v / 3.0) / math.sqrt(3.0 * math.pi)
    name = "kac.estimate_density"
    return estimators.estimate_from(draw, factor, n_realizations, seed, name, method)


def estimate_tail(
    v: float,
    time: float,
    *,
    n_realizations: int,
    seed: int,
    collision_rate: float = RATE,
    method: str = choice.BEST,
    cut: float = 0.0,
    max_nodes: int = MAX_NODES,
) -> Estimate:
    """Estimate P(v_1(t) > v) of the Kac equation by McKean's trees (docs/ancestral_trees.md).

    It is for the paper's f0 and uniform angles: `estimate_relaxation_tail` takes any symmetric one.
    Parameters, result and errors as `estimate_density`, with v >= 0 and without branching.
    """
    tree = {**choice.PLAIN, "max_nodes": max_nodes}
    checks.raise_problems(
        checks.not_negative("v", v),
        checks.not_negative("time", time),
        checks.one_of("method", method, (choice.BEST, *METHODS)),
        checks.not_negative("cut", cut),
        checks.positive("collision_rate", collision_rate),
        checks.count("max_nodes", max_nodes),
        estimators.sizes(n_realizations, seed),
    )
    method, own = choice.chosen(method, {"v": v}, collision_rate * time, KAC, cut, tree)

    draw = mckean_tree.kac_tail_ancestral(v, time, collision_rate=collision_rate, **own)
    return estimators.estimate_from(draw, 1.0, n_realizations, seed, "kac.estimate_tail", method)
