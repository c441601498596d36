"""Study: the error of every algorithm, at every N and step, against the time that a draw takes.

Nothing is drawn for it: the samples are those of Fig. 2 and of the study of bias. The seconds
follow from the coefficients that `kacsim benchmark --fit` has kept: every run writes the same.
"""

import math

from kacsim import costs as kept
from kacsim.items import _kac, kac_bias
from kacsim.items._lazy import exact, histogram, np, plotting, store, xr
from kacsim.kac.constants import RATE
from kacsim.kac.samplers import ALGORITHMS, ENGINES, STEPPED, TITLES
from kacsim.kac.work import of_velocities

ENDLESS = "poisson"  # follows the ancestors of one among infinitely many particles
ERRORS = ("moment", "tvn")
DASHES = ("-", "--", ":")  # of the budgets


def costs():
    """Return what the plan adds to the settings: the machine, and kind -> term -> nanoseconds."""
    kinds = [f"kac-{algorithm}-{engine}" for algorithm in ALGORITHMS for engine in ENGINES]
    nanoseconds = {kind: kept.nanoseconds(kind) for kind in kinds}
    return {"machine": kept.table()["machine"], "nanoseconds": nanoseconds}


def cases(settings):
    """Return what other items draw: all algorithms against N and step, two readings at many N."""
    many = settings["n_replicates"], settings["other_n_replicates"]
    several = [
        _kac.velocity_case(settings, reading, n_particles, step, n_replicates=many[r])
        for r, reading in enumerate(_kac.READINGS)
        for n_particles in settings["step_n_particles"]
        for step in settings["time_step"]
    ]
    grids = kac_bias.particle_grid(settings), kac_bias.step_grid(settings)
    found = [*(case for grid in grids for case in grid.values()), *several]
    return list({case.id: case for case in found}.values())


def _seconds(settings, parameters, engine):
    """Return the processor time of one draw."""
    each = settings["costs"]["nanoseconds"][f"kac-{parameters['algorithm']}-{engine}"]
    amounts = of_velocities(parameters | {"engine": engine})
    return 1e-9 * sum(amount * each.get(term, 0.0) for term, amount in amounts.items())


def reduce(samples, settings):
    """Return the errors of E v_1**4 and of the TVN, and seconds per draw on both engines."""
    points = cases(settings)
    known = [case.parameters for case in points]
    time, width = settings["time"], settings["bin_width"]
    limit = _kac.limit_moment(time)
    expected, _ = _kac.target(settings, width)
    n_replicates = min(settings["n_replicates"], settings["other_n_replicates"])
    n_draws = settings["n_draws"] * n_replicates
    floor = histogram.noise_floor(expected, n_draws)
    seconds = [[_seconds(settings, p, engine) for engine in ENGINES] for p in known]
    endless = {"algorithm": ENDLESS, "n_particles": math.inf, "time": time, "collision_rate": RATE}
    described, one = store.described, ("point",)
    variables = {
        "moment": described(
            [abs(_kac.exact_moment(case) / limit - 1.0) for case in points],
            one,
            "relative error of the exact E v_1**4 against the Kac equation",
        ),
        "moment_noise": described(_noise(time), (), "standard deviation of v**4 over its mean"),
        "tvn": described(
            [_pooled_tvn(samples[case.id], n_replicates, width, expected) for case in points],
            one,
            "TVN of as many draws of each against eq. (8)",
        ),
        "tvn_floor": described(floor, (), "mean TVN of as many exact draws"),
        "tvn_noise": described(
            floor * math.sqrt(n_draws),
            (),
            "mean TVN of exact draws times the root of their number",
        ),
        "seconds": described(seconds, (*one, "engine"), "processor time of one draw", "s"),
        "endless_seconds": described(
            _seconds(settings, endless, "ancestral"),
            (),
            "processor time of one ancestral draw for infinitely many particles",
            "s",
        ),
    }
    coords = {
        "algorithm": (one, [p["algorithm"] for p in known]),
        "n_particles": (one, [float(p["n_particles"]) for p in known]),
        "time_step": (one, [p.get("time_step") or math.nan for p in known]),
        "engine": ("engine", list(ENGINES)),
    }
    return _with_best(xr.Dataset(variables, coords=coords), settings["budget"])


