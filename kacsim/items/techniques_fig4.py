"""Fig. 11.4 of the chapter: volume of the 4-sphere by lattice and Monte Carlo, and d = 2 to 8."""

import math

from kacsim.items import _sphere_claims, _spheres
from kacsim.items._lazy import estimate, integration, np, plotting, store, techniques_exact, xr
from kacsim.items._spheres import MANY, PSEUDORANDOM

LABELS = ("Monte Carlo, good", "Monte Carlo, exhausted", "Monte Carlo, congruential")
MANY_LABELS = ("lattice", "Monte Carlo", "Sobol, scrambled")


problems = _spheres.problems


def cases(settings):
    """Return lattices up to the largest edge, and points of every generator."""
    return list(_spheres.cases(settings).values())


def reduce(samples, settings):
    """Return fractional errors against N, the powers of N with errors, and who is ahead."""
    found = {name: samples[case.id] for name, case in _spheres.cases(settings).items()}
    shown, dimensions = settings["shown_dimension"], settings["dimension"]
    largest = settings["largest_edge"]
    error, edge = _spheres.lattice_errors(found["lattice"], shown, largest)
    roots, root_errors = [], []
    every = settings | {"fit_from_edge": 1}
    powers = [_spheres.fit_lattice(found["lattice"], shown, every, largest)[0]]
    upper = _spheres.fit_lattice(found["lattice"], shown, settings, largest)[0]
    for name in PSEUDORANDOM:
        errors, n = _spheres.errors_of(found[name], shown)
        root, root_error = _spheres.rms(errors)
        roots.append(root)
        root_errors.append(root_error)
        powers.append(_spheres.fit(errors, n, n[0])[0])
    slopes, many = np.empty((3, len(MANY), len(dimensions))), []
    level = np.empty(len(dimensions))
    for i, d in enumerate(dimensions):
        lattice, level[i] = _spheres.fit_lattice(
            found["lattice"], d, settings, settings["power_largest_edge"]
        )
        parts = [lattice]
        for name in MANY[1:]:
            errors, n = _spheres.errors_of(found[name], d)
            parts.append(_spheres.fit(errors, n, n[0])[0])
            many.append(_spheres.rms(errors))
        slopes[:, :, i] = np.array([[p.value, p.standard_error, p.degrees] for p in parts]).T
    one = [techniques_exact.point_error(d) for d in dimensions]
    described, at = store.described, ("generator", "edge")
    both = np.array(dimensions, dtype=float)
    cross = [_spheres.crossing(a, level[i], slopes[0, 0, i]) for i, a in enumerate(one)]
    columns = np.array(many).reshape(len(dimensions), 2, 2, -1)
    lattices = np.stack(
        [_spheres.lattice_errors(found["lattice"], d, largest)[0] for d in dimensions]
    )
    volume = estimate.of_replicates(_spheres.volumes(found["good"], shown))
    circle = _spheres.fit_circles(found["circles"])
    variables = {
        "lattice_error": described(np.abs(error), ("edge",), "fractional error of the lattice"),
        "rms": described(roots, at, "root mean square fractional error"),
        "rms_error": described(root_errors, at, "standard error"),
        "shown_slope": described([p.value for p in powers], ("line",), "power of N"),
        "shown_slope_error": described([p.standard_error for p in powers], ("line",), "its error"),
        "upper_slope": described(upper.value, (), "the lattice's from the smallest M of fits on"),
        "slope": described(slopes[0], ("way", "dimension"), "power of N"),
        "slope_error": described(slopes[1], ("way", "dimension"), "standard error"),
        "runs_out": described(
            [math.inf, integration.EXHAUSTED / shown, integration.PERIOD / shown],
            ("generator",),
            "points after which a generator's numbers come again",
        ),
        "slope_degrees": described(slopes[2], ("way", "dimension"), "degrees of freedom"),
        "circle_slope": described(circle.value, (), "power of N of the lattice, larger circles"),
        "circle_slope_error": described(circle.standard_error, (), "standard error"),
        "circle_slope_degrees": described(circle.degrees, (), "degrees of freedom"),
        "line_power": described(_spheres.line_power(), (), "power of M, sum of a step on a line"),
        "volume": described(volume.value, (), "Monte Carlo's volume, most points"),
        "volume_error": described(volume.standard_error, (), "standard error"),
        "lattice_volume": described(
            (1.0 + error[-1]) * techniques_exact.ball_volume(shown), (), "S / M^d, largest M"
        ),
        "lattice_level": described(level, ("dimension",), "lattice's error extrapolated to N = 1"),
        "point_error": described(one, ("dimension",), "exact error of one random point"),
        "lattice_exponent": described(
            np.where(both == 2.0, -0.75, -2.0 / both),
            ("dimension",),
            "power predicted of a lattice",
        ),
        "sobol_exponent": described(
            -0.5 - 0.5 / both, ("dimension",), "power by counting cells that the surface cuts"
        ),
        "crossing": described(cross, ("dimension",), "N from which Monte Carlo is ahead"),
        "many_lattice": described(np.abs(lattices), ("dimension", "edge"), "fractional error"),
        "many_rms": described(
            columns[:, :, 0], ("dimension", "points_way", "points"), "rms fractional error"
        ),
        "many_rms_error": described(
            columns[:, :, 1], ("dimension", "points_way", "points"), "standard error"
        ),
        "advantage": described(
            _spheres.advantage(error, edge, shown, settings),
            (),
            "exact rms error of Monte Carlo over the lattice's, larger half of M",
        ),
    }
    coords = {
        "edge": ("edge", edge),
        "n_points": ("edge", edge**shown),
        "generator": list(PSEUDORANDOM),
        "line": ["lattice", *PSEUDORANDOM],
        "way": list(MANY),
        "points_way": list(MANY[1:]),
        "dimension": dimensions,
        "points": found["random"]["points"].values,
    }
    return xr.Dataset(variables, coords=coords)


