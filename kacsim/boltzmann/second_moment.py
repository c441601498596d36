"""The second moment of Algorithm 2 at a given speed (Boltzmann paper, section II e).

Let g(c; t) = E[(F / M)**2] at speed c. A collision multiplies two independent estimates, so that
g M obeys the Boltzmann equation (5), its norm being G(t) instead of 1. Hence g M / G obeys it in a
time tau, d tau = G dt, from its start, proportional to c**4 exp(-7 c**2 / 6). The Laguerre
coefficients a_n of g / G (order 1/2, in c**2 / 2) of Maxwell molecules obey
d a_n / d tau = -a_n + sum over k of a_k a_(n-k) / (n + 1).
g diverges with G at every speed. Velocities are in c_q, times in mean collision times.
"""

from __future__ import annotations

import functools
import math

import numpy as np
from scipy import integrate, special

from kacsim import checks
from kacsim.boltzmann import bkw
from kacsim.typed import ArrayLike, Floats

N_TERMS = 120
FARTHEST = 7.0  # speed up to which double precision holds the alternating sum
RATE = 4.0 / 7.0  # of the generating function of the start
REACH = 3.0  # beyond a threshold, above which nothing of Algorithm 3's second moment is left


@functools.lru_cache(maxsize=256)
def coefficients(time):
    """Return a_n of g / G at a time before `bkw.critical_time`, float64[N_TERMS].

    a_n(0) = n! [x**n] exp(RATE x) (1 - RATE x + 12/245 x**2).
    """
    n = np.arange(N_TERMS, dtype=float)
    start = RATE**n - n * RATE**n + 12.0 / 245.0 * n * (n - 1.0) * RATE ** (n - 2.0)
    rest = 1.0 - 1.0 / bkw.INITIAL_SECOND_MOMENT
    tau = time - math.log((1.0 - rest * math.exp(time)) / (1.0 - rest))

    def change(_, a):
        return np.convolve(a, a)[:N_TERMS] / (n + 1.0) - a

    return integrate.solve_ivp(change, (0.0, tau), start, "DOP853", rtol=1e-11, atol=1e-14).y[:, -1]


def at_speed(speed, time):
    """Return g(c; t), the mean of (F / M)**2 at each speed, up to `FARTHEST`; float64[...]."""
    half_square = 0.5 * np.asarray(speed, dtype=float)[..., None] ** 2
    terms = special.eval_genlaguerre(np.arange(N_TERMS), 0.5, half_square)
    return float(bkw.second_moment(time)) * terms @ coefficients(time)


def variance(speed, time):
    """Return the variance of one realization of F / M at each speed."""
    return at_speed(speed, time) - bkw.relative_density(speed, time) ** 2


def relative_deviation(speed: ArrayLike, time: float) -> float | Floats:
    """Return the standard deviation of one realization of Algorithm 2 over f(c; t), exactly.

    Parameters
    ----------
    speed : float64[...], from 0 to `FARTHEST`, in c_q
    time : float >= 0, before `kacsim.boltzmann.bkw.critical_time`, in mean collision times

    Raises
    ------
    ValueError
        If the variance is infinite, or the speed out of reach of the series.
    """
    speed = np.asarray(speed, dtype=float)
    checks.raise_problems(checks.not_negative("time", time))
    if time >= bkw.critical_time():
        sentence = f"must be before {bkw.critical_time():.4g}, from where the variance is infinite"
        raise ValueError(f"time = {time!r}: {sentence}")
    if not ((speed >= 0.0) & (speed <= FARTHEST)).all():
        sentence = f"must be from 0 to {FARTHEST:g}: the series has no digits left beyond"
        raise ValueError(f"speed = {speed!r}: {sentence}")
    return np.sqrt(variance(speed, time)) / bkw.relative_density(speed, time)


def sampling_density(speed, threshold):
    """Return p(c_f) of eq. (19), c_f >= threshold."""
    width = threshold / (threshold * threshold - 2.0) if threshold > 2.0 else 2.0
    return width / (width + speed - threshold) ** 2


def normalization(threshold):
    """Return the integral of eq. (19) from the threshold on, by y = 1 / (1 + c_f - c0)."""
    nodes, weights = np.polynomial.legendre.leggauss(400)
    y = 0.5 * (nodes + 1.0)
    density = sampling_density(threshold + 1.0 / y - 1.0, threshold)
    return float((0.5 * weights * density / y**2).sum())


def fraction_deviation(threshold, time):
    """Return the standard deviation of one realization of Algorithm 3 over the fraction.

    A realization is 4 pi c_f**2 F(c_f) / p(c_f); threshold of at most 6.
    """
    nodes, weights = np.polynomial.legendre.leggauss(160)
    speed = threshold + 0.5 * REACH * (nodes + 1.0)
    shell = 4.0 * math.pi * speed**2 * bkw.maxwellian(speed)
    moments = shell**2 * at_speed(speed, time) / sampling_density(speed, threshold)
    square = 0.5 * REACH * (weights * moments).sum()
    return math.sqrt(square / float(bkw.fraction(threshold, time)) ** 2 - 1.0)


def growth_over_fall(fall, speed, time):
    """Return by which factor the relative deviation grows until f is divided by `fall`.

    Parameters
    ----------
    fall : > 1
    speed : float64[n], where one starts

    Returns
    -------
    (speed beyond where f is `fall` times smaller, factor), float64[n] each
    """
    fine = np.linspace(0.0, FARTHEST, 7001)
    logs = np.log(bkw.density(fine, time))
    densest = np.argmax(logs)
    wanted = np.log(bkw.density(speed, time)) - math.log(fall)
    there = np.interp(-wanted, -logs[densest:], fine[densest:])
    return there, relative_deviation(there, time) / relative_deviation(speed, time)
