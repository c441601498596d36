"""Runs of their own for what the Boltzmann paper states: tiny fractions, and a bound too low."""

import math

from kacsim.cases import make_case
from kacsim.items import _probes, _trap
from kacsim.items._lazy import bkw, estimate, extinction, np, trap, verdict

MISS = 0.25  # share of its value by which an estimate may be off and still quantify it


def grid(settings):
    """Return name -> case."""
    state = {key: settings[key] for key in _trap.STATE} | {"initial": "bkw"}
    budget = {"max_nodes": settings["max_nodes"]}
    seed = {"seed": settings["seed"]}

    def size(n_draws, n_replicates="n_replicates"):
        return seed | {"n_draws": settings[n_draws], "n_replicates": settings[n_replicates]}

    published = [2.0 * math.pi * turn for turn in settings["published_turn"]]
    return {
        "billionth": make_case(
            "bkw_fraction",
            **size("billionth_n_draws"),
            threshold=[settings["billionth_threshold"]],
            time=settings["time"][:1],
            **budget,
        ),
        "millionth": make_case(
            "trap_fraction",
            **size("published_n_draws", "millionth_n_replicates"),
            radius=[settings["millionth_radius"]],
            time=published,
            **state,
        ),
        "quarter": make_case(
            "trap_fraction",
            **size("published_n_draws"),
            radius=[settings["quarter_radius"]],
            time=[0.5 * math.pi],
            **state,
        ),
        "low": make_case(
            "extinction",
            **size("published_n_draws", "low_n_replicates"),
            majorant=[settings["low_majorant"]],
            time=[settings["low_time"]],
            **budget,
        ),
    }


def findings(samples, settings):
    """Return what these runs tell."""
    cases = grid(settings)
    drawn = {name: samples[case.id] for name, case in cases.items()}
    return [
        _billionth(drawn["billionth"], settings),
        _millionth(drawn["millionth"], settings),
        _macroscopic(drawn["quarter"], settings),
        _low(drawn["low"], cases["low"], settings),
    ]


def _billionth(sample, settings):
    """Return the mean of Algorithm 3 over the exact tiny fraction."""
    threshold, time = settings["billionth_threshold"], settings["time"][0]
    exact = float(bkw.fraction(threshold, time))
    mean = estimate.of_replicates(sample["mean"].values[0, 0]).over(exact)
    evidence = f"Beyond c0 = {threshold:g} c_q at t = {time:g} there is {exact:.3e} of the gas."
    return verdict.finding("boltzmann_billionth_mean", mean, evidence, printed=1.0)


def _millionth(sample, settings):
    """Count the estimates of the published size that miss the mean of all by a quarter."""
    parts = []
    for j, turn in enumerate(settings["published_turn"]):
        values = sample["mean"].values[0, j]
        missed = int((np.abs(values / values.mean() - 1.0) > MISS).sum())
        label = f"ωt = {2.0 * turn:g}π, fraction {values.mean():.3g}"
        parts.append(verdict.Part(estimate.Share(missed, values.size), label))
    evidence = (
        f"Beyond r0 = {settings['millionth_radius']:g} c_q,eq/ω; estimates of "
        f"{settings['published_n_draws']:,} realizations that miss by {MISS:g} of the value."
    )
    return verdict.Finding("boltzmann_millionth", tuple(parts), evidence)


def _macroscopic(sample, settings):
    """Return by which share the matter beyond a radius is less than in the breathing state."""
    radius, state = settings["quarter_radius"], (settings["breathing"], settings["start_phase"])
    exact = float(trap.fraction(radius, 0.5 * np.pi, *state))
    ratio = estimate.of_replicates(sample["mean"].values[0, 0]).over(exact)
    shape = trap.free_shape(0.5 * np.pi, *state)
    free = float(trap.fraction(radius, 0.5 * np.pi, *state, shape)) / exact
    evidence = (
        f"Beyond r = {radius:g} c_q,eq/ω at a quarter turn, ωt = π/2; without collisions the "
        f"matter there is {free:.3f} of that in the breathing state."
    )
    return verdict.finding("boltzmann_macroscopic", _probes.gap(ratio), evidence)


def _low(sample, case, settings):
    """Count the bars of Algorithm 4 that cover where its variance is infinite."""
    time, majorant = settings["low_time"], settings["low_majorant"]
    exact = np.full((1, 1), extinction.density(time, 1.0, 1.0))
    covered = int(_probes.covering(sample, case, exact)[0, 0])
    largest = float(np.abs(sample["top"].values).max())
    evidence = (
        f"ν̂ = {majorant:g} αf₀ at t = {time:g}, infinite from {majorant / (1.0 - majorant):g} on; "
        f"largest realization {largest:.2g} f₀, where f = {float(exact[0, 0]):.3f} f₀."
    )
    share = estimate.Share(covered, case.n_replicates)
    return verdict.finding("boltzmann_29b_run", share, evidence)
