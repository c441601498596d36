"""The public estimators of the harmonic trap: Algorithms 5, 6 and 7 in physical units."""

from __future__ import annotations

import numpy as np

from kacsim import checks
from kacsim.boltzmann import trap, trap_tree
from kacsim.boltzmann.constants import BREATHING, MAX_NODES
from kacsim.boltzmann.estimators import Estimate, estimate_from, length, product, sizes, vector_of
from kacsim.boltzmann.samplers import phase
from kacsim.samplers import declared
from kacsim.typed import ArrayLike

PUBLISHED = {"majorant_factor": 1.0, "spread": 1.0, "anisotropy": 0.0}  # laws of the text


def _scaled(gas):
    """Return (unit of length, coupling of the reduced problem); ValueError names a wrong one."""
    checks.raise_problems(*(checks.positive(name, value) for name, value in gas.items()))
    unit = gas["rms_velocity"] / gas["angular_frequency"]
    return unit, gas["amount"] * gas["cross_section"] / unit**2 / gas["rms_velocity"]


def _turned(angular_frequency, time):
    """Return the phase omega t; ValueError if it is too large."""
    turned = float(angular_frequency * time)
    checks.raise_problems(phase("angular_frequency * time", turned))
    return turned


def estimate_trap(
    position: ArrayLike,
    velocity: ArrayLike,
    time: float,
    *,
    n_realizations: int,
    seed: int,
    initial: str = "bkw",
    breathing: float = BREATHING,
    start_phase: float = 0.0,
    angular_frequency: float = 1.0,
    rms_velocity: float = 1.0,
    amount: float = 1.0,
    cross_section: float = 3.0,
    majorant_factor: float = 1.0,
    spread: float = 1.0,
    anisotropy: float = 0.0,
    max_nodes: int = MAX_NODES,
) -> Estimate:
    """Estimate f(r; c; t) in the harmonic trap by Algorithm 6, or 5 (sections IV and V).

    Parameters
    ----------
    position, velocity : float (along one axis) or float64[3]
    time : float >= 0
    n_realizations, seed, max_nodes : as `estimate_bkw`
    initial : "bkw" (Algorithm 6) or "breathing" (Algorithm 5: every realization is exact)
    breathing, start_phase : eps in [0, 1) and phi0 of eq. (31)
    angular_frequency, rms_velocity : omega and c_eq
    amount, cross_section : n and kappa; n kappa omega**2 / c_eq**3 is 3 in the text
    majorant_factor, spread, anisotropy : other sampling laws of the raised frequency, of c* and
        of u'; the mean does not depend on them

    Returns
    -------
    Estimate, amount per unit of length cubed and velocity cubed

    Raises
    ------
    ValueError, BudgetError
        As `estimate_bkw`.
    """
    place, speed = vector_of("position", position), vector_of("velocity", velocity)
    gas = {
        "amount": amount,
        "cross_section": cross_section,
        "angular_frequency": angular_frequency,
        "rms_velocity": rms_velocity,
    }
    laws = {
        "initial": initial,
        "breathing": breathing,
        "start_phase": start_phase,
        "majorant_factor": majorant_factor,
        "spread": spread,
        "anisotropy": anisotropy,
        "max_nodes": max_nodes,
    }
    checks.raise_problems(
        checks.not_negative("time", time), declared("trap", laws), sizes(n_realizations, seed)
    )
    unit, coupling = _scaled(gas)
    turned = _turned(angular_frequency, time)
    radius = length(place) / unit
    along = place / length(place) if radius > 0.0 else np.array([1.0, 0.0, 0.0])
    outward = product(speed, along)
    radial, tangential = outward / rms_velocity, length(speed - outward * along) / rms_velocity
    draw = trap_tree.at(radius, radial, tangential, turned, coupling=coupling, **laws)
    state = trap.breathing_density(radius, radial, tangential, turned, breathing, start_phase)
    factor = amount * float(state) / (unit * rms_velocity) ** 3
    return estimate_from(draw, factor, n_realizations, seed, "boltzmann.estimate_trap")


def estimate_trap_fraction(
    radius: float,
    time: float,
    *,
    n_realizations: int,
    seed: int,
    initial: str = "bkw",
    breathing: float = BREATHING,
    start_phase: float = 0.0,
    angular_frequency: float = 1.0,
    rms_velocity: float = 1.0,
    amount: float = 1.0,
    cross_section: float = 3.0,
    max_nodes: int = MAX_NODES,
) -> Estimate:
    """Estimate the fraction of matter with |r| > radius by Algorithm 7 and eq. (40).

    Parameters, result and errors as `estimate_trap`, with radius >= 0 in place of the probe.
    """
    gas = {
        "amount": amount,
        "cross_section": cross_section,
        "angular_frequency": angular_frequency,
        "rms_velocity": rms_velocity,
    }
    laws = PUBLISHED | {
        "initial": initial,
        "breathing": breathing,
        "start_phase": start_phase,
        "max_nodes": max_nodes,
    }
    checks.raise_problems(
        checks.not_negative("radius", radius),
        checks.not_negative("time", time),
        declared("trap_fraction", laws),
        sizes(n_realizations, seed),
    )
    unit, coupling = _scaled(gas)
    turned = _turned(angular_frequency, time)
    draw = trap_tree.trap_fraction(radius / unit, turned, coupling=coupling, **laws)
    return estimate_from(draw, 1.0, n_realizations, seed, "boltzmann.estimate_trap_fraction")
