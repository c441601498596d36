"""Closed forms of the chapter against scipy, quadrature and numbers counted by hand.

No z tests.
"""

import math

import numpy as np
import pytest
from scipy import integrate, stats

from kacsim.techniques import circles, exact, flux, integration, pair_laws


@pytest.mark.parametrize("mean", [0.3, 7.0, 900.0])
def test_poisson_is_that_of_scipy(mean):
    """900: exp(-mean) is below the smallest double."""
    most = exact.poisson_most(mean)
    share = exact.poisson(mean, most)
    np.testing.assert_allclose(share, stats.poisson.pmf(np.arange(most + 1), mean), rtol=1e-9)
    assert share.sum() == pytest.approx(1.0, abs=1e-11)


@pytest.mark.parametrize(("n", "share"), [(2, 0.3), (35, 0.08), (4000, 0.308)])
def test_binomial_is_that_of_scipy(n, share):
    k, probability = exact.binomial(n, share)
    np.testing.assert_allclose(probability, stats.binom.pmf(k, n, share), rtol=1e-9)
    assert probability.sum() == pytest.approx(1.0, abs=1e-9)


def test_coverage_by_hand():
    """N = 3, p = 1/2: one or two hits are 1/6 off, with the error 1/3; none and all have none."""
    assert exact.coverage(3, 0.5, 1.0) == pytest.approx(0.75)
    assert exact.coverage(3, 0.5, 0.49) == pytest.approx(0.0)
    assert exact.coverage(3, 0.5, 0.51) == pytest.approx(0.75)


def test_errors_of_shares_and_of_steps():
    """Of a share the root of (1 - p) / p n; of a step, uniform in its cell, 1 / (M root 12)."""
    assert exact.share_error(50, 0.3) == pytest.approx(math.sqrt(0.7 / 0.3 / 50))
    assert exact.sample_variance(9, 0.2) == pytest.approx(1.0)
    assert exact.step_error(7) == pytest.approx(1.0 / (7.0 * math.sqrt(12.0)), rel=1e-5)


def test_circles_are_lattices_in_two_dimensions():
    edges = np.array([1, 2, 3, 10, 57])
    inside, column = np.empty(5, np.int64), np.empty(2, np.int64)
    circles.count_circles(inside, edges)
    for count, edge in zip(inside, edges, strict=True):
        integration.count_lattice(column, edge)
        assert count == column[1]


def test_edges_are_different_and_spread():
    edges = circles.spread_edges(3, 300, 50)
    assert (edges[0], edges[-1]) == (3, 300)
    assert (np.diff(edges) > 0).all()
    assert np.diff(np.log(edges[edges > 100])).std() < 0.01


# Laws that are not separable


def pair(w, v, correlation):
    """Return the bivariate normal density of scipy at (v, w)."""
    cov = [[1.0, correlation], [correlation, 1.0]]
    return stats.multivariate_normal(cov=cov).pdf([v, w])


@pytest.mark.parametrize("correlation", [0.8, -0.4])
def test_mean_of_the_entering_particles(correlation):
    """Two adaptive integrals over v f(v, w)."""

    def moment(power):
        def inner(w, v):
            return v * w**power * pair(w, v, correlation)

        return integrate.dblquad(inner, 0.0, 9.0, -9.0, 9.0, epsabs=1e-7)[0]

    mean = moment(1) / moment(0)
    assert pair_laws.exact_mean(correlation) == pytest.approx(mean, abs=1e-6)
    assert pair_laws.entering_mean(correlation) == pytest.approx(mean, abs=1e-5)
    assert pair_laws.entering_mean(correlation, 0.3) == pytest.approx(mean + 0.3, abs=1e-5)


def test_printed_steps_take_p_itself():
    """P(v, w) of scipy as a function of w at v = 0.9: its law, and that of the quadrature."""
    correlation, v = 0.8, 0.9
    law = stats.multivariate_normal(cov=[[1.0, correlation], [correlation, 1.0]])
    w = np.linspace(-6.0, 6.0, 241)
    shares = np.array([law.cdf([v, x]) for x in w]) / stats.norm.cdf(v)
    mean = (np.diff(shares) * 0.5 * (w[1:] + w[:-1])).sum()
    assert mean == pytest.approx(given_mean(v, correlation), abs=2e-4)
    assert pair_laws.printed_mean(correlation) == pytest.approx(-0.2069, abs=5e-5)
    assert pair_laws.printed_mean(correlation) == pytest.approx(
        integrate.quad(lambda r: r * math.exp(-r * r / 2) * given_mean(r, correlation), 0, 12)[0],
        rel=1e-5,
    )


def given_mean(v, correlation):
    """Return the mean of w on the condition that the normal velocity is below v."""
    return -correlation * stats.norm.pdf(v) / stats.norm.cdf(v)


def test_densities_have_their_means():
    w = np.linspace(-9.0, 9.0, 3601)
    for density, mean in (
        (pair_laws.entering_density, pair_laws.exact_mean(0.8)),
        (pair_laws.printed_density, pair_laws.printed_mean(0.8)),
    ):
        values = density(w, 0.8)
        assert np.trapezoid(values, w) == pytest.approx(1.0, abs=1e-6)
        assert np.trapezoid(values * w, w) == pytest.approx(mean, abs=1e-5)


@pytest.mark.parametrize("drift", [0.0, -0.7, 1.2])
def test_both_lines_of_the_flux(drift):
    first, second = pair_laws.flux_lines(1.4, drift)
    known = integrate.quad(lambda v: v * stats.norm.pdf(v - drift), 0.0, 1.4)[0]
    assert (first, second) == (pytest.approx(known, rel=1e-6), pytest.approx(known, rel=1e-6))
    share = float(flux.cumulative(1.4, drift, 1.0))
    assert pair_laws.flux_cumulative(1.4, drift) == pytest.approx(share, rel=1e-5)


def test_error_of_representatives_is_that_of_many_samples():
    """3000 samples of 400 particles: the spread of sum v**2 / sum v, to 5 % of its formula."""
    rng = np.random.default_rng(3)
    v = np.maximum(0.0, rng.normal(0.6, math.sqrt(1.7), (3000, 400)))
    means = (v**2).sum(axis=1) / v.sum(axis=1)
    found = flux.representative_error(0.6, 1.7, 400)
    assert means.std() / means.mean() == pytest.approx(found, rel=0.05)
