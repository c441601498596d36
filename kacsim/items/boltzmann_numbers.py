"""Every number and every checkable claim of the Boltzmann paper: published, measured, verdict."""

import math

from kacsim.items import _claims, _probes, _trap
from kacsim.items._lazy import bkw, estimate, extinction, np, trap, verdict

USES = ("boltzmann_variance",)


def _grid(settings):
    """Return name -> case of everything that the claims need beyond the figures."""
    make, found = _probes.case, {}
    budget = {"max_nodes": settings["max_nodes"]}
    ends = [settings["common_speed"], settings["rare_speed"]]
    found["rare"] = make(settings, "bkw", "large", speed=ends, time=settings["time"], **budget)
    found["equilibrium"] = make(
        settings, "bkw_literal", speed=[1.0], time=settings["time"], initial="equilibrium"
    )
    found["billionth"] = make(
        settings,
        "bkw_fraction",
        "large",
        threshold=[settings["billionth_threshold"]],
        time=settings["time"][:1],
        **budget,
    )
    found["extinction"] = make(
        settings,
        "extinction",
        "large",
        majorant=settings["majorant"],
        time=[settings["extinction_time"]],
        **budget,
    )
    turns = [2.0 * math.pi * turn for turn in settings["turn"]]
    state = {key: settings[key] for key in _trap.STATE}
    found["literal"] = make(
        settings, "trap_literal", initial="breathing", radius=[settings["radius"]], time=turns[:1]
    )
    for k, choices in enumerate(CHOICES):
        common = state | choices | {"radius": [settings["radius"]], "time": turns[:1]}
        found[f"breathing_{k}"] = make(settings, "trap", initial="breathing", **common)
        found[f"choice_{k}"] = make(settings, "trap", "large", initial="bkw", **common)
    common = state | {"radius": [0.0], "time": turns, "initial": "bkw"}
    found["mass"] = make(settings, "trap_fraction", "large", **common)
    found["energy"] = make(settings, "trap_energy", "large", **common)
    places = [0.0, settings["radius"]]
    found["places"] = make(settings, "trap", **(common | {"radius": places}))
    beyond = [settings["millionth_radius"]]
    found["millionth"] = make(
        settings, "trap_fraction", "large", **(common | {"radius": beyond, "time": turns[-1:]})
    )
    return found


# Two choices each of the raised frequency, of the law of c* and of that of u'.
CHOICES = (
    {"majorant_factor": 1.0, "spread": 1.0, "anisotropy": 0.0},
    {"majorant_factor": 1.5, "spread": 1.0, "anisotropy": 0.0},
    {"majorant_factor": 1.0, "spread": 1.2, "anisotropy": 0.0},
    {"majorant_factor": 1.0, "spread": 1.0, "anisotropy": 0.5},
)


def cases(settings):
    """Return the cases of the claims, and those of the study of the variance."""
    return [*_grid(settings).values(), *_claims.cases(USES, settings)]


def reduce(samples, settings):
    """Return one row per claim with its statistic and verdict."""
    grid = _grid(settings)
    findings = _findings(samples, grid, settings) + _claims.findings(USES, samples, settings)
    return _claims.table(("boltzmann_numbers", *USES), findings)


draw = _claims.draw


