"""What the items of the Boltzmann paper share: probes, estimates with errors, two-row figures."""

import math
from typing import NamedTuple

from kacsim.cases import make_case
from kacsim.items._lazy import estimate, np, plotting, store, xr

SIZES = ("published", "large")


def case(settings, sampler, size="published", **parameters):
    """Return the case of a sampler at one of the item's two numbers of realizations."""
    n_draws = settings["n_draws" if size == "published" else "large_n_draws"]
    return make_case(
        sampler,
        n_draws=n_draws,
        n_replicates=settings["n_replicates"],
        seed=settings["seed"],
        **parameters,
    )


class Summary(NamedTuple):
    """What realizations say at every probe, before any factor; each is float64[first, time].

    Attributes
    ----------
    mean, error : of the realizations
    variance : of one realization
    nodes : mean recursion
    """

    mean: object
    error: object
    variance: object
    nodes: object


def summary(sample, case_):
    """Return the Summary of a sample."""
    n = case_.n_draws * case_.n_replicates
    mean = sample["mean"].mean("replicate").values
    square = sample["mean_square"].mean("replicate").values
    variance = np.maximum(0.0, square - mean**2) * n / max(1, n - 1)
    nodes = sample["nodes"].mean("replicate").values
    return Summary(mean, np.sqrt(variance / n), variance, nodes)


def table(samples, cases, axes, factor, exact, places=None):
    """Return estimates with errors beside the exact values.

    Parameters
    ----------
    samples : case id -> dataset
    cases : dict size -> Case
    axes : dict of the two probe axes, name -> values
    factor : float64[first, time], by which a realization is multiplied
    exact : float64[first, time]
    places : dict size -> places of the case's times among all; the other times become nan

    Returns
    -------
    xarray.Dataset: value, error, spread (of one realization), actual_error, recursion with its
    error, largest share [size, *axes], exact[*axes], n_draws[size]
    """
    rows = []
    for size, one in cases.items():
        sample = samples[one.id]
        mean, error, variance, nodes = summary(sample, one)
        total = sample["mean"].sum("replicate").values * one.n_draws
        share = sample["largest"].max("replicate").values / np.where(total > 0, total, np.nan)
        nodes_error = sample["nodes"].std("replicate", ddof=1).values / math.sqrt(one.n_replicates)
        mean, error, spread, nodes, nodes_error, share = (
            _spread_out(part, exact.shape, places and places[size])
            for part in (mean, error, np.sqrt(variance), nodes, nodes_error, share)
        )
        rows.append(
            {
                "value": factor * mean,
                "error": factor * error,
                "spread": factor * spread,
                "actual_error": factor * mean - exact,
                "recursion": nodes,
                "recursion_error": nodes_error,
                "largest_share": share,
            }
        )
    texts = {
        "value": "estimate",
        "error": "standard error from the sample variance",
        "spread": "standard deviation of one realization",
        "actual_error": "estimate less the exact value",
        "recursion": "mean number of t' drawings of one realization",
        "recursion_error": "standard error from the replicates",
        "largest_share": "share of the largest realization in the sum",
    }
    dims = ("size", *axes)
    variables = {
        name: store.described(np.array([row[name] for row in rows]), dims, text)
        for name, text in texts.items()
    }
    variables["exact"] = store.described(exact, tuple(axes), "exact value")
    amounts = [one.n_draws * one.n_replicates for one in cases.values()]
    variables["n_draws"] = store.described(amounts, ("size",), "realizations per point")
    coords = {"size": list(cases)} | {name: list(values) for name, values in axes.items()}
    return xr.Dataset(variables, coords=coords)


def _spread_out(part, shape, places):
    """Return a table with the columns of `part` at their places, nan elsewhere."""
    if places is None:
        return part
    whole = np.full(shape, np.nan)
    whole[:, places] = part
    return whole


def recursion_of(table):
    """Return the mean recursion at one place of a table, judged by its replicates."""
    degrees = table.attrs["settings"]["n_replicates"] - 1
    return estimate.Mean(float(table.recursion), float(table.recursion_error), degrees)


def covering(sample, case_, exact):
    """Return how many replicates' own bars of one standard deviation cover the exact value.

    Parameters
    ----------
    exact : float64[first, time], in units of the realizations
    """
    mean, square = sample["mean"].values, sample["mean_square"].values
    n = case_.n_draws
    error = np.sqrt(np.maximum(0.0, square - mean**2) / max(1, n - 1))
    return (np.abs(mean - exact[..., None]) < error).sum(axis=-1)


