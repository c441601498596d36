"""What docs/ancestral_trees.md says: identities by quadrature, bounds realization by realization.

The bounds hold for every tree, whatever the seed: no statistics, no false alarms.
"""

import math

import numpy as np
import pytest
from scipy import integrate, special

from kacsim.boltzmann import bkw
from kacsim.kac import exact
from kacsim.mckean import constants, contour, probing, work
from kacsim.streams import new_stream

BKW, KAC = constants.BKW, constants.KAC
LAWS = pytest.mark.parametrize("law", [BKW, KAC])
# sup over theta and y of g0 exp(theta y) / L0(theta), and of |g0'| / (1 + theta) alike
C_0, C_1 = (0.5411, 0.6844), (0.5151, math.nan)


def native(law, function):
    """Return E function(U): by Gauss-Legendre, or over the angle for Kac's law."""
    nodes, weights = np.polynomial.legendre.leggauss(60)
    u = 0.5 * (nodes + 1.0)
    u = u if law == BKW else np.cos(0.5 * math.pi * u) ** 2
    return (0.5 * weights * function(u)).sum()


def product_mean(b, time, law):
    """Return (Q(b, t), x)."""
    x = b * math.exp(-constants.KAPPA[law] * time)
    return np.exp(b - x) * (1.0 + x), x


def number_mean(b, time, law):
    """Return E[n prod(1 + b rho_i)] = mu Q of the page."""
    q, x = product_mean(b, time, law)
    more = constants.KAPPA[law] * x * x / (1.0 + x)
    return q * (1.0 + math.expm1(time) * (1.0 + more))


def slope(function, time, h=1e-5):
    """Return the derivative, to h**4."""
    ahead, behind = function(time + h) - function(time - h), function(time + 2 * h)
    return (8.0 * ahead - behind + function(time - 2 * h)) / (12.0 * h)


@LAWS
@pytest.mark.parametrize("b", [0.4, 3.7, 11.0, -0.8 + 2.3j])
@pytest.mark.parametrize("time", [0.0, 0.9, 4.0])
def test_equation_of_the_product(b, time, law):
    gain = native(
        law, lambda u: product_mean(u * b, time, law)[0] * product_mean((1 - u) * b, time, law)[0]
    )
    change = slope(lambda t: product_mean(b, t, law)[0], time)
    assert change == pytest.approx(gain - product_mean(b, time, law)[0], rel=1e-7, abs=1e-9)
    assert product_mean(b, 0.0, law)[0] == pytest.approx(1.0 + b)


@LAWS
@pytest.mark.parametrize("b", [0.4, 3.7, 11.0])
@pytest.mark.parametrize("time", [0.0, 0.9, 4.0])
def test_equation_of_the_mean_number_of_leaves(b, time, law):
    gain = 2.0 * native(
        law, lambda u: number_mean(u * b, time, law) * product_mean((1 - u) * b, time, law)[0]
    )
    change = slope(lambda t: number_mean(b, t, law), time)
    assert change == pytest.approx(gain - number_mean(b, time, law), rel=1e-7)
    assert number_mean(b, 0.0, law) == pytest.approx(1.0 + b)


@LAWS
@pytest.mark.parametrize(("b", "left"), [(0.7, 1.1), (9.0, 0.2)])
def test_splits_of_the_tilted_tree(b, left, law):
    """The tilted rate over the native one, and its integral."""
    whole, x = product_mean(b, left, law)
    u = np.array([0.05, 0.31, 0.5, 0.9])
    tilted = product_mean(u * b, left, law)[0] * product_mean((1 - u) * b, left, law)[0] / whole
    np.testing.assert_allclose(tilted, 1.0 + u * (1.0 - u) * x * x / (1.0 + x), rtol=1e-12)
    assert native(law, lambda u: u * (1.0 - u)) == pytest.approx(constants.KAPPA[law])


@LAWS
@pytest.mark.parametrize("time", [0.3, 2.0])
def test_the_transform_is_that_of_the_exact_law(time, law):
    """M(eta, t) by the product, against an integral of the closed form."""
    eta = 1.3
    b = constants.BETA[law] * eta * eta
    product = math.exp(constants.ELL[law] * eta * eta) * product_mean(b, time, law)[0]
    if law == KAC:
        integrand = lambda v: exact.density(v, time, 1.0) * math.cosh(eta * v)  # noqa: E731
    else:  # the mean of exp(eta c_x) over directions
        integrand = lambda c: bkw.density(c, time) * 2 * math.pi * c * math.sinh(eta * c) / eta  # noqa: E731
    whole, _ = integrate.quad(integrand, 0.0, 25.0, limit=200)
    assert 2.0 * whole == pytest.approx(product, rel=1e-8)


def tilted_leaf(theta, law):
    """Return g0 exp(theta y) / L0(theta) and the same of |g0'|, about the peak of the first."""
    variance = 2.0 * constants.ELL[law]
    u = np.linspace(-8.0, 8.0, 20001)
    y = variance * theta + u
    bell = np.exp(-0.5 * u * u / variance) / math.sqrt(2.0 * math.pi * variance)
    bell /= 1.0 + constants.BETA[law] * theta**2
    square = constants.SQUARE[law]
    polynomial = constants.CONSTANT[law] + square * y * y
    return bell * polynomial, np.abs(bell * (2.0 * square * y - polynomial * y / variance))


