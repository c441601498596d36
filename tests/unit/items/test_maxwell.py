"""The studies of Maxwell molecules, on samples with known moments, counts and TVN. No z tests."""

import math

import numpy as np
import pytest
from fabricated import FINE_LIMIT, FINE_WIDTH, about, reduced, rounded, settings, velocities
from scipy import stats

from kacsim.items import maxwell_bias, maxwell_cost, maxwell_tvn

N_DRAWS, N_REPLICATES, TIME = 10**6, 4, 2.0
NUMBERS, SEVERAL, STEPS = [3, 10], [10, 20], [1.0, 0.5]
STEPPED = ("nanbu_sequential", "nanbu_synchronous", "nanbu_babovsky")
ORDER = (*STEPPED, "bird", "poisson", "poisson_printed")
GRID = {
    "n_particles": NUMBERS,
    "step_n_particles": SEVERAL,
    "time_step": STEPS,
    "n_draws": N_DRAWS,
    "n_replicates": N_REPLICATES,
}
LIMIT = 15.0 - 2.4 * math.exp(-TIME / 3.0)


def level(case):
    """Return a number that tells every case from every other."""
    p = case.parameters
    return ORDER.index(p["algorithm"]) + 0.01 * p["n_particles"] + 0.2 * (p.get("time_step") or 0.0)


def bkw_bins():
    """Return float64[322], the probabilities of the speed in the fine bins.

    A mixture: Maxwellian of variance K with the weight (5 K - 3) / (2 K), else |v|**2 / K is
    chi-squared with 5 degrees of freedom.
    """
    k = 1.0 - 0.4 * math.exp(-TIME / 6.0)
    edges = np.linspace(-FINE_LIMIT, FINE_LIMIT, round(2 * FINE_LIMIT / FINE_WIDTH) + 1)
    square = np.maximum(edges, 0.0) ** 2 / k
    weight = (5.0 * k - 3.0) / (2.0 * k)
    below = weight * stats.chi2(3).cdf(square) + (1.0 - weight) * stats.chi2(5).cdf(square)
    return np.diff(below, prepend=0.0, append=1.0)


def make(case):
    """Return moments of `level` about 13, and a TVN of a hundredth of it."""
    lost = [round(0.01 * (1.0 + level(case)) * N_DRAWS)] * case.n_replicates
    counts = np.array([rounded(bkw_bins(), N_DRAWS - many) for many in lost])
    counts[:, 0] += lost
    # v2 comes out 0.01 too large, and v4 on average 10 times as much.
    high = {"v2": 3.01, "v4": 13.0 + level(case) + 0.1}
    square = high["v4"] - high["v2"] ** 2
    high["v6"] = high["v4"] * high["v2"] + 10.0 * square
    high["v8"] = high["v4"] ** 2 + 16.0 + 100.0 * square
    return velocities(case, counts, **high)


@pytest.fixture(scope="module")
def bias():
    return reduced("maxwell_bias", settings("maxwell_bias", **GRID), make)


@pytest.fixture(scope="module")
def tvn():
    return reduced("maxwell_tvn", settings("maxwell_tvn", **GRID), make)


def test_moments_stand_at_their_algorithm_n_and_step(bias):
    """The mean square is known to be 3 and serves as a control variate."""
    for k, algorithm in enumerate(ORDER):
        step = 0.125 if algorithm in STEPPED else 0.0
        for n in NUMBERS:
            here = bias.sel(algorithm=algorithm, n_particles=n)
            assert float(here.moment) == pytest.approx(13.0 + k + 0.01 * n + 0.2 * step)
            error = 4.0 / math.sqrt(N_DRAWS * N_REPLICATES)
            assert float(here.moment_error) == pytest.approx(error)
    for k, algorithm in enumerate(STEPPED):
        for n in SEVERAL:
            for step in STEPS:
                here = bias.step_moment.sel(stepped=algorithm, step_n=n, time_step=step)
                assert float(here) == pytest.approx(13.0 + k + 0.01 * n + 0.2 * step)


