"""What the Boltzmann paper states on the trap: eqs. (36) to (40), Figs. 9 and 10."""

import math

from kacsim.items import _probes
from kacsim.items._lazy import bkw, estimate, np, second_moment, trap, verdict

N_PHASES, N_RADII, FARTHEST = 2001, 801, 8.0  # of the search for the largest frequencies
FARTHEST_SPEED, N_SPEEDS = 10.0, 10_001
THRESHOLDS = (0.5, 2.0, 5.5)  # of eq. (40), in c_eq / omega: below, at and above its change
ROUNDING = 1e-12  # relative: the largest ratio is 1


def of_fig9(dataset):
    """Test the raised frequencies, and how recursion and variance depend on place and time."""
    settings = dataset.attrs["settings"]
    published = dataset.sel(size="published")
    turns = settings["claim_turn"]
    return [
        _zero_start(dataset, settings),
        _prefactor(),
        _bound(settings),
        _highest(settings),
        _constant(published, settings, turns),
        _place(published, turns),
        _time(published, turns),
        _growth(dataset, settings),
        _far(published, turns),
    ]


def of_fig10(dataset):
    """Test fractions without collisions, eq. (40), and what happens away from the centre."""
    radius = dataset.radius.values
    parts = []
    for turn in dataset.turn.values:
        here = dataset.sel(turn=turn)
        ratio = (here.ballistic / here.exact).values
        worst = float(ratio[np.abs(ratio - 1.0).argmax()])
        parts.append(_exact(worst, f"ωt = {2.0 * turn:g}π", printed=1.0))
    degrees = dataset.attrs["settings"]["n_replicates"] - 1
    change = estimate.Mean(float(dataset.rarefaction), float(dataset.rarefaction_error), degrees)
    first = dataset.isel(turn=0)
    evidence = (
        f"ωt = {2.0 * float(first.turn):g}π, from r0 = {radius[0]:g} to {radius[-1]:g}: the "
        f"fraction falls from {float(first.exact[0]):.2g} to {float(first.exact[-1]):.2g}."
    )
    return [
        verdict.Finding("boltzmann_fig10_ballistic", tuple(parts), "Worst of all radii."),
        verdict.Finding("boltzmann_40_density", _normalized(THRESHOLDS)),
        _falls("boltzmann_fig10_recursion", dataset.sel(size="published"), dataset.turn.values),
        verdict.finding("boltzmann_trap_rarefaction", change, evidence),
    ]


def _exact(value, label="", **known):
    return verdict.Part(estimate.Exact(float(value)), label, **known)


def _state(settings):
    return settings["breathing"], settings["start_phase"]


def _zero_start(dataset, settings):
    """Count the probes at which f is not 0 at the start."""
    radius = dataset.radius.values
    speed = trap.flow(radius, 0.0, *_state(settings))
    ratio = trap.relative_start(radius, speed, 0.0, *_state(settings))
    return verdict.finding("boltzmann_fig9_start", estimate.Exact(float((ratio != 0.0).mean())))


def _prefactor():
    """Return the largest ratio of eq. (18) to its Maxwellian, searched over the speeds."""
    speed = np.linspace(0.0, FARTHEST_SPEED, N_SPEEDS)
    ratio = bkw.density(speed, 0.0) / bkw.maxwellian(speed)
    k = int(ratio.argmax())
    evidence = f"At c = {speed[k]:.3f} c_q."
    printed = (5.0 / 3.0) ** 2.5 / math.e
    exact = estimate.Exact(float(ratio[k]))
    return verdict.finding("boltzmann_37_prefactor", exact, evidence, printed=printed)


def _grid():
    phase = np.linspace(0.0, 2.0 * math.pi, N_PHASES)
    return np.linspace(0.0, FARTHEST, N_RADII)[:, None], phase


def _bound(settings):
    """Count where the collision frequency of the free cloud exceeds the raised one of eq. (36)."""
    radius, phase = _grid()
    real = settings["coupling"] * trap.cloud(radius, phase, *_state(settings))
    real = real * trap.free_relative_cloud(radius, phase, *_state(settings))
    raised = trap.majorant(radius, phase, settings["coupling"], *_state(settings))
    ratio = real / raised
    i, j = np.unravel_index(ratio.argmax(), ratio.shape)
    evidence = (
        f"Without collisions f over the breathing state is carried along, so that it stays below "
        f"the prefactor; real over raised frequency at most {ratio[i, j]:.6f}, at "
        f"r = {radius[i, 0]:.2f}, ωt = {phase[j]:.3f}."
    )
    wrong = estimate.Exact(float((ratio > 1.0 + ROUNDING).mean()))
    return verdict.finding("boltzmann_36_bound", wrong, evidence)


