"""Study: the perfect sampler with epsilon = 0, its law, its draws' independence, and its work."""

import math

from kacsim import costs as kept
from kacsim.cases import make_case
from kacsim.items import _kac, _perfect_work
from kacsim.items._lazy import estimate, exact, np, plotting, special, store, verdict, xr
from kacsim.kac.constants import LAGS, LEVELS

LEVEL = 1e-3  # of the Kolmogorov-Smirnov test
POWER = 0.95  # of it, for a distance that is called seen
COARSE = 32  # bins of the range of v_1 from one point of the figure to the next


def costs():
    """Return what the plan adds to the settings: the machine, and kind -> term -> nanoseconds."""
    nanoseconds = {kind: kept.nanoseconds(kind) for kind in _perfect_work.KINDS}
    return {"machine": kept.table()["machine"], "nanoseconds": nanoseconds}


def problems(settings):
    """Return numbers of particles that are looked at further, and are not drawn."""
    yield from _kac.subset(settings, "biased_n_particles", of="n_particles")
    if settings["fixed_n_particles"] not in settings["cost_n_particles"]:
        yield "fixed_n_particles", "must be among cost_n_particles"


def _case(settings, n_particles, tolerance=None, prefix="", **own):
    """Return a case of the perfect sampler, or of the epsilon-perfect one."""
    size = {key: settings[prefix + key] for key in ("n_draws", "n_replicates")}
    sampler = "kac_perfect" if tolerance is None else "kac_equilibrium"
    own |= {} if tolerance is None else {"tolerance": tolerance}
    return make_case(sampler, n_particles=n_particles, seed=settings["seed"], **size, **own)


def _grids(settings):
    """Return (perfect, biased, work of both kinds, work against the block's length)."""
    tolerance, few = settings["tolerance"], {"prefix": "cost_"}
    fixed = settings["fixed_n_particles"]
    return (
        [_case(settings, n) for n in settings["n_particles"]],
        [_case(settings, n, settings["biased_tolerance"]) for n in settings["biased_n_particles"]],
        [
            (_case(settings, n, **few), _case(settings, n, tolerance, **few))
            for n in settings["cost_n_particles"]
        ],
        [_case(settings, fixed, block=block, **few) for block in settings["block"]],
    )


def cases(settings):
    """Return the draws that are tested, biased ones beside them, and those that count work."""
    perfect, biased, work, scan = _grids(settings)
    return [*perfect, *biased, *(case for pair in work for case in pair), *scan]


