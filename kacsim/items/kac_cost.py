"""Study: collisions simulated per draw, forward and ancestral, against N and against time."""

import math

from kacsim.items import _kac
from kacsim.items._lazy import (
    ancestors,
    bird,
    estimate,
    np,
    plotting,
    statements,
    store,
    verdict,
    xr,
)
from kacsim.kac.constants import RATE
from kacsim.kac.samplers import TITLES

FORWARD, ANCESTRAL = ("bird", "poisson"), ("bird", "poisson")


def _forward_grid(settings):
    return {
        (a, n): _case(settings, algorithm, n_particles, settings["time"], engine="forward")
        for a, algorithm in enumerate(FORWARD)
        for n, n_particles in enumerate(settings["forward_n_particles"])
    }


def _ancestral_grid(settings):
    grid = {
        (a, n): _case(settings, algorithm, n_particles, settings["time"], engine="ancestral")
        for a, algorithm in enumerate(ANCESTRAL)
        for n, n_particles in enumerate(settings["n_particles"])
    }
    endless = _case(settings, "poisson", math.inf, settings["time"], engine="ancestral")
    return grid | {(ANCESTRAL.index("poisson"), len(settings["n_particles"])): endless}


def _time_grid(settings):
    n_particles = settings["fixed_n_particles"]
    return {
        (k,): _case(settings, "poisson", n_particles, time, engine="ancestral")
        for k, time in enumerate(settings["growth_time"])
    }


def _case(settings, algorithm, n_particles, time, engine):
    n_draws = settings["forward_n_draws" if engine == "forward" else "n_draws"]
    return _kac.velocity_case(
        settings, algorithm, n_particles, time=time, engine=engine, n_draws=n_draws
    )


def cases(settings):
    """Return forward and ancestral draws against N, and ancestral ones against time."""
    grids = _forward_grid(settings), _ancestral_grid(settings), _time_grid(settings)
    return [case for grid in grids for case in grid.values()]


def problems(settings):
    """Return numbers of particles of the claim that are not drawn."""
    return _kac.subset(settings, "claim_n_particles", of="forward_n_particles")


def reduce(samples, settings):
    """Return collisions per draw with errors, and their predictions."""
    few = np.array(settings["forward_n_particles"], dtype=float)
    many = [*map(float, settings["n_particles"]), math.inf]
    times, time = settings["growth_time"], settings["time"]
    span, n = RATE * time, settings["fixed_n_particles"]
    forward = _kac.count_table(samples, _forward_grid(settings), (len(FORWARD), few.size))
    ancestral = _kac.count_table(samples, _ancestral_grid(settings), (len(ANCESTRAL), len(many)))
    growth = _kac.count_table(samples, _time_grid(settings), (len(times),))
    never = -math.expm1(-span)
    whole = few * span / 2
    described = store.described
    variables = {}
    for name, table, dims in (
        ("forward", forward, ("algorithm", "forward_n")),
        ("ancestral", ancestral, ("algorithm", "n_particles")),
        ("growth", growth, ("growth_time",)),
    ):
        variables[name] = described(table[0], dims, f"collisions per draw, {name}")
        variables[f"{name}_error"] = described(table[1], dims, "standard error of the mean")
    predictions = [ancestors.expected_collisions(time, n_) for n_ in many]
    variables |= {
        "whole_ensemble": described(whole, ("forward_n",), "rate N t / 2"),
        "saving_published": described(
            whole - 0.5 * few * never, ("forward_n",), "less the published saving"
        ),
        "saving_exact": described(
            whole - 0.5 * (few - 2.0) * never, ("forward_n",), "less the exact saving"
        ),
        "bird_exact": described(
            [_collisions_of_bird(n, time) for n in settings["forward_n_particles"]],
            ("forward_n",),
            "collisions of Bird's algorithm",
        ),
        "poisson_exact": described(
            [statements.poisson_collisions(n, time, (n - 2.0) / 2.0) for n in few],
            ("forward_n",),
            "mean collisions of the Poisson algorithm",
        ),
        "poisson_printed": described(
            [statements.poisson_collisions(n, time, (n - 1.0) / 2.0) for n in few],
            ("forward_n",),
            "mean collisions of the Poisson algorithm at the printed rate",
        ),
        "ancestral_exact": described(predictions, ("n_particles",), "exact mean, Kac's process"),
        "growth_exact": described(
            [ancestors.expected_collisions(t, n) for t in times], ("growth_time",), "exact mean"
        ),
        "growth_endless": described(
            [ancestors.expected_collisions(t) for t in times], ("growth_time",), "exp(rate t) - 1"
        ),
    }
    coords = {"algorithm": list(FORWARD), "forward_n": few, "n_particles": many}
    coords |= {"growth_time": times}
    return xr.Dataset(variables, coords={key: (key, list(v)) for key, v in coords.items()})


