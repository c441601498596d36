"""Isotropic laws to start from, known by the transform of one component: E exp(z x)."""

import math
from dataclasses import dataclass

import numpy as np
from scipy import special

from kacsim import checks

TOLERANCE = 1e-9  # of a total that has to be 1
FARTHEST = 60.0  # up to where a density is looked at, in variances of its widest part
GRID = 6001


@dataclass(frozen=True)
class Mixture:
    """A density that is a sum of polynomials times Gaussians.

    f(v) = sum of P_j(|v|**2) times the normal density of variance s_j per axis, in `dimensions`.

    Attributes
    ----------
    parts : tuple of (s_j, coefficients of P_j from the constant on)
    dimensions : 3 for velocities of a gas, 1 for Kac's line

    Raises
    ------
    ValueError
        If a variance is not positive, the total is not 1 or the density is negative somewhere.
    """

    parts: tuple
    dimensions: int = 3

    def __post_init__(self):
        """Check the law."""
        checks.raise_problems(
            checks.bounded("dimensions", self.dimensions, 1, 3),
            *(checks.positive("variance", s) for s, _ in self.parts),
            *(checks.each("coefficients", list(c), checks.finite) for _, c in self.parts),
        )
        if not self.parts:
            raise ValueError("parts = (): a mixture has at least one part")
        total = float(self.mgf(np.zeros(1))[0].real)
        if abs(total - 1.0) > TOLERANCE:
            raise ValueError(f"parts = {self.parts!r}: their total is {total:.6g}, and must be 1")
        widest = max(s for s, _ in self.parts)
        speed = np.sqrt(np.linspace(0.0, FARTHEST * widest, GRID))
        density = self.density(speed)
        if density.min() < 0.0:
            where = float(speed[density.argmin()])
            raise ValueError(f"parts = {self.parts!r}: the density is negative near {where:.3g}")

    def density(self, speed):
        """Return f at speeds, per unit of velocity to the power of the dimensions."""
        square = np.asarray(speed, float) ** 2
        return sum(
            np.polynomial.polynomial.polyval(square, coefficients)
            * np.exp(-0.5 * square / s)
            / (2.0 * math.pi * s) ** (0.5 * self.dimensions)
            for s, coefficients in self.parts
        )

    def mgf(self, z):
        """Return E exp(z x) of one component, for complex arrays.

        A Gaussian tilted by z is one about s z, and E |x|**(2 k) there is
        (2 s)**k k! L_k^(d/2 - 1)(-s z**2 / 2).
        """
        w = np.asarray(z, dtype=complex) ** 2
        total = np.zeros_like(w)
        for s, coefficients in self.parts:
            powers = sum(
                coefficient
                * (2.0 * s) ** k
                * math.factorial(k)
                * special.genlaguerre(k, 0.5 * self.dimensions - 1.0)(-0.5 * s * w)
                for k, coefficient in enumerate(coefficients)
            )
            total += np.exp(0.5 * s * w) * powers
        return total


@dataclass(frozen=True)
class Transform:
    """A law given by its moment generating function.

    Attributes
    ----------
    mgf : callable(complex128[...]) -> complex128[...], E exp(z x) of one component, an even entire
        function

    Raises
    ------
    ValueError
        If it is not 1 at 0, not even, or not that of a law at some places that are tried.
    """

    mgf: object

    def __post_init__(self):
        """Check the function at some places."""
        z = np.array([0.0, 0.5, 1.0, 0.3 + 0.7j, 1.2j, 2.3j])
        here, there = np.asarray(self.mgf(z), complex), np.asarray(self.mgf(-z), complex)
        if here.shape != z.shape or not np.isfinite(here).all():
            raise ValueError("mgf: must return a finite number for each of a complex array")
        if abs(here[0] - 1.0) > TOLERANCE:
            raise ValueError(f"mgf: is {here[0]:.6g} at 0, and must be 1")
        if np.abs(here - there).max() > TOLERANCE * np.abs(here).max():
            raise ValueError("mgf: must be even, as that of an isotropic law")
        if np.abs(here[:3].imag).max() > TOLERANCE or (np.diff(here[:3].real) <= 0.0).any():
            raise ValueError("mgf: must be real and grow along the real axis")
        if np.abs(here[4:]).max() > 1.0 + TOLERANCE or np.abs(here[4:].imag).max() > TOLERANCE:
            raise ValueError("mgf: must be real and at most 1 along the imaginary axis")


def variance_of(law):
    """Return E x**2 of one component, by the mean of the transform over a small circle."""
    return float(coefficients(law, 1e-2)[1].real * 2.0)


def coefficients(law, radius, n=64):
    """Return the Taylor coefficients of E exp(z x) in w = z**2, complex128[n // 2].

    Parameters
    ----------
    radius : of the circle in w that they are found on
    """
    w = radius * np.exp(2j * math.pi * np.arange(n) / n)
    return (np.fft.fft(law.mgf(np.sqrt(w))) / n)[: n // 2] / radius ** np.arange(n // 2)
