"""Study: an initial law and a law of the scattering angle of one's own, given by the configuration.

Other items test statements about the paper's laws; this one takes any, by name or from a file.
"""

import math

from kacsim.items import _kac
from kacsim.items._lazy import estimate, histogram, np, own_drawn, own_moments, plotting, store, xr
from kacsim.kac import own_tables
from kacsim.kac.samplers import TITLES

N_CURVE = 200  # points of a curve in time


def settled(settings):
    """Return the settings with the digest of the content of each file that they name."""
    names = {"initial": (own_tables.INITIALS, False), "scattering": (own_tables.SCATTERINGS, True)}
    found = {key: own_tables.settled(settings[key], *about) for key, about in names.items()}
    return settings | {key: found[key] or settings[key] for key in names}


def cases(settings):
    """Return one algorithm at every time."""
    laws = {key: settings[key] for key in ("initial", "scattering")}
    return [
        _kac.velocity_case(
            settings, settings["algorithm"], settings["n_particles"], **(laws | {"time": time})
        )
        for time in settings["time"]
    ]


def reduce(samples, settings):
    """Return histograms and moments at every time, beside the exact moments of the same laws."""
    found = [samples[case.id] for case in cases(settings)]
    laws = {key: settings[key] for key in ("initial", "scattering")}
    square, start = own_moments.moments_at_start(own_drawn.initial_law(laws["initial"]))
    n_draws = settings["n_draws"] * settings["n_replicates"]
    squares, fourths = [], []
    for sample in found:
        means = sample["moment"].mean("replicate").to_series()
        spread = max(0.0, float(means[4]) - float(means[2]) ** 2)
        squares.append(estimate.Mean(float(means[2]), math.sqrt(spread / n_draws)))
        fourths.append(estimate.of_power(means, 4, n_draws, square))
    counts = [sample["counts"].values.sum(axis=0) for sample in found]
    bars = [histogram.coarsen(one, settings["bin_width"]) for one in counts]
    edges = bars[0][1]
    density = [inside[1:-1] / n_draws / np.diff(edges) for inside, _ in bars]
    process = laws | {"algorithm": settings["algorithm"], "n_particles": settings["n_particles"]}
    curve = np.linspace(0.0, max(settings["time"]), N_CURVE + 1)[1:]
    first = own_moments.cumulative(own_drawn.initial_law(laws["initial"]), edges)
    described, time = store.described, ("time",)
    return xr.Dataset(
        {
            "density": described(density, ("time", "bin"), "histogram of v_1, all replicates"),
            "density_start": described(
                np.diff(first) / np.diff(edges), ("bin",), "mean density at time 0, exact"
            ),
            "square": described([one.value for one in squares], time, "mean of v_1**2"),
            "square_error": described(
                [one.standard_error for one in squares], time, "standard error"
            ),
            "square_exact": described(square, (), "exact mean of v_1**2, at all times"),
            "moment": described([one.value for one in fourths], time, "mean of v_1**4"),
            "moment_error": described(
                [one.standard_error for one in fourths], time, "standard error"
            ),
            "moment_exact": described(
                [own_moments.fourth_moment(t, **process) for t in settings["time"]],
                time,
                "exact mean of v_1**4, this process",
            ),
            "moment_start": described(start, (), "exact mean of v_1**4 at time 0"),
            "moment_limit": described(
                [own_moments.fourth_moment(t, **laws) for t in curve],
                ("curve_time",),
                "exact mean of v**4 for infinitely many particles",
            ),
        },
        coords={"time": settings["time"], "curve_time": curve, "edge": ("edge", edges)},
    )


def draw(dataset):
    """Draw the law at every time, and the fourth moment on its way to the equilibrium."""
    figure, (left, right) = plotting.panels(1, 2)
    edges, square = dataset.edge.values, float(dataset.square_exact)
    left.stairs(dataset.density_start, edges, color="0.6", lw=1, ls="--", label="$t$ = 0, exact")
    for k, time in enumerate(dataset.time.values):
        plotting.bars(left, edges, dataset.density[k], k, f"$t$ = {time:g}", fill=False)
    grid = 0.5 * (edges[1:] + edges[:-1])
    normal = np.exp(-0.5 * grid**2 / square) / math.sqrt(2.0 * math.pi * square)
    left.plot(grid, normal, color="black", lw=1, label="equilibrium")
    plotting.velocity_axis(left)
    left.set_ylim(bottom=0.0)
    plotting.density_axis(left)
    plotting.legends_above((left,), share=0.3, ncols=2)
    settings = dataset.attrs["settings"]
    right.plot(
        [0.0, *dataset.curve_time.values],
        [float(dataset.moment_start), *dataset.moment_limit.values],
        color="black", lw=1, label="exact, $N$ → ∞",
    )  # fmt: skip
    size = f"$N$ = {settings['n_particles']}"
    right.plot(dataset.time, dataset.moment_exact, "_", ms=16, color="0.4", label=f"exact, {size}")
    label = f"{TITLES[settings['algorithm']]}, {size}"
    plotting.points(right, dataset.time, dataset.moment, dataset.moment_error, 0, label, line=False)
    right.axhline(3.0 * square**2, color="0.5", ls=":", lw=1.2, label="equilibrium")
    right.set_xlabel("time $t$")
    right.set_ylabel("E $v^4$")
    right.legend(loc="lower right")
    return figure
