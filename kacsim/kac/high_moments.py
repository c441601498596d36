"""Exact moments of v_1 up to order 12 at finite N: Kac's process and Bird's algorithm.

A collision sends the energies x_i, x_j of a pair to U (x_i + x_j), (1 - U) (x_i + x_j), with
U = cos(theta)**2, so that means of products x_1**k_1 ... x_m**k_m of one degree k_1 + ... + k_m
turn into one another: by symmetry one unknown a partition of the degree, 11 at degree 6. Let T map
them over one collision of a uniform pair, and L = (T - I) N / 2, whose entries stay finite as N
grows. Bird's m collisions give T**m = (I + 2 L / N)**m. A Poisson number of them, of mean
mu = rate N t / 2, gives the sum of exp(-mu) mu**m T**m / m! = exp(mu (T - I)) = exp(rate t L),
which is Kac's process. The same two lines hold with T as the map of the whole ensemble's law.
"""

import functools
import math

import numpy as np
from scipy import linalg

from kacsim import checks
from kacsim.kac import exact
from kacsim.kac.bird import arguments
from kacsim.kac.constants import MEAN_ENERGY, RATE
from kacsim.kac.samplers import number_of_particles

ALGORITHMS = ("poisson", "bird")
LARGEST_ORDER = 12
TERMS = 40  # of log(1 + 2 L / N), where the matrix is small
DIRECT = 200  # particles up to which Bird's matrix is raised to its power by multiplications


def moment(
    order: int,
    time: float,
    n_particles: int | float = math.inf,
    *,
    algorithm: str = "poisson",
    collision_rate: float = RATE,
) -> float:
    """Return E v_1**order at time t, exactly, from v**2 that follow Gamma(3/2, 1).

    It is for the paper's f0, whose v**2 these are, and uniform angles.

    Parameters
    ----------
    order : even int from 2 to 12
    time : float >= 0; math.inf is allowed for "poisson"
    n_particles : int >= 2, or math.inf for the Kac equation
    algorithm : "poisson", which is Kac's N-particle process, or "bird"
    collision_rate : float > 0

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    checks.raise_problems(problems(order, time, n_particles, algorithm, collision_rate))
    if n_particles == math.inf:
        return exact.shape_moment(order, exact.shape(time, collision_rate))
    degree, n = order // 2, int(n_particles)
    if time == math.inf:
        return exact.drawn_moment(order, n)
    start = initial(degree, n)
    if algorithm == "poisson":
        return float(linalg.expm(collision_rate * time * generator(degree, n))[0] @ start)
    _, collisions = arguments(n_particles=n, time=time, collision_rate=collision_rate)
    return float(power(2.0 / n * generator(degree, n), collisions, n)[0] @ start)


def problems(order, time, n_particles, algorithm, collision_rate):
    """Yield what is wrong with the arguments of `moment`."""
    if not checks.is_integer(order) or order % 2 or not 2 <= order <= LARGEST_ORDER:
        sentence = f"must be an even integer from 2 to {LARGEST_ORDER}"
        yield checks.Problem("order", order, sentence)
    yield from checks.one_of("algorithm", algorithm, ALGORITHMS)
    yield from number_of_particles("n_particles", n_particles)
    yield from checks.positive("collision_rate", collision_rate)
    if time != math.inf:
        yield from checks.not_negative("time", time)
    elif algorithm != "poisson":
        yield checks.Problem("time", time, "infinity needs poisson")


def power(step, collisions, n_particles):
    """Return (I + step)**collisions without the rounding of many multiplications.

    Parameters
    ----------
    step : float64[p, p], of order 1 / N
    """
    one = np.eye(len(step))
    if n_particles <= DIRECT:
        return np.linalg.matrix_power(one + step, collisions)
    logarithm, term = np.zeros_like(step), one
    for k in range(1, TERMS):
        term = -term @ step
        logarithm -= term / k
    return linalg.expm(collisions * logarithm)


def partitions(degree, largest=None):
    """Yield the partitions of a degree, parts falling, the degree itself first."""
    if degree == 0:
        yield ()
    for first in range(min(degree, largest or degree), 0, -1):
        for rest in partitions(degree - first, first):
            yield (first, *rest)


def share_moment(a, b):
    """Return E[U**a (1 - U)**b], U = cos(theta)**2 of a uniform angle."""
    numerator = math.factorial(2 * a) * math.factorial(2 * b)
    factorials = math.factorial(a) * math.factorial(b) * math.factorial(a + b)
    return numerator / (4 ** (a + b) * factorials)


@functools.cache
def generator(degree, n_particles):
    """Return L, float64[p, p]: d m / d (rate t) = L m for the means m of `means_of`."""
    known = means_of(degree, n_particles)
    places = {parts: k for k, parts in enumerate(known)}
    matrix = np.zeros((len(known), len(known)))
    for row, parts in enumerate(known):
        m = len(parts)
        for a in range(m):
            # The pair's second: one of the parts after, or any of the others, whose power is 0.
            others = [(b, 1.0) for b in range(a + 1, m)]
            for b, rate in [*others, (m, float(n_particles - m))]:
                if rate == 0.0:
                    continue
                grown = (*parts, 0)
                rate /= n_particles - 1.0
                matrix[row, row] -= rate
                both = grown[a] + grown[b]
                mean = share_moment(grown[a], grown[b])
                rest = [part for k, part in enumerate(grown) if k not in (a, b)]
                for first in range(both + 1):
                    new = sorted([*rest, first, both - first], reverse=True)
                    new = tuple(part for part in new if part)
                    matrix[row, places[new]] += rate * mean * math.comb(both, first)
    return matrix


def means_of(degree, n_particles):
    """Return the partitions whose parts are no more than the particles, the degree itself first."""
    return [parts for parts in partitions(degree) if len(parts) <= n_particles]


def initial(degree, n_particles):
    """Return the means at time 0: products of E x**k = 3/2 5/2 ... (k + 1/2)."""
    one = [1.0]
    for k in range(degree):
        one.append(one[-1] * (MEAN_ENERGY + k))
    return np.array([math.prod(one[k] for k in p) for p in means_of(degree, n_particles)])


def bird_of_poisson(order, time, n_particles, collision_rate=RATE):
    """Return E v_1**order of Bird's collisions in a Poisson number: the sum over numbers of them.

    Term by term, as a check of the identity above; O(N).
    """
    degree, n = order // 2, int(n_particles)
    mean = collision_rate * n * time / 2.0
    state = initial(degree, n)
    step = np.eye(len(state)) + 2.0 / n * generator(degree, n)
    total = 0.0
    for m in range(int(mean + 40.0 * math.sqrt(mean) + 40.0)):
        weight = math.exp(m * math.log(mean) - mean - math.lgamma(m + 1.0))
        total += weight * state[0]
        state = step @ state
    return float(total)
