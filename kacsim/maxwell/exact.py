"""The law of the speed |v| of the BKW mode, the solution for infinitely many particles.

Speeds are in units of the RMS velocity per axis of the equilibrium. With K = K(rate t) of
`kacsim.boltzmann.bkw` the speed is that of a Maxwellian of variance K per axis with the probability
(5 K - 3) / (2 K), and otherwise has |v|**2 / K chi-squared with 5 degrees of freedom.
"""

from __future__ import annotations

import math

import numpy as np
from scipy import special

from kacsim.boltzmann import bkw
from kacsim.typed import ArrayLike, Floats


def shape(time, collision_rate=1.0):
    """Return K at time t; time may be infinite."""
    if not time >= 0.0:
        raise ValueError(f"time = {time!r}: must be at least 0, or infinite")
    return float(bkw.shape(collision_rate * time))


def density(speed: ArrayLike, time: float, collision_rate: float = 1.0) -> float | Floats:
    """Return the density 4 pi c**2 f(c; t) of the speed.

    Parameters
    ----------
    speed : float or array of speeds; the density of negative ones is 0
    time : float >= 0, or math.inf for the equilibrium
    collision_rate : float > 0, collisions of one particle per time
    """
    shape(time, collision_rate)
    c = np.maximum(np.asarray(speed, dtype=float), 0.0)
    return 4.0 * math.pi * c**2 * bkw.density(c, collision_rate * time)


def survival(speed: ArrayLike, time: float, collision_rate: float = 1.0) -> float | Floats:
    """Return P(|v| > c), without cancellation at high speeds; arguments as `density`."""
    k = shape(time, collision_rate)
    return bkw.fraction_of_shape(np.maximum(np.asarray(speed, dtype=float), 0.0), k)


def cumulative(speed: ArrayLike, time: float, collision_rate: float = 1.0) -> float | Floats:
    """Return P(|v| <= c), without cancellation at low speeds; arguments as `density`."""
    k = shape(time, collision_rate)
    half_square = np.maximum(np.asarray(speed, dtype=float), 0.0) ** 2 / (2.0 * k)
    share = (5.0 * k - 3.0) / (2.0 * k)
    low, high = (special.gammainc(a, half_square) for a in (1.5, 2.5))
    return share * low + (1.0 - share) * high


def speed_moment(order, time, collision_rate=1.0):
    """Return E |v|**order for an order > -3."""
    k = shape(time, collision_rate)
    share = (5.0 * k - 3.0) / (2.0 * k)
    low, high = (special.gamma(a + order / 2.0) / special.gamma(a) for a in (1.5, 2.5))
    return float((2.0 * k) ** (order / 2.0) * (share * low + (1.0 - share) * high))