def _findings(samples, grid, settings):
    def summary(name):
        return _probes.summary(samples[grid[name].id], grid[name])

    def mean_of(name, j=0):
        """Return (mean, standard error) at the first place and the j-th time."""
        found = summary(name)
        return float(found.mean[0, j]), float(found.error[0, j])

    def row(claim, measured, error=0.0, **others):
        return verdict.Finding(claim, float(measured), float(error), **others)

    times = settings["time"]
    found = []
    for j, time in enumerate(times):
        rare = summary("rare")
        mean, variance = rare.mean[:, j], rare.variance[:, j]
        ratio = math.sqrt(variance[1] / variance[0]) * mean[0] / mean[1]
        spread = _ratio_error(samples[grid["rare"].id], j)
        fall = bkw.density(settings["common_speed"], time) / bkw.density(
            settings["rare_speed"], time
        )
        if time < bkw.critical_time():  # beyond, the ratio of two infinite variances
            found.append(
                row(
                    "boltzmann_rarefaction",
                    ratio,
                    spread,
                    evidence=f"t = {time:g}, from c = {settings['common_speed']:g} c_q to "
                    f"{settings['rare_speed']:g} c_q, where f is {fall:.2g} times smaller.",
                )
            )
        recursion = _recursion(samples[grid["rare"].id], 0, j)
        found.append(
            row(
                f"boltzmann_recursion_{j + 1}",
                recursion.value,
                recursion.standard_error,
                printed=float(bkw.mean_recursion(time)),
                evidence=f"t = {time:g}.",
            )
        )
    wrong = _largest_spread(samples[grid["equilibrium"].id])
    found.append(
        row(
            "boltzmann_equilibrium",
            float(wrong > settings["rounding"]),
            evidence=f"Largest relative departure of a realization {wrong:.1e}, printed algorithm.",
        )
    )
    names = ["literal", *(f"breathing_{k}" for k in range(len(CHOICES)))]
    wrong = max(_largest_spread(samples[grid[name].id]) for name in names)
    found.append(
        row(
            "boltzmann_breathing",
            float(wrong > settings["rounding"]),
            evidence=f"Largest relative departure {wrong:.1e}, printed algorithm; reduced one with "
            f"{len(CHOICES)} choices of laws.",
        )
    )
    for claim, name, exact in (
        (
            "boltzmann_billionth",
            "billionth",
            float(bkw.fraction(settings["billionth_threshold"], times[0])),
        ),
        ("boltzmann_millionth", "millionth", _millionth(settings)),
    ):
        mean, error = mean_of(name)
        found.append(row(claim, mean, error, printed=exact, evidence=f"Exact {exact:.3e}."))
    for i, majorant in enumerate(settings["majorant"]):
        found += _extinction(samples, grid, settings, i, majorant)
    base, base_error = mean_of("choice_0")
    for k, name in ((1, "majorant"), (2, "spread"), (3, "anisotropy")):
        other, error = mean_of(f"choice_{k}")
        found.append(row(f"boltzmann_choice_{name}", other - base, math.hypot(error, base_error)))
    for j, turn in enumerate(settings["turn"]):
        for name in ("mass", "energy"):
            mean, error = mean_of(name, j)
            found.append(
                row(
                    f"boltzmann_{name}_{j + 1}",
                    mean,
                    error,
                    evidence=f"ωt = {2 * turn:g}π.",
                )
            )
    sample = samples[grid["places"].id]
    inner = _recursion(sample, 0, -1)
    for what, other in (("place", _recursion(sample, 1, -1)), ("time", _recursion(sample, 0, 0))):
        gap = inner.minus(other)
        found.append(row(f"boltzmann_recursion_{what}", gap.value, gap.standard_error))
    return found


def _millionth(settings):
    from scipy.stats import chi

    phase = 2.0 * np.pi * settings["turn"][-1]
    size = trap.swelling(phase, settings["breathing"], settings["start_phase"])
    return float(chi.sf(settings["millionth_radius"] / np.sqrt(size), 3))


def _extinction(samples, grid, settings, i, majorant):
    case, time = grid["extinction"], settings["extinction_time"]
    sample = samples[case.id]
    variance = _probes.summary(sample, case).variance
    square = sample["mean_square"].values[i, 0] - sample["mean"].values[i, 0] ** 2
    nodes = _recursion(sample, i, 0)
    return [
        verdict.Finding(
            f"boltzmann_extinction_variance_{i + 1}",
            float(variance[i, 0]),
            float(square.std(ddof=1) / math.sqrt(square.size)),
            printed=float(extinction.variance(time, 1.0, 1.0, majorant)),
            evidence=f"Raised frequency {majorant:g} αf₀.",
        ),
        verdict.Finding(
            f"boltzmann_extinction_recursion_{i + 1}",
            nodes.value,
            nodes.standard_error,
            printed=float(extinction.mean_recursion(time, majorant)),
            evidence=f"Raised frequency {majorant:g} αf₀.",
        ),
    ]


def _recursion(sample, i, j):
    """Return the mean recursion at a probe, from the replicates."""
    return estimate.of_replicates(sample["nodes"].values[i, j])


def _largest_spread(sample):
    """Return the largest relative departure from 1 of the kept values and of the means."""
    return float(max(np.abs(sample[name].values - 1.0).max() for name in ("top", "mean")))


def _ratio_error(sample, j):
    """Return the standard error of the ratio of relative errors: jackknife over replicates."""
    mean, square = sample["mean"].values[:, j], sample["mean_square"].values[:, j]
    n = mean.shape[-1]
    left = [np.delete(np.arange(n), k) for k in range(n)]
    ratios = []
    for keep in left:
        m, s = mean[:, keep].mean(axis=-1), square[:, keep].mean(axis=-1)
        relative = np.sqrt(np.maximum(0.0, s - m**2)) / m
        ratios.append(relative[1] / relative[0])
    return math.sqrt((n - 1) / n * np.sum((np.array(ratios) - np.mean(ratios)) ** 2))
