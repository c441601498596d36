"""Study: collisions and time of a draw of Maxwell molecules, forward and ancestral, against N."""

import math

from kacsim import costs as kept
from kacsim.items import _kac, _maxwell
from kacsim.items._lazy import ancestors, np, plotting, store, xr
from kacsim.kac.samplers import ENGINES, TITLES
from kacsim.kac.work import of_velocities
from kacsim.maxwell.constants import RATE

COMPARED = ("bird", "poisson")  # without a step


def costs():
    """Return what the plan adds to the settings: the machine, and kind -> term -> nanoseconds."""
    kinds = [f"maxwell-{algorithm}-{engine}" for algorithm in COMPARED for engine in ENGINES]
    nanoseconds = {kind: kept.nanoseconds(kind) for kind in kinds}
    return {"machine": kept.table()["machine"], "nanoseconds": nanoseconds}


def _case(settings, algorithm, n_particles, time, engine):
    n_draws = settings["forward_n_draws" if engine == "forward" else "n_draws"]
    return _maxwell.case(
        settings, algorithm, n_particles, time=time, engine=engine, n_draws=n_draws
    )


def _forward_grid(settings):
    return {
        (a, n): _case(settings, algorithm, n_particles, settings["time"], "forward")
        for a, algorithm in enumerate(COMPARED)
        for n, n_particles in enumerate(settings["forward_n_particles"])
    }


def _ancestral_grid(settings):
    grid = {
        (a, n): _case(settings, algorithm, n_particles, settings["time"], "ancestral")
        for a, algorithm in enumerate(COMPARED)
        for n, n_particles in enumerate(settings["n_particles"])
    }
    endless = _case(settings, "poisson", math.inf, settings["time"], "ancestral")
    return grid | {(COMPARED.index("poisson"), len(settings["n_particles"])): endless}


def _time_grid(settings):
    return {
        (k,): _case(settings, "poisson", math.inf, time, "ancestral")
        for k, time in enumerate(settings["growth_time"])
    }


def cases(settings):
    """Return forward and ancestral draws against N, and ancestral ones against time."""
    grids = _forward_grid(settings), _ancestral_grid(settings), _time_grid(settings)
    found = [case for grid in grids for case in grid.values()]
    return list({case.id: case for case in found}.values())


def _seconds(settings, grid, shape):
    """Return the processor time of one draw of each case, nan where it was not measured."""
    table = np.full(shape, np.nan)
    for place, case in grid.items():
        p = case.parameters
        each = settings["costs"]["nanoseconds"][f"maxwell-{p['algorithm']}-{p['engine']}"]
        amounts = of_velocities({**p, "collision_rate": RATE})
        if each:
            table[place] = 1e-9 * sum(n * each.get(term, 0.0) for term, n in amounts.items())
    return table


def reduce(samples, settings):
    """Return collisions per draw with errors, their exact means, and processor times."""
    few, many = settings["forward_n_particles"], [*map(float, settings["n_particles"]), math.inf]
    times, time = settings["growth_time"], settings["time"]
    described, variables = store.described, {}
    for name, grid, sizes in (
        ("forward", _forward_grid(settings), {"algorithm": COMPARED, "forward_n": few}),
        ("ancestral", _ancestral_grid(settings), {"algorithm": COMPARED, "n_particles": many}),
        ("growth", _time_grid(settings), {"growth_time": times}),
    ):
        dims, shape = tuple(sizes), tuple(len(values) for values in sizes.values())
        mean, error = _kac.count_table(samples, grid, shape)
        seconds = _seconds(settings, grid, shape)
        variables[name] = described(mean, dims, f"collisions per draw, {name}")
        variables[f"{name}_error"] = described(error, dims, "standard error of the mean")
        variables[f"{name}_seconds"] = described(seconds, dims, "processor time of one draw", "s")
    whole = 0.5 * RATE * time * np.array(few, dtype=float)
    spared = -0.5 * math.expm1(-RATE * time) * (np.array(few) - 2.0)
    exact = [ancestors.expected_collisions(time, n, RATE) for n in many]
    variables |= {
        "whole_ensemble": described(whole, ("forward_n",), "N t / 2"),
        "poisson_exact": described(
            whole - spared, ("forward_n",), "exact mean of the Poisson algorithm"
        ),
        "ancestral_exact": described(exact, ("n_particles",), "exact mean of the process"),
        "growth_exact": described([math.expm1(t) for t in times], ("growth_time",), "exp(t) - 1"),
    }
    coords = {"algorithm": list(COMPARED), "forward_n": few, "n_particles": many}
    coords |= {"growth_time": times}
    return xr.Dataset(variables, coords={key: (key, list(v)) for key, v in coords.items()})


def draw(dataset):
    """Draw collisions against N and against time, and processor times against N."""
    figure, axes = plotting.panels(1, 3)
    finite = dataset.where(np.isfinite(dataset.n_particles), drop=True)
    for k, algorithm in enumerate(COMPARED):
        here, there = dataset.sel(algorithm=algorithm), finite.sel(algorithm=algorithm)
        for m, (line, name, x) in enumerate(
            ((here, "forward", "forward_n"), (there, "ancestral", "n_particles"))
        ):
            place, label = k + len(COMPARED) * m, f"{TITLES[algorithm]}, {name}"
            error = line[f"{name}_error"]
            plotting.points(axes[0], line[x], line[name], error, place, label, line=False)
            plotting.points(axes[2], line[x], line[f"{name}_seconds"], None, place, label)
    style = {"color": "0.3", "lw": 1}
    axes[0].plot(dataset.forward_n, dataset.whole_ensemble, label="$Nt/2$", **style)
    axes[0].plot(dataset.forward_n, dataset.poisson_exact, ls="--", **style)
    axes[0].plot(finite.n_particles, finite.ancestral_exact, **style)
    error = dataset.growth_error
    plotting.points(
        axes[1], dataset.growth_time, dataset.growth, error, 3, "ancestral, $N=\\infty$", line=False
    )
    axes[1].plot(dataset.growth_time, dataset.growth_exact, label="$e^t-1$", **style)
    axes[0].set_ylabel("collisions simulated per draw")
    axes[1].set_ylabel("collisions simulated per draw")
    axes[1].set_xlabel("time $t$, in mean collision times")
    axes[2].set_ylabel("processor seconds of one draw")
    for axis in axes if np.isfinite(dataset.forward_seconds).any() else axes[:2]:
        axis.set_yscale("log")
        axis.legend()
    for axis in (axes[0], axes[2]):
        axis.set_xscale("log")
        axis.set_xlabel("number of particles $N$")
    return figure
