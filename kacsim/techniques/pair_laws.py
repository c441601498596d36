"""What section 11.3 gives for a law that is not separable: by quadrature, and in closed form.

The law is a bivariate normal density f(v, w) of unit variances, v normal to the face and positive
inward. Integrals are sums over a grid in v and, where the other velocity matters, in w.
"""

import math

import numpy as np
from scipy import special

FINE = 4001  # places of a grid
LIMIT = 10.0  # thermal velocities


def _grid(low):
    return np.linspace(low, LIMIT, FINE)


def _density(x):
    return np.exp(-0.5 * x * x) / math.sqrt(2.0 * math.pi)


def entering_mean(correlation, drift=0.0):
    """Return the mean of w over the flux v f(v, w), v > 0: a double sum that takes no formula.

    Parameters
    ----------
    correlation : between -1 and 1
    drift : mean of w
    """
    v, w = _grid(0.0)[:, None], (_grid(-LIMIT) + drift)[None, :]
    rest = math.sqrt(1.0 - correlation**2)
    flux = v * _density(v) * _density((w - drift - correlation * v) / rest) / rest
    return float((flux * w).sum() / flux.sum())


def exact_mean(correlation):
    """Return the same in closed form: the flux law of v has mean sqrt(pi / 2)."""
    return correlation * math.sqrt(math.pi / 2.0)


def printed_mean(correlation):
    """Return the mean of w by the printed steps: v from the flux, w from P(v, w) at this v.

    As a function of w, P(v, w) is the law of w on the condition that the normal velocity is below
    v, whose mean is -f(v) / P(v) by the truncated normal law.
    """
    v = _grid(0.0)
    flux = v * _density(v)
    return float(-correlation * (flux * _density(v) / special.ndtr(v)).sum() / flux.sum())


def printed_density(w, correlation):
    """Return the density of w by the printed steps.

    Parameters
    ----------
    w : float64[n]
    """
    v, w = _grid(0.0)[:, None], np.asarray(w, dtype=float)[None, :]
    rest = math.sqrt(1.0 - correlation**2)
    given = _density(w) * special.ndtr((v - correlation * w) / rest) / special.ndtr(v)
    flux = v * _density(v)
    return (flux * given).sum(axis=0) / flux.sum()


def entering_density(w, correlation):
    """Return the density of w over the entering particles."""
    v, w = _grid(0.0)[:, None], np.asarray(w, dtype=float)[None, :]
    rest = math.sqrt(1.0 - correlation**2)
    flux = v * _density(v)
    return (flux * _density((w - correlation * v) / rest) / rest).sum(axis=0) / flux.sum()


def flux_lines(v, drift=0.0):
    """Return both lines of eq. (11.16) at v: the integral of v dP, and what parts make of it.

    Parameters
    ----------
    v : float > 0
    drift : mean of the normal velocity
    """
    x = np.linspace(0.0, v, FINE)
    cumulative = special.ndtr(x - drift)
    first = np.trapezoid(x * _density(x - drift), x)
    second = v * special.ndtr(v - drift) - np.trapezoid(cumulative, x)
    return float(first), float(second)


def flux_cumulative(v, drift=0.0):
    """Return F(v) of eq. (11.16), normalized by F at the largest velocity."""
    return flux_lines(v, drift)[1] / flux_lines(drift + LIMIT, drift)[1]