def claims(dataset):
    """Test the powers of N, the bad generator, and where Monte Carlo gets ahead."""
    return _sphere_claims.findings(dataset)


def draw(dataset):
    """Draw errors against N in 4 dimensions, a panel a way, and what is found in 2 to 8."""
    figure, (clouds, (many, *of_dimension)) = plotting.rows((4, 3), heights=(3.1, 3.2), width=8.0)
    _published(clouds, dataset)
    _many(many, dataset.isel(dimension=-1))
    _powers(of_dimension[0], dataset)
    _ratios(of_dimension[1], dataset)
    for axis in (*clouds, many):
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xlabel("number of points $N$")
    for axis in (clouds[0], many):
        axis.set_ylabel("fractional error")
    for axis in of_dimension:
        axis.set_xlabel("dimension $d$")
    for axis in (many, *of_dimension):
        plotting.legend_on_top(axis, ncols=2)
    return figure


def _published(axes, dataset):
    """Draw the errors of the published figure, each way on its own, over the same exact line."""
    dimension = dataset.attrs["settings"]["shown_dimension"]
    n = dataset.n_points.values
    value, error = dataset.shown_slope.values, dataset.shown_slope_error.values
    axes[0].plot(n, dataset.lattice_error, "o", ms=2.5, color=plotting.COLOURS[0])
    for k, name in enumerate(PSEUDORANDOM):
        here = dataset.sel(generator=name)
        colour = {"color": plotting.COLOURS[k + 1], "fmt": plotting.MARKERS[k + 1]}
        axes[k + 1].errorbar(n, here.rms, here.rms_error, ms=2.5, elinewidth=0.6, **colour)
        _mark_numbers(axes[k + 1], dimension, float(here.runs_out), n[-1])
        axes[k + 1].set_title(LABELS[k])
    one = techniques_exact.point_error(dimension)
    for k, axis in enumerate(axes):
        axis.plot(n, one * n**-0.5, color="black", lw=1, label="exact, $N^{-1/2}$")
        axis.set_xlim(0.5, 2.0 * n[-1])
        axis.set_ylim(1e-7, 10.0)
        axis.tick_params(labelleft=k == 0)
        if k < 2:
            power = plotting.with_error(estimate.Mean(float(value[k]), float(error[k])))
            text = f"power {power}".replace("-", "−")
            axis.text(0.03, 0.03, text, transform=axis.transAxes, size=7.5)
    axes[0].set_title(f"lattice, $d$ = {dimension}")
    axes[0].legend(loc="upper right", frameon=False)


def _mark_numbers(axis, dimension, runs_out, most):
    """Count random numbers on a second axis, and mark where a generator has no new ones."""
    numbers = axis.secondary_xaxis(
        "top", functions=(lambda n: n * dimension, lambda n: n / dimension)
    )
    numbers.set_xlabel(f"random numbers, ${dimension}N$")
    if runs_out < most:
        axis.axvline(runs_out, color="0.4", ls=":", lw=1)
        place = {"transform": axis.get_xaxis_transform(), "ha": "right", "size": 7.5}
        axis.text(0.6 * runs_out, 0.03, "no new numbers\nfrom here on", **place)


def _powers(axis, dataset):
    """Draw the powers of N against the dimension, with predictions."""
    d = dataset.dimension.values
    for k, name in enumerate(MANY):
        here = dataset.sel(way=name)
        plotting.points(axis, d, here.slope, here.slope_error, k, MANY_LABELS[k], line=False)
    for variable, label, dash in (
        ("lattice_exponent", "$-2/d$ ($-3/4$ at $d$ = 2)", "-"),
        ("sobol_exponent", "$-1/2-1/(2d)$", "--"),
    ):
        axis.plot(d, dataset[variable], color="0.3", ls=dash, lw=1, label=label)
    axis.axhline(-0.5, color="black", ls=":", lw=1.2, label="$-1/2$")
    axis.set_ylabel("power of $N$")


def _ratios(axis, dataset):
    """Draw the exact error of Monte Carlo over the fitted one of the lattice."""
    for k, n in enumerate((1e4, 1e8, 1e12)):
        lattice = dataset.lattice_level * n ** dataset.slope.sel(way="lattice")
        axis.plot(
            dataset.dimension,
            dataset.point_error * n**-0.5 / lattice,
            plotting.MARKERS[k] + "-",
            ms=4,
            lw=0.8,
            color=plotting.COLOURS[k],
            label=f"$N$ = {plotting.power_of_ten(n)}",
        )
    axis.axhline(1.0, color="black", lw=1)
    axis.set_yscale("log")
    axis.set_ylabel("error, Monte Carlo / lattice (fit)")


def _many(axis, here):
    """Draw the errors in the most dimensions."""
    d = int(here.dimension)
    axis.plot(
        here.edge.values**d,
        here.many_lattice,
        "o",
        ms=2.5,
        color=plotting.COLOURS[0],
        label=MANY_LABELS[0],
    )
    for k, name in enumerate(MANY[1:]):
        one = here.sel(points_way=name)
        plotting.points(
            axis,
            one.points,
            one.many_rms,
            one.many_rms_error,
            k + 1,
            MANY_LABELS[k + 1],
            line=False,
        )
    grid = np.array([1.0, float(here.edge[-1]) ** d])
    axis.plot(grid, float(here.point_error) * grid**-0.5, color="black", lw=1, label="$N^{-1/2}$")
    axis.set_title(f"$d$ = {d}", y=1.22)
