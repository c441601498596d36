"""Study: the variance of Algorithm 6 against its raised frequency, in a uniform gas and a trap.

In a uniform gas the second moment has an equation of its own, which the trees are compared with; in
the trap it is measured.
"""

import math

from kacsim.cases import make_case
from kacsim.items import _probes
from kacsim.items._lazy import bkw, estimate, np, null_moment, plotting, store, trap, verdict, xr

FINE = 120  # points of the curves
BUDGET = 1e8  # nodes of the largest tree that one waits for, some ten seconds
RATIOS = (1.0, 2.6)  # of the axis


def problems(settings):
    """Return (key, sentence) of each setting that does not fit another."""
    if len(settings["trap_n_draws"]) != len(settings["turn"]):
        return [("trap_n_draws", "must have one number per value of turn")]
    return []


def _uniform(settings):
    return make_case(
        "uniform_moment",
        majorant=settings["ratio"],
        time=settings["time"],
        max_nodes=settings["max_nodes"],
        n_draws=settings["n_draws"],
        n_replicates=settings["n_replicates"],
        seed=settings["seed"],
    )


def _trapped(settings):
    """Return (place of the turn, factor) -> case."""
    state = {name: settings[name] for name in ("breathing", "coupling", "max_nodes")}
    return {
        (k, factor): make_case(
            "trap",
            radius=[settings["radius"]],
            time=[2.0 * math.pi * turn],
            majorant_factor=factor,
            n_draws=n_draws,
            n_replicates=settings["n_replicates"],
            seed=settings["seed"],
            **state,
        )
        for k, (turn, n_draws) in enumerate(
            zip(settings["turn"], settings["trap_n_draws"], strict=True)
        )
        for factor in settings["factor"]
    }


def cases(settings):
    """Return realizations in a uniform gas, at velocities drawn from M, and in the trap."""
    return [_uniform(settings), *_trapped(settings).values()]


def reduce(samples, settings):
    """Return second moments with their equation, and deviation and nodes in the trap."""
    sample = samples[_uniform(settings).id]
    ratio, time = (np.array(settings[name], float) for name in ("ratio", "time"))
    fine = np.linspace(0.0, settings["latest"], FINE)
    axis = np.linspace(*RATIOS, FINE)
    square = sample["mean_square"].values
    n = settings["n_replicates"]
    critical = np.array([null_moment.critical_time(one) for one in axis])
    works = [[_work(when, one) for one in axis] for when in settings["work_time"]]
    best = np.array([null_moment.best_ratio(when) for when in settings["work_time"]])
    described, two = store.described, ("ratio", "time")
    exact = np.array([null_moment.second_moment(time, one) for one in ratio])
    variables = {
        "moment": described(square.mean(axis=-1), two, "mean of (F / M)**2"),
        "moment_error": described(
            square.std(axis=-1, ddof=1) / math.sqrt(n), two, "standard error from the replicates"
        ),
        "moment_exact": described(exact, two, "its equation"),
        "curve": described(
            [null_moment.second_moment(fine, one) for one in ratio],
            ("ratio", "fine_time"),
            "its equation, all times",
        ),
        "recursion": described(sample["nodes"].values.mean(axis=-1), two, "mean t' drawings"),
        "recursion_exact": described(
            [null_moment.mean_calls(time, one) for one in ratio], two, "mean t' drawings, exact"
        ),
        "fourth": described(
            [null_moment.fourth_moment_time(one) for one in ratio],
            ("ratio",),
            "about the time from which the fourth moment is infinite",
        ),
        "critical": described(critical, ("axis",), "time from which the variance is infinite"),
        "ratio_critical": described(
            [null_moment.critical_time(one) for one in ratio], ("ratio",), "the same"
        ),
        "safe_ratio": described(
            null_moment.safe_ratio(), (), "least ratio whose variance stays finite for ever"
        ),
        "work": described(works, ("work_time", "axis"), "t' drawings times variance"),
        "best_ratio": described(best[:, 0], ("work_time",), "ratio of the least of these"),
        "best_work": described(best[:, 1], ("work_time",), "the least of these"),
    }
    coords = {"ratio": ratio, "time": time, "fine_time": fine, "axis": axis}
    coords |= {"work_time": settings["work_time"]}
    return xr.Dataset(variables | _in_the_trap(samples, settings), coords=coords).assign_coords(
        turn=settings["turn"], factor=settings["factor"]
    )


def _work(time, ratio):
    """Return drawings times variance of a realization; inf where the variance is."""
    excess = float(null_moment.second_moment(time, ratio)) - float(bkw.mean_square(time))
    return float(null_moment.mean_calls(time, ratio)) * excess


