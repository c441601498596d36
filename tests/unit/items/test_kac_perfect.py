"""The study of the perfect sampler: laws, correlations and work of samples written down by hand."""

import math

import fabricated
import numpy as np
import pytest
from scipy import stats

from kacsim.items import kac_perfect
from kacsim.statistics import verdict

BINS = 8192
SIZE = {
    "n_particles": [3, 4],
    "biased_n_particles": [3],
    "n_draws": 1000,
    "n_replicates": 2,
    "fixed_n_particles": 50,
    "cost_n_particles": [3, 50],
    "block": [2000, 3000],
    "cost_n_draws": 100,
    "cost_n_replicates": 4,
}
COSTS = {
    "costs": {
        "machine": "by hand",
        "nanoseconds": {"kac_perfect": {"entry": 0.5}, "kac_equilibrium": {"entry": 1.0}},
    }
}


def law(n):
    """Return the distribution function of v_1 over the radius, by scipy."""
    half = stats.beta(0.5, 0.5 * (n - 1))
    return lambda v: 0.5 + 0.5 * np.sign(v) * half.cdf(np.minimum(1.0, v**2))


def levels(case, moved=0.0):
    """Return counts that follow the law, a share of all moved from the lowest to the middle one."""
    n, size = case.parameters["n_particles"], case.n_draws * case.n_replicates
    edges = np.linspace(-1.0, 1.0, BINS + 1)
    counts = fabricated.rounded(np.diff(law(n)(edges)), size)
    taken = round(moved * size)
    first = np.flatnonzero(np.cumsum(counts) > taken)[0]
    below = counts[:first].sum()
    counts[:first] = 0
    counts[first] -= taken - below
    counts[BINS // 2] += taken
    return np.stack([counts] + [0 * counts] * (case.n_replicates - 1))


def perfect(case, blocks=1.25, moved=0.0, products=(0.0, 0.0, 0.0, 0.0)):
    base = fabricated.velocities(case, v2=1.5, v4=4.05, v8=60.0)
    found = base.drop_vars(["collisions", "own_collisions", "own_variance"])
    return found.assign(
        level_counts=(("replicate", "level"), levels(case, moved)),
        lag_product=(("replicate", "lag"), np.tile(products, (case.n_replicates, 1))),
        blocks=("replicate", np.full(case.n_replicates, blocks)),
    )


def biased(case, mean=3000.0):
    """Return epsilon-perfect draws, all just above v_1 = 0."""
    counts = np.tile(fabricated.bins({0.0: case.n_draws}), (case.n_replicates, 1))
    base = fabricated.velocities(case, counts=counts)
    found = base.drop_vars(["collisions", "own_collisions", "own_variance"])
    times = {"mean": mean, "variance": 400.0, "min": 1.0, "max": 9000.0}
    return found.assign(
        coupling_time=("draw", [mean]),
        **{
            f"coupling_{name}": ("replicate", np.full(case.n_replicates, value))
            for name, value in times.items()
        },
    )


def dataset(of_perfect=perfect, of_biased=biased, **changes):
    chosen = fabricated.settings("kac_perfect", **SIZE | changes) | COSTS

    def make(case):
        return of_biased(case) if "tolerance" in case.parameters else of_perfect(case)

    return fabricated.reduced("kac_perfect", chosen, make)


def test_exact_counts_have_no_distance():
    """Counts are rounded: at most half a draw of 2000 at any edge."""
    found = dataset()
    assert (found.distance.values <= 0.5 / 2000 + 1e-12).all()
    assert found.chance.values == pytest.approx(1.0)


@pytest.mark.parametrize("moved", [0.1, 0.04])
def test_the_distance_is_the_share_that_is_elsewhere(moved):
    """Below the middle a share of all is missing: F_n is too small, by that share."""
    found = dataset(lambda case: perfect(case, moved=moved))
    assert found.distance.values == pytest.approx([moved, moved], abs=6e-4)
    wanted = stats.kstwobign.sf(math.sqrt(2000) * found.distance.values)
    assert found.chance.values == pytest.approx(wanted, rel=1e-6)


def test_draws_in_one_bin_are_half_of_all_off():
    """All epsilon-perfect draws just above 0: F_n is 0 there, F is 1/2."""
    found = dataset()
    assert float(found.biased_distance[0]) == pytest.approx(0.5)
    assert float(found.biased_chance[0]) < 1e-100


def test_a_distance_that_is_seen_is_seen_in_95_of_100_runs():
    """n = 2000 draws of a uniform law of which a share is moved over the middle, both ways."""
    distance, random = float(dataset().seen), np.random.default_rng(4)
    critical = stats.kstwobign.isf(1e-3) / math.sqrt(2000)
    assert distance == pytest.approx(critical + 0.5 * stats.norm.ppf(0.95) / math.sqrt(2000))
    edges = np.linspace(0.0, 1.0, 201)
    density = np.full(200, 1.0 / 200)
    density[:100] -= distance / 100.0
    density[100:] += distance / 100.0
    below = random.multinomial(2000, density, size=4000).cumsum(axis=1) / 2000
    seen = np.abs(below - edges[1:]).max(axis=1) > critical
    assert seen.mean() > 0.945


def test_correlations_are_products_over_the_variance():
    """v_1**2 / E of N = 3 has the variance 4/45, of N = 4 1/16."""
    for n, variance in ((3, 4.0 / 45.0), (4, 1.0 / 16.0)):
        assert stats.beta(0.5, 0.5 * (n - 1)).var() == pytest.approx(variance)
    found = dataset(lambda case: perfect(case, products=(0.01, -0.02, 0.0, 0.03)))
    wanted = np.array([0.01, -0.02, 0.0, 0.03])
    assert found.correlation.values[0] == pytest.approx(wanted * 45.0 / 4.0)
    assert found.correlation.values[1] == pytest.approx(wanted * 16.0)
    assert float(found.correlation_error) == pytest.approx(1.0 / math.sqrt(2000.0))


def test_work_is_in_steps_with_the_sweep_s_bounds():
    """N = 50: 1.25 blocks of 2707 + 50 steps; 3000 +- 20 of the other, 400 draws."""
    found = dataset().sel(cost_n=50)
    assert int(found.chosen) == 2707
    assert float(found.steps) == pytest.approx(1.25 * 2757)
    error = 2757 * math.sqrt(1.25 * 0.25 / 400.0)
    assert float(found.steps_error) == pytest.approx(error)
    assert float(found.other_steps_error) == pytest.approx(1.0)
    ratio = 1.25 * 2757 / 3000.0
    assert float(found.ratio) == pytest.approx(ratio)
    relative = math.hypot(error / (1.25 * 2757), 1.0 / 3000.0)
    assert float(found.ratio_error) == pytest.approx(ratio * relative)
    assert dataset().scan.values == pytest.approx([1.25 * 2050, 1.25 * 3050])


def test_times_are_amounts_times_nanoseconds():
    """Entries of half the time: half of the ratio of the steps that the plan expects."""
    from kacsim.kac.contraction import blocks_per_draw, predicted_steps

    found = dataset()
    for n, block in ((3, 5), (50, 2707)):
        steps = blocks_per_draw(n, block) * (block + n)
        wanted = 0.5 * steps / predicted_steps(n, 1e-6)
        assert float(found.time_ratio.sel(cost_n=n)) == pytest.approx(wanted)


def test_the_gain_is_at_most_what_lies_within_epsilon_of_an_edge():
    """2 epsilon times the density at all edges, which is 1 over the bins' width: 2e-5."""
    assert float(dataset().gain) == pytest.approx(2e-5, rel=1e-3)
    assert float(dataset(bin_width=0.2).gain) == pytest.approx(1e-5, rel=1e-3)


def claims(**changes):
    return fabricated.found("kac_perfect", dataset(**changes))


def test_the_gain_is_not_worth_it():
    found = claims()
    assert fabricated.judged(found["kac_6_perfect"])[0] == verdict.REPRODUCED
    assert found["kac_6_perfect"].parts[0].measured.standard_error == 0.0


def test_a_wrong_moment_contradicts_that_it_is_possible():
    """E v_1**4 = 3 E**2 / (N (N + 2)): 4.05 for N = 3, 4.5 for N = 4, where the samples have 4.05.

    With 2e8 draws of each the errors are small.
    """
    found = claims(n_draws=10**8)["kac_6_possible"]
    assert [part.label for part in found.parts] == ["N = 3", "N = 4"]
    assert [part.printed for part in found.parts] == pytest.approx([4.05, 4.5])
    word, parts = fabricated.judged(found)
    assert parts == [verdict.REPRODUCED, verdict.CONTRADICTED]
    assert word == verdict.CONTRADICTED


def test_particles_that_are_not_drawn_are_refused():
    chosen = fabricated.settings("kac_perfect", **SIZE)
    assert list(kac_perfect.problems(chosen)) == []
    wrong = chosen | {"biased_n_particles": [5], "fixed_n_particles": 7}
    assert [key for key, _ in kac_perfect.problems(wrong)] == [
        "biased_n_particles",
        "fixed_n_particles",
    ]
