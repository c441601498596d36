"""Exact laws of the Kac paper: eqs. (8) and (9), and the equilibrium of N particles.

The laws at a time t are those of the paper's f0 and of uniform angles: for other ones (`kac.draw`)
`kacsim.kac.reference` solves the equation, and the equilibrium is the same for any angles.
"""

from __future__ import annotations

import math

import numpy as np
from scipy import special

from kacsim.kac.constants import MEAN_ENERGY, RATE
from kacsim.typed import ArrayLike, Floats

ENERGIES = 1000  # parts of the law of an ensemble's energy


def shape(time, collision_rate=RATE):
    """Return C(t) = 1 / (3 - 2 exp(-rate t / 8)) of eq. (8); time may be infinite."""
    if not time >= 0.0:
        raise ValueError(f"time = {time!r}: must be at least 0, or infinite")
    return 1.0 / (3.0 - 2.0 * math.exp(-collision_rate * time / 8.0))


def density(v: ArrayLike, time: float, collision_rate: float = RATE) -> float | Floats:
    """Return f(v, t), the solution of the Kac equation (Kac paper, eqs. 8 and 9).

    It is for the paper's f0 and uniform angles.

    Parameters
    ----------
    v : float or array of velocities
    time : float >= 0, or math.inf for the equilibrium, Normal(0, 3/2)
    """
    c = shape(time, collision_rate)
    v = np.asarray(v, dtype=float)
    constant = 1.5 * (1.0 - c) * math.sqrt(c)
    quadratic = (3.0 * c - 1.0) * c**1.5
    return (constant + quadratic * v**2) * np.exp(-c * v**2) / math.sqrt(math.pi)


def survival(v: ArrayLike, time: float, collision_rate: float = RATE) -> float | Floats:
    """Return P(V > v) under eq. (8), without cancellation in the upper tail.

    It is for the paper's f0 and uniform angles; arguments as `density`.
    """
    c = shape(time, collision_rate)
    w = math.sqrt(c) * np.asarray(v, dtype=float)
    odd = (3.0 * c - 1.0) / (2.0 * math.sqrt(math.pi)) * w * np.exp(-(w**2))
    return 0.5 * special.erfc(w) + odd


def cumulative(v: ArrayLike, time: float, collision_rate: float = RATE) -> float | Floats:
    """Return P(V <= v) under eq. (8), for the paper's f0 and uniform angles; as `density`."""
    return survival(-np.asarray(v, dtype=float), time, collision_rate)


def equilibrium_cumulative(v, n_particles, energy=None):
    """Return P(v_1 <= v) at the equilibrium of N particles: v_1**2 / E ~ Beta(1/2, (N - 1)/2).

    Parameters
    ----------
    v : float or array
    energy : the ensemble's sum of v**2, by default 3 N / 2
    """
    total = MEAN_ENERGY * n_particles if energy is None else energy
    v = np.asarray(v, dtype=float)
    inside = special.betainc(0.5, 0.5 * (n_particles - 1), np.minimum(v**2 / total, 1.0))
    return 0.5 + 0.5 * np.sign(v) * inside


def equilibrium_fourth_moment(n_particles, energy=None):
    """Return E v_1**4 = 3 E**2 / (N (N + 2)) at the equilibrium of N particles."""
    total = MEAN_ENERGY * n_particles if energy is None else energy
    return 3.0 * total**2 / (n_particles * (n_particles + 2.0))


def shape_moment(order, c):
    """Return the mean of v**order, an even order, of the density (8) for a value of C."""
    k = order // 2
    constant = math.gamma(k + 0.5) / math.sqrt(math.pi)
    return constant * (1.0 - k + 3.0 * k * c) / c**k


def drawn_cumulative(v, n_particles):
    """Return P(v_1 <= v) at the equilibrium of N particles whose v**2 were drawn from f0.

    Their energy, which section 5.2 takes, follows Gamma(3 N / 2, 1): the mean over equally
    probable parts of that law.
    """
    parts = (np.arange(ENERGIES) + 0.5) / ENERGIES
    energies = special.gammaincinv(MEAN_ENERGY * n_particles, parts)
    return np.mean([equilibrium_cumulative(v, n_particles, e) for e in energies], axis=0)


def drawn_fourth_moment(n_particles):
    """Return E v_1**4 of `drawn_cumulative`: 3 E[E**2] / (N (N + 2)), E[E**2] = a (a + 1)."""
    alpha = MEAN_ENERGY * n_particles
    return 3.0 * alpha * (alpha + 1.0) / (n_particles * (n_particles + 2.0))


def drawn_moment(order, n_particles):
    """Return E v_1**order of `drawn_cumulative`, an even order: E[E**k] times a Beta moment."""
    value, alpha = 1.0, MEAN_ENERGY * n_particles
    for j in range(order // 2):
        value *= (alpha + j) * (0.5 + j) / (0.5 * n_particles + j)
    return value
