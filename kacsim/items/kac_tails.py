"""Study: tail probabilities P(|v_1| > x) of Bird and Poisson relative to those of eq. (8)."""

import math

from kacsim.items import _kac
from kacsim.items._lazy import estimate, exact, np, plotting, store, tail, verdict, xr
from kacsim.kac.samplers import TITLES

ENDLESS = {"endless": "Poisson, N = ∞"}
SERIES = ("bird", "poisson", "poisson_printed", "endless")


def _grid(settings):
    finite = {
        name: _kac.velocity_case(settings, name, settings["n_particles"]) for name in SERIES[:3]
    }
    endless = _kac.velocity_case(settings, "poisson", math.inf, engine="ancestral")
    return finite | {"endless": endless}


def cases(settings):
    """Return Bird, both Poisson variants, and Poisson with infinitely many particles."""
    return list(_grid(settings).values())


def reduce(samples, settings):
    """Return counts beyond each threshold, shares with exact intervals, and the exact tails."""
    thresholds, grid = settings["tail_threshold"], _grid(settings)
    counts = np.array(
        [
            [_beyond(samples[case.id], threshold) for threshold in thresholds]
            for case in grid.values()
        ]
    )
    n_draws = _kac.n_draws_of(grid["endless"])
    intervals = np.array([[tail.clopper_pearson(c, n_draws) for c in row] for row in counts])
    described, dims = store.described, ("series", "threshold")
    return xr.Dataset(
        {
            "count": described(counts, dims, "draws with |v_1| > x"),
            "share": described(counts / n_draws, dims, "share of draws with |v_1| > x"),
            "low": described(intervals[..., 0], dims, "lower end of the exact 95 % interval"),
            "high": described(intervals[..., 1], dims, "upper end of the exact 95 % interval"),
            "exact": described(
                2.0 * exact.survival(thresholds, settings["time"]),
                ("threshold",),
                "P(|v| > x) of eq. (8)",
            ),
            "n_draws": described(n_draws, (), "draws of each series"),
        },
        coords={"series": list(SERIES), "threshold": thresholds},
    )


def _beyond(sample, threshold):
    counts = sample["counts"].values.sum(axis=0)
    return tail.counts_beyond(counts, threshold, both_sides=True)


def _miss(dataset, series, threshold):
    """Return (share - exact tail) with its standard error."""
    here = dataset.sel(series=series, threshold=threshold)
    share = estimate.of_share(int(here["count"]), int(dataset.n_draws))
    return estimate.Mean(share.value - float(here.exact), share.standard_error)


def claims(dataset):
    """Test whether Poisson is nearer than Bird to the exact tail at one threshold."""
    x = dataset.attrs["settings"]["claim_threshold"]
    miss = {name: _miss(dataset, name, x) for name in SERIES}
    scores = ", ".join(f"{(TITLES | ENDLESS)[name]} {mean.z():+.1f}" for name, mean in miss.items())
    gap = abs(miss["bird"].value) - abs(miss["poisson"].value)
    return [
        verdict.Finding(
            "kac_tails_better",
            gap,
            miss["bird"].minus(miss["poisson"]).standard_error,
            evidence=f"P(|v₁| > {x:g}) less the exact tail, in standard errors: {scores}.",
        ),
    ]


def draw(dataset):
    """Draw the ratio to the exact tail with exact intervals, all thresholds and the lower ones."""
    figure, axes = plotting.panels(1, 2)
    for k, series in enumerate(SERIES):
        here = dataset.sel(series=series)
        ratio, low, high = (here[name] / here.exact for name in ("share", "low", "high"))
        errors = np.maximum(0.0, [ratio - low, high - ratio])
        label = (TITLES | ENDLESS)[series]
        x = here.threshold + 0.05 * (k - 1.5)
        for axis in axes:
            plotting.points(axis, x, ratio, errors, k, label, line=False)
    low = dataset.threshold.values[0]
    axes[1].set_xlim(low - 0.25, low + 1.75)
    axes[1].set_ylim(0.985, 1.015)
    axes[1].set_title("enlarged")
    for axis in axes:
        axis.axhline(1.0, color="black", lw=1)
        axis.set_xlabel("threshold $x$")
    axes[0].set_ylabel("P(|$v_1$| > $x$) / exact, 95 % intervals")
    axes[0].set_yscale("log")
    axes[0].set_ylim(0.4, 3.5)
    plotting.plain_log(axes[0].yaxis)
    axes[0].legend()
    return figure
