"""The study of work and precision, on samples whose TVN is known and with costs made up."""

import math

import numpy as np
import pytest
from fabricated import reduced, settings, velocities, with_tvn
from scipy import stats

from kacsim.items import kac_work_precision, load

N_DRAWS, N_REPLICATES, TIME = 10**7, 2, 2.0
RATE = math.sqrt(math.pi) / 2
COSTS = {
    "machine": "an abacus",
    "nanoseconds": {
        f"kac-{algorithm}-{engine}": {"draw": 10.0, "particle": 4.0, "collision": 3.0 + k}
        for k, algorithm in enumerate(kac_work_precision.ALGORITHMS)
        for engine in ("ancestral", "forward")
    },
}


def tvn(p):
    return 0.004 + 0.01 * (p.get("time_step") or 0.0) + 0.1 / p["n_particles"]


def make(case):
    """The first two replicates have the mean TVN that is wanted; others, where any, none at all."""
    parts = np.array([0.5, 1.5, 0.0, 0.0])[: case.n_replicates]
    return velocities(case, with_tvn(parts * tvn(case.parameters), N_DRAWS, TIME))


@pytest.fixture(scope="module")
def dataset():
    chosen = settings(
        "kac_work_precision",
        n_particles=[3, 10],
        fixed_time_step=0.25,
        fixed_n_particles=10,
        step_n_particles=[5, 10],
        time_step=[1.0, 0.5],
        budget=[0.01, 3.0],
        n_draws=N_DRAWS,
        n_replicates=N_REPLICATES + 2,
        other_n_replicates=N_REPLICATES,
        costs=COSTS,
    )
    return reduced("kac_work_precision", chosen, make)


def at(dataset, algorithm, n, step=None):
    places = (dataset.algorithm == algorithm) & (dataset.n_particles == n)
    places &= dataset.time_step.isnull() if step is None else dataset.time_step == step
    (place,) = np.flatnonzero(places)
    return dataset.isel(point=place)


def test_every_case_is_one_point(dataset):
    """Six algorithms at two N; three at two steps and N = 10; two readings at N = 5 as well."""
    assert dataset.sizes["point"] == 6 * 2 + 3 * 2 + 2 * 2
    points = zip(
        dataset.algorithm.values, dataset.n_particles.values, dataset.time_step.values, strict=True
    )
    assert len({tuple(map(str, point)) for point in points}) == dataset.sizes["point"]


def test_nothing_is_drawn_that_other_items_do_not_draw():
    drawn = {
        case.id for name in ("kac_fig2", "kac_bias") for case in load(name).cases(settings(name))
    }
    own = kac_work_precision.cases(settings("kac_work_precision"))
    assert {case.id for case in own} <= drawn
    assert len(own) > 140


def test_errors_of_the_moment_are_exact(dataset):
    """Closed forms of Bird and Poisson, N = 10, over that of the Kac equation."""
    limit = 3.75 + 3.0 * (1.0 - math.exp(-RATE * TIME / 4))
    gain = 3.0 * 9 / 12
    poisson = 3.75 + gain * (1.0 - math.exp(-RATE * 12 * TIME / 36))
    bird = 3.75 + gain * (1.0 - (1.0 - 12 / 180) ** 9)
    for name, moment in (("poisson", poisson), ("bird", bird)):
        assert float(at(dataset, name, 10).moment) == pytest.approx(abs(moment / limit - 1.0))


def test_the_tvn_is_that_of_all_draws_together(dataset):
    for place in (("bird", 3, None), ("nanbu_synchronous", 5, 0.5), ("nanbu_babovsky", 10, 1.0)):
        wanted = tvn({"n_particles": place[1], "time_step": place[2]})
        assert float(at(dataset, *place).tvn) == pytest.approx(wanted, rel=1e-3)


def test_seconds_are_the_work_times_the_given_costs(dataset):
    """Forward Poisson, N = 10: 10 particles and 5 rate t collisions, the latter 7 ns each."""
    here = at(dataset, "poisson", 10)
    nanoseconds = 10.0 + 4.0 * 10 + 7.0 * 10 * RATE * TIME / 2
    assert float(here.seconds.sel(engine="forward")) == pytest.approx(1e-9 * nanoseconds)
    endless = 10.0 + 7.0 * math.expm1(RATE * TIME)
    assert float(dataset.endless_seconds) == pytest.approx(1e-9 * endless)
    assert float(here.seconds.sel(engine="ancestral")) < float(dataset.endless_seconds)


def test_noise_is_that_of_eq_8(dataset):
    """Variance of v**4 of the mixture of a normal law and a root of a Gamma(3/2) variate."""
    c = 1.0 / (3.0 - 2.0 * math.exp(-RATE * TIME / 8))
    fourth, eighth = (
        (1.5 * (1.0 - c) * stats.norm(scale=(0.5 / c) ** 0.5).moment(2 * k))
        + (1.5 * c - 0.5) * stats.gamma(1.5, scale=1.0 / c).moment(k)
        for k in (2, 4)
    )
    assert float(dataset.moment_noise) == pytest.approx(math.sqrt(eighth / fourth**2 - 1.0))
    assert float(dataset.tvn_floor) < 1e-3
    floor = float(dataset.tvn_noise) / math.sqrt(N_DRAWS * N_REPLICATES)
    assert float(dataset.tvn_floor) == pytest.approx(floor)


def test_the_best_of_finite_n_has_the_least_error_of_all(dataset):
    """With time enough it is that of the smallest bias; with little, noise counts too."""
    for budget in (0.01, 3.0):
        errors = [
            math.hypot(float(moment), float(dataset.moment_noise) * math.sqrt(float(s) / budget))
            for moment, both in zip(dataset.moment, dataset.seconds, strict=True)
            for s in both
        ]
        here = dataset.sel(budget=budget)
        assert float(here.best_error) == pytest.approx(min(errors))
        endless = float(dataset.moment_noise) * math.sqrt(float(dataset.endless_seconds) / budget)
        assert float(here.endless_error) == pytest.approx(endless)
    last = dataset.isel(budget=-1)
    least = dataset.isel(point=int(np.argmin(dataset.moment.values)))
    assert float(last.best_error) >= float(least.moment)
    assert float(last.best_n) == float(least.n_particles)
    assert str(last.best_engine.item()) == "ancestral"


def test_the_figure_has_a_line_for_every_algorithm_and_budget(dataset):
    figure = kac_work_precision.draw(dataset)
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert len(labels) == 6 + 2 + 1 + 1 + 2
    assert "noise after 3 s" in labels
