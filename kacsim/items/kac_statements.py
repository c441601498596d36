"""Study: what sections 2 to 4 of the Kac paper state, tested exactly, without a draw."""

import math

from kacsim.items import _kac, _statements
from kacsim.items._lazy import (
    bird,
    exact,
    kac,
    nanbu_babovsky,
    nanbu_sequential,
    nanbu_synchronous,
    np,
    plotting,
    statements,
    store,
    xr,
)
from kacsim.items._statements import CURVES, DEGREE, NAMES, ORDERS
from kacsim.kac.constants import MEAN_ENERGY, RATE
from kacsim.kac.samplers import TITLES


def cases(settings):
    """Return nothing: everything here is exact."""
    return []


problems = _kac.problems_of_step


def reduce(samples, settings):
    """Return exact values against N, and what each statement is tested by."""
    numbers = settings["n_particles"]
    rows = [_against_n(n, settings) for n in numbers]
    table = {key: [row[key] for row in rows] for key in rows[0]}
    described, dims = store.described, ("n_particles",)
    variables = {
        "moment": described(table["moment"], (*dims, "curve"), "E v**4 at the fixed step"),
        "growth": described(
            table["growth"], (*dims, "reading"), "E (sum of v**2)**2 over that at the start, less 1"
        ),
        "process": described(table["process"], dims, "E v**4 of Kac's process"),
        "series": described(
            table["series"], dims, "E v**4, Poisson series of the printed solution"
        ),
        "bird": described(table["bird"], dims, "E v**4 of Bird's algorithm"),
        "replaced": described(table["replaced"], dims, "E v**4, Nanbu-Babovsky with replacement"),
        "count": described(table["count"], dims, "collisions of Bird's algorithm"),
        "expected": described(table["expected"], dims, "rate N t / 2"),
        "marginal": described(table["marginal"], dims, "mass of eq. (5) for the uniform density"),
        "mended": described(table["mended"], dims, "the same with the factor that it lacks"),
    }
    texts = {"limit": "E v**4 of eq. (8)", "discretized": "E v**4 of eq. (10)"}
    values = {
        "limit": _kac.limit_moment(settings["time"]),
        "discretized": statements.discretized_moment(settings["time"], settings["time_step"]),
    }
    variables |= {key: described(value, (), texts[key]) for key, value in values.items()}
    in_place = statements.in_place_moments(settings["time"], settings["time_step"])
    variables["in_place"] = described(in_place, ("place",), "limits of the first two curves")
    variables |= _walk(settings["few_particles"])
    variables |= _solution(settings["time"])
    variables |= _norms(settings)
    coords = {"n_particles": numbers, "curve": list(CURVES), "reading": list(_kac.READINGS)}
    coords |= {"order": list(ORDERS)}
    return xr.Dataset(variables, coords={key: (key, values) for key, values in coords.items()})


def _against_n(n, settings):
    """Return every exact value at one number of particles."""
    time, step = settings["time"], settings["time_step"]
    whole = {"n_particles": n, "time": time, "collision_rate": RATE}
    stepped = whole | {"time_step": step}
    in_place = nanbu_sequential.second_moments(**stepped)
    square, product = nanbu_synchronous.second_moments(**stepped)
    disjoint = nanbu_babovsky.fourth_moment(**stepped)
    if 2 * math.ceil(RATE * n * step / 2.0) > n:
        disjoint = math.nan  # fewer particles than disjoint pairs need
    start = 15.0 / 4.0 + (n - 1) * MEAN_ENERGY**2  # E (sum of v**2)**2 / N
    return {
        "moment": [in_place[0, 0], in_place.trace() / n, square, disjoint],
        "growth": [in_place.sum() / (n * start) - 1.0, (square + (n - 1) * product) / start - 1.0],
        "process": kac.fourth_moment(time, n),
        "series": statements.series_moment(n, time),
        "bird": kac.fourth_moment(time, n, algorithm="bird"),
        "replaced": nanbu_babovsky.fourth_moment_with_replacement(**stepped),
        "count": bird.arguments(**whole)[1],
        "expected": RATE * n * time / 2.0,
        "marginal": statements.mass_of_marginal(n, surface=False),
        "mended": statements.mass_of_marginal(n, surface=True),
    }


