"""Exercises 1 to 3 of the chapter, solved and checked."""

import functools
import math

from kacsim.items import _techniques
from kacsim.items._lazy import estimate, np, plotting, store, techniques_exact, verdict, xr
from kacsim.techniques.constants import NUMBER, SPEED_2, flux_at_rest

AREA_WAYS = ("hits", "heights")
LABELS = ("points below the curve", "mean height")
BINS = 50


def _area_and_step(settings):
    """Return the area of a face times the duration of a step."""
    return 4.0 * settings["half_width"] ** 2 * settings["step"]


def _cases(settings):
    rate = _area_and_step(settings) * flux_at_rest(1.0, settings["temperature"])
    return {
        "exponential": _techniques.case(
            settings, "inversion", law="exponential", rate=settings["rate"]
        ),
        # the density that makes one particle per step and face of a cube
        "gas": _techniques.case(
            settings,
            "outer_gas",
            density=round(1.0 / rate, 12),
            temperature=settings["temperature"],
            drift=[0.0, 0.0, 0.0],
            half_width=[settings["half_width"]] * 3,
            step=settings["step"],
            n_draws=settings["gas_n_draws"],
        ),
        "area": _techniques.case(
            settings,
            "area",
            exponent=settings["exponent"],
            n_points=settings["n_points"],
            n_draws=1,
            n_replicates=settings["area_n_replicates"],
        ),
    }


def cases(settings):
    """Return draws of each exercise; those of exercise 2 are a gas that knows no fluxes."""
    return list(_cases(settings).values())


def reduce(samples, settings):
    """Return what each exercise asks for beside its closed form."""
    found = {name: samples[case.id] for name, case in _cases(settings).items()}
    return xr.Dataset(
        _exponential(found["exponential"], settings)
        | _gas(found["gas"], _cases(settings)["gas"], settings)
        | _area(found["area"], settings),
        coords={
            "way": list(AREA_WAYS),
            "points": settings["n_points"],
            "number": list(range(3)),
        },
    )


def _exponential(sample, settings):
    """Exercise 1: x = -log(1 - y) / k."""
    counts = sample["counts"].values.sum(axis=0)
    share, edges = _techniques.binned(counts, BINS)
    mean = estimate.of_replicates(_techniques.mean_of_power(sample, 1))
    gap = _techniques.distance(counts)
    described = store.described
    edges[-1] = 1.0 - 0.1 / counts.size  # the last bin has no end
    return {
        "exponential_mean": described(mean.value, (), "mean of x"),
        "exponential_mean_error": described(mean.standard_error, (), "standard error"),
        "exponential_p_value": described(
            _techniques.p_of_distance(gap, counts.sum()), (), "Kolmogorov-Smirnov p-value"
        ),
        "share": described(share, ("bin",), "share of the draws"),
        "edge": described(-np.log1p(-edges) / settings["rate"], ("edge",), "edges of the bins"),
    }


def _gas(sample, case, settings):
    """Exercise 2: v_n under 1 - exp(-v**2 / 2 T), rate n sqrt(T / 2 pi), Poisson numbers.

    The six faces of a cube, at rest in the gas, are as good as each other.
    """
    steps, sums = sample["steps"].values.sum(axis=1), sample["sum"].values.sum(axis=1)
    rate = estimate.of_replicates(_techniques.per_step(sample).mean(axis=1))
    area = _area_and_step(settings)
    square = estimate.of_replicates(sums[:, SPEED_2] / np.maximum(1.0, sums[:, NUMBER]))
    speeds, edges = sample["speeds"].values.sum(axis=(0, 1)), sample["speed_edge"].values
    law = np.diff(np.append(-np.expm1(-(edges**2) / (2.0 * settings["temperature"])), 1.0))
    shares = [estimate.of_replicates(steps[:, k] / steps.sum(axis=-1)) for k in range(3)]
    exact = case.parameters["density"] * math.sqrt(settings["temperature"] / (2.0 * math.pi))
    described = store.described
    return {
        "flux": described(rate.value / area, (), "particles per area and time"),
        "flux_error": described(rate.standard_error / area, (), "standard error"),
        "flux_exact": described(exact, (), "n sqrt(T / (2 pi))"),
        "square": described(square.value, (), "mean squared normal velocity"),
        "square_error": described(square.standard_error, (), "standard error"),
        "speed_p_value": described(
            _techniques.chi_squared(speeds, law), (), "p-value of the normal velocities"
        ),
        "number_share": described([m.value for m in shares], ("number",), "share of the steps"),
        "number_share_error": described([m.standard_error for m in shares], ("number",), "error"),
        "number_exact": described(
            [math.exp(-1.0) / math.factorial(k) for k in range(3)], ("number",), "Poisson, mean 1"
        ),
        "speeds": described(speeds, ("speed_bin",), "particles by normal velocity"),
        "speed_edge": described(edges, ("speed_bin",), "lower edge of the bin"),
    }


