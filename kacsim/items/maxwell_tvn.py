"""Study: mean TVN of the speeds of Maxwell molecules against the BKW mode, against N and the step.

Figs. 2 and 3 of the Kac paper for the gas that the Boltzmann paper probes.
"""

from kacsim.items import _kac, _maxwell
from kacsim.items._lazy import plotting, store
from kacsim.kac.samplers import STEPPED
from kacsim.maxwell.samplers import ALGORITHMS, TITLES

cases, problems = _maxwell.cases, _maxwell.problems


def reduce(samples, settings):
    """Return the mean TVN and fourth moments of both grids, and the noise floor."""
    gas, steps = _maxwell.MAXWELL, settings["time_step"]
    coords = {"algorithm": ALGORITHMS, "n_particles": settings["n_particles"]}
    grid = _maxwell.particle_grid(settings)
    table = _kac.tvn_table(samples, grid, tuple(coords), coords, settings, gas)
    coords = {
        "stepped": STEPPED,
        "step_n": settings["step_n_particles"],
        "time_step": steps,
    }
    grid = _maxwell.step_grid(settings)
    by_step = _kac.tvn_table(samples, grid, tuple(coords), coords, settings, gas)
    names = [name for name in by_step if name != "floor"]
    excess = table.tvn.isel(bin_width=0).values - float(table.floor[0])
    return table.assign(
        {f"step_{name}": by_step[name] for name in names}
        | {
            "nearest": store.described(
                [ALGORITHMS[k] for k in excess.argmin(axis=0)],
                ("n_particles",),
                "algorithm of the least mean TVN",
            ),
            "least": store.described(
                excess.min(axis=0), ("n_particles",), "its mean TVN above the noise floor"
            ),
        }
    )


def draw(dataset):
    """Draw the mean TVN against N and against the step, with the noise floor."""
    settings = dataset.attrs["settings"]
    figure, axes = plotting.panels(1, 2, share_y=True)
    here = dataset.isel(bin_width=0)
    for k, algorithm in enumerate(ALGORITHMS):
        line, label = here.sel(algorithm=algorithm), TITLES[algorithm]
        plotting.points(axes[0], line.n_particles, line.tvn, line.tvn_error, k, label)
    for algorithm in STEPPED:
        k = ALGORITHMS.index(algorithm)
        for n, (dash, _) in zip(here.step_n.values, _maxwell.DASHES, strict=False):
            line = here.sel(stepped=algorithm, step_n=n)
            label = TITLES[algorithm] if n == here.step_n[0] else None
            error = line.step_tvn_error
            plotting.points(axes[1], line.time_step, line.step_tvn, error, k, label, ls=dash)
    for axis in axes:
        plotting.floor(axis, float(here.floor))
        axis.set_xscale("log")
        axis.set_yscale("log")
        plotting.plain_log(axis.xaxis)
        plotting.plain_log(axis.yaxis)
    plotting.legends_above(axes, 0.3, ncols=2)
    axes[0].set_title(f"step {settings['fixed_time_step']:g}")
    axes[0].set_xlabel("number of particles $N$")
    axes[0].set_ylabel("mean TVN of $|v_1|$")
    axes[1].set_title(_maxwell.dashed(here.step_n.values))
    axes[1].set_xlabel("time step $\\Delta t$")
    return figure
