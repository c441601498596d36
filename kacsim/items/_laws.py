"""Checks of our own Algorithms 6 and 7: other sampling laws, all matter, all energy."""

import math

from kacsim.cases import make_case
from kacsim.items import _probes, _trap
from kacsim.items._lazy import estimate, verdict
from kacsim.items._zero_variance import CHOICES

WHOLE = {"mass": ("trap_fraction", 1.0), "energy": ("trap_energy", 3.0)}  # sampler, exact value
NAMES = ("majorant", "spread", "anisotropy")  # what a choice of laws changes


def grid(settings):
    """Return name -> case: every choice of laws at one probe, and the whole cloud."""
    state = {key: settings[key] for key in _trap.STATE} | {"initial": "bkw"}
    turns = [2.0 * math.pi * turn for turn in settings["turn"]]
    size = {"n_replicates": settings["n_replicates"], "seed": settings["seed"]}
    found = {}
    for k, choices in enumerate(CHOICES):
        place = {"radius": [settings["radius"]], "time": turns[:1]}
        laws = state | choices | place
        found[k] = make_case("trap", n_draws=settings["choice_n_draws"], **size, **laws)
    for name, (sampler, _) in WHOLE.items():
        place = {"radius": [0.0], "time": turns}
        found[name] = _probes.case(settings, sampler, "large", **(state | place))
    return found


def findings(samples, settings):
    """Compare means under other laws with those of the text, and the whole cloud with its sums."""
    cases = grid(settings)
    means = {
        name: [
            estimate.of_replicates(samples[case.id]["mean"].values[0, j])
            for j in range(len(case.parameters["time"]))
        ]
        for name, case in cases.items()
    }
    (base,), found = means[0], []
    for k, name in enumerate(NAMES, 1):
        ratio = _probes.ratio(means[k][0], base)
        evidence = f"{name} {CHOICES[k][_key(name)]:g} against {CHOICES[0][_key(name)]:g}."
        found.append(verdict.finding(f"boltzmann_choice_{name}", ratio, evidence, printed=1.0))
    for name, (_, exact) in WHOLE.items():
        parts = [
            verdict.Part(mean, f"ωt = {2.0 * turn:g}π", printed=exact)
            for mean, turn in zip(means[name], settings["turn"], strict=True)
        ]
        found.append(verdict.Finding(f"boltzmann_{name}", tuple(parts)))
    return found


def _key(name):
    return "majorant_factor" if name == "majorant" else name
