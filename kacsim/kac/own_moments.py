"""Exact second and fourth moments for any initial law and any law of the scattering angle.

A collision by theta or, as likely, -theta makes of a = E v_1**4 and b = E v_1**2 v_2**2

    E v_1'**4 = a + 2 s (3 b - a),    s = E cos(theta)**2 sin(theta)**2,

and keeps a + (N - 1) b. Laws are the `Drawn` that the kernels draw by: nothing is lost in a table.
As under eq. (8) of the Kac paper E v**2 stays, and E v**4 goes to 3 (E v**2)**2.
"""

from __future__ import annotations

import math

import numpy as np
from scipy import special

from kacsim.checks import one_of, raise_problems
from kacsim.kac import samplers
from kacsim.kac.constants import MEAN_ENERGY, RATE
from kacsim.kac.exact import cumulative as paper_cumulative
from kacsim.kac.moments import INITIAL_SQUARE
from kacsim.kac.own_drawn import tables
from kacsim.typed import Law

ALGORITHMS = ("poisson", "bird")
NODES, WEIGHTS = np.polynomial.legendre.leggauss(64)  # of a cosine of at most 50 radians


def fourth_moment(
    time: float,
    n_particles: int | float = math.inf,
    *,
    initial: Law | None = None,
    scattering: Law | None = None,
    algorithm: str = "poisson",
    collision_rate: float = RATE,
) -> float:
    """Return E v_1**4 at time t, exactly.

    Parameters
    ----------
    time : float >= 0
    n_particles : int >= 2, or math.inf for the equation
    initial, scattering : as of `kac.draw`
    algorithm : "poisson", Kac's process itself, or "bird"
    collision_rate : float > 0

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    raise_problems(
        [
            *one_of("algorithm", algorithm, ALGORITHMS),
            *samplers.moment_problems(algorithm, time, n_particles, collision_rate),
        ]
    )
    first, angle = tables(initial, scattering)
    square, start = moments_at_start(first)
    lost = 2.0 * shared(angle)
    if n_particles == math.inf:
        end, left = 3.0 * square**2, math.exp(-lost * collision_rate * time)
    else:
        n = float(n_particles)
        end = 3.0 * (start + (n - 1.0) * square**2) / (n + 2.0)
        lost *= (n + 2.0) / (n - 1.0)
        if algorithm == "bird":
            left = (1.0 - 2.0 * lost / n) ** math.ceil(collision_rate * n_particles * time / 2)
        else:
            left = math.exp(-lost * collision_rate * time)
    return end + (start - end) * left


def shared(angle):
    """Return E cos(theta)**2 sin(theta)**2 of a law of the angle, 1/8 of a uniform one."""
    u = 0.5 * (1.0 + NODES)
    theta = angle.start[:, None] + angle.width[:, None] * u
    weight = 0.5 * WEIGHTS * (1.0 - angle.tilt[:, None] + 2.0 * angle.tilt[:, None] * u)
    of_pieces = (weight * np.sin(2.0 * theta) ** 2 / 4.0).sum(axis=1)
    return float(shares(angle) @ of_pieces)


def shares(law):
    """Return the probability of each piece of a law, float64[k]."""
    given = np.bincount(law.other, weights=1.0 - law.cut, minlength=law.cut.size)
    return (law.cut + given) / max(1, law.cut.size)


def moments_at_start(law):
    """Return (E v**2, E v**4) of an initial law, whose variates that are added are independent."""
    added = np.array([law.spread**2, 3.0 * law.spread**4])
    if law.paper:
        added = _of_sum(added, (MEAN_ENERGY, INITIAL_SQUARE))
    if not law.start.size:
        return tuple(map(float, added))
    u = 0.5 * (1.0 + NODES)
    v = law.start[:, None] + law.width[:, None] * u
    weight = 0.5 * WEIGHTS * (1.0 - law.tilt[:, None] + 2.0 * law.tilt[:, None] * u)
    powers = [float(shares(law) @ (weight * v**k).sum(axis=1)) for k in (2, 4)]
    return tuple(map(float, _of_sum(added, powers)))


def _of_sum(one, other):
    """Return (E v**2, E v**4) of a sum; one of the two is symmetric, so that odd powers vanish."""
    return np.array([one[0] + other[0], one[1] + 6.0 * one[0] * other[0] + other[1]])


def cumulative(law, v):
    """Return P(v_1 <= v) at time 0, of an array of velocities.

    A law of the names has pieces of a width or a spread, never both.
    """
    v = np.asarray(v, dtype=float)
    if law.paper:
        return paper_cumulative(v, 0.0)
    if law.spread > 0.0:
        places = law.start if law.start.size else np.zeros(1)
        chance = shares(law) if law.start.size else np.ones(1)
        return special.ndtr((v[..., None] - places) / law.spread) @ chance
    x = np.clip((v[..., None] - law.start) / law.width, 0.0, 1.0)
    below = (1.0 - law.tilt) * x + law.tilt * x**2
    return np.where(law.width < 0.0, 1.0 - below, below) @ shares(law)