def reduce(samples, settings):
    """Return distances from the exact law, correlations of successive draws, and work per draw."""
    perfect, biased, work, scan = _grids(settings)
    fixed, tolerance = settings["fixed_n_particles"], settings["tolerance"]
    n_draws = _kac.n_draws_of(perfect[0])
    laws = [_law(_levels(samples[case.id], case), n_draws) for case in perfect]
    others = [_law(_bins(samples[case.id], case), n_draws) for case in biased]
    moments = [_kac.fourth_moment_of(samples[case.id], case) for case in perfect]
    ns, coarse = settings["n_particles"], slice(None, None, COARSE)
    described = store.described
    one, two = ("n_particles",), ("n_particles", "lag")
    variables = {
        "distance": described([law["distance"] for law in laws], one, "largest |F_n - F|"),
        "chance": described(
            [law["chance"] for law in laws], one, "bound of the chance of a larger distance"
        ),
        "level": described([law["level"][coarse] for law in laws], (*one, "place"), "F"),
        "departure": described(
            [law["departure"][coarse] for law in laws], (*one, "place"), "root n times (F_n - F)"
        ),
        "biased_distance": described(
            [law["distance"] for law in others], ("biased_n",), "largest |F_n - F|, epsilon-perfect"
        ),
        "biased_chance": described(
            [law["chance"] for law in others], ("biased_n",), "bound of its chance"
        ),
        "biased_level": described([law["level"] for law in others], ("biased_n", "edge"), "F"),
        "biased_departure": described(
            [law["departure"] for law in others], ("biased_n", "edge"), "root n times (F_n - F)"
        ),
        "seen": described(
            _seen(n_draws), (), f"distance seen with probability {POWER} at the level {LEVEL}"
        ),
        "one_in": described(1.0 / LEVEL, (), "runs of exact draws of which one passes the lines"),
        "power": described(POWER, (), "probability with which a distance `seen` is seen"),
        "moment": described([m.value for m in moments], one, "mean of v_1**4"),
        "moment_error": described([m.standard_error for m in moments], one, "its standard error"),
        "moment_exact": described(
            [exact.equilibrium_fourth_moment(n) for n in ns], one, "exact E v_1**4"
        ),
        "correlation": described(
            [_correlation(samples[case.id], case) for case in perfect],
            two,
            "correlation of v_1**2 with that of a later draw",
        ),
        "correlation_error": described(1.0 / math.sqrt(n_draws), (), "its standard error"),
        "n_draws": described(n_draws, (), "draws of each that are tested"),
        "gain": described(
            _gain(fixed, tolerance, settings["bin_width"]),
            (),
            "bound of the TVN by epsilon",
        ),
    }
    variables |= _perfect_work.of_both(samples, work, settings)
    variables |= _perfect_work.against_block(samples, scan, settings)
    coords = {
        "n_particles": ns,
        "biased_n": settings["biased_n_particles"],
        "cost_n": settings["cost_n_particles"],
        "block": settings["block"],
        "lag": list(range(1, LAGS + 1)),
    }
    return xr.Dataset(variables, coords={key: (key, list(v)) for key, v in coords.items()})


def _levels(sample, case):
    """Return (draws below each edge, the exact law there) of equal bins of the range of v_1."""
    n = case.parameters["n_particles"]
    below = np.r_[0, sample["level_counts"].values.sum(axis=0).cumsum()]
    law = exact.equilibrium_cumulative(np.linspace(-1.0, 1.0, LEVELS + 1), n, energy=1.0)
    return below, law


def _bins(sample, case):
    """Return (draws below each edge, the exact law there) of the bins of all samplers of v_1."""
    below = sample["counts"].values.sum(axis=0).cumsum()[:-1]
    n = case.parameters["n_particles"]
    return below, exact.equilibrium_cumulative(sample["edge"].values, n)


def _law(known, n_draws):
    """Return level, departure, distance and chance: Kolmogorov and Smirnov's test at the edges.

    The largest distance at some places is at most that at all, so that the chance of a larger one
    is at most that of their law.
    """
    below, level = known
    gap = below / n_draws - level
    distance, root = float(np.abs(gap).max()), math.sqrt(n_draws)
    chance = float(special.kolmogorov(root * distance))
    return {"level": level, "departure": root * gap, "distance": distance, "chance": chance}


def _seen(n_draws):
    """Return a distance that the test sees with the probability POWER, or more.

    Where the law is that far off, F_n has at most the standard deviation 1 / (2 sqrt(n)).
    """
    reach = float(special.kolmogi(LEVEL)) + 0.5 * float(special.ndtri(POWER))
    return reach / math.sqrt(n_draws)


def _correlation(sample, case):
    """Return the correlation of v_1**2 / E with later ones, its mean and variance being known."""
    n = case.parameters["n_particles"]
    variance = 2.0 * (n - 1.0) / (n * n * (n + 2.0))
    return sample["lag_product"].values.mean(axis=0) / variance


def _gain(n, tolerance, width):
    """Return by how much the TVN of epsilon-perfect draws differs at most from that of exact ones.

    Each differs from an exact draw by less than epsilon, and is in another bin only near an edge.
    """
    edges = np.arange(-round(8.0 / width), round(8.0 / width) + 1) * width
    near = [exact.equilibrium_cumulative(edges + side, n) for side in (tolerance, -tolerance)]
    return float((near[0] - near[1]).sum())