def _walk(n):
    """Return what the Kac walk does to polynomials, to energy and to momentum."""
    described = store.described
    symmetric, one_sided = (
        statements.unequal_pairs(n, DEGREE, angles)
        for angles in (statements.both_signs(), statements.ANGLES)
    )
    changed = statements.energy_changes(n, statements.both_signs())
    return {
        "unequal": described(
            symmetric, ("count_of",), "pairs for which eq. (2) fails, pairs tested"
        ),
        "unequal_one_sided": described(
            one_sided, ("count_of",), "the same for angles that are not symmetric about 0"
        ),
        "energy_changed": described(changed, ("count_of",), "collisions that change it, all"),
        "momentum_change": described(
            statements.momentum_change(), (), "mean square change of a pair's momentum over its own"
        ),
    }


def _solution(time):
    """Return how fast moments change by eq. (6) and by eq. (8), and eq. (8) at late times."""
    described = store.described
    by_equation, by_solution = (
        [change(order, time) for order in ORDERS]
        for change in (statements.change_by_equation, statements.change_by_solution)
    )
    speeds = np.array([0.0, 1.0, 3.0])
    ratio = exact.density(speeds, math.inf) * np.sqrt(3.0 * np.pi) * np.exp(speeds**2 / 3.0)
    return {
        "change": described(by_equation, ("order",), "d/dt of E v**order by eq. (6)"),
        "change_solution": described(by_solution, ("order",), "d/dt of E v**order by eq. (8)"),
        "late": described(ratio, ("speed",), "eq. (8) at infinite time over eq. (9)"),
        "speed": described(speeds, ("speed",), "velocity"),
    }


def _norms(settings):
    """Return both norms of the distance from f0 to eq. (8), over the bins of the figures."""
    start, later = (
        _kac.target(settings, settings["bin_width"], when)[0] for when in (0.0, settings["time"])
    )
    supremum, half_sum = statements.norms(start, later)
    return {
        "supremum": store.described(supremum, (), "largest difference of probability of a set"),
        "half_sum": store.described(half_sum, (), "half the sum of absolute differences"),
    }


claims = _statements.claims


def draw(dataset):
    """Draw the limits at a fixed step, the growth of energy, and the collisions of Bird."""
    figure, axes = plotting.panels(1, 3)
    numbers = dataset.n_particles.values
    for k, name in enumerate(CURVES):
        label = (NAMES | TITLES)[name]
        moments = dataset.moment.sel(curve=name)
        plotting.points(axes[0], numbers, moments, None, k, label)
    axes[0].axhline(float(dataset.discretized), color="black", lw=1, label="eq. (10)")
    axes[0].axhline(float(dataset.limit), color="black", ls="--", lw=1, label="eq. (8)")
    axes[0].set_ylabel("E $v^4$ at the fixed step")
    low, high = axes[0].get_ylim()
    axes[0].set_ylim(low, high + 0.9 * (high - low))
    for k, name in enumerate(_kac.READINGS):
        growth = dataset.growth.sel(reading=name)
        plotting.points(axes[1], numbers, growth, None, k, TITLES[name])
    axes[1].set_yscale("log")
    axes[1].set_ylabel("growth of E ($\\Sigma v^2)^2$")
    surplus = dataset["count"] / dataset.expected - 1.0
    plotting.points(
        axes[2], numbers, surplus, None, 0, "Bird, collisions over $\\lambda Nt/2$, less 1"
    )
    mass = 1.0 - dataset.marginal
    plotting.points(axes[2], numbers, mass, None, 1, "mass that eq. (5) lacks")
    axes[2].set_yscale("log")
    for axis in axes:
        axis.set_xscale("log")
        axis.set_xlabel("number of particles $N$")
        axis.legend()
    return figure