def _highest(settings):
    """Return the maximum of eq. (36) over places and times beside eq. (39)."""
    raised = trap.majorant(*_grid(), settings["coupling"], *_state(settings))
    printed = trap.highest_majorant(settings["breathing"], settings["coupling"])
    exact = estimate.Exact(float(raised.max()))
    return verdict.finding("boltzmann_39_highest", exact, printed=printed)


def _constant(published, settings, turns):
    """Return how much lower the recursion is than with the constant frequency of eq. (38)."""
    rate = trap.highest_majorant(settings["breathing"], settings["coupling"])
    parts = []
    for turn in turns:
        constant = float(trap.constant_recursion(2.0 * math.pi * turn, rate))
        for radius in published.radius.values:
            recursion = _probes.recursion_of(published.sel(radius=radius, turn=turn))
            saved = _probes.gap(recursion.over(constant))
            label = f"r = {radius:g}, ωt = {2.0 * turn:g}π (constant: {constant:.4g})"
            parts.append(verdict.Part(saved, label))
    return verdict.Finding("boltzmann_38_constant", tuple(parts))


def _lower(first, second):
    """Return 1 - second / first of two independent estimates."""
    return _probes.gap(_probes.ratio(second, first))


def _falls(claim, published, turns):
    """Return by which share the recursion is lower at the last radius than at the first."""
    radius, parts = published.radius.values, []
    for turn in turns:
        ends = [_probes.recursion_of(published.sel(turn=turn).isel(radius=k)) for k in (0, -1)]
        parts.append(verdict.Part(_lower(*ends), f"ωt = {2.0 * turn:g}π"))
    evidence = f"From r = {radius[0]:g} to {radius[-1]:g} c_q,eq/ω."
    return verdict.Finding(claim, tuple(parts), evidence)


def _place(published, turns):
    return _falls("boltzmann_recursion_place", published, turns)


def _time(published, turns):
    """Return by which share the recursion is lower at the first time than at the last."""
    parts = []
    for radius in published.radius.values:
        here = published.sel(radius=radius)
        ends = [_probes.recursion_of(here.sel(turn=turns[k])) for k in (-1, 0)]
        parts.append(verdict.Part(_lower(*ends), f"r = {radius:g}"))
    evidence = f"From ωt = {2.0 * turns[0]:g}π to {2.0 * turns[-1]:g}π."
    return verdict.Finding("boltzmann_recursion_time", tuple(parts), evidence)


def _growth(dataset, settings):
    """Return the growth of the variance of f between two half turns."""
    degrees, parts = settings["n_replicates"] - 1, []
    for radius in dataset.radius.values:
        here = dataset.sel(radius=radius)
        grown = estimate.Mean(float(here.growth) - 1.0, float(here.growth_error), degrees)
        parts.append(verdict.Part(grown, f"r = {radius:g}"))
    first, last = (2.0 * turn for turn in settings["growth_turn"])
    evidence = f"From ωt = {first:g}π to {last:g}π, where the breathing state is the same."
    return verdict.Finding("boltzmann_trap_variance_time", tuple(parts), evidence)


def _far(published, turns):
    """Return how far f is from the breathing state at the last time, relative to it."""
    degrees = published.attrs["settings"]["n_replicates"] - 1
    last, parts = published.sel(turn=turns[-1]), []
    for radius in published.radius.values:
        here = last.sel(radius=radius)
        ratio = estimate.Mean(float(here.value), float(here.error), degrees).over(float(here.exact))
        parts.append(verdict.Part(_probes.gap(ratio), f"r = {radius:g}"))
    evidence = (
        f"ωt = {2.0 * turns[-1]:g}π; largest realization's share of a sum "
        f"{float(last.largest_share.max()):.2g}."
    )
    return verdict.Finding("boltzmann_far", tuple(parts), evidence)


def _normalized(thresholds):
    """Return the integral of eq. (40), eq. (19) in c_eq / omega, at each threshold."""
    return tuple(
        _exact(second_moment.normalization(one), f"r0 = {one:g}", printed=1.0) for one in thresholds
    )
