"""The study of moments: closed forms at the right order, N and place. No samples."""

import math

import pytest
from fabricated import reduced, settings

from kacsim.items import kac_moments

RATE = math.sqrt(math.pi) / 2


@pytest.fixture(scope="module")
def dataset():
    given = {"n_particles": [2, 5, 1000], "mixed_up_to": 10, "ensembles": [10, 40]}
    return reduced("kac_moments", settings("kac_moments", **given), None)


def test_fourth_moments_and_their_biases(dataset):
    limit = 3.75 + 3.0 * -math.expm1(-RATE / 2.0)
    assert float(dataset.limit.sel(order=4)) == pytest.approx(limit, rel=1e-13)
    for n in (2, 5, 1000):
        here = dataset.sel(n_particles=n, order=4)
        gain = 3.0 * (n - 1) / (n + 2)
        process = 3.75 - gain * math.expm1(-RATE * (n + 2) / (2 * (n - 1)))
        left = (1.0 - (n + 2) / (2 * n * (n - 1))) ** math.ceil(RATE * n)
        wanted = {"poisson": process, "bird": 3.75 + gain * (1.0 - left)}
        for name, value in wanted.items():
            assert float(here.moment.sel(algorithm=name)) == pytest.approx(value, rel=1e-12)
            bias = float(here.bias.sel(algorithm=name)) * limit
            assert bias == pytest.approx(value - limit, abs=1e-11)
    absolute = dataset.bias.sel(n_particles=1000, order=4) * limit
    assert absolute.sel(algorithm="bird") == pytest.approx(3.0e-4, abs=5e-6)
    assert absolute.sel(algorithm="poisson") == pytest.approx(-6.6e-4, abs=5e-6)


def test_twelfth_moment_of_two_particles(dataset):
    """Bird's two collisions leave an arcsine share of all energy: E S**6 E U**6, S of Gamma(3)."""
    here = dataset.sel(n_particles=2, order=12, algorithm="bird")
    assert float(here.moment) == pytest.approx(math.factorial(8) / 2 * 231 / 1024, rel=1e-12)


def test_the_constant_number_is_nearer_at_every_order(dataset):
    sizes = abs(dataset.bias)
    ratios = sizes.sel(algorithm="bird") / sizes.sel(algorithm="poisson")
    assert float(dataset.nearness) == pytest.approx(float(ratios.max()), rel=1e-12)
    assert 0.9 < float(dataset.nearness) < 1.0


def test_a_poisson_number_of_collisions_is_the_process(dataset):
    assert 0.0 <= float(dataset.mixed) < 1e-12


def test_updates_in_place(dataset):
    assert float(dataset.in_place[0]) == pytest.approx(4.97321, abs=5e-6)
    assert float(dataset.population) == pytest.approx(5.12441, abs=5e-6)
    assert float(dataset.discretized) == pytest.approx(4.93208, abs=5e-6)
    limits = [dataset.in_place[0], dataset.population, dataset.in_place[-1]]
    far, near = (abs(dataset.ends.sel(ensemble=n).values - limits) for n in (10, 40))
    assert far / near == pytest.approx([4.0] * 3, rel=0.1)


def test_figure(dataset):
    figure = kac_moments.draw(dataset)
    assert [len(axis.get_lines()) > 0 for axis in figure.axes] == [True] * 3


def test_a_step_that_does_not_divide_the_time_is_refused():
    (name, said), *_ = kac_moments.problems({"time": 2.0, "time_step": 0.3})
    assert name == "time_step"
    assert "divide" in said