def claims(dataset):
    """Say whether a perfect algorithm is possible, what is gained by it, and what it costs."""
    settings = dataset.attrs["settings"]
    n, tolerance = settings["fixed_n_particles"], settings["tolerance"]
    possible = tuple(
        verdict.Part(
            _kac.mean_of(dataset, "moment", n_particles=size),
            f"N = {size}",
            printed=float(dataset.moment_exact.sel(n_particles=size)),
        )
        for size in settings["n_particles"]
    )
    law = "; ".join(
        f"N = {size}: distance {float(d):.1e}, chance {float(p):.2g}"
        for size, d, p in zip(
            settings["n_particles"], dataset.distance.values, dataset.chance.values, strict=True
        )
    )
    here = dataset.sel(cost_n=n)
    return [
        verdict.Finding(
            "kac_6_possible",
            possible,
            f"Proved. Kolmogorov–Smirnov against the exact law, {int(dataset.n_draws)} draws: "
            f"{law}. A distance of {float(dataset.seen):.1e} would have been seen.",
        ),
        verdict.finding(
            "kac_6_perfect",
            estimate.Exact(float(dataset.gain)),
            f"A bound, N = {n}, ε = {tolerance:g}, bins of {settings['bin_width']:g}: no draw is "
            "moved by ε or more, so that no draws that can be made would tell. How complicated a "
            f"program is no run measures; work per draw is not more: {float(here.steps):.0f} ± "
            f"{float(here.steps_error):.0f} steps with ε = 0, {float(here.other_steps):.0f} ± "
            f"{float(here.other_steps_error):.0f} with ε = {tolerance:g}.",
        ),
    ]


def draw(dataset):
    """Draw departures from the exact law, correlations, and work against N and block length."""
    figure, axes = plotting.panels(2, 2)
    _draw_departures(axes[0], dataset)
    _draw_correlations(axes[1], dataset)
    _perfect_work.draw_ratios(axes[2], dataset)
    _perfect_work.draw_scan(axes[3], dataset)
    for axis in axes:
        plotting.legend_on_top(axis, ncols=2)
    return figure


def _draw_departures(axis, dataset):
    settings = dataset.attrs["settings"]
    for k, n in enumerate(dataset.n_particles.values):
        here = dataset.sel(n_particles=n)
        style = {"color": plotting.COLOURS[k], "lw": 0.8}
        axis.plot(here.level, here.departure, label=f"$\\varepsilon$ = 0, $N$ = {n}", **style)
    few = dataset.isel(biased_n=0)
    label = f"$\\varepsilon$ = {settings['biased_tolerance']:g}, $N$ = {int(few.biased_n)}"
    style = {"color": "black", "ls": "--", "lw": 0.8}
    axis.plot(few.biased_level, few.biased_departure, label=label, **style)
    limit = float(special.kolmogi(LEVEL))
    for side in (-limit, limit):
        axis.axhline(side, color="0.5", ls=":", lw=1)
    axis.set_xlabel("exact law $F(v_1)$")
    axis.set_ylabel("$\\sqrt{n}\\,(F_n - F)$")


def _draw_correlations(axis, dataset):
    error = float(dataset.correlation_error)
    for k, n in enumerate(dataset.n_particles.values):
        x = dataset.lag + 0.12 * (k - 1)
        y = 1e3 * dataset.correlation.sel(n_particles=n)
        bar = np.full(dataset.sizes["lag"], 1e3 * error)
        plotting.points(axis, x, y, bar, k, f"$N$ = {n}", line=False)
    axis.axhline(0.0, color="0.5", lw=0.8)
    axis.set_xticks(dataset.lag.values)
    axis.set_xlabel("draws apart")
    axis.set_ylabel("correlation of $v_1^2$ in $10^{-3}$")
