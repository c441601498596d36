"""Exact E |v_1|**4 of every algorithm at finite N and finite step.

The means A..J of `kacsim.maxwell.contractions` obey a linear recursion for each scheme of
collisions. They start at (12.6, 9, 3, 0, 0, 0, 0).

- One collision of a uniform pair: M. Bird's algorithm after m of them: M**m; the exact process:
  exp(rate N t / 2 (M - 1)).
- Nanbu-Babovsky: P disjoint pairs. Of k particles q given pairs collide with each other, s with
  others and the remaining u not, with the probability
  2**(q + s) (P)_(q + s) (N - 2 P)_u / (N)_k, where (x)_k = x (x - 1) ... (x - k + 1).
- Nanbu, synchronous: each of k particles collides with probability p and reads a partner at the
  old level, one of the others or a further one, which several may share.
- Poisson with the printed rate: particle 1 is told from the others, in the means of products that
  are equal but for the names of these.
- Nanbu, sequential: `kacsim.maxwell.in_place`, from `LARGEST_TENSOR` on by a polynomial in 1 / N
  through fewer particles and infinitely many (its error is below 1e-8).

Infinitely many particles: A' = A + p (15 - A) / 3 for a step of probability p, so that
E |v|**4 = 15 - 2.4 exp(-rate t / 3) = 15 K (2 - K) without one, but for the sequential algorithm.
"""

import math
from collections.abc import Callable

import numpy as np
from scipy import linalg

from kacsim import checks
from kacsim.kac import samplers
from kacsim.kac.constants import n_steps
from kacsim.maxwell.contractions import EQUILIBRIUM, INITIAL, kind
from kacsim.maxwell.exchangeable import disjoint_pairs, generator, old_level, power, with_first
from kacsim.maxwell.in_place import endless_in_place, in_place

START = EQUILIBRIUM - INITIAL[0]
LARGEST_TENSOR = 20
NODES = (6, 8, 10, 12, 16, 20)  # of the polynomial in 1 / N


def fourth_moment(
    time: float,
    n_particles: float = math.inf,
    *,
    algorithm: str = "poisson",
    collision_rate: float = 1.0,
    **parameters: float | None,
) -> float:
    """Return E |v_1|**4 at time t of Maxwell molecules that start from the BKW mode, exactly.

    Parameters
    ----------
    time : float >= 0, in mean collision times if the rate is 1
    n_particles : int >= 2, or math.inf
    algorithm : name as in `maxwell.draw`; "poisson" is the N-particle process itself
    collision_rate : float > 0
    parameters : those that the algorithm has beside these, such as time_step

    Returns
    -------
    float, in units of the equilibrium's variance per axis squared

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    checks.raise_problems(checks.one_of("algorithm", algorithm, MOMENTS))
    own = samplers.own_parameters(algorithm, parameters)
    checks.raise_problems(_problems(algorithm, time, n_particles, collision_rate, **own))
    if time == 0:
        return INITIAL[0]
    return MOMENTS[algorithm](n_particles, time, collision_rate, **own)


def _problems(algorithm, time, n_particles, rate, **own):
    """Yield the problems of a moment: as Kac's, and steps of infinitely many particles."""
    found = list(checks.not_negative("time", time))
    yield from found or samplers.moment_problems(algorithm, time, n_particles, rate, **own)
    if n_particles == math.inf and own and not found and time > 0:
        found = list(checks.positive("time_step", own["time_step"]))
        yield from found or samplers.step_problems(algorithm, time, own["time_step"], rate)


def _poisson(n, time, rate):
    if n == math.inf:
        return EQUILIBRIUM - START * math.exp(-rate * time / 3.0)
    return _first(linalg.expm(rate * time * generator(n)))


def _poisson_printed(n, time, rate):
    if n == math.inf or n == 2:
        return _poisson(n, time, rate)
    products, change = with_first(n, 1.0 / (n - 2.0))
    start = [INITIAL[kind(product)] for product in products]
    return float(linalg.expm(rate * time * change)[0] @ start)


def _bird(n, time, rate):
    if n == math.inf:
        return _poisson(n, time, rate)
    return _first(power(2.0 / n * generator(n), math.ceil(rate * n * time / 2)))


def _nanbu_babovsky(n, time, rate, time_step):
    p, steps = rate * time_step, n_steps(time, time_step)
    if n == math.inf:
        return EQUILIBRIUM - START * (1.0 - p / 3.0) ** steps
    pairs = 0.5 * n * p
    whole = math.floor(pairs)
    step = disjoint_pairs(n, whole)
    if pairs > whole:
        step = step + (pairs - whole) * (disjoint_pairs(n, whole + 1) - step)
    return _first(np.linalg.matrix_power(step, steps))


def _nanbu_synchronous(n, time, rate, time_step):
    p, steps = rate * time_step, n_steps(time, time_step)
    if n == math.inf:
        return _nanbu_babovsky(n, time, rate, time_step)
    return _first(np.linalg.matrix_power(old_level(n, p), steps))


def _nanbu_sequential(n, time, rate, time_step):
    p, steps = rate * time_step, n_steps(time, time_step)
    if n == math.inf:
        return float(endless_in_place(p, steps)[0])
    if n <= LARGEST_TENSOR:
        return in_place(n, p, steps)
    values = [in_place(node, p, steps) for node in NODES]
    return _through(
        [0.0, *(1.0 / node for node in NODES)],
        [_nanbu_sequential(math.inf, time, rate, time_step), *values],
        1.0 / n,
    )


MOMENTS: dict[str, Callable[..., float]] = {
    "nanbu_sequential": _nanbu_sequential,
    "nanbu_synchronous": _nanbu_synchronous,
    "nanbu_babovsky": _nanbu_babovsky,
    "bird": _bird,
    "poisson": _poisson,
    "poisson_printed": _poisson_printed,
}


def _first(total):
    """Return A after a map of A..J."""
    return float(total[0] @ np.array(INITIAL))


def _through(x, y, place):
    """Return the polynomial through points at a place (Lagrange)."""
    total = 0.0
    for k, value in enumerate(y):
        others = [one for m, one in enumerate(x) if m != k]
        total += value * math.prod((place - one) / (x[k] - one) for one in others)
    return total
