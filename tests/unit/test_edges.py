"""Extreme but allowed values give right answers; those that cannot be answered are refused."""

import math

import numpy as np
import pytest
from law.algorithms import own_parameters

from kacsim import boltzmann, kac
from kacsim.kac import exact

SIZE = {"n_draws": 400, "seed": 3}


@pytest.mark.parametrize("engine", ["forward", "ancestral"])
@pytest.mark.parametrize("algorithm", kac.ALGORITHMS)
def test_no_time_leaves_the_initial_law(algorithm, engine):
    """t = 1e-9: collisions are rarer than one in 10**6; KS against the law at t = 0, D < 0.1."""
    given = {"n_particles": 2, "time": 1e-9} | own_parameters(algorithm, 1e-9, 2)
    drawn = np.sort(kac.draw(algorithm, engine=engine, **given, **SIZE))
    gap = np.abs(exact.cumulative(drawn, 0.0) - (np.arange(400) + 0.5) / 400).max()
    if algorithm == "bird":
        assert np.isfinite(drawn).all()  # its fixed number of collisions is rounded up to one
    else:
        assert gap < 0.1


@pytest.mark.parametrize("engine", ["forward", "ancestral"])
@pytest.mark.parametrize("algorithm", ["bird", "poisson", "poisson_printed", "nanbu_babovsky"])
def test_a_long_time_keeps_the_energy(algorithm, engine):
    """t = 60 at N = 7: E[v**2] stays 3/2; 4 standard errors of 400 draws are at most 0.6."""
    given = {"n_particles": 7, "time": 60.0} | own_parameters(algorithm, 60.0, 120)
    drawn = kac.draw(algorithm, engine=engine, **given, **SIZE)
    assert abs((drawn**2).mean() - 1.5) < 0.6


@pytest.mark.parametrize("n_particles", [10**9, math.inf])
def test_an_endless_ancestry_is_refused(n_particles):
    with pytest.raises(ValueError, match=r"time = 60\.0: must be earlier"):
        kac.draw("poisson", n_particles=n_particles, time=60.0, n_draws=1, seed=1)


@pytest.mark.parametrize("algorithm", kac.ALGORITHMS)
def test_one_draw(algorithm):
    given = {"n_particles": 50, "time": 1.0} | own_parameters(algorithm, 1.0, 2)
    assert kac.draw(algorithm, n_draws=1, seed=1, **given).shape == (1,)


def test_a_tolerance_near_rounding_ends_or_is_refused():
    common = {"n_particles": 5, "n_draws": 3, "seed": 1}
    values, times = kac.draw_equilibrium(tolerance=1e-12, **common)
    assert np.isfinite(values).all()
    assert (times > 0).all()
    with pytest.raises(ValueError, match=r"tolerance = 1e-17: "):
        kac.draw_equilibrium(tolerance=1e-17, **common)


def test_a_density_of_1e_300_is_refused():
    """Its realizations are subnormal numbers or zero, which have no digits."""
    for speed in (28.0, 60.0):
        assert kac.density(speed, 0.5) < 1e-300
        with pytest.raises(ValueError, match="double precision holds no value"):
            kac.estimate_density(speed, 0.5, n_realizations=1000, seed=1)


def test_a_probe_too_far_out_says_so():
    """At v = 16 the mean is wrong by a factor of 200 at this size: the largest share tells."""
    found = kac.estimate_density(16.0, 0.5, n_realizations=100_000, seed=2)
    near = kac.estimate_density(2.0, 0.5, n_realizations=100_000, seed=2)
    assert found.largest_share > 0.2
    assert near.largest_share < 0.001
    assert abs(near.mean - kac.density(2.0, 0.5)) < 4.0 * near.standard_error


def test_probes_at_the_start_are_exact():
    found = boltzmann.estimate_bkw(1.3, 0.0, n_realizations=10, seed=1)
    assert found.standard_error == pytest.approx(0.0, abs=1e-12)
    assert found.mean_recursion == 1.0


def test_a_tree_without_end_is_ended():
    with pytest.raises(boltzmann.BudgetError, match="max_nodes"):
        boltzmann.estimate_bkw(1.0, 60.0, n_realizations=10, seed=1, max_nodes=10**5)