def _pooled_tvn(sample, n_replicates, width, expected):
    """Return the TVN of the first replicates, all draws together."""
    counts = sample["counts"].values[:n_replicates].sum(axis=0, keepdims=True)
    return float(histogram.total_variation(histogram.coarsen(counts, width)[0], expected)[0])


def _noise(time):
    """Return the standard deviation of v**4 under eq. (8), over its mean."""
    fourth, eighth = (exact.shape_moment(order, exact.shape(time)) for order in (4, 8))
    return math.sqrt(eighth / fourth**2 - 1.0)


def _with_best(dataset, budget):
    """Add, for each budget, the least error of E v_1**4, and that of infinitely many particles.

    The error is the root of the sum of squares of the exact one and of the standard error of the
    draws that the budget has time for.
    """
    budgets, noise = np.array(budget, dtype=float), float(dataset.moment_noise)
    scatter = noise * np.sqrt(dataset.seconds.values[:, :, None] / budgets)
    errors = np.hypot(dataset.moment.values[:, None, None], scatter).reshape(-1, budgets.size)
    point, engine = np.unravel_index(errors.argmin(axis=0), dataset.seconds.shape)
    names = [TITLES[str(name)] for name in dataset.algorithm.values[point]]
    endless = noise * np.sqrt(float(dataset.endless_seconds) / budgets)
    described, dims = store.described, ("budget",)
    return dataset.assign(
        best_error=described(errors.min(axis=0), dims, "least error of E v_1**4 at finite N"),
        best_algorithm=described(names, dims, "its algorithm"),
        best_engine=described([ENGINES[e] for e in engine], dims, "its engine"),
        best_n=described(dataset.n_particles.values[point], dims, "its number of particles"),
        endless_error=described(endless, dims, "error of E v_1**4 for infinitely many particles"),
    ).assign_coords(budget=("budget", budgets))


def draw(dataset):
    """Draw both errors against the seconds of a draw, and the noise that some budgets leave."""
    settings = dataset.attrs["settings"]
    figure, axes = plotting.panels(1, 2, height=4.0)
    span = np.array([0.5, 2.0]) * [dataset.seconds.min(), dataset.seconds.max()]
    for axis, error in zip(axes, ERRORS, strict=True):
        for k, algorithm in enumerate(ALGORITHMS):
            here = dataset.isel(point=(dataset.algorithm == algorithm).values)
            _series(axis, here, error, k, settings["fixed_time_step"])
        for budget, dash in zip(settings["budget"], DASHES, strict=False):
            noise = float(dataset[f"{error}_noise"]) * np.sqrt(span / budget)
            style = {"color": "0.3", "lw": 1, "ls": dash, "zorder": 1}
            axis.plot(span, noise, label=f"noise after {budget:g} s", **style)
        name = f"$N$ = $\\infty$, {TITLES[ENDLESS]}"
        style = {"color": "black", "lw": 1, "ls": "-.", "zorder": 1}
        axis.axvline(float(dataset.endless_seconds), label=name, **style)
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xlim(*span)
        axis.set_xlabel("processor seconds of one draw")
    axes[0].set_ylabel("relative error of E $v_1^4$, exact")
    axes[1].set_ylabel("TVN of many draws together")
    plotting.floor(axes[1], float(dataset.tvn_floor))
    for face, engine in (("0.3", "ancestral"), ("white", "forward")):
        axes[1].plot([], [], "o", color="0.3", mfc=face, ms=4, label=engine)
    handles, labels = axes[1].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3, **plotting.TIGHT)
    return figure


def _series(axis, here, error, k, fixed_step):
    """Draw one algorithm: all its steps as dots, and a line through N at the fixed one."""
    algorithm, colour = str(here.algorithm.values[0]), plotting.COLOURS[k]
    step, stepped = here.time_step.values, algorithm in STEPPED
    along = np.flatnonzero(step == fixed_step if stepped else np.isnan(step))
    along = along[np.argsort(here.n_particles.values[along])]
    for engine in ENGINES:
        face = colour if engine == "ancestral" else "white"
        style = {"color": colour, "mfc": face, "mew": 0.8, "lw": 0, "marker": plotting.MARKERS[k]}
        x, y = here.seconds.sel(engine=engine).values, here[error].values
        if stepped:
            axis.plot(x, y, **style | {"ms": 2, "alpha": 0.6})
        label = TITLES[algorithm] if engine == "ancestral" else None
        axis.plot(x[along], y[along], **style | {"ms": 4, "lw": 0.8, "label": label})
