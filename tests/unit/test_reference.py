"""The deterministic solution by moment generating functions, against laws in closed form.

BKW and the solution of the Kac paper are solved as if nothing were known of them but their start.
For a law without closed form: moments, two contours, and the collision of two particles by hand.
"""

import math

import numpy as np
import pytest

from kacsim.boltzmann import bkw, reference, transform
from kacsim.kac import exact
from kacsim.kac import reference as kac_reference


class Gaussian:
    """The transform of w exp(s z**2 / 2), summed, times 1 + b z**2."""

    def __init__(self, weights, variances, polynomial=0.0):
        self.parts, self.polynomial = list(zip(weights, variances, strict=True)), polynomial

    def mgf(self, z):
        total = sum(w * np.exp(0.5 * variance * z * z) for w, variance in self.parts)
        return total * (1.0 + self.polynomial * z * z)

    def coefficients(self, n):
        """Return n! times the coefficients of z**(2 n)."""
        k = np.arange(n)
        plain = sum(w * (0.5 * variance) ** k for w, variance in self.parts)
        return plain + self.polynomial * k * np.concatenate([[0.0], plain[:-1]])


BKW = Gaussian([1.0], [0.6], 0.2)
KAC = Gaussian([1.0], [0.5], 0.5)
MIXED = Gaussian([0.8, 0.2], [0.5, 3.0])


@pytest.mark.parametrize("time", [0.0, 0.3, 4.0])
def test_bkw_from_its_start(time):
    speed = np.array([0.5, 4.0, 10.0])
    found = reference.density(BKW, speed, time)
    assert found == pytest.approx(bkw.density(speed, time), rel=1e-9, abs=0.0)
    found = reference.fraction(BKW, speed, time)
    assert found == pytest.approx(bkw.fraction(speed, time), rel=1e-9, abs=0.0)


@pytest.mark.parametrize("time", [0.0, 0.3, 4.0])
def test_the_solution_of_kac_from_its_start(time):
    v = np.array([-0.7, 1.0, 8.0])
    found = kac_reference.density(KAC, v, time, 0.9)
    assert found == pytest.approx(exact.density(v, time, 0.9), rel=1e-10, abs=0.0)
    found = kac_reference.tail(KAC, v, time, 0.9)
    assert found == pytest.approx(exact.survival(v, time, 0.9), rel=1e-10, abs=0.0)


def test_the_centre():
    assert reference.density(BKW, 0.0, 1.0) == pytest.approx(bkw.density(0.0, 1.0), rel=1e-10)
    assert reference.fraction(BKW, 0.0, 1.0) == pytest.approx(1.0, abs=1e-12)
    assert kac_reference.tail(KAC, 0.0, 1.0) == pytest.approx(0.5, abs=1e-12)


def test_scattering_of_the_other_model_is_seen():
    """Negative control: shares of the line for the gas in space, and the other way around."""
    wrong = transform.invert(BKW, 4.0, 2.0, transform.squared_cosine_share, lambda z: 2 / z + 8)
    assert abs(wrong[0] / bkw.fraction(4.0, 2.0) - 1.0) > 0.01
    wrong = transform.invert(KAC, 4.0, 2.0, transform.uniform_share, np.ones_like)
    assert abs(wrong[0] / exact.density(4.0, 2.0, 1.0) - 1.0) > 0.01


def test_plain_fourier_inversion_loses_the_tail():
    """Without a tilt the error is 1e-15 of f(0), so that nothing is left where f is that small."""
    near = reference.density(BKW, 3.0, 2.0, tilt=0.0)
    assert near == pytest.approx(bkw.density(3.0, 2.0), rel=1e-9)
    far = reference.density(BKW, 9.0, 2.0, tilt=0.0)
    assert abs(far / bkw.density(9.0, 2.0) - 1.0) > 1.0


