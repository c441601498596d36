"""Study: the Kac equation's density probed by branching trees, far beyond any histogram."""

import math

from kacsim.cases import make_case
from kacsim.items import _kac
from kacsim.items._lazy import estimate, exact, np, plotting, store, verdict, xr
from kacsim.kac.constants import RATE


def _case(settings, time):
    late = time >= settings["oversampled_time"]
    return make_case(
        "kac_probe",
        speed=settings["speed"],
        time=[time],
        oversampling=settings["oversampling"] if late else 1.0,
        n_draws=settings["n_draws"],
        n_replicates=settings["n_replicates"],
        seed=settings["seed"],
        max_nodes=settings["max_nodes"],
    )


def cases(settings):
    """Return the probes at every time, oversampled at late ones."""
    return [_case(settings, time) for time in settings["time"]]


def problems(settings):
    """Return velocities of the check that are not probed."""
    return _kac.subset(settings, "claim_speed", of="speed")


def reduce(samples, settings):
    """Return estimates with errors, and the error of a histogram of ancestral draws at equal cost.

    Cost is counted in leaves of the initial law: a tree has half as many as nodes, an ancestral
    draw exp(rate t) of them.
    """
    speed, times = np.array(settings["speed"], dtype=float), settings["time"]
    n = settings["n_draws"] * settings["n_replicates"]
    rows = []
    for time in times:
        sample = samples[_case(settings, time).id]
        mean = sample["mean"].values[:, 0]
        factor = np.exp(-(speed**2) / 3.0) / math.sqrt(3.0 * math.pi)
        value = factor * mean.mean(axis=-1)
        error = factor * mean.std(axis=-1, ddof=1) / math.sqrt(mean.shape[-1])
        nodes = sample["nodes"].values[:, 0].mean(axis=-1)
        density = exact.density(speed, time)
        draws = n * 0.5 * (nodes + 1.0) / math.exp(RATE * time)
        histogram = 1.0 / np.sqrt(2.0 * draws * density * settings["bin_width"])
        rows.append((value, error, density, error / density, histogram, nodes))
    table = np.array(rows)
    names = {
        "value": "estimate of f(v, t)",
        "error": "standard error, from the replicates",
        "exact": "eq. (8)",
        "relative_error": "standard error over eq. (8)",
        "histogram_error": "relative error of a histogram bin at equal cost",
        "nodes": "mean recursion",
    }
    return xr.Dataset(
        {
            name: store.described(table[:, k], ("time", "speed"), text)
            for k, (name, text) in enumerate(names.items())
        },
        coords={"time": times, "speed": settings["speed"]},
    )


def claims(dataset):
    """Check the estimates against eq. (8) at the first time, whose variance is finite."""
    here, settings = dataset.isel(time=0), dataset.attrs["settings"]
    parts = []
    for speed in settings["claim_speed"]:
        one = here.sel(speed=speed)
        mean = estimate.Mean(float(one.value), float(one.error), settings["n_replicates"] - 1)
        parts.append(verdict.Part(mean, f"v = {speed:g}", printed=float(one.exact)))
    evidence = f"f(v, t) at t = {float(here.time):g}."
    return [verdict.Finding("kac_probe_density", tuple(parts), evidence)]


def draw(dataset):
    """Draw the density down to where no histogram reaches, and the relative errors."""
    figure, axes = plotting.panels(1, 2)
    grid = np.linspace(0.0, float(dataset.speed.max()), 300)
    for k, time in enumerate(dataset.time.values):
        here = dataset.sel(time=time)
        axes[0].plot(grid, exact.density(grid, time), color="black", lw=0.8)
        label = f"$t$ = {time:g}"
        plotting.points(axes[0], here.speed, here.value, here.error, k, label, line=False)
        colour, marker = plotting.COLOURS[k], plotting.MARKERS[k]
        axes[1].plot(here.speed, here.relative_error, marker, color=colour, ms=4, label=label)
        axes[1].plot(here.speed, here.histogram_error, ls="--", color=colour, lw=1)
    axes[0].set_ylabel("density $f(v,t)$, lines eq. (8)")
    axes[1].set_ylabel("relative error (dashed: histogram)")
    axes[1].set_ylim(1e-5, 10.0)
    for axis in axes:
        axis.set_yscale("log")
        axis.set_xlabel("velocity $v$")
        axis.legend()
    return figure
