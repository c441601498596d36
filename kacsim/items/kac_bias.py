"""Study: E v_1**4 of every algorithm against N and the step, measured and exact."""

import math

from kacsim.cases import make_case
from kacsim.items import _kac
from kacsim.items._lazy import estimate, nanbu_babovsky, np, plotting, store, verdict, xr
from kacsim.kac.samplers import ALGORITHMS, STEPPED, TITLES


def _particle_grid(settings):
    return {
        (a, n): _kac.velocity_case(settings, algorithm, n_particles, settings["fixed_time_step"])
        for a, algorithm in enumerate(ALGORITHMS)
        for n, n_particles in enumerate(settings["n_particles"])
    }


def _step_grid(settings):
    n_particles = settings["fixed_n_particles"]
    return {
        (a, s): _kac.velocity_case(settings, algorithm, n_particles, step)
        for a, algorithm in enumerate(STEPPED)
        for s, step in enumerate(settings["time_step"])
    }


def _forward_case(settings):
    """Return forward draws of the exact Poisson algorithm: they count what it spares."""
    return make_case(
        "kac",
        algorithm="poisson",
        engine="forward",
        n_particles=settings["fixed_n_particles"],
        time=settings["time"],
        n_draws=settings["n_draws"],
        n_replicates=settings["n_replicates"],
        seed=settings["seed"],
    )


def cases(settings):
    """Return all algorithms against N, those with a step against it, and one forward count."""
    grids = _particle_grid(settings), _step_grid(settings)
    return [*(case for grid in grids for case in grid.values()), _forward_case(settings)]


def reduce(samples, settings):
    """Return measured and exact fourth moments, and the collisions that Poisson spares."""
    by_n = _moments(samples, _particle_grid(settings), ALGORITHMS, settings["n_particles"])
    by_step = _moments(samples, _step_grid(settings), STEPPED, settings["time_step"])
    described, variables = store.described, {}
    names = ("moment", "moment_error", "moment_exact")
    texts = ("mean of v_1**4", "standard error of the mean of v_1**4", "exact mean of v_1**4")
    for k, (name, text) in enumerate(zip(names, texts, strict=True)):
        variables[name] = described(by_n[k], ("algorithm", "n_particles"), text)
        variables[f"step_{name}"] = described(by_step[k], ("stepped", "time_step"), text)
    case = _forward_case(settings)
    sample = samples[case.id]
    own = sample["own_collisions"].values
    own_error = math.sqrt(float(sample["own_variance"].mean()) / _kac.n_draws_of(case))
    simulated = estimate.of_replicates(sample["collisions"].values)
    rate, n = case.parameters["collision_rate"], settings["fixed_n_particles"]
    variables |= {
        "limit": described(_kac.limit_moment(settings["time"]), (), "E v**4 of the Kac equation"),
        "own_collisions": described(own.mean(), (), "mean collisions of particle 1"),
        "own_collisions_error": described(own_error, (), "its standard error"),
        "rate_time": described(rate * settings["time"], (), "rate times t"),
        "spared": described(rate * n * settings["time"] / 2 - simulated.value, (), "spared"),
        "spared_error": described(simulated.standard_error, (), "its standard error"),
        "replacement": described(
            nanbu_babovsky.fourth_moment_with_replacement(
                n_particles=n,
                time=settings["time"],
                time_step=settings["time_step"][0],
                collision_rate=rate,
            ),
            (),
            "exact mean of v_1**4 of Nanbu-Babovsky, pairs with replacement, largest step",
        ),
    }
    coords = {
        "algorithm": list(ALGORITHMS),
        "stepped": list(STEPPED),
        "n_particles": settings["n_particles"],
        "time_step": settings["time_step"],
    }
    return xr.Dataset(variables, coords={key: (key, values) for key, values in coords.items()})


def _moments(samples, grid, rows, columns):
    """Return (measured, error, exact), each float64[rows, columns]."""
    table = np.full((3, len(rows), len(columns)), np.nan)
    for place, case in grid.items():
        mean = _kac.fourth_moment_of(samples[case.id], case)
        table[(slice(None), *place)] = mean.value, mean.standard_error, _kac.exact_moment(case)
    return table


def claims(dataset):
    """Test the statements on rates, on replacement and on the collisions spared."""
    settings = dataset.attrs["settings"]
    n, time = settings["fixed_n_particles"], settings["time"]
    mean_own = float(dataset.rate_time)
    never = -math.expm1(-mean_own)
    step = settings["time_step"][0]
    disjoint = dataset.sel(stepped="nanbu_babovsky", time_step=step)
    return [
        verdict.Finding(
            "kac_43_exponential",
            float(dataset.own_collisions),
            float(dataset.own_collisions_error),
            printed=mean_own * time,
            corrected=mean_own,
            evidence=f"Mean collisions of particle 1 until t = {time:g}.",
        ),
        verdict.Finding(
            "kac_43_saving",
            float(dataset.spared),
            float(dataset.spared_error),
            printed=0.5 * n * never,
            corrected=0.5 * (n - 2) * never,
            evidence=f"Collisions of the whole ensemble less those simulated, N = {n}.",
        ),
        verdict.Finding(
            "kac_44_replacement",
            float(disjoint.step_moment),
            float(disjoint.step_moment_error),
            printed=float(dataset.replacement),
            corrected=float(disjoint.step_moment_exact),
            evidence=f"E v₁⁴ of Nanbu-Babovsky at N = {n} and step {step:g}.",
        ),
    ]


def draw(dataset):
    """Draw E v_1**4 against N and against the step, points measured and lines exact."""
    figure, axes = plotting.panels(1, 2)
    for k, algorithm in enumerate(dataset.algorithm.values):
        here = dataset.sel(algorithm=algorithm)
        _series(axes[0], here.n_particles, here, "", k, TITLES[str(algorithm)])
    for k, algorithm in enumerate(dataset.stepped.values):
        here = dataset.sel(stepped=algorithm)
        _series(axes[1], here.time_step, here, "step_", k, TITLES[str(algorithm)])
    for axis in axes:
        axis.axhline(float(dataset.limit), color="black", ls="--", lw=1, label="$N\\to\\infty$")
        axis.set_xscale("log")
        plotting.plain_log(axis.xaxis)
    settings = dataset.attrs["settings"]
    axes[0].set_title(f"step {settings['fixed_time_step']:g}")
    axes[0].set_xlabel("number of particles $N$")
    axes[0].set_ylabel("E $v_1^4$ at $t$ = " + f"{settings['time']:g}")
    axes[1].set_title(f"$N$ = {settings['fixed_n_particles']}")
    axes[1].set_xlabel("time step $\\Delta t$")
    axes[0].legend()
    return figure


def _series(axis, x, here, prefix, k, label):
    plotting.points(
        axis, x, here[prefix + "moment"], here[prefix + "moment_error"], k, label, line=False
    )
    axis.plot(x, here[prefix + "moment_exact"], color=plotting.COLOURS[k], lw=1)