def test_exact_moments_are_those_of_each_process(bias):
    """Bird at N = 3 makes three collisions; N = infinity, 16 or 2 steps of the limit."""
    assert float(bias.limit) == pytest.approx(LIMIT, rel=1e-14)
    synchronous = bias.sel(algorithm="nanbu_synchronous")
    assert float(synchronous.endless) == pytest.approx(15.0 - 2.4 * (1.0 - 0.125 / 3.0) ** 16)
    here = bias.step_endless.sel(stepped="nanbu_babovsky", time_step=1.0)
    assert float(here) == pytest.approx(15.0 - 2.4 * (1.0 - 1.0 / 3.0) ** 2)
    # By the enumeration of `test_maxwell_moments.test_bird_and_the_process_by_enumeration`.
    here = bias.moment_exact.sel(n_particles=3)
    assert float(here.sel(algorithm="bird")) == pytest.approx(13.600823, abs=1e-6)
    assert float(here.sel(algorithm="poisson")) == pytest.approx(13.494661, abs=1e-6)


@pytest.mark.parametrize(
    ("algorithm", "limit"),
    [("poisson", LIMIT), ("nanbu_synchronous", 15.0 - 2.4 * (1.0 - 0.125 / 3.0) ** 16)],
)
def test_the_slope_is_that_of_the_bias_against_one_over_n(bias, algorithm, limit):
    """Without what a step leaves of the error for N = infinity; by twice as many particles."""
    chosen, numbers = bias.attrs["settings"], (2000, 4000)
    first = [n * (maxwell_bias._moment(chosen, algorithm, n) - limit) for n in numbers]
    slope = bias.slope.sel(algorithm=algorithm)
    assert float(slope) == pytest.approx(2.0 * first[1] - first[0], rel=1e-4)


def test_departures_are_in_standard_errors(bias):
    assert bias.departure.size == 6 * 2 + 3 * 2 * 2
    here = bias.isel(algorithm=0, n_particles=0)
    z = float((here.moment - here.moment_exact) / here.moment_error)
    assert float(bias.departure[0]) == pytest.approx(z)
    here = bias.isel(stepped=-1, step_n=-1, time_step=-1)
    z = float((here.step_moment - here.step_moment_exact) / here.step_moment_error)
    assert float(bias.departure[-1]) == pytest.approx(z)


def test_tvn_is_against_the_bkw_mode(tvn):
    """A share of the draws is in the lower tail, where no speed is."""
    assert tvn.bin_width[0] == 0.1
    for k, algorithm in enumerate(ORDER):
        step = 0.125 if algorithm in STEPPED else 0.0
        for n in NUMBERS:
            here = tvn.tvn.sel(algorithm=algorithm, n_particles=n).isel(bin_width=0)
            assert float(here) == pytest.approx(0.01 * (1 + k + 0.01 * n + 0.2 * step), abs=5e-5)
    here = tvn.step_tvn.sel(stepped="nanbu_babovsky", step_n=20, time_step=0.5).isel(bin_width=0)
    assert float(here) == pytest.approx(0.01 * (1 + 2 + 0.2 + 0.1), abs=5e-5)


def test_the_nearest_algorithm_at_each_n(tvn):
    assert tvn.nearest.values.tolist() == ["nanbu_sequential"] * 2
    least = 0.01 * (1.0 + 0.01 * np.array(NUMBERS) + 0.2 * 0.125) - float(tvn.floor[0])
    assert tvn.least.values == pytest.approx(least, abs=5e-5)


def test_the_noise_floor_is_that_of_the_speed(tvn):
    """Half the sum of mean absolute deviations, of which each is nearly that of a normal law."""
    wide = bkw_bins()[1:-1].reshape(-1, 2).sum(axis=1)
    wide = wide[wide > 1e-4]
    normal = 0.5 * np.sqrt(2.0 * wide * (1.0 - wide) / (math.pi * N_DRAWS)).sum()
    assert float(tvn.floor[0]) == pytest.approx(normal, rel=0.02)


def test_cases_are_shared():
    """Both studies read the same samples; a step that both grids have is drawn once."""
    several = [
        [case.id for case in item.cases(settings(name))]
        for item, name in ((maxwell_bias, "maxwell_bias"), (maxwell_tvn, "maxwell_tvn"))
    ]
    assert several[0] == several[1]
    assert len(set(several[0])) < len(several[0])


def test_more_particles_than_dashes_are_refused():
    chosen = settings("maxwell_tvn", step_n_particles=[5, 10, 20, 50])
    ((key, sentence),) = maxwell_tvn.problems(chosen)
    assert (key, sentence) == ("step_n_particles", "must be at most 3")


# Cost