def _in_the_trap(samples, settings):
    """Return relative deviation with its error, nodes, and where the mean tree is too large."""
    shape = (len(settings["turn"]), len(settings["factor"]))
    value, error, nodes = (np.full(shape, np.nan) for _ in range(3))
    for (k, factor), case in _trapped(settings).items():
        sample, j = samples[case.id], settings["factor"].index(factor)
        found = _probes.jackknife(_probes.relative_deviation, _probes.moments_at(sample, 0, 0))
        value[k, j], error[k, j] = found.value, found.standard_error
        nodes[k, j] = sample["nodes"].values.mean()
    described, dims = store.described, ("turn", "factor")
    last = np.full(shape[1], np.nan)
    if shape[0] > 1:
        for j in range(shape[1]):
            slope, start = np.polyfit(settings["turn"][-2:], np.log(nodes[-2:, j]), 1)
            last[j] = (math.log(BUDGET) - start) / slope
    return {
        "deviation": described(value, dims, "relative deviation of one realization in the trap"),
        "deviation_error": described(error, dims, "standard error, replicates left out in turn"),
        "nodes": described(nodes, dims, "mean t' drawings of one realization in the trap"),
        "trap_work": described(nodes * value**2, dims, "their product with the squared deviation"),
        "last_turn": described(last, ("factor",), f"turn where a mean tree has {BUDGET:g} nodes"),
    }


def claims(dataset):
    """Compare the second moments with their equation, where an error can be believed."""
    degrees = dataset.attrs["settings"]["n_replicates"] - 1
    parts = []
    for ratio in dataset.ratio.values:
        for time in dataset.time.values:
            here = dataset.sel(ratio=ratio, time=time)
            if time < float(here.fourth):
                exact = float(here.moment_exact)
                mean = estimate.Mean(float(here.moment), float(here.moment_error), degrees)
                label = f"raised frequency {ratio:g} κη, t = {time:g}"
                parts.append(verdict.Part(mean.over(exact), label, printed=1.0))
    evidence = "Means over velocities of the Maxwellian, where the fourth moment is finite, about."
    return [verdict.Finding("boltzmann_null_moment", tuple(parts), evidence)]


def draw(dataset):
    """Draw moments, the times of infinite variance, the work in a uniform gas and in the trap."""
    figure, axes = plotting.panels(2, 2, share_y=False)
    for k, ratio in enumerate(dataset.ratio.values):
        here, colour = dataset.sel(ratio=ratio), plotting.COLOURS[k]
        axes[0].plot(dataset.fine_time, here.curve, color=colour, lw=1)
        label = f"$\\hat\\nu$ = {ratio:.3g} $\\kappa\\eta$"
        plotting.points(
            axes[0], dataset.time.values, here.moment, here.moment_error, k, label, line=False
        )
    axes[0].set_ylim(1.0, 3.0)
    axes[0].set_xlabel("mean collision times")
    axes[0].set_ylabel("second moment $G$")
    axes[0].legend()
    axes[1].plot(dataset.axis, dataset.critical, color="black", lw=1)
    for value, label, dash in (
        (float(dataset.safe_ratio), "finite for ever", "--"),
        (float(trap.MAJORANT), "the text's, eq. (36)", ":"),
    ):
        axes[1].axvline(value, color="0.4", lw=1, ls=dash, label=label)
    axes[1].set_yscale("log")
    axes[1].set_xlabel("raised frequency / $\\kappa\\eta$")
    axes[1].set_ylabel("time of infinite variance\nin mean collision times")
    axes[1].legend(loc="upper left")
    for k, when in enumerate(dataset.work_time.values):
        here = dataset.sel(work_time=when)
        work = np.where(here.work < 1e3 * float(here.best_work), here.work, np.nan)
        style = {"color": plotting.COLOURS[k], "lw": 1, "label": f"$t$ = {when:g}"}
        axes[2].plot(dataset.axis, work / float(here.best_work), **style)
    axes[2].set_yscale("log")
    axes[2].set_xlabel("raised frequency / $\\kappa\\eta$")
    axes[2].set_ylabel("drawings times variance\nover the least")
    axes[2].legend()
    for k, factor in enumerate(dataset.factor.values):
        here, many = dataset.sel(factor=factor), 2.0 * dataset.deviation_error
        error = here.trap_work * many.sel(factor=factor) / here.deviation
        label = f"$\\hat\\nu$ raised {factor:g} times"
        plotting.points(axes[3], dataset.turn.values, here.trap_work, error, k, label)
    axes[3].set_yscale("log")
    axes[3].set_xlabel("$\\omega t/(2\\pi)$, in the trap")
    axes[3].set_ylabel("drawings times\nsquared deviation")
    axes[3].legend()
    return figure
