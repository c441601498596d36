"""The study of cost, on counts put by hand. No z tests: all is exact."""

import math

import pytest
from fabricated import about, found, judged, reduced, settings, velocities

from kacsim.items import kac_cost

N_REPLICATES, RATE, TIME = 4, math.sqrt(math.pi) / 2, 2.0
SPAN = RATE * TIME
NEVER = 1.0 - math.exp(-SPAN)
ALGORITHMS = ("bird", "poisson")


def count(engine, algorithm, n, time):
    """Return a number that tells every case from every other."""
    n = 7.0 if n == math.inf else n
    return (100.0 if engine == "forward" else 0.0) + 10.0 * ALGORITHMS.index(algorithm) + n + time


@pytest.fixture(scope="module")
def dataset():
    def make(case):
        p = case.parameters
        mean = count(p["engine"], p["algorithm"], p["n_particles"], p["time"])
        return velocities(case, collisions=about(mean, 0.25, N_REPLICATES))

    chosen = settings(
        "kac_cost",
        forward_n_particles=[3, 50, 1000],
        claim_n_particles=[50, 1000],
        n_particles=[5, 20],
        growth_time=[1.0, 3.0],
        n_replicates=N_REPLICATES,
    )
    return reduced("kac_cost", chosen, make)


def test_counts_stand_at_their_engine_algorithm_and_n(dataset):
    for algorithm in ALGORITHMS:
        for n in (3, 50, 1000):
            here = dataset.sel(algorithm=algorithm, forward_n=n)
            assert float(here.forward) == pytest.approx(count("forward", algorithm, n, TIME))
            assert float(here.forward_error) == pytest.approx(0.25)
        for n in (5, 20):
            here = dataset.sel(algorithm=algorithm, n_particles=n)
            assert float(here.ancestral) == pytest.approx(count("ancestral", algorithm, n, TIME))
    endless = dataset.ancestral.sel(n_particles=math.inf)
    assert float(endless.sel(algorithm="poisson")) == pytest.approx(7.0 + 10.0 + TIME)
    assert math.isnan(endless.sel(algorithm="bird"))
    for time in (1.0, 3.0):
        growth = dataset.growth.sel(growth_time=time)
        assert float(growth) == pytest.approx(count("ancestral", "poisson", 1000, time))


def test_predictions(dataset):
    """lambda N t / 2, less the published and less the exact saving; exp(lambda t) - 1."""
    for n in (3, 50, 1000):
        here = dataset.sel(forward_n=n)
        whole = n * SPAN / 2
        assert float(here.whole_ensemble) == pytest.approx(whole)
        assert float(here.saving_published) == pytest.approx(whole - n / 2 * NEVER)
        assert float(here.saving_exact) == pytest.approx(whole - (n - 2) / 2 * NEVER)
        assert float(here.poisson_exact) == pytest.approx(whole - (n - 2) / 2 * NEVER)
        printed = SPAN + (n - 1) / 2 * (SPAN - NEVER)
        assert float(here.poisson_printed) == pytest.approx(printed)
    assert dataset.bird_exact.values.tolist() == [3, 45, 887]
    assert dataset.growth_endless.values == pytest.approx([math.expm1(RATE), math.expm1(3 * RATE)])
    endless = dataset.ancestral_exact.sel(n_particles=math.inf)
    assert float(endless) == pytest.approx(math.expm1(SPAN))


def test_nearly_half_of_birds_collisions_are_saved(dataset):
    """1 - 24.39 / 45 and 1 - 472.0 / 887: not slightly fewer."""
    finding = found("kac_cost", dataset)["kac_6_collisions"]
    assert [part.label for part in finding.parts] == ["N = 50", "N = 1000"]
    for part, n, bird in zip(finding.parts, (50, 1000), (45, 887), strict=True):
        poisson = n * SPAN / 2 - (n - 2) / 2 * NEVER
        assert part.measured.value == pytest.approx(1.0 - poisson / bird)
    assert finding.parts[1].measured.value == pytest.approx(0.468, abs=1e-3)
    assert judged(finding)[0] == "contradicted"
    assert "N = 1000: Bird 887, Poisson 472.0, at the printed rate 472.5" in finding.evidence
    assert "Forward draws at N = 1000: 1112 ± 0" in finding.evidence


def test_a_number_of_particles_that_is_not_drawn_is_refused():
    chosen = settings("kac_cost", forward_n_particles=[50], claim_n_particles=[50, 70])
    ((key, sentence),) = kac_cost.problems(chosen)
    assert key == "claim_n_particles"
    assert "70" in sentence
