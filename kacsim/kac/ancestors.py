"""Exact numbers of ancestors of particle 1, and of the collisions among them.

Backward in time the s ancestors of Kac's N-particle process are touched by a collision at the
rate s (1 - (s - 1) / (2 (N - 1))), in units of the collision rate; the partner is a new ancestor
with the rate s (N - s) / (N - 1). For infinitely many particles s is a Yule process.
"""

import math

import numpy as np
from scipy import integrate

from kacsim.kac.constants import RATE

TAIL = 40.0  # states up to TAIL times the mean number of ancestors are kept: exp(-TAIL) is lost


def expected_collisions(time, n_particles=math.inf, collision_rate=RATE):
    """Return the mean number of collisions in the history of particle 1's ancestors.

    Parameters
    ----------
    time : float >= 0
    n_particles : int >= 2 or math.inf, for which it is exp(rate t) - 1
    """
    span = collision_rate * time
    if n_particles == math.inf:
        return math.expm1(span)
    states = np.arange(1, 1 + int(min(n_particles, 2 + TAIL * math.exp(span))), dtype=float)
    crowding = (states - 1.0) / (n_particles - 1.0)
    touched, joined = states * (1.0 - crowding / 2.0), states * (1.0 - crowding)

    def change(_, y):
        flow = joined * y[:-1]
        return np.append(np.diff(flow, prepend=0.0) * -1.0, touched @ y[:-1])

    start = np.zeros(states.size + 1)
    start[0] = 1.0
    solution = integrate.solve_ivp(change, (0.0, span), start, rtol=1e-8, atol=1e-12)
    return float(solution.y[-1, -1])
