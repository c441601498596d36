"""Study: tail probabilities P(|v_1| > x) of Bird and Poisson relative to those of eq. (8)."""

import math

from kacsim.items import _kac
from kacsim.items._lazy import (
    estimate,
    exact,
    np,
    plotting,
    statements,
    store,
    tail,
    verdict,
    xr,
)
from kacsim.kac.samplers import TITLES

ENDLESS = {"endless": "Poisson, N = ∞"}
SERIES = ("bird", "poisson", "poisson_printed", "endless")


def _grid(settings):
    n, fewer = settings["n_particles"], {"n_replicates": settings["other_n_replicates"]}
    above = {"keep_above": settings["tail_above"]}
    compared = {name: _kac.velocity_case(settings, name, n, **above) for name in SERIES[:2]}
    return compared | {
        "poisson_printed": _kac.velocity_case(settings, "poisson_printed", n, **fewer),
        "endless": _kac.velocity_case(settings, "poisson", math.inf, engine="ancestral", **fewer),
    }


def cases(settings):
    """Return Bird, both Poisson variants, and Poisson with infinitely many particles."""
    return list(_grid(settings).values())


def problems(settings):
    """Return thresholds of the claim that are not drawn."""
    return _kac.subset(settings, "claim_threshold", of="tail_threshold")


def reduce(samples, settings):
    """Return counts beyond each threshold, shares with exact intervals, and the exact tails."""
    thresholds, grid = settings["tail_threshold"], _grid(settings)
    counts = np.array(
        [
            [_beyond(samples[case.id], threshold) for threshold in thresholds]
            for case in grid.values()
        ]
    )
    n_draws = np.array([_kac.n_draws_of(case) for case in grid.values()])
    intervals = np.array(
        [[tail.clopper_pearson(c, n) for c in row] for n, row in zip(n_draws, counts, strict=True)]
    )
    described, dims = store.described, ("series", "threshold")
    return xr.Dataset(
        {
            "count": described(counts, dims, "draws with |v_1| > x"),
            "share": described(counts / n_draws[:, None], dims, "share of draws with |v_1| > x"),
            "low": described(intervals[..., 0], dims, "lower end of the exact 95 % interval"),
            "high": described(intervals[..., 1], dims, "upper end of the exact 95 % interval"),
            "exact": described(
                2.0 * exact.survival(thresholds, settings["time"]),
                ("threshold",),
                "P(|v| > x) of eq. (8)",
            ),
            "n_draws": described(n_draws, ("series",), "draws"),
            "moment": described(
                [_kac.exact_moment(case) for case in grid.values()],
                ("series",),
                "exact mean of v_1**4",
            ),
            "moment_varied": described(
                statements.series_moment(settings["n_particles"], settings["time"]),
                (),
                "exact mean of v_1**4 of Bird with a Poisson number of collisions",
            ),
        },
        coords={"series": list(SERIES), "threshold": thresholds},
    )


def _beyond(sample, threshold):
    counts = sample["counts"].values.sum(axis=0)
    return tail.counts_beyond(counts, threshold, both_sides=True)


def _gain(dataset, x):
    """Return by how much Poisson is nearer than Bird to the exact tail, in units of that tail."""
    misses = []
    for name in ("bird", "poisson"):
        here = dataset.sel(series=name, threshold=x)
        share = estimate.of_share(int(here["count"]), int(here.n_draws))
        miss = abs(share.value - float(here.exact))
        misses.append(estimate.Mean(miss, share.standard_error).over(float(here.exact)))
    return misses[0].minus(misses[1])


def claims(dataset):
    """Test whether Poisson is nearer than Bird to the exact tail, and to the exact E v_1**4."""
    limit = float(dataset.moment.sel(series="endless"))
    bias = {name: float(dataset.moment.sel(series=name)) - limit for name in SERIES[:2]}
    gains = {x: _gain(dataset, x) for x in dataset.attrs["settings"]["claim_threshold"]}
    parts = [verdict.Part(gain, f"P(|v₁| > {x:g})") for x, gain in gains.items()]
    moment = estimate.Exact((abs(bias["bird"]) - abs(bias["poisson"])) / limit)
    evidence = (
        f"Gains over the exact values. E v₁⁴ less that of eq. (8), exactly: "
        f"Bird {bias['bird']:+.1e}, Poisson {bias['poisson']:+.1e}. Bird’s algorithm with a "
        "Poisson number of collisions in place of the constant one is the Poisson algorithm in law "
        f"(E v₁⁴ less that of eq. (8): {float(dataset.moment_varied) - limit:+.1e}), so that the "
        "variable number does not help."
    )
    parts.append(verdict.Part(moment, "E v₁⁴, exact"))
    return [verdict.Finding("kac_tails_better", tuple(parts), evidence)]


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
