"""Exact fourth moments of every algorithm at finite N and finite step.

Second-order moments of the energies x_i = v_i**2 obey linear recursions. A rotation by a uniform
angle shares S = x_i + x_j so that E x_i'**2 = 3/8 E S**2, E x_i' x_j' = 1/8 E S**2 and
E x_i' x_k = 1/2 E S x_k. Unknowns: a = E x_i**2 and b = E x_i x_j; they start at 15/4 and 9/4.
The recursion of an algorithm stands with its kernels, as ``fourth_moment``.
"""

import math

from kacsim import checks
from kacsim.kac import samplers
from kacsim.kac.constants import RATE
from kacsim.kernels.lookup import named

INITIAL_SQUARE = 15.0 / 4.0
INITIAL_PRODUCT = 9.0 / 4.0


def gain(n):
    """Return how much E v_1**4 grows from its start to the equilibrium of n particles."""
    return 3.0 * (n - 1.0) / (n + 2.0)


def fourth_moment(
    time: float,
    n_particles: float = math.inf,
    *,
    algorithm: str = "poisson",
    collision_rate: float = RATE,
    **parameters: float | None,
) -> float:
    """Return E v_1**4 at time t, exactly, for one algorithm at finite N and finite step.

    It is for the paper's f0 and uniform angles.

    Parameters
    ----------
    time : float >= 0
    n_particles : int >= 2, or math.inf for the Kac equation (any algorithm but with a step)
    algorithm : name as in `kac.draw`; "poisson" is Kac's N-particle process itself
    collision_rate : float > 0
    parameters : those that the algorithm has beside these, such as time_step

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    own = samplers.own_parameters(algorithm, parameters)
    checks.raise_problems(
        samplers.moment_problems(algorithm, time, n_particles, collision_rate, **own)
    )
    if time == 0:
        return INITIAL_SQUARE
    if n_particles == math.inf:
        return INITIAL_SQUARE + 3.0 * -math.expm1(-collision_rate * time / 4.0)
    moment = named("kacsim.kac", algorithm, "fourth_moment")
    return moment(n_particles=n_particles, time=time, collision_rate=collision_rate, **own)