def _area(sample, settings):
    """Exercise 3: the area with many seeds, and the points that the wanted accuracy takes."""
    exact = techniques_exact.area(settings["exponent"])
    relative = sample["estimate"].values / exact - 1.0
    n, wanted = sample["points"].values, settings["accuracy"]
    squares = relative**2
    mean = squares.mean(axis=1)
    error = squares.std(axis=1, ddof=1) / math.sqrt(squares.shape[1])
    # N times the squared error has one mean at all N: every number of points tells of it
    of_seeds = (squares * n).mean(axis=2) / wanted**2
    needed = [estimate.of_replicates(row) for row in of_seeds]
    within = (np.abs(relative) <= wanted).mean(axis=1)
    last = [estimate.of_replicates(row) for row in sample["estimate"].values[:, :, -1]]
    described, at = store.described, ("way", "points")
    predicted = [techniques_exact.area_error(settings["exponent"], m) ** 2 for m in AREA_WAYS]
    return {
        "area": described([m.value for m in last], ("way",), "mean of the areas, most points"),
        "area_error": described([m.standard_error for m in last], ("way",), "standard error"),
        "area_exact": described(exact, (), "sqrt(pi) Gamma(1.3) / Gamma(1.8) for exponent 0.3"),
        "rms": described(np.sqrt(mean), at, "root mean square relative error over seeds"),
        "rms_error": described(error / (2.0 * np.sqrt(mean)), at, "standard error"),
        "within": described(within, at, "share of seeds within the wanted accuracy"),
        "needed": described([m.value for m in needed], ("way",), "points for this rms accuracy"),
        "needed_error": described([m.standard_error for m in needed], ("way",), "standard error"),
        "needed_exact": described(np.array(predicted) / wanted**2, ("way",), "predicted"),
    }


def claims(dataset):
    """Test the solutions of the exercises against what was drawn: checks of this project."""
    s = dataset.attrs["settings"]
    mean = functools.partial(_techniques.mean_of, dataset)
    numbers = [
        verdict.Part(
            _techniques.mean_of(dataset.isel(number=k), "number_share"),
            f"{k} injections",
            printed=float(dataset.number_exact[k]),
        )
        for k in range(3)
    ]
    areas, points = [], []
    for way, label in zip(AREA_WAYS, LABELS, strict=True):
        here, degrees = dataset.sel(way=way), s["area_n_replicates"] - 1
        area = _techniques.mean_of(here, "area", degrees)
        areas.append(verdict.Part(area, label, printed=float(dataset.area_exact)))
        needed = _techniques.mean_of(here, "needed", degrees)
        points.append(verdict.Part(needed.over(float(here.needed_exact)), label))
    last = dataset.isel(points=-1)
    return [
        verdict.finding("techniques_exercise1", mean("exponential_mean"), printed=1.0 / s["rate"]),
        verdict.finding(
            "techniques_exercise2_velocity",
            mean("square"),
            "Gas that is moved without knowing fluxes; the rival is the mean under f.",
            printed=2.0 * s["temperature"],
            rival=s["temperature"],
        ),
        verdict.finding(
            "techniques_exercise2_rate", mean("flux"), printed=float(dataset.flux_exact)
        ),
        verdict.Finding(
            "techniques_exercise2_numbers",
            tuple(numbers),
            "All faces of a cube, whose rate per step is one.",
        ),
        verdict.Finding(
            "techniques_exercise3_area", tuple(areas), f"N = {int(last.points)}, mean over seeds."
        ),
        verdict.Finding(
            "techniques_exercise3_points",
            tuple(points),
            "Points for a root mean square error over seeds of "
            f"{100 * s['accuracy']:g} %: "
            + ", ".join(
                f"{float(dataset.needed.sel(way=way)):.0f} by {label}"
                for way, label in zip(AREA_WAYS, LABELS, strict=True)
            )
            + "; measured over predicted.",
        ),
    ]


def draw(dataset):
    """Draw the exponential, the injected normal velocity, and the error of the area against N."""
    s = dataset.attrs["settings"]
    figure, axes = plotting.panels(1, 3)
    edges = dataset.edge.values
    plotting.bars(axes[0], edges, dataset.share.values / np.diff(edges), 0, "draws")
    grid = np.linspace(0.0, 4.0 / s["rate"], 200)
    axes[0].plot(
        grid, s["rate"] * np.exp(-s["rate"] * grid), color="black", lw=1, label="$k e^{-kx}$"
    )
    axes[0].set_xlim(0.0, grid[-1])
    axes[0].set_xlabel("$x$")
    axes[0].set_ylabel("density")
    axes[0].set_title(f"exercise 1, $k$ = {s['rate']:g}")
    lower = dataset.speed_edge.values
    height = dataset.speeds.values[:-1] / dataset.speeds.values.sum() / np.diff(lower)
    plotting.bars(axes[1], lower, height, 0, "gas outside, moved")
    v = np.linspace(0.0, 0.75 * lower[-1], 200)
    temperature = s["temperature"]
    law = v / temperature * np.exp(-(v**2) / (2.0 * temperature))
    axes[1].plot(v, law, color="black", lw=1, label="$(v/T)\\,e^{-v^2/2T}$")
    axes[1].set_xlim(0.0, v[-1])
    axes[1].set_xlabel("normal velocity $v_n$")
    axes[1].set_ylabel("density")
    axes[1].set_title(f"exercise 2, $T$ = {temperature:g}")
    for k in range(len(AREA_WAYS)):
        here = dataset.isel(way=k)
        plotting.points(axes[2], dataset.points, here.rms, here.rms_error, k, LABELS[k], line=False)
        n = dataset.points.values
        line = s["accuracy"] * np.sqrt(float(here.needed_exact) / n)
        axes[2].plot(n, line, color=plotting.COLOURS[k], lw=1)
    axes[2].axhline(s["accuracy"], color="0.5", ls=":", lw=1.2, label=f"{100 * s['accuracy']:g} %")
    axes[2].set_xscale("log")
    axes[2].set_yscale("log")
    axes[2].set_xlabel("number of points $N$")
    axes[2].set_ylabel("rms relative error of the area")
    axes[2].set_title("exercise 3")
    for axis in axes:
        axis.legend()
    return figure
