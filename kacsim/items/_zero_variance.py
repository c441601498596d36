"""Starts from which every realization is exact (Boltzmann paper, sections II d and IV b)."""

import math

from kacsim.items import _probes, _trap
from kacsim.items._lazy import estimate, np, verdict

# Two choices each of the raised frequency, of the law of c* and of that of u'.
CHOICES = (
    {"majorant_factor": 1.0, "spread": 1.0, "anisotropy": 0.0},
    {"majorant_factor": 1.5, "spread": 1.0, "anisotropy": 0.0},
    {"majorant_factor": 1.0, "spread": 1.2, "anisotropy": 0.0},
    {"majorant_factor": 1.0, "spread": 1.0, "anisotropy": 0.5},
)


def grid(settings):
    """Return name -> case: Algorithm 2 as printed, Algorithm 5 as printed and with other laws."""
    state = {key: settings[key] for key in _trap.STATE}
    place = {"radius": [settings["radius"]], "time": [2.0 * math.pi * settings["turn"][0]]}
    found = {
        "equilibrium": _probes.case(
            settings,
            "bkw_literal",
            speed=settings["equilibrium_speed"],
            time=settings["time"],
            initial="equilibrium",
        ),
        "literal": _probes.case(settings, "trap_literal", initial="breathing", **place),
    }
    for k, choices in enumerate(CHOICES):
        laws = state | choices | place
        found[f"breathing_{k}"] = _probes.case(settings, "trap", initial="breathing", **laws)
    return found


def findings(samples, settings):
    """Count realizations that are not the exact value, 1 in the units of the kernels."""
    cases = grid(settings)
    first = cases.pop("equilibrium")
    laws = f"Algorithm 5 as printed, and its reduced form with {len(CHOICES)} choices of laws"
    return [
        _finding("boltzmann_equilibrium", "Algorithm 2 as printed", [first], samples, settings),
        _finding("boltzmann_breathing", laws, list(cases.values()), samples, settings),
    ]


def _finding(claim, what, cases, samples, settings):
    wrong, total, worst = 0, 0, 0.0
    for case in cases:
        departures = [np.abs(samples[case.id][name].values - 1.0) for name in ("top", "mean")]
        wrong += sum(int((one > settings["rounding"]).sum()) for one in departures)
        worst = max(worst, *(float(one.max()) for one in departures))
        total += departures[1].size * case.n_draws
    evidence = (
        f"{what}: {total:,} realizations, the largest ones and the means of all; largest relative "
        f"departure {estimate.within(worst, settings['rounding'])}."
    )
    return verdict.finding(claim, estimate.Share(wrong, total), evidence)
