"""Study: Figs. 9 and 10 of the Boltzmann paper carried on in time, until they give out."""

import math

from kacsim.cases import make_case
from kacsim.items import _trap
from kacsim.items._lazy import np, plotting, store, xr

RADIUS_KEYS = {"trap": "density_radius", "trap_fraction": "fraction_radius"}
PANELS = {
    "density": "$f$ / $f$ of the breathing state",
    "fraction": "fraction beyond $r_0$",
    "recursion": "mean recursion",
    "effective_share": "effective share",
    "largest_share": "largest realization's share",
    "coverage": "coverage of $\\pm\\sigma$",
}


def problems(settings):
    """Return (key, sentence) of each setting that does not fit another."""
    if len(settings["n_draws"]) != len(settings["turn"]):
        return [("n_draws", "must have one number per value of turn")]
    return []


def _grid(settings):
    """Return (sampler, place of the turn) -> case: fewer realizations of larger trees."""
    found = {}
    for sampler, key in RADIUS_KEYS.items():
        for k, (turn, n_draws) in enumerate(
            zip(settings["turn"], settings["n_draws"], strict=True)
        ):
            found[sampler, k] = make_case(
                sampler,
                radius=settings[key],
                time=[2.0 * math.pi * turn],
                n_draws=n_draws,
                n_replicates=settings["n_replicates"],
                seed=settings["seed"],
                **{name: settings[name] for name in _trap.STATE},
            )
    return found


def cases(settings):
    """Return both algorithms at every time, a case each."""
    return list(_grid(settings).values())


def _measures(sample, n_draws):
    """Return name -> float64[radius]: what tells whether the error bars can be believed."""
    one = sample.isel(time=0)
    mean, square = one["mean"].values, one["mean_square"].values
    n_batches = mean.shape[1]
    total = mean.sum(axis=1)
    variance = np.maximum(square - mean**2, 0.0) / n_draws * (n_draws / max(1, n_draws - 1))
    others = (total[:, None] - mean) / (n_batches - 1)
    others_variance = (variance.sum(axis=1)[:, None] - variance) / (n_batches - 1) ** 2
    gap = np.abs(mean - others) / np.sqrt(np.maximum(variance + others_variance, 1e-300))
    return {
        "value": total / n_batches,
        "error": np.sqrt(variance.mean(axis=1) / n_batches),
        "recursion": one["nodes"].values.mean(axis=1),
        "largest_share": one["largest"].values.max(axis=1) / (total * n_draws),
        "effective_share": total**2 / (n_batches * square.sum(axis=1)),
        "coverage": (gap < 1.0).mean(axis=1),
    }


def reduce(samples, settings):
    """Return estimates, recursion and three measures of reliability at every time."""
    from scipy import special

    texts = {
        "value": "mean of the realizations, relative to the breathing state for the density",
        "error": "standard error from the sample variance",
        "recursion": "mean number of t' drawings of one realization",
        "largest_share": "share of the largest realization in the sum",
        "effective_share": "effective sample size, share of the realizations",
        "coverage": "share of batches whose bar of one sigma covers the mean of the others",
    }
    turns = settings["turn"]
    labels = [(sampler, radius) for sampler, key in RADIUS_KEYS.items() for radius in settings[key]]
    tables = {name: np.full((len(labels), len(turns)), np.nan) for name in texts}
    for (sampler, k), case in _grid(settings).items():
        rows = [row for row, label in enumerate(labels) if label[0] == sampler]
        for name, column in _measures(samples[case.id], case.n_draws).items():
            tables[name][rows, k] = column
    dims, described = ("probe", "turn"), store.described
    variables = {name: described(tables[name], dims, text) for name, text in texts.items()}
    growth = np.polyfit(turns, np.log(tables["recursion"]).T, 1)[0]
    room = np.log(settings["max_nodes"] / tables["recursion"][:, -1])
    n_batches = settings["n_replicates"]
    # Student's law: the share of right bars that cover depends on the realizations of a batch.
    nominal = 2.0 * special.stdtr(np.array(settings["n_draws"]) - 1.0, 1.0) - 1.0
    spread = np.sqrt(nominal * (1.0 - nominal) / n_batches)
    believed = np.cumprod(tables["largest_share"] <= settings["largest_share"], axis=1)
    variables |= {
        "n_believed": described(
            believed.sum(axis=1), ("probe",), "times before one realization outweighs the limit"
        ),
        "sampler": described([sampler for sampler, _ in labels], ("probe",), "algorithm"),
        "radius": described([radius for _, radius in labels], ("probe",), "radius"),
        "growth": described(np.exp(growth), ("probe",), "factor of the recursion in one turn"),
        "last_turn": described(
            turns[-1] + room / growth, ("probe",), "turn where the mean tree fills the budget"
        ),
        "n_draws": described(
            [n * n_batches for n in settings["n_draws"]], ("turn",), "realizations"
        ),
        "nominal": described(nominal, ("turn",), "coverage if the bars are right"),
        "coverage_error": described(
            spread, ("turn",), "standard deviation of the coverage if they are"
        ),
    }
    return xr.Dataset(variables, coords={"turn": turns})


def draw(dataset):
    """Draw values, recursion and the three measures of reliability against time, one an axis."""
    figure, axes = plotting.panels(3, 2, height=2.4)
    panel = dict(zip(PANELS, axes, strict=True))
    turn = dataset.turn.values
    count = dataset.sizes["probe"]
    for k in range(count):
        here = dataset.isel(probe=k)
        density = here.sampler == "trap"
        what, where = ("$f$", "r") if density else ("fraction", "r_0")
        label = f"{what}, ${where}$ = {float(here.radius):g}"
        _value(panel["density" if density else "fraction"], turn, here, k, label)
        for name in ("recursion", "effective_share", "largest_share"):
            plotting.points(panel[name], turn, here[name], None, k, label)
        beside = turn + 0.03 * (k - 0.5 * (count - 1))  # so that no bar hides another
        bars = dataset.coverage_error
        plotting.points(panel["coverage"], beside, here.coverage, bars, k, label, line=False)
    for name, text in PANELS.items():
        panel[name].set_ylabel(text)
        panel[name].set_xlabel("$\\omega t/(2\\pi)$")
    for name in ("fraction", "recursion", "effective_share", "largest_share"):
        panel[name].set_yscale("log")
    panel["density"].set_ylim(0.0, 1.5)
    panel["coverage"].set_ylim(0.0, 1.05)
    limit = np.full(turn.size, dataset.attrs["settings"]["largest_share"])
    for name, level, label, place in (
        ("density", np.ones(turn.size), "breathing state", "upper left"),
        ("largest_share", limit, "limit", "upper left"),
        ("coverage", dataset.nominal, "if the bars are right", "lower left"),
    ):
        (line,) = panel[name].plot(turn, level, color="0.4", lw=1, label=label)
        panel[name].legend(handles=[line], loc=place, frameon=False)
    handles, labels = panel["recursion"].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=4, frameon=False)
    return figure


def _value(axis, turn, here, k, label):
    """Draw estimates with bars, hollow from where one realization outweighs the limit."""
    kept = int(here.n_believed)
    for part, style in ((slice(0, kept), {}), (slice(kept, None), {"mfc": "white"})):
        values = here.isel(turn=part)
        plotting.points(axis, turn[part], values.value, values.error, k, label, line=False, **style)