def jackknife(statistic, *samples):
    """Return a statistic of the mean over replicates, and its error by leaving each out in turn.

    Parameters
    ----------
    statistic : callable(mean, mean square, ...) -> float, two arguments for each sample
    samples : (mean, mean_square), float64[replicate] each

    Returns
    -------
    Mean
    """
    columns = np.stack([column for sample in samples for column in sample])
    n = columns.shape[1]
    left = (columns.sum(axis=1, keepdims=True) - columns) / (n - 1)
    values = np.array([statistic(*row) for row in left.T])
    error = math.sqrt((n - 1) / n * ((values - values.mean()) ** 2).sum())
    return estimate.Mean(float(statistic(*columns.mean(axis=1))), error, n - 1)


def gap(ratio):
    """Return 1 less an estimated ratio."""
    return estimate.Mean(1.0 - ratio.value, ratio.standard_error, ratio.degrees)


def ratio(above, below):
    """Return the ratio of two independent estimates, with the degrees of freedom of the first."""
    value = above.value / below.value
    relative = [one.standard_error / one.value for one in (above, below)]
    return estimate.Mean(value, abs(value) * math.hypot(*relative), above.degrees)


def moments_at(sample, i, j):
    """Return (mean, mean_square) of a sample at one probe, float64[replicate] each."""
    return sample["mean"].values[i, j], sample["mean_square"].values[i, j]


def relative_deviation(mean, square):
    """Return the standard deviation over the mean."""
    return math.sqrt(max(0.0, square - mean**2)) / mean


def draw_sizes(axis, dataset, x, variable, error=None, factor=1.0):
    """Draw a variable at all numbers of realizations, with bars or as plain symbols.

    The larger run is drawn first and hollow, so that the published size stays visible on it.
    """
    for k in reversed(range(dataset.sizes["size"])):
        here = dataset.isel(size=k)
        seen = np.isfinite(here[variable].values)
        label = f"{int(here.n_draws):,} realizations"
        bars = None if error is None else (here[error] * factor)[seen]
        style = {"ms": 6.0, "mfc": "none"} if k else {}
        plotting.points(
            axis, x[seen], (here[variable] * factor)[seen], bars, k, label, line=False, **style
        )


def draw_rows(dataset, along, panel, titles, x_label, y_label, critical=None):
    """Draw values over relative errors, one column per value of the panel axis.

    Parameters
    ----------
    along, panel : names of the x axis and of the axis with one panel per value
    titles : list of panel titles
    critical : float, time from which the bars are no standard errors, or None
    """
    figure, axes = plotting.panels(2, dataset.sizes[panel], share_y=False)
    count = dataset.sizes[panel]
    for k, value in enumerate(dataset[panel].values):
        here = dataset.sel({panel: value}).isel(size=0)
        large = dataset.sel({panel: value}).isel(size=-1)
        top, low = axes[k], axes[count + k]
        x = here[along].values
        curve = here[f"curve_{along}"]
        top.plot(here[f"fine_{along}"], curve, color="black", lw=1, label="exact")
        label = f"{int(here.n_draws):,} realizations"
        plotting.points(top, x, here.value, here.error, 0, label, line=False)
        top.set_title(titles[k])
        top.set_ylabel(y_label)
        for j, one in enumerate((here, large)[: dataset.sizes["size"]]):
            amount = f"{int(one.n_draws):,}"
            style = {"ls": "", "ms": 4, "color": plotting.COLOURS[j]}
            low.plot(x, one.error / one.exact, "o", label=f"relative s.d., {amount}", **style)
            if f"deviation_{along}" in dataset:
                line = one[f"deviation_{along}"] / np.sqrt(float(one.n_draws))
                label = "exact relative s.d." if j == 0 else None
                low.plot(one[f"some_{along}"], line, color=style["color"], lw=0.8, label=label)
            wrong = np.abs(one.actual_error) / one.exact
            low.plot(x, wrong, "^", mfc="none", label=f"actual error, {amount}", **style)
        low.set_yscale("log")
        low.set_xlabel(x_label)
        low.set_ylabel("relative error")
        _mark(top, low, critical, value, along)
    axes[0].legend()
    plotting.legends_above(axes[count : count + 1], share=0.2, ncols=2)
    return figure


def _mark(top, low, critical, value, along):
    """Mark where the variance is infinite: a shaded range of times, or a sentence."""
    if critical is None:
        return
    if along != "time":
        if value >= critical:
            sentence = "variance infinite:\nbars are no standard errors"
            top.text(0.02, 0.05, sentence, transform=top.transAxes, size=7)
        return
    right = top.get_xlim()[1]
    if right > critical:
        for axis, label in ((top, "variance infinite"), (low, None)):
            axis.axvspan(critical, right, color="0.9", zorder=0, lw=0, label=label)
            axis.set_xlim(right=right)


def worst_batch(sample):
    """Return the largest |z| between the means of replicates and their common mean."""
    mean = sample["mean"].values
    spread = mean.std(axis=-1, ddof=1)
    gaps = np.abs(mean - mean.mean(axis=-1, keepdims=True)).max(axis=-1)
    return gaps / np.where(spread > 0, spread, math.inf)
