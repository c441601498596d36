"""The exact laws, eqs. (8) and (9) and the equilibrium of N particles, against other derivations.

No random numbers, no false alarms.
"""

import math

import numpy as np
import pytest
from scipy import integrate, stats

from kacsim import kac
from kacsim.kac import exact

CASES = [(0.3, 0.9), (1.7, 0.9), (2.0, kac.RATE), (40.0, 1.3)]
GRID = np.linspace(-5.0, 5.0, 41)


@pytest.mark.parametrize(("time", "rate"), CASES)
def test_density_integrates_to_one_and_to_the_cumulative(time, rate):
    total, _ = integrate.quad(kac.density, -np.inf, np.inf, args=(time, rate))
    assert total == pytest.approx(1.0, abs=1e-9)
    for v in (-3.1, -0.2, 0.0, 0.7, 2.6):
        below, _ = integrate.quad(kac.density, -np.inf, v, args=(time, rate))
        assert kac.cumulative(v, time, rate) == pytest.approx(below, abs=1e-9)


@pytest.mark.parametrize(("time", "rate"), CASES)
def test_density_is_the_derivative_of_the_cumulative(time, rate):
    h = 1e-4
    upper, lower = kac.cumulative(GRID + h, time, rate), kac.cumulative(GRID - h, time, rate)
    np.testing.assert_allclose((upper - lower) / (2 * h), kac.density(GRID, time, rate), atol=1e-8)


@pytest.mark.parametrize(("time", "rate"), CASES)
def test_survival_and_cumulative_add_to_one(time, rate):
    sums = kac.survival(GRID, time, rate) + kac.cumulative(GRID, time, rate)
    np.testing.assert_allclose(sums, 1.0, rtol=1e-15)


@pytest.mark.parametrize("v", [5.0, 8.0, 12.0])
def test_survival_is_accurate_far_out(v):
    tail, _ = integrate.quad(kac.density, v, v + 8.0, args=(2.0, 0.9), epsabs=0.0)
    assert kac.survival(v, 2.0, 0.9) == pytest.approx(tail, rel=1e-8)


def test_equilibrium_is_normal():
    law = stats.norm(0.0, math.sqrt(1.5))
    np.testing.assert_allclose(kac.density(GRID, math.inf), law.pdf(GRID), rtol=1e-13)
    np.testing.assert_allclose(kac.cumulative(GRID, math.inf), law.cdf(GRID), rtol=1e-12)
    np.testing.assert_allclose(kac.survival(GRID, math.inf), law.sf(GRID), rtol=1e-12)


def test_start_is_f0():
    f0 = 2.0 / math.sqrt(math.pi) * GRID**2 * np.exp(-(GRID**2))
    np.testing.assert_allclose(kac.density(GRID, 0.0), f0, atol=1e-15)
    half = 0.5 * stats.gamma(1.5).cdf(GRID**2)
    np.testing.assert_allclose(kac.cumulative(GRID, 0.0), 0.5 + np.sign(GRID) * half, atol=1e-14)


@pytest.mark.parametrize(("time", "rate"), CASES)
def test_fourth_moment_is_the_densitys(time, rate):
    shape = exact.shape(time, rate)
    for order, expected in ((2, 1.5), (4, kac.fourth_moment(time, collision_rate=rate))):
        moment, _ = integrate.quad(lambda v, k=order: v**k * kac.density(v, time, rate), -40, 40)
        assert moment == pytest.approx(expected, rel=1e-9)
        assert exact.shape_moment(order, shape) == pytest.approx(expected, rel=1e-14)


def gain(v, time, rate):
    """Return Q+(v) = E over theta of the integral of f(v') f(w') over w, by quadrature."""
    node, weight = np.polynomial.hermite.hermgauss(60)
    scale = 1.0 / math.sqrt(exact.shape(time, rate))
    w, weight = node * scale, weight * np.exp(node**2) * scale
    theta = np.arange(64) * 2.0 * math.pi / 64
    cos, sin = np.cos(theta)[:, None], np.sin(theta)[:, None]
    pairs = [kac.density(x, time, rate) for x in (v * cos + w * sin, w * cos - v * sin)]
    return float((pairs[0] * pairs[1] * weight).sum(axis=1).mean())