def count(p):
    """Return a number that tells every case from every other."""
    n = 7.0 if p["n_particles"] == math.inf else p["n_particles"]
    forward = 100.0 if p["engine"] == "forward" else 0.0
    return forward + 10.0 * (p["algorithm"] == "poisson") + n + 0.1 * p["time"]


@pytest.fixture(scope="module")
def cost():
    chosen = settings(
        "maxwell_cost",
        forward_n_particles=[3, 50],
        n_particles=[5, 20],
        growth_time=[1.0, 3.0],
        n_replicates=N_REPLICATES,
    )
    terms = {"draw": 100.0, "collision": 10.0}
    nanoseconds = dict.fromkeys(chosen["costs"]["nanoseconds"], terms)
    nanoseconds["maxwell-bird-forward"] = {}
    chosen["costs"] = {"machine": "one", "nanoseconds": nanoseconds}

    def make(case):
        return velocities(case, collisions=about(count(case.parameters), 0.25, N_REPLICATES))

    return reduced("maxwell_cost", chosen, make)


def test_counts_stand_at_their_engine_algorithm_and_n(cost):
    p = {"time": TIME}
    for algorithm in ("bird", "poisson"):
        for n in (3, 50):
            here = cost.sel(algorithm=algorithm, forward_n=n)
            own = p | {"algorithm": algorithm, "engine": "forward", "n_particles": n}
            assert float(here.forward) == pytest.approx(count(own))
            assert float(here.forward_error) == pytest.approx(0.25)
        for n in (5, 20):
            own = p | {"algorithm": algorithm, "engine": "ancestral", "n_particles": n}
            here = cost.ancestral.sel(algorithm=algorithm, n_particles=n)
            assert float(here) == pytest.approx(count(own))
    endless = cost.ancestral.sel(n_particles=math.inf)
    assert float(endless.sel(algorithm="poisson")) == pytest.approx(17.2)
    assert math.isnan(endless.sel(algorithm="bird"))
    assert cost.growth.values == pytest.approx([17.1, 17.3])


def test_predictions_of_counts(cost):
    """N t / 2, exp(t) - 1, and at N = 5 the mean of a chain of at most five ancestors."""
    assert cost.whole_ensemble.values == pytest.approx([3.0, 50.0])
    never = 1.0 - math.exp(-TIME)
    assert cost.poisson_exact.values == pytest.approx([3.0 - never / 2, 50.0 - 24.0 * never])
    assert cost.growth_exact.values == pytest.approx([math.expm1(1.0), math.expm1(3.0)])
    assert float(cost.ancestral_exact[-1]) == pytest.approx(math.expm1(TIME))
    s = np.arange(1.0, 6.0)
    joined, touched = s * (5.0 - s) / 4.0, s * (1.0 - (s - 1.0) / 8.0)
    chances, expected, parts = np.eye(5)[0], 0.0, 20_000
    for _ in range(parts):
        expected += touched @ chances * TIME / parts
        chances = chances + TIME / parts * (np.r_[0.0, (joined * chances)[:-1]] - joined * chances)
    assert float(cost.ancestral_exact[0]) == pytest.approx(expected, rel=1e-3)


def test_times_follow_from_coefficients(cost):
    """100 ns a draw and 10 ns a collision, N t / 2 of them; nothing where none were measured."""
    forward = cost.forward_seconds
    assert np.isnan(forward.sel(algorithm="bird")).all()
    here = forward.sel(algorithm="poisson").values
    assert here == pytest.approx([1.3e-7, 6.0e-7])
    endless = cost.ancestral_seconds.sel(algorithm="poisson", n_particles=math.inf)
    assert float(endless) == pytest.approx(1e-9 * (100.0 + 10.0 * math.expm1(TIME)))


@pytest.mark.parametrize(
    ("name", "item"),
    [("bias", maxwell_bias), ("tvn", maxwell_tvn), ("cost", maxwell_cost)],
)
def test_figures_name_every_algorithm(name, item, request):
    dataset = request.getfixturevalue(name)
    figure = item.draw(dataset)
    titles = {text.get_text() for axis in figure.axes for text in axis.get_legend().get_texts()}
    wanted = ("Bird", "Poisson (exact)") if name == "cost" else ("Bird", "Nanbu (synchronous)")
    assert all(any(title.startswith(word) for title in titles) for word in wanted)
