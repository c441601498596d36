"""Any isotropic initial law: its density and its tails at any time, by McKean's trees.

Only the transform of one component at time 0 is needed (docs/ancestral_trees.md). The tilt is that
of a law with the same variance and fourth cumulant whose transform is known.
"""

import math

import numpy as np
from scipy import integrate, special

from kacsim.boltzmann import transform
from kacsim.boltzmann.initial_laws import coefficients, variance_of
from kacsim.mckean import constants, forest
from kacsim.mckean.constants import BKW, KAPPA
from kacsim.mckean.contour import FEW, ORDERS, SERIES

TERMS = 48  # of a transform in its moments
LARGEST = 16.0  # |z**2 rho| E x**2 that so many terms serve
DIGITS = 2  # of the tilt: no bit of a draw hangs on how it was found
SHARES = {BKW: transform.uniform_share, constants.KAC: transform.squared_cosine_share}


def rounded(value):
    """Return a number with few digits."""
    return float(f"{value:.{DIGITS}g}")


class Relaxation:
    """Realizations of a quantity of one component at one place and time.

    Parameters
    ----------
    law : with ``mgf``, such as `kacsim.boltzmann.Mixture`
    factor : callable(z) -> what multiplies the transform: 1 for the density at v
    v, time : >= 0; time in mean collision times
    kind : BKW or KAC: how shares split
    cut : subtrees of shares below cut / (eta**2 E x**2 / 5), or less where their series asks for
        it, are replaced by their mean
    """

    def __init__(self, law, factor, v, time, kind, cut):
        self.law, self.time, self.kind = law, time, kind
        variance = variance_of(law)
        eta, deviation = transform.saddle(law, v, time, SHARES[kind])
        self.eta = rounded(max(eta, 1.0 / deviation))
        z = transform.contour(law, self.eta, deviation)
        weights = np.full(z.size, (z[1].imag - z[0].imag) / math.pi)
        weights[0] *= 0.5
        self.weights = weights * factor(z) * np.exp(-z * v)
        self.squares = z * z
        self.b = rounded(self._excess(variance) * eta * eta)
        largest = float(np.abs(self.squares).max())
        self.series, radius = self._logarithm(variance)
        self.small = radius * SERIES / largest
        self.cut = min(cut / (0.2 * self.eta**2), LARGEST / largest) / variance
        self.sums = np.zeros(ORDERS)
        capacity = int(1.0 / self.small) + FEW + 2 + (int(64.0 / self.cut) if cut else 0)
        self.shares, self.left = np.empty(capacity), np.empty(capacity)
        self.moments = self._moments(variance) if cut else None

    def _excess(self, variance):
        """Return beta of the law exp(ell z**2) (1 + beta z**2) with this fourth cumulant."""
        second, fourth = coefficients(self.law, 0.5 / variance)[1:3].real
        excess = 2.0 * (0.5 * second**2 - fourth)
        return min(math.sqrt(max(0.0, excess)), 0.5 * variance)

    def _logarithm(self, variance):
        """Return the coefficients of log E exp(z x) in z**2, and where they serve to 1e-10."""
        radius = 4.0 / variance
        while True:
            a = coefficients(self.law, radius)[: ORDERS + 1].real
            logs = np.zeros(ORDERS + 1)
            for n in range(1, ORDERS + 1):
                inner = sum(k * logs[k] * a[n - k] for k in range(1, n))
                logs[n] = (a[n] - inner / n) / a[0]
            w = SERIES * radius * np.exp(2j * math.pi * np.arange(16) / 16)
            series = np.polynomial.polynomial.polyval(w, logs)
            if np.abs(series - np.log(self.law.mgf(np.sqrt(w)))).max() < 1e-10:
                return logs[1:], radius
            radius *= 0.5

    def _moments(self, variance):
        """Return the coefficients of E exp(z v_1(s)) in z**2 variance, as a function of s.

        a_n' = -a_n + sum over k of E[U**k (1 - U)**(n - k)] a_k a_(n-k): those of a subtree.
        """
        n = np.arange(TERMS)
        start = np.zeros(TERMS)
        found = coefficients(self.law, 16.0 / variance, 4 * TERMS)[:TERMS].real
        start[:] = found / variance**n
        half = 0.0 if self.kind == BKW else -0.5
        k, rest = np.meshgrid(n, n, indexing="ij")
        beta = special.beta(k + half + 1.0, rest + half + 1.0) / special.beta(1 + half, 1 + half)

        def change(_, a):
            terms = beta * np.outer(a, a)
            gains = [np.trace(terms[: m + 1, m::-1]) for m in n]
            return np.array(gains) - a

        # Scaled by growing powers: orders of very different size keep their digits.
        solved = integrate.solve_ivp(
            change, (0.0, self.time), start, "DOP853", rtol=1e-10, atol=0.0, dense_output=True
        )
        return lambda s: solved.sol(s) / variance ** -n.reshape(-1, 1).astype(float)

    def transforms(self, shares, left):
        """Return E exp(z v) of each end over its tilt, complex128[ends, z]."""
        w = shares[:, None] * self.squares
        leaves = left <= 0.0
        found = np.empty(w.shape, dtype=complex)
        found[leaves] = self.law.mgf(np.sqrt(w[leaves]))
        if not leaves.all():
            a = self.moments(left[~leaves])
            total = np.zeros_like(w[~leaves])
            for row in a[::-1]:
                total = total * w[~leaves] + row[:, None]
            found[~leaves] = total
        kept = np.exp(-KAPPA[self.kind] * left)
        tilt = np.exp(self.b * shares * (1.0 - kept)) * (1.0 + self.b * shares * kept)
        return found / tilt[:, None]

    def integral(self, product):
        """Return the integral along the contour."""
        return float((self.weights * product).real.sum())

    def __call__(self, values, nodes, stream):
        """Fill realizations and numbers of ends; False if a tree is too large."""
        left = math.exp(-KAPPA[self.kind] * self.time)
        mean = math.exp(self.b * (1.0 - left)) * (1.0 + self.b * left)
        if self.time == 0.0 or self.cut > 1.0:
            whole = self.transforms(np.ones(1), np.array([self.time]))
            values[:], nodes[:] = mean * self.integral(whole[0]), 1
            return True
        chance = math.exp(-self.time) * (1.0 + self.b)
        single = self.transforms(np.ones(1), np.zeros(1))[0]
        known = chance * self.integral(single)
        powers = self.squares[None, :] ** np.arange(1, ORDERS + 1)[:, None]
        signs = -((-self.b) ** np.arange(1, ORDERS + 1)) / np.arange(1, ORDERS + 1)
        for k in range(values.size):
            listed, nodes[k] = forest.grow(
                self.time, self.b, self.kind, self.small, self.cut, self.shares, self.left,
                self.sums, stream,
            )  # fmt: skip
            if listed < 0:
                return False
            parts = self.transforms(self.shares[:listed], self.left[:listed])
            logs = (self.series * self.sums) @ powers - signs @ self.sums
            product = parts.prod(axis=0) * np.exp(logs)
            values[k] = known + (mean - chance) * self.integral(product)
        return True
