"""What the studies of late times share: three methods by McKean's trees at a grid of probes."""

from typing import NamedTuple

from kacsim import costs as kept
from kacsim.cases import make_case
from kacsim.items import _probes
from kacsim.items._lazy import estimate, np, plotting, special, store, verdict, xr
from kacsim.mckean.constants import METHODS

SPANS = ("time", "late_time")
QUANTITIES = ("density", "tail")
MOMENTS = (("mean", 1), ("mean_square", 2))
TEXTS = {
    "ratio": "mean of the realizations over the exact value",
    "ratio_error": "standard error from the sample variance",
    "deviation": "standard deviation of one realization over the exact value",
    "deviation_error": "standard error, replicates left out in turn",
    "worst": "the same of the worst replicate",
    "top_share": "square of the largest realization over the sum of squares",
    "leaves": "mean number of leaves",
    "seconds": "processor time of one realization",
}
NAMES = {
    "ancestral": "leaves integrated out",
    "free_leaf": "one leaf integrated out",
    "geometric": "the same, geometric number",
}


class Family(NamedTuple):
    """One law: name -> sampler of a quantity, its axis, and its exact value over the unit of draws.

    Attributes
    ----------
    samplers : dict quantity -> (sampler, name of its first axis)
    fixed : dict of what its cases have besides
    exact : callable(quantity, speed, time) -> float64 in units of draws, arrays broadcast
    unit : callable(quantity, speed) -> the unit
    """

    samplers: dict
    fixed: dict
    exact: object
    unit: object


def problems(settings):
    """Return (key, sentence) of each setting that does not fit another."""
    if settings["shown_speed"] not in settings["speed"]:
        return [("shown_speed", "must be among the values of speed")]
    return []


def costs(family):
    """Return what the plan adds to the settings: the machine, and kind -> term -> nanoseconds."""
    kinds = [f"{sampler}-{one}" for sampler, _ in family.samplers.values() for one in METHODS]
    return {
        "machine": kept.table()["machine"],
        "nanoseconds": {kind: kept.nanoseconds(kind) for kind in kinds},
    }


def speeds(settings, quantity, method):
    """Return the probes: at 0 only the density with all leaves integrated out has a variance."""
    whole = quantity == "density" and method == METHODS[0]
    return [one for one in settings["speed"] if one > 0.0 or whole]


def grid(family, settings):
    """Return (quantity, method, span) -> case."""
    found = {}
    for quantity, (sampler, axis) in family.samplers.items():
        for method in METHODS:
            for span in SPANS:
                found[quantity, method, span] = make_case(
                    sampler,
                    **{axis: speeds(settings, quantity, method), "time": settings[span]},
                    method=method,
                    max_nodes=settings["max_nodes"],
                    n_draws=settings["n_draws" if span == "time" else "late_n_draws"],
                    n_replicates=settings["n_replicates"],
                    seed=settings["seed"],
                    **family.fixed,
                )
    return found


def bars(family, settings):
    """Return quantity -> case of many short runs at one probe, whose bars are counted."""
    return {
        quantity: make_case(
            sampler,
            **{axis: [settings["covered_speed"]], "time": settings["covered_time"]},
            method=METHODS[0],
            max_nodes=settings["max_nodes"],
            n_draws=settings["covered_n_draws"],
            n_replicates=settings["covered_n_replicates"],
            seed=settings["seed"],
            **family.fixed,
        )
        for quantity, (sampler, axis) in family.samplers.items()
    }


def cases(family, settings):
    """Return all of them."""
    return [*grid(family, settings).values(), *bars(family, settings).values()]


def measured(sample, case, exact):
    """Return name -> float64[speed, time] of TEXTS, seconds apart.

    Parameters
    ----------
    exact : float64[speed, time], in units of the realizations
    """
    mean, square = (sample[name].values / exact[..., None] ** k for name, k in MOMENTS)
    n, many = case.n_draws, case.n_draws * case.n_replicates
    variance = np.maximum(0.0, square - mean**2) * n / max(1, n - 1)
    whole = np.maximum(0.0, square.mean(-1) - mean.mean(-1) ** 2) * many / max(1, many - 1)
    found = {
        "ratio": mean.mean(axis=-1),
        "ratio_error": np.sqrt(whole / many),
        "deviation": np.sqrt(whole),
        "worst": np.sqrt(variance).max(axis=-1),
        "top_share": (sample["largest"].values.max(-1) / exact) ** 2 / (many * square.mean(-1)),
        "leaves": sample["nodes"].values.mean(axis=-1),
    }
    found["deviation_error"] = np.zeros(exact.shape)
    for place in np.ndindex(exact.shape):
        left = _probes.jackknife(_probes.relative_deviation, (mean[place], square[place]))
        found["deviation_error"][place] = left.standard_error
    return found


def reduce(family, samples, settings):
    """Return what the three methods do at all probes, and how often their bars cover."""
    times = [*settings["time"], *settings["late_time"]]
    shape = (len(QUANTITIES), len(METHODS), len(settings["speed"]), len(times))
    tables = {name: np.full(shape, np.nan) for name in TEXTS}
    for (quantity, method, span), case in grid(family, settings).items():
        probes = np.array(speeds(settings, quantity, method))
        exact = family.exact(quantity, probes[:, None], np.array(settings[span]))
        found = measured(samples[case.id], case, exact)
        found["seconds"] = _seconds(settings, quantity, method, found["leaves"], family)
        rows = [settings["speed"].index(one) for one in probes]
        columns = [times.index(one) for one in settings[span]]
        place = np.ix_([QUANTITIES.index(quantity)], [METHODS.index(method)], rows, columns)
        for name, values in found.items():
            tables[name][place] = values[None, None]
    dims = ("quantity", "estimator", "speed", "time")
    described = store.described
    variables = {name: described(tables[name], dims, text) for name, text in TEXTS.items()}
    exact = [
        family.exact(one, np.array(settings["speed"])[:, None], np.array(times))
        for one in QUANTITIES
    ]
    variables["exact"] = described(exact, ("quantity", "speed", "time"), "exact, in units of draws")
    unit = [family.unit(one, np.array(settings["speed"], float)) for one in QUANTITIES]
    variables["unit"] = described(unit, ("quantity", "speed"), "unit of draws")
    coords = {"quantity": list(QUANTITIES), "estimator": list(METHODS), "speed": settings["speed"]}
    coords |= {"time": times, "covered_time": settings["covered_time"]}
    return xr.Dataset(variables | _coverage(family, samples, settings), coords=coords)


