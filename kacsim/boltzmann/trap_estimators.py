"""The public estimators of the harmonic trap: Algorithms 5, 6 and 7 in physical units."""

import numpy as np

from kacsim import checks, checks_boltzmann
from kacsim.boltzmann import trap, trap_tree
from kacsim.boltzmann.estimators import MAX_NODES, check, estimate_from, sizes, vector_of
from kacsim.checks import BREATHING


def _problems(physics, choices):
    for name in ("amount", "cross_section", "angular_frequency", "rms_velocity"):
        yield from checks.positive(name, physics[name])
    yield from checks_boltzmann.breathing("breathing", physics["breathing"])
    yield from checks.finite("start_phase", physics["start_phase"])
    yield from checks.one_of("initial", physics["initial"], checks_boltzmann.STARTS)
    yield from checks_boltzmann.trap_choices(**choices)


def _units(physics):
    """Return (kernel physics, unit of length) from physical parameters."""
    length = physics["rms_velocity"] / physics["angular_frequency"]
    coupling = physics["amount"] * physics["cross_section"] / length**2 / physics["rms_velocity"]
    start = 1.0 if physics["initial"] == "bkw" else 0.0
    return (coupling, physics["breathing"], physics["start_phase"], start), length


def estimate_trap(
    position,
    velocity,
    time,
    *,
    n_realizations,
    seed,
    initial="bkw",
    breathing=BREATHING,
    start_phase=0.0,
    angular_frequency=1.0,
    rms_velocity=1.0,
    amount=1.0,
    cross_section=3.0,
    majorant_factor=1.0,
    spread=1.0,
    anisotropy=0.0,
    max_nodes=MAX_NODES,
):
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
    physics = {
        "initial": initial,
        "breathing": breathing,
        "start_phase": start_phase,
        "angular_frequency": angular_frequency,
        "rms_velocity": rms_velocity,
        "amount": amount,
        "cross_section": cross_section,
    }
    choices = {"majorant_factor": majorant_factor, "spread": spread, "anisotropy": anisotropy}
    check(
        checks.not_negative("time", time),
        _problems(physics, choices),
        sizes(n_realizations, seed, max_nodes),
    )
    reduced, length = _units(physics)
    radius = float(np.linalg.norm(place)) / length
    along = place / np.linalg.norm(place) if radius > 0.0 else np.array([1.0, 0.0, 0.0])
    radial = float(speed @ along) / rms_velocity
    tangential = float(np.linalg.norm(speed - (speed @ along) * along)) / rms_velocity
    phase = float(angular_frequency * time)
    laws = trap.MAJORANT * majorant_factor, float(spread), float(anisotropy)

    def draw(values, nodes, stream):
        probe = radius, radial, tangential, phase
        return trap_tree.estimate(values, nodes, *probe, reduced, laws, max_nodes, stream)

    state = trap.breathing_density(radius, radial, tangential, phase, breathing, start_phase)
    factor = amount * float(state) / (length * rms_velocity) ** 3
    return estimate_from(draw, factor, n_realizations, seed, "boltzmann.estimate_trap")


def estimate_trap_fraction(
    radius,
    time,
    *,
    n_realizations,
    seed,
    initial="bkw",
    breathing=BREATHING,
    start_phase=0.0,
    angular_frequency=1.0,
    rms_velocity=1.0,
    amount=1.0,
    cross_section=3.0,
    max_nodes=MAX_NODES,
):
    """Estimate the fraction of matter with |r| > radius by Algorithm 7 and eq. (40).

    Parameters, result and errors as `estimate_trap`, with radius >= 0 in place of the probe.
    """
    physics = {
        "initial": initial,
        "breathing": breathing,
        "start_phase": start_phase,
        "angular_frequency": angular_frequency,
        "rms_velocity": rms_velocity,
        "amount": amount,
        "cross_section": cross_section,
    }
    check(
        checks.not_negative("radius", radius),
        checks.not_negative("time", time),
        _problems(physics, checks_boltzmann.PUBLISHED_CHOICES),
        sizes(n_realizations, seed, max_nodes),
    )
    reduced, length = _units(physics)
    laws = trap.MAJORANT, 1.0, 0.0

    def draw(values, nodes, stream):
        probe = radius / length, float(angular_frequency * time)
        return trap_tree.estimate_fraction(values, nodes, *probe, reduced, laws, max_nodes, stream)

    return estimate_from(draw, 1.0, n_realizations, seed, "boltzmann.estimate_trap_fraction")
