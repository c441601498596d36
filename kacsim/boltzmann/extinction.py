"""Exact results on extinction alone (Boltzmann paper, section III)."""

import math

import numpy as np
from scipy import integrate

INFINITE = 1e8  # of a moment in units of that of f0: beyond, it grows like 1 / (end - t)


def density(time, rate, initial):
    """Return f(t) = f0 / (1 + alpha f0 t), eq. (21)."""
    return initial / (1.0 + rate * initial * np.asarray(time, dtype=float))


def mean_recursion(time, majorant):
    """Return 2 exp(majorant t) - 1, eq. (28)."""
    return 2.0 * np.exp(majorant * np.asarray(time, dtype=float)) - 1.0


def variance(time, rate, initial, majorant):
    """Return the variance of one realization, eq. (29); infinite where that diverges."""
    scaled = rate * initial * np.asarray(time, dtype=float)
    ratio = majorant / (rate * initial)
    denominator = ratio + (ratio - 1.0) * scaled
    with np.errstate(divide="ignore"):
        relative = np.where(denominator > 0.0, scaled / denominator, np.inf)
    return relative * density(time, rate, initial) ** 2


def moments(time, ratio, order=2):
    """Return E[(F / f0)**k], k = 1 to order, from their own equations, without eqs. (21), (29).

    Expanding the powers of Algorithm 4's F1 (1 - alpha F2 / majorant) gives, with t in
    1 / (alpha f0), m_k(0) = 1 and r = majorant / (alpha f0),
    m_k' = r m_k (sum over j = 1 to k of C(k, j) (-1/r)**j m_j).

    Parameters
    ----------
    time : alpha f0 t, before the largest moment is infinite
    ratio : majorant / (alpha f0)

    Returns
    -------
    float64[order]
    """
    return _integrated(time, ratio, order).y[:, -1]


def moment_end(ratio, latest, order=2):
    """Return when a moment of Algorithm 4 becomes infinite; inf if not until `latest`."""
    found = _integrated(latest, ratio, order)
    return float(found.t[-1]) if found.status == 1 else math.inf


def _integrated(time, ratio, order):
    def change(_, m):
        lower = [m[:k] @ _expansion(k, ratio) for k in range(1, order + 1)]
        return ratio * m * np.array(lower)

    def explodes(_, m):
        return m[-1] - INFINITE

    explodes.terminal = True
    options = {"events": explodes, "rtol": 1e-10, "atol": 1e-13}
    return integrate.solve_ivp(change, (0.0, time), np.ones(order), "DOP853", **options)


def _expansion(power, ratio):
    """Return the coefficients of x, ..., x**power in (1 - x / ratio)**power."""
    return np.array([math.comb(power, j) * (-1.0 / ratio) ** j for j in range(1, power + 1)])