def _seconds(settings, quantity, method, leaves, family):
    each = settings["costs"]["nanoseconds"][f"{family.samplers[quantity][0]}-{method}"]
    return 1e-9 * (each.get("draw", 0.0) + each.get("node", 0.0) * leaves)


def _coverage(family, samples, settings):
    """Return the share of bars of one sigma that cover, with its error, beside Student's."""
    covered = []
    for quantity, case in bars(family, settings).items():
        speed, time = settings["covered_speed"], np.array(settings["covered_time"])
        exact = family.exact(quantity, np.array([[speed]]), time)
        covered.append(_probes.covering(samples[case.id], case, exact)[0])
    n = settings["covered_n_replicates"]
    share = np.array(covered) / n
    nominal = 2.0 * special.stdtr(settings["covered_n_draws"] - 1.0, 1.0) - 1.0
    dims, described = ("quantity", "covered_time"), store.described
    error = np.sqrt(nominal * (1.0 - nominal) / n)
    return {
        "coverage": described(share, dims, "share of bars of one sigma that cover the exact value"),
        "coverage_error": described(error, (), "its standard deviation if the bars are right"),
        "nominal": described(nominal, (), "share of right bars that cover"),
    }


def unbiased(dataset, claim):
    """Return the finding that means are the exact values, over all speeds at every time."""
    parts = []
    for quantity in QUANTITIES:
        for time in dataset.time.values:
            here = dataset.sel(estimator=METHODS[0], quantity=quantity, time=time)
            errors = here.ratio_error.values[np.isfinite(here.ratio.values)]
            error = float(np.sqrt((errors**2).sum())) / errors.size
            mean = estimate.Mean(float(here.ratio.mean()), error)
            parts.append(verdict.Part(mean, f"{quantity}, t = {time:g}"))
    return verdict.Finding(claim, tuple(parts))


def smallness(dataset, claim, quantity, speed):
    """Return the finding on the largest relative deviation, at all speeds from one on."""
    here = dataset.sel(quantity=quantity, estimator=METHODS[0])
    here = here.sel(speed=here.speed[here.speed >= speed])
    row, column = np.unravel_index(np.nanargmax(here.deviation.values), here.deviation.shape)
    one = here.isel(speed=row, time=column)
    degrees = dataset.attrs["settings"]["n_replicates"] - 1
    largest = estimate.Mean(float(one.deviation), float(one.deviation_error), degrees)
    evidence = (
        f"Largest at speed {float(one.speed):g}, t = {float(one.time):g}; of the worst replicate "
        f"{float(here.worst.max()):.3g} anywhere. The largest realization makes at most "
        f"{100.0 * float(here.top_share.max()):.2g} % of a second moment."
    )
    return verdict.finding(claim, largest, evidence)


def draw_deviations(axis, dataset, quantity, speed):
    """Draw the relative deviation of one realization against time, a line a method."""
    here = dataset.sel(quantity=quantity, speed=speed)
    for k, method in enumerate(METHODS):
        one = here.sel(estimator=method)
        errors = one.deviation_error
        plotting.points(axis, here.time.values, one.deviation, errors, k, NAMES[method])
    axis.set_yscale("log")
    axis.set_ylim(bottom=0.02 * float(here.deviation.min()))  # room for a legend
    axis.set_xlabel("mean collision times")
    axis.set_ylabel("relative deviation\nof one realization")


def draw_coverage(axis, dataset, labels):
    """Draw the share of bars that cover, beside that of right bars."""
    for k, quantity in enumerate(QUANTITIES):
        beside = dataset.covered_time.values + 0.06 * (k - 0.5)
        error = np.full(beside.size, float(dataset.coverage_error))
        here = dataset.coverage.sel(quantity=quantity)
        plotting.points(axis, beside, here, error, k, labels[quantity], line=False)
    axis.axhline(float(dataset.nominal), color="0.4", lw=1, label="if the bars are right")
    axis.set_ylim(0.4, 1.0)
    axis.set_xlabel("mean collision times")
    axis.set_ylabel("coverage of $\\pm\\sigma$")
    axis.legend()


def draw_tails(axis, dataset, quantity, y_label):
    """Draw the quantity against speed, a curve a time."""
    here = dataset.sel(quantity=quantity, estimator=METHODS[0])
    shown = [here.time.values[k] for k in np.linspace(0, here.sizes["time"] - 1, 3).astype(int)]
    for k, time in enumerate(shown):
        one = here.sel(time=time)
        value = one.exact * one.unit
        plotting.points(
            axis, one.speed.values, value * one.ratio, value * one.ratio_error, k,
            f"$t$ = {time:g}", line=False,
        )  # fmt: skip
        axis.plot(one.speed, value, color=plotting.COLOURS[k], lw=1)
    axis.set_yscale("log")
    axis.set_ylabel(y_label)
    axis.legend()