@LAWS
def test_constants_of_the_bounds_on_one_leaf(law):
    thetas = [*np.linspace(0.0, 8.0, 161), 20.0, 100.0, 1e4]
    density, steep = zip(
        *((g.max(), d.max() / (1 + t)) for t in thetas for g, d in [tilted_leaf(t, law)]),
        strict=True,
    )
    assert C_0[law] - 1e-3 < max(density) <= C_0[law]
    if law == BKW:
        assert C_1[law] - 1e-3 < max(steep) <= C_1[law]
    assert tilted_leaf(0.0, law)[0].max() <= C_0[law]


def bounds(law, v, time, leaves):
    """Return quantity -> the bound on realizations with so many leaves."""
    eta, b = work.tilt(v, time, law)
    chernoff = math.exp(constants.ELL[law] * eta * eta - eta * v) * product_mean(b, time, law)[0]
    root = C_0[law] * np.sqrt(leaves)
    found = {contour.TAIL: np.ones_like(root), contour.DENSITY: root}
    if law == BKW:
        found[contour.BEYOND] = 2.0 + 2.0 * v * root
        found[contour.SHELL] = C_1[law] * (1.0 + eta) * leaves / (2.0 * math.pi * v)
    return {quantity: chernoff * bound for quantity, bound in found.items()}


@LAWS
@pytest.mark.parametrize("method", ["ancestral", "free_leaf"])
@pytest.mark.parametrize(("v", "time"), [(0.3, 1.1), (2.2, 3.0), (5.7, 0.6), (7.1, 4.2)])
def test_no_realization_exceeds_its_bound(v, time, method, law, seed):
    """A tree of one leaf is known, so that a realization's number of leaves is at least that."""
    values, leaves = np.empty(2000), np.empty(2000, np.int64)
    tree = {"method": method, "cut": 0.0, "max_nodes": 10**7}
    for quantity in bounds(law, v, time, np.ones(1)):
        stream = new_stream(seed, f"bound {law} {method} {quantity}")
        assert probing.bound(quantity, v, time, law, **tree)(values, leaves, stream)
        bound = bounds(law, v, time, leaves.astype(float))[quantity]
        assert (np.abs(values) <= bound * (1.0 + 1e-6)).all()
        if quantity == contour.TAIL:
            assert values.min() > 0.0
            assert values.mean() < bound[0]


@LAWS
def test_leaves_integrated_out_are_the_mean_given_the_tree(law):
    """A tree of three leaves: F averaged over two of them, by quadrature, is R."""
    v, eta, shares = 2.1, 1.4, np.array([0.55, 0.3, 0.15])
    variance = 2.0 * constants.ELL[law]
    nodes, weights = np.polynomial.hermite_e.hermegauss(60)
    x, weights = math.sqrt(variance) * nodes, weights / weights.sum()
    weights = weights * (constants.CONSTANT[law] + constants.SQUARE[law] * x * x)
    rest = math.sqrt(0.3) * x[:, None] + math.sqrt(0.15) * x
    y = (v - rest) / math.sqrt(0.55)
    bell = np.exp(-0.5 * y * y / variance) / math.sqrt(2.0 * math.pi * variance)
    tail = special.ndtr(-y / math.sqrt(variance)) + constants.SQUARE[law] * variance * y * bell
    mean = (weights[:, None] * weights * tail).sum()

    def integrand(omega):
        z = eta + 1j * omega
        product = np.prod(1.0 + constants.BETA[law] * z * z * shares)
        return (np.exp(constants.ELL[law] * z * z - z * v) * product / z).real / math.pi

    assert mean == pytest.approx(integrate.quad(integrand, 0.0, 40.0, limit=200)[0], rel=1e-7)


@pytest.mark.parametrize("p", [0.55, 0.59, 0.61])
def test_how_rare_large_geometric_numbers_may_become(p):
    """sum of w_n**2 q_n converges if p < e**-t (2 - e**-t): here 0.6 at e**-t = 0.3675."""
    native_p = 1.0 - math.sqrt(0.4)
    n = np.arange(1.0, 20001.0)
    logs = 2.0 * (n - 1.0) * math.log1p(-native_p) - (n - 1.0) * math.log1p(-p)
    total = (native_p**2 / p) * np.exp(logs)
    assert (total[-1] < total[0]) == (p < native_p * (2.0 - native_p))


@pytest.mark.parametrize("c", [0.3, 0.02])
def test_ends_of_a_tree_that_is_cut_and_goes_on_for_ever(c):
    """m = 2 rho / c - 1 splits solve m(rho) = 1 + 2 / rho times the integral of m from c on."""
    inner, _ = integrate.quad(lambda y: 2.0 * y / c - 1.0, c, 1.0)
    assert 1.0 + 2.0 * inner == pytest.approx(2.0 / c - 1.0)