def _collisions_of_bird(n_particles, time):
    """Return the fixed number of collisions of Bird's algorithm."""
    return bird.arguments(n_particles=n_particles, time=time, collision_rate=RATE)[1]


def claims(dataset):
    """Test by how much the Poisson algorithm has fewer collisions to process than Bird's."""
    settings = dataset.attrs["settings"]
    parts, words = [], []
    for n in settings["claim_n_particles"]:
        here = dataset.sel(forward_n=float(n))
        fewer = 1.0 - float(here.poisson_exact / here.bird_exact)
        parts.append(verdict.Part(estimate.Exact(fewer), f"N = {n}"))
        words.append(
            f"N = {n}: Bird {int(here.bird_exact)}, Poisson {float(here.poisson_exact):.1f}, "
            f"at the printed rate {float(here.poisson_printed):.1f}"
        )
    drawn = _kac.mean_of(dataset, "forward", algorithm="poisson", forward_n=float(n))
    evidence = (
        f"Share of Bird’s collisions that need not be processed until t = {settings['time']:g}. "
        f"{'; '.join(words)}. Forward draws at N = {n}: {drawn.value:.0f} ± "
        f"{drawn.standard_error:.0f}. More is saved than the text says, not less."
    )
    return [verdict.Finding("kac_6_collisions", tuple(parts), evidence)]


def draw(dataset):
    """Draw collisions per draw against N, and their growth with time."""
    figure, axes = plotting.panels(1, 2)
    finite = dataset.where(np.isfinite(dataset.n_particles), drop=True)
    for k, algorithm in enumerate(dataset.algorithm.values):
        name = TITLES[str(algorithm)]
        here, there = dataset.sel(algorithm=algorithm), finite.sel(algorithm=algorithm)
        style = {"line": False}
        plotting.points(
            axes[0],
            here.forward_n,
            here.forward,
            here.forward_error,
            k,
            f"{name}, forward",
            **style,
        )
        plotting.points(
            axes[0],
            there.n_particles,
            there.ancestral,
            there.ancestral_error,
            k + 2,
            f"{name}, ancestral",
            **style,
        )
    lines = {
        "whole_ensemble": ("$\\lambda N t/2$", "-"),
        "saving_published": ("published saving", ":"),
        "saving_exact": ("exact saving", "--"),
    }
    for variable, (label, dash) in lines.items():
        axes[0].plot(dataset.forward_n, dataset[variable], color="0.3", ls=dash, lw=1, label=label)
    axes[0].plot(finite.n_particles, finite.ancestral_exact, color="0.3", lw=1)
    axes[0].set_xlabel("number of particles $N$")
    axes[0].set_ylabel("collisions simulated per draw")
    times = dataset.growth_time
    n = dataset.attrs["settings"]["fixed_n_particles"]
    plotting.points(
        axes[1], times, dataset.growth, dataset.growth_error, 3, f"ancestral, N = {n}", line=False
    )
    axes[1].plot(times, dataset.growth_exact, color="0.3", lw=1, label=f"exact, N = {n}")
    axes[1].plot(
        times, dataset.growth_endless, color="0.3", ls=":", lw=1, label="$e^{\\lambda t}-1$"
    )
    axes[1].plot(
        times, n * RATE * times / 2, color="black", ls="--", lw=1, label=f"forward, N = {n}"
    )
    axes[1].set_xlabel("time $t$")
    axes[0].set_xscale("log")
    for axis in axes:
        axis.set_yscale("log")
        axis.legend()
    return figure
