"""The public estimators of the BKW mode and of extinction: checked arguments, physical units."""

from __future__ import annotations

from kacsim import checks
from kacsim.boltzmann import bkw, bkw_tree, mckean_tree, null_collisions
from kacsim.boltzmann.constants import MAX_NODES
from kacsim.boltzmann.estimators import Estimate, estimate_from, length, sizes, vector_of
from kacsim.mckean import choice
from kacsim.mckean.constants import BKW
from kacsim.samplers import declared
from kacsim.typed import ArrayLike


def estimate_bkw(
    velocity: ArrayLike,
    time: float,
    *,
    n_realizations: int,
    seed: int,
    rms_velocity: float = 1.0,
    oversampling: float = 1.0,
    onset: float = 0.0,
    method: str = choice.BRANCHING,
    cut: float = 0.0,
    max_nodes: int = MAX_NODES,
) -> Estimate:
    """Estimate f(c; t) of the BKW mode: by Algorithm 2 (Boltzmann paper, section II), or others.

    Parameters
    ----------
    velocity : float (a speed) or float64[3], in the unit of rms_velocity
    time : float >= 0, in mean collision times
    n_realizations : int >= 2
    seed : int >= 0
    rms_velocity : float > 0, c_q, per axis
    oversampling : float >= 1, mean number of sub-estimates that replace each one; 1 as published
    onset : float >= 0, collisions before this time are not oversampled
    method : "branching" is the paper's, of infinite variance from `bkw.critical_time` on. By trees
        of McKean's (docs/ancestral_trees.md), of finite variance at every time: "ancestral"
        integrates all leaves out, "free_leaf" one of them, "geometric" too, with a geometric
        number of leaves. "best" takes the one that serves, and the result says which
    cut : float >= 0, of "ancestral": subtrees of shares below cut / (beta eta**2) are replaced by
        their mean, which is the law that is estimated; 0 for none
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
    tree = {"oversampling": oversampling, "onset": onset, "max_nodes": max_nodes}
    speed = length(vector_of("velocity", velocity))
    checks.raise_problems(
        checks.not_negative("time", time),
        checks.positive("rms_velocity", rms_velocity),
        declared("bkw", tree),
        choice.problems(method, cut, tree),
        sizes(n_realizations, seed),
    )
    unit = speed / rms_velocity
    method, own = choice.chosen(method, {"velocity": unit}, time, BKW, cut, tree, at_speed=True)

    bind = bkw_tree.bkw if method == choice.BRANCHING else mckean_tree.bkw_ancestral
    factor = float(bkw.maxwellian(speed, rms_velocity))
    name = "boltzmann.estimate_bkw"
    return estimate_from(bind(unit, time, **own), factor, n_realizations, seed, name, method)


def estimate_bkw_fraction(
    threshold: float,
    time: float,
    *,
    n_realizations: int,
    seed: int,
    rms_velocity: float = 1.0,
    oversampling: float = 1.0,
    onset: float = 0.0,
    method: str = choice.BRANCHING,
    cut: float = 0.0,
    max_nodes: int = MAX_NODES,
) -> Estimate:
    """Estimate the fraction of particles with |c| > threshold by Algorithm 3 and eq. (19).

    Parameters, result and errors as `estimate_bkw`, with threshold >= 0 in place of velocity.
    """
    tree = {"oversampling": oversampling, "onset": onset, "max_nodes": max_nodes}
    checks.raise_problems(
        checks.not_negative("threshold", threshold),
        checks.not_negative("time", time),
        checks.positive("rms_velocity", rms_velocity),
        declared("bkw", tree),
        choice.problems(method, cut, tree),
        sizes(n_realizations, seed),
    )
    unit = threshold / rms_velocity
    method, own = choice.chosen(method, {"threshold": unit}, time, BKW, cut, tree)

    branching = method == choice.BRANCHING
    bind = bkw_tree.bkw_fraction if branching else mckean_tree.bkw_fraction_ancestral
    name = "boltzmann.estimate_bkw_fraction"
    return estimate_from(bind(unit, time, **own), 1.0, n_realizations, seed, name, method)


def estimate_extinction(
    time: float,
    *,
    n_realizations: int,
    seed: int,
    rate: float,
    initial: float,
    majorant: float,
    max_nodes: int = MAX_NODES,
) -> Estimate:
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
    checks.raise_problems(
        checks.not_negative("time", time),
        checks.positive("rate", rate),
        checks.positive("initial", initial),
        checks.positive("majorant", majorant),
        declared("extinction", {"max_nodes": max_nodes}),
        sizes(n_realizations, seed),
    )
    scale = rate * initial

    draw = null_collisions.extinction(majorant / scale, scale * time, max_nodes=max_nodes)
    return estimate_from(draw, initial, n_realizations, seed, "boltzmann.estimate_extinction")