@pytest.mark.parametrize("share", [transform.uniform_share, transform.squared_cosine_share])
def test_two_contours_agree_on_a_law_without_closed_form(share):
    """A shifted contour has other nodes, other rays and other polynomials."""
    eta, _ = transform.saddle(MIXED, 6.0, 1.0, share)
    here, error = transform.invert(MIXED, 6.0, 1.0, share, np.ones_like)
    there, _ = transform.invert(MIXED, 6.0, 1.0, share, np.ones_like, tilt=0.8 * eta)
    assert there == pytest.approx(here, rel=1e-9)
    assert error < 1e-10


@pytest.mark.parametrize("share", [transform.uniform_share, transform.squared_cosine_share])
def test_series_and_rays_agree(share):
    z, time, n = np.array([0.9 + 0.4j]), 1.3, 60
    slope, rest = transform.grow(MIXED, z, time, share, 40)
    moments = transform.series(MIXED.coefficients(n), [0.4, time], share)[-1]
    factorials = np.array([math.factorial(k) for k in range(n)], dtype=float)
    wanted = (moments / factorials * z ** (2.0 * np.arange(n))).sum()
    assert np.exp(slope[0]) * rest[-1, 0] == pytest.approx(wanted, rel=1e-9)


def test_series_of_bkw_and_kac():
    """phi = exp((l + b (1 - e)) y) (1 + b e y) with e = exp(-t / 6), on the line exp(-t / 8)."""
    for law, share, rate in (
        (BKW, transform.uniform_share, 6.0),
        (KAC, transform.squared_cosine_share, 8.0),
    ):
        left = math.exp(-1.7 / rate)
        b, half = law.polynomial, 0.5 * law.parts[0][1]
        later = Gaussian([1.0], [2.0 * (half + b * (1.0 - left))], b * left)
        found = transform.series(law.coefficients(80), [1.7], share)[0]
        assert found == pytest.approx(later.coefficients(80), rel=1e-11)
        assert (transform.series(law.coefficients(5), [0.0], share) == law.coefficients(5)).all()


@pytest.mark.parametrize("share", [transform.uniform_share, transform.squared_cosine_share])
def test_shares(share):
    """E U (1 - U) is 1/6 in space and 1/8 on the line; E U**4 + (1 - U)**4 is 2/5, 35/64."""
    nodes, weights = share(5)
    line = share is transform.squared_cosine_share
    assert weights.sum() == pytest.approx(1.0, rel=1e-14)
    assert (weights * nodes * (1 - nodes)).sum() == pytest.approx(1 / 8 if line else 1 / 6)
    fourth = (weights * (nodes**4 + (1 - nodes) ** 4)).sum()
    assert fourth == pytest.approx(35 / 64 if line else 2 / 5)


def test_fraction_of_a_mixture_is_all_of_it():
    """The density integrates to the difference of fractions, at a time when both parts live."""
    nodes, weights = np.polynomial.legendre.leggauss(3)
    speed = 2.5 + 0.1 * nodes
    shell = 4.0 * math.pi * speed**2 * reference.density(MIXED, speed, 0.7)
    first, last = reference.fraction(MIXED, [2.4, 2.6], 0.7)
    assert 0.1 * (weights * shell).sum() == pytest.approx(first - last, rel=1e-8)


class Skew:
    def mgf(self, z):
        return np.exp(z)


class Laplace:
    def mgf(self, z):
        return np.where(np.abs(np.real(z)) < 1.0, 1.0 / (1.0 - z * z), np.inf)


@pytest.mark.parametrize(
    ("law", "speed", "time", "said"),
    [
        (BKW, -1.0, 1.0, "speed = -1.0"),
        (BKW, 1.0, -1.0, "time = -1.0"),
        (BKW, 1.0, math.inf, "time = inf"),
        (BKW, math.nan, 1.0, "speed = nan"),
        (Skew(), 1.0, 1.0, "must be 1 at 0 and even"),
        (Laplace(), 1.0, 1.0, "its mgf must be finite"),
    ],
)
def test_wrong_arguments_are_refused(law, speed, time, said):
    with pytest.raises(ValueError, match=said):
        reference.density(law, speed, time)
