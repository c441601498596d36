"""Nanbu's algorithm updated in place, with infinitely many particles and a fixed step.

Let u = i/N be the place of a particle in the order of updates and f_k(u) its law after k steps. A
partner w is uniform; it has been updated in this step if w < u. So the law of the partner's
velocity is mu_k(u), the integral of f_k over [0, u] and of f_(k-1) over [u, 1], and with
p = rate times the step
f_k(u) = (1 - p) f_(k-1)(u) + p G(f_(k-1)(u), mu_k(u)),  d mu_k / du = f_k(u) - f_(k-1)(u),
G the law of v cos(theta) + w sin(theta) of independent v and w. The printed formula has the mean
of f_(k-1) over all u in the place of mu_k(u): it is the limit of the other reading.
With a = E v**4 at u and b that of mu_k(u), every E v**2 being 3/2, E G**4 = 3/8 (a + b) + 27/16, so
that b solves b' = p (3/8 b - 5/8 a + 27/16): a linear equation for power series in u.
"""

import numpy as np

from kacsim import checks
from kacsim.kac.constants import RATE, n_steps
from kacsim.kac.moments import INITIAL_SQUARE
from kacsim.kac.samplers import step_problems

TERMS = 60
CONSTANT = 27.0 / 16.0


def fourth_moments(places, time, time_step, collision_rate=RATE):
    """Return (E v**4 at each place, mean over all places) at time t, N infinite, in place.

    Parameters
    ----------
    places : float or array of u from 0 to 1: 0 is particle 1, 1 the last one
    time : float > 0
    time_step : float > 0, divides the time; collision_rate * time_step <= 1

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    numbers = {"time": time, "time_step": time_step, "collision_rate": collision_rate}
    for name, value in numbers.items():
        checks.raise_problems(checks.positive(name, value))
    checks.raise_problems(step_problems("Nanbu", time, time_step, collision_rate))
    places = np.asarray(places, dtype=float)
    if not ((places >= 0.0) & (places <= 1.0)).all():
        raise ValueError(f"places = {places!r}: must lie between 0 and 1")
    a = coefficients(n_steps(time, time_step), collision_rate * time_step)
    return np.polynomial.polynomial.polyval(places, a), float((a / np.arange(1, TERMS + 1)).sum())


def coefficients(steps, p):
    """Return the power series in u of E v**4 after so many steps, float64[TERMS]."""
    a, b = np.zeros(TERMS), np.zeros(TERMS)
    a[0] = INITIAL_SQUARE
    for _ in range(steps):
        b[0] = (a / np.arange(1, TERMS + 1)).sum()
        for k in range(TERMS - 1):
            change = 0.375 * b[k] - 0.625 * a[k] + (CONSTANT if k == 0 else 0.0)
            b[k + 1] = p * change / (k + 1.0)
        a = (1.0 - 0.625 * p) * a + 0.375 * p * b
        a[0] += p * CONSTANT
    return a
