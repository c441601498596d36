"""Any symmetric initial law on Kac's line, at any time."""

from __future__ import annotations

from kacsim import checks
from kacsim.boltzmann.estimators import Estimate
from kacsim.boltzmann.relaxation_estimators import estimate
from kacsim.kac.constants import RATE
from kacsim.mckean.constants import KAC
from kacsim.typed import HasMgf


def estimate_relaxation(
    v: float,
    time: float,
    *,
    initial: HasMgf,
    n_realizations: int,
    seed: int,
    collision_rate: float = RATE,
    cut: float = 0.0,
) -> Estimate:
    """Estimate f(v, t) of the Kac equation that starts from any symmetric law, for uniform angles.

    Parameters
    ----------
    v : float
    time : float >= 0
    initial : `kacsim.boltzmann.Mixture` of one dimension, `Transform`, or any object with ``mgf``
    n_realizations, seed, cut : as `kacsim.boltzmann.estimate_relaxation`
    collision_rate : float > 0

    Returns
    -------
    kacsim.boltzmann.Estimate

    Raises
    ------
    ValueError, kacsim.boltzmann.BudgetError
        As `kacsim.boltzmann.estimate_relaxation`.
    """
    checks.raise_problems(checks.finite("v", v), checks.positive("collision_rate", collision_rate))
    return _estimate(
        lambda z: 1.0 + 0.0 * z, abs(v), time, initial, collision_rate, "estimate_relaxation",
        n_realizations=n_realizations, seed=seed, cut=cut,
    )  # fmt: skip


def estimate_relaxation_tail(
    v: float,
    time: float,
    *,
    initial: HasMgf,
    n_realizations: int,
    seed: int,
    collision_rate: float = RATE,
    cut: float = 0.0,
) -> Estimate:
    """Estimate P(v_1(t) > v) of the Kac equation from any symmetric law, for uniform angles.

    Parameters, result and errors as `estimate_relaxation`, with v >= 0.
    """
    checks.raise_problems(checks.positive("collision_rate", collision_rate))
    return _estimate(
        lambda z: 1.0 / z, v, time, initial, collision_rate, "estimate_relaxation_tail",
        n_realizations=n_realizations, seed=seed, cut=cut,
    )  # fmt: skip


def _estimate(factor, v, time, initial, collision_rate, name, **sizes):
    checks.raise_problems(checks.not_negative("time", time))
    span = collision_rate * time
    return estimate(factor, 1.0, {"v": v}, span, KAC, initial, name=f"kac.{name}", **sizes)
