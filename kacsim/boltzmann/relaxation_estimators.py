"""Any isotropic initial law at any time: the public estimators."""

from __future__ import annotations

import math

import numpy as np

from kacsim import checks
from kacsim.boltzmann.estimators import Estimate, estimate_from, length, sizes, vector_of
from kacsim.boltzmann.relaxation import Relaxation
from kacsim.mckean.constants import BKW, METHODS
from kacsim.typed import ArrayLike, HasMgf

NEAR = 0.01  # speeds below it take sinh(z c) / c in place of exp(-z c)
LATEST = 12.0  # mean collision times of whole trees: e**12 leaves


def estimate(factor, unit, probe, time, kind, initial, *, n_realizations, seed, cut, name):
    """Return the Estimate of a quantity of a law that starts anywhere.

    Parameters
    ----------
    factor, unit : callable(z) that multiplies the transform, and a number that multiplies it all
    probe : dict of the name of a speed and its value
    time : in mean collision times
    kind : BKW or KAC

    Raises
    ------
    ValueError, BudgetError
        As `estimate_relaxation`.
    """
    ((axis, v),) = probe.items()
    checks.raise_problems(
        checks.not_negative(axis, v),
        checks.not_negative("time", time),
        checks.not_negative("cut", cut),
        sizes(n_realizations, seed),
    )
    if not hasattr(initial, "mgf"):
        raise ValueError(f"initial = {initial!r}: must be a law such as kacsim.boltzmann.Mixture")
    if cut == 0.0 and time > LATEST:
        raise ValueError(f"time = {time!r}: must be at most {LATEST:g} without a cut")
    draw = Relaxation(initial, factor, float(v), float(time), kind, cut)
    return estimate_from(draw, unit, n_realizations, seed, name, METHODS[0])


def estimate_relaxation(
    velocity: ArrayLike,
    time: float,
    *,
    initial: HasMgf,
    n_realizations: int,
    seed: int,
    cut: float = 0.0,
) -> Estimate:
    """Estimate f(c; t) of Maxwell molecules that start from any isotropic law.

    Parameters
    ----------
    velocity : float (a speed) or float64[3], in the unit of the law
    time : float >= 0, in mean collision times
    initial : `Mixture` of three dimensions, `Transform`, or any object with ``mgf``
    n_realizations : int >= 2
    seed : int >= 0
    cut : float >= 0: subtrees of small shares are replaced by their mean, by a series in moments;
        0 for none. Needed at late times

    Returns
    -------
    Estimate, per unit of velocity cubed

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    BudgetError
        If a tree has too many ends.
    """
    speed = length(vector_of("velocity", velocity))

    def factor(z):
        """Return what makes -g'(c) / c of the density g of a component; the transform is even."""
        if speed >= NEAR:
            return z / speed
        return -z * np.exp(z * speed) * (np.sinh(z * speed) / speed if speed > 0.0 else z)

    sizes_ = {"n_realizations": n_realizations, "seed": seed, "cut": cut}
    name = "boltzmann.estimate_relaxation"
    unit = 0.5 / math.pi
    return estimate(factor, unit, {"velocity": speed}, time, BKW, initial, name=name, **sizes_)


def estimate_relaxation_fraction(
    threshold: float,
    time: float,
    *,
    initial: HasMgf,
    n_realizations: int,
    seed: int,
    cut: float = 0.0,
) -> Estimate:
    """Estimate the fraction of Maxwell molecules faster than a threshold, from any isotropic law.

    Parameters, result and errors as `estimate_relaxation`, with threshold >= 0.
    """
    sizes_ = {"n_realizations": n_realizations, "seed": seed, "cut": cut}
    name = "boltzmann.estimate_relaxation_fraction"
    return estimate(
        lambda z: 2.0 / z + 2.0 * threshold, 1.0, {"threshold": threshold}, time, BKW, initial,
        name=name, **sizes_,
    )  # fmt: skip
