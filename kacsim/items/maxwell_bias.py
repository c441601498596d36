"""Study: E |v_1|**4 of Maxwell molecules by every algorithm against N and the step."""

import math

from kacsim.items import _kac, _maxwell
from kacsim.items._lazy import maxwell, np, plotting, store, xr
from kacsim.kac.samplers import STEPPED
from kacsim.maxwell.samplers import ALGORITHMS, TITLES

cases, problems = _maxwell.cases, _maxwell.problems
MANY = 10**6  # particles at which the bias times N is taken for its limit
NAMES = {
    "moment": "mean of |v_1|**4",
    "moment_error": "standard error of the mean of |v_1|**4",
    "moment_exact": "exact mean of |v_1|**4",
}


def reduce(samples, settings):
    """Return measured and exact fourth moments, those of infinitely many particles, and biases."""
    numbers, several = settings["n_particles"], settings["step_n_particles"]
    steps, time = settings["time_step"], settings["time"]
    gas = _maxwell.MAXWELL
    shape = len(ALGORITHMS), len(numbers)
    by_n = _kac.moment_table(samples, _maxwell.particle_grid(settings), shape, gas)
    shape = len(STEPPED), len(several), len(steps)
    by_step = _kac.moment_table(samples, _maxwell.step_grid(settings), shape, gas)
    described, variables = store.described, {}
    for k, (name, text) in enumerate(NAMES.items()):
        variables[name] = described(by_n[k], ("algorithm", "n_particles"), text)
        dims = ("stepped", "step_n", "time_step")
        variables[f"step_{name}"] = described(by_step[k], dims, text)
    departures = np.concatenate([((t[0] - t[2]) / t[1]).ravel() for t in (by_n, by_step)])
    limit = _kac.limit_moment(time, gas)
    endless = [_moment(settings, name, math.inf) for name in ALGORITHMS]
    variables |= {
        "limit": described(limit, (), "E |v|**4 of the BKW mode"),
        "endless": described(
            endless, ("algorithm",), "exact mean of |v_1|**4 for N = infinity at the fixed step"
        ),
        "step_endless": described(
            [[_moment(settings, name, math.inf, step) for step in steps] for name in STEPPED],
            ("stepped", "time_step"),
            "exact mean of |v_1|**4 for N = infinity",
        ),
        "slope": described(
            [
                MANY * (_moment(settings, name, MANY) - own)
                for name, own in zip(ALGORITHMS, endless, strict=True)
            ],
            ("algorithm",),
            "N times the exact mean less that of N = infinity, for large N",
        ),
        "departure": described(departures, ("point",), "measured less exact, in standard errors"),
    }
    coords = {
        "algorithm": list(ALGORITHMS),
        "stepped": list(STEPPED),
        "n_particles": numbers,
        "step_n": several,
        "time_step": steps,
    }
    return xr.Dataset(variables, coords={key: (key, values) for key, values in coords.items()})


def _moment(settings, algorithm, n_particles, step=None):
    """Return an exact moment at a step, or at the fixed one."""
    own = {"time_step": step or settings["fixed_time_step"]} if algorithm in STEPPED else {}
    return maxwell.fourth_moment(settings["time"], n_particles, algorithm=algorithm, **own)


def draw(dataset):
    """Draw E |v_1|**4 against N and against the step, points measured and lines exact."""
    settings = dataset.attrs["settings"]
    figure, axes = plotting.panels(1, 2)
    for k, algorithm in enumerate(ALGORITHMS):
        here = dataset.sel(algorithm=algorithm)
        label = TITLES[algorithm]
        style = {"line": False}
        error = here.moment_error
        plotting.points(axes[0], here.n_particles, here.moment, error, k, label, **style)
        axes[0].plot(here.n_particles, here.moment_exact, color=plotting.COLOURS[k], lw=1)
    for algorithm in STEPPED:
        k, here = ALGORITHMS.index(algorithm), dataset.sel(stepped=algorithm)
        colour = plotting.COLOURS[k]
        for n, (dash, _) in zip(here.step_n.values, _maxwell.DASHES, strict=False):
            line, label = here.sel(step_n=n), TITLES[algorithm] if n == here.step_n[0] else None
            error = line.step_moment_error
            plotting.points(axes[1], line.time_step, line.step_moment, error, k, label, line=False)
            axes[1].plot(line.time_step, line.step_moment_exact, color=colour, lw=1, ls=dash)
        axes[1].plot(here.time_step, here.step_endless, color=colour, lw=1, ls=":")
    for axis in axes:
        axis.axhline(float(dataset.limit), color="black", ls="--", lw=1, label="BKW mode")
        axis.set_xscale("log")
        plotting.plain_log(axis.xaxis)
        plotting.legends_above([axis], 0.3, ncols=2)
    axes[0].set_title(f"step {settings['fixed_time_step']:g}")
    axes[0].set_xlabel("number of particles $N$")
    axes[0].set_ylabel("E $|v_1|^4$ at $t$ = " + f"{settings['time']:g}")
    axes[1].set_title(_maxwell.dashed(dataset.step_n.values) + ", $\\infty$ (dotted)")
    axes[1].set_xlabel("time step $\\Delta t$")
    return figure
