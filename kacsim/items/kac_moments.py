"""Study: moments of v_1 up to order 12 at finite N, exactly; and updates in place at N infinite."""

from kacsim.items import _kac
from kacsim.items._lazy import (
    high_moments,
    nanbu_sequential,
    np,
    plotting,
    sequential_limit,
    statements,
    store,
    xr,
)
from kacsim.kac.constants import RATE
from kacsim.kac.samplers import TITLES

ORDERS = (4, 6, 8, 10, 12)
ALGORITHMS = ("poisson", "bird")
PLACES = 41


def cases(settings):
    """Return nothing: everything here is exact."""
    return []


problems = _kac.problems_of_step


def reduce(samples, settings):
    """Return moments against N, Bird's with a Poisson number, and limits of updates in place."""
    time, numbers = settings["time"], settings["n_particles"]
    limit = np.array([high_moments.moment(order, time) for order in ORDERS])
    moments = [
        [[high_moments.moment(order, time, n, algorithm=name) for order in ORDERS] for n in numbers]
        for name in ALGORITHMS
    ]
    sizes = np.abs(np.array(moments) / limit - 1.0)
    few = [n for n in numbers if n <= settings["mixed_up_to"]]
    mixed = np.array([[high_moments.bird_of_poisson(k, time, n) for k in ORDERS] for n in few])
    alike = np.abs(mixed / np.array(moments[0])[: len(few)] - 1.0).max()
    places = np.linspace(0.0, 1.0, PLACES)
    step = {"time": time, "time_step": settings["time_step"], "collision_rate": RATE}
    at, mean = sequential_limit.fourth_moments(places, **step)
    finite = [nanbu_sequential.second_moments(n_particles=n, **step) for n in settings["ensembles"]]
    ends = [[m[0, 0], m.trace() / len(m), m[-1, -1]] for m in finite]
    described, dims = store.described, ("algorithm", "n_particles", "order")
    return xr.Dataset(
        {
            "moment": described(moments, dims, "exact mean of v_1**order"),
            "limit": described(limit, ("order",), "that of eq. (8)"),
            "bias": described(moments / limit - 1.0, dims, "moment over that of eq. (8), less 1"),
            "nearness": described(
                np.max(sizes[1] / sizes[0]), (), "largest |bias| of Bird over that of the process"
            ),
            "mixed": described(
                alike, (), "largest relative difference of Bird with a Poisson number of collisions"
            ),
            "in_place": described(at, ("place",), "E v**4 of updates in place, N infinite"),
            "population": described(mean, (), "its mean over all particles"),
            "discretized": described(
                statements.discretized_moment(time, settings["time_step"]), (), "E v**4 of eq. (10)"
            ),
            "ends": described(ends, ("ensemble", "end"), "exact E v**4 with N particles"),
        },
        coords={
            "algorithm": list(ALGORITHMS),
            "n_particles": numbers,
            "order": list(ORDERS),
            "place": places,
            "ensemble": settings["ensembles"],
            "end": ["first", "mean", "last"],
        },
    )


def draw(dataset):
    """Draw the biases of both algorithms against N, and E v**4 against the place in the order."""
    figure, axes = plotting.panels(1, 3)
    numbers = dataset.n_particles.values
    for axis, name in zip(axes, ALGORITHMS, strict=False):
        for k, order in enumerate(dataset.order.values):
            bias = dataset.bias.sel(algorithm=name, order=order)
            sizes = np.abs(bias)
            plotting.points(axis, numbers, sizes, None, k, f"$v^{{{order}}}$", mfc="none")
            above = bias.values > 0.0
            axis.plot(
                numbers[above],
                sizes.values[above],
                plotting.MARKERS[k],
                color=plotting.COLOURS[k],
                ms=4,
            )
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_title(f"{TITLES[name]}; full: too large")
        axis.set_xlabel("number of particles $N$")
    low = min(axes[0].get_ylim()[0], axes[1].get_ylim()[0])
    high = max(axes[0].get_ylim()[1], axes[1].get_ylim()[1])
    for axis in axes[:2]:
        axis.set_ylim(low, high)
    axes[0].set_ylabel("|bias| over the moment of eq. (8)")
    axes[0].legend(ncols=2)
    axes[2].plot(dataset.place, dataset.in_place, color="black", lw=1, label="$N\\to\\infty$")
    axes[2].axhline(float(dataset.population), color="black", ls="--", lw=1, label="mean")
    axes[2].axhline(float(dataset.discretized), color="0.4", ls=":", lw=1.2, label="eq. (10)")
    for k, n in enumerate(dataset.ensemble.values):
        ends = dataset.ends.sel(ensemble=n)
        plotting.points(axes[2], [0.0, 0.5, 1.0], ends, None, k, f"$N$ = {n}", line=False)
    axes[2].set_xlabel("place $u$ in the order of updates")
    axes[2].set_ylabel("E $v^4$, updated in place")
    axes[2].legend()
    return figure