def residual(v, time, rate, density=kac.density):
    """Return df/dt - rate (Q+ - f), which vanishes for a solution of the Kac equation."""
    h = 1e-4
    slope = (density(v, time + h, rate) - density(v, time - h, rate)) / (2 * h)
    return slope - rate * (gain(v, time, rate) - density(v, time, rate))


@pytest.mark.parametrize("v", [0.0, 0.4, 1.1, 2.5])
@pytest.mark.parametrize(("time", "rate"), CASES[:3])
def test_density_solves_the_kac_equation(v, time, rate):
    """Negative control: the same density run at a rate 2 % too large."""
    assert residual(v, time, rate) == pytest.approx(0.0, abs=1e-8)
    assert abs(residual(v, time, rate, lambda v, t, r: kac.density(v, 1.02 * t, r))) > 1e-5


@pytest.mark.parametrize(("time", "rate"), CASES)
def test_fourth_moment_solves_its_equation(time, rate):
    """dm/dt = rate (3/4 (m + m_2**2) - m), from E (v cos + w sin)**4, with m_2 = 3/2."""

    def moment(at):
        return kac.fourth_moment(at, collision_rate=rate)

    slope = (moment(time + 1e-4) - moment(time - 1e-4)) / 2e-4
    assert slope == pytest.approx(rate * (0.75 * (moment(time) + 2.25) - moment(time)), abs=1e-7)


@pytest.mark.parametrize("energy", [None, 4.9])
@pytest.mark.parametrize("n", [2, 3, 7, 50])
def test_equilibrium_of_n_particles_is_a_beta_law(n, energy):
    total = 1.5 * n if energy is None else energy
    v = np.linspace(-1.2, 1.2, 49) * math.sqrt(total)
    beta = stats.beta(0.5, 0.5 * (n - 1))
    expected = 0.5 + 0.5 * np.sign(v) * beta.cdf(np.minimum(v**2 / total, 1.0))
    np.testing.assert_allclose(exact.equilibrium_cumulative(v, n, energy), expected, atol=1e-12)
    moment = total**2 * beta.moment(2)
    assert exact.equilibrium_fourth_moment(n, energy) == pytest.approx(moment, rel=1e-12)


def test_an_energy_drawn_from_f0_mixes_the_laws():
    """By quadrature over E ~ Gamma(3 N / 2, 1); E v**4 = 3 E[E**2] / (N (N + 2))."""
    n, v = 5, np.array([-1.3, -0.4, 0.0, 0.7, 2.9])
    energies = np.linspace(1e-3, 60.0, 60_001)
    weights = stats.gamma(1.5 * n).pdf(energies) * (energies[1] - energies[0])
    mixed = [
        weights
        @ (0.5 + 0.5 * np.sign(x) * stats.beta(0.5, 2.0).cdf(np.minimum(1, x * x / energies)))
        for x in v
    ]
    np.testing.assert_allclose(exact.drawn_cumulative(v, n), mixed, atol=2e-5)
    second = weights @ energies**2
    assert exact.drawn_fourth_moment(n) == pytest.approx(3.0 * second / (n * (n + 2)), rel=1e-6)
    assert exact.drawn_fourth_moment(50) == pytest.approx(342.0 / 52.0, rel=1e-12)


def test_equilibrium_of_many_particles_is_eq_9():
    finite = exact.equilibrium_cumulative(GRID, 10**7)
    np.testing.assert_allclose(finite, kac.cumulative(GRID, math.inf), atol=1e-7)
    assert exact.equilibrium_fourth_moment(10**9) == pytest.approx(6.75, rel=1e-8)
