"""What sections 2 to 4 of the Kac paper state, worked out exactly: no draws."""

import functools
import itertools
import math
from fractions import Fraction

import numpy as np
from scipy import special, stats

from kacsim.kac import exact, sequential_limit
from kacsim.kac.constants import MEAN_ENERGY, RATE, n_steps
from kacsim.kac.moments import INITIAL_SQUARE, gain

# Angles with rational sine and cosine, and their chances: a density of angles that is symmetric
# about 0 has each of them with both signs.
ANGLES = (
    (Fraction(4, 5), Fraction(3, 5), Fraction(1, 3)),
    (Fraction(12, 13), Fraction(-5, 13), Fraction(2, 3)),
)


# Section 2.1: the Kac walk


def both_signs():
    """Return angles (sine, cosine, chance), symmetric about 0 and not uniform."""
    return tuple((sign * s, c, p / 2) for s, c, p in ANGLES for sign in (1, -1))


def walked(polynomial, n_particles, angles):
    """Return Q_N g for a polynomial g (Kac paper, section 2.1), exactly.

    Parameters
    ----------
    polynomial : dict, exponents of v_1..v_N (tuple) -> coefficient
    n_particles : int
    angles : iterable of (sine, cosine, chance)
    """
    pairs = list(itertools.combinations(range(n_particles), 2))
    found = {}
    for (i, j), (sin, cos, chance) in itertools.product(pairs, angles):
        for exponents, coefficient in polynomial.items():
            for shift, value in _rotated(exponents[i], exponents[j], sin, cos).items():
                new = list(exponents)
                new[i], new[j] = shift
                weight = coefficient * value * chance / len(pairs)
                found[tuple(new)] = found.get(tuple(new), 0) + weight
    return found


@functools.cache
def _rotated(a, b, sin, cos):
    """Return (x cos + y sin)**a (y cos - x sin)**b as powers (of x, of y) -> coefficient."""
    found = {}
    for k, m in itertools.product(range(a + 1), range(b + 1)):
        value = math.comb(a, k) * cos**k * sin ** (a - k) * math.comb(b, m) * (-sin) ** m
        powers = k + m, a - k + b - m
        found[powers] = found.get(powers, 0) + value * cos ** (b - m)
    return found


def sphere_mean(polynomial, n_particles):
    """Return the mean of a polynomial over the unit sphere, exactly."""
    return sum(c * _monomial_mean(e, n_particles) for e, c in polynomial.items())


@functools.cache
def _monomial_mean(exponents, n_particles):
    if any(one % 2 for one in exponents):
        return Fraction(0)
    top = math.prod(math.prod(range(1, one, 2)) for one in exponents)
    return Fraction(top, math.prod(n_particles + k for k in range(0, sum(exponents), 2)))


def times(one, other):
    """Return the product of two polynomials."""
    found = {}
    for (e, c), (f, d) in itertools.product(one.items(), other.items()):
        key = tuple(map(sum, zip(e, f, strict=True)))
        found[key] = found.get(key, 0) + c * d
    return found


def unequal_pairs(n_particles, degree, angles):
    """Return (pairs g, f of monomials for which eq. (2) fails, pairs tested), exactly.

    Parameters
    ----------
    n_particles : int
    degree : int, largest degree of a monomial
    angles : iterable of (sine, cosine, chance)
    """
    grid = itertools.product(range(degree + 1), repeat=n_particles)
    monomials = [{exponents: Fraction(1)} for exponents in grid if sum(exponents) <= degree]
    images = [walked(one, n_particles, angles) for one in monomials]
    failed, tested = 0, 0
    for (g, qg), (f, qf) in itertools.combinations(zip(monomials, images, strict=True), 2):
        left, right = (sphere_mean(times(*pair), n_particles) for pair in ((qg, f), (g, qf)))
        failed += left != right
        tested += 1
    return failed, tested


def energy_changes(n_particles, angles):
    """Return (collisions that change the sum of v**2, collisions tested), exactly.

    A collision is orthogonal, and so conserves the energy of every state, if each two of the
    images of the unit vectors have the scalar product of the unit vectors themselves.
    """
    failed, tested = 0, 0
    for (i, j), (sin, cos, _) in itertools.product(
        itertools.combinations(range(n_particles), 2), angles
    ):
        matrix = [[Fraction(int(a == b)) for b in range(n_particles)] for a in range(n_particles)]
        matrix[i][i], matrix[i][j], matrix[j][i], matrix[j][j] = cos, sin, -sin, cos
        columns = list(zip(*matrix, strict=True))
        failed += any(
            sum(x * y for x, y in zip(columns[a], columns[b], strict=True)) != (a == b)
            for a, b in itertools.product(range(n_particles), repeat=2)
        )
        tested += 1
    return failed, tested


def momentum_change():
    """Return the mean square change of the pair's v_i + v_j over its mean square, 8 angles exact.

    Independent v_i and v_j of one variance; the square of a sum of sines and cosines.
    """
    angle = 2.0 * math.pi * np.arange(8) / 8
    sin, cos = np.sin(angle), np.cos(angle)
    return float(np.mean((cos - sin - 1.0) ** 2 + (cos + sin - 1.0) ** 2) / 2.0)


# Sections 2.2 and 3: the master equation, the Kac equation and its solution


def series_moment(n_particles, time, collision_rate=RATE):
    """Return E v_1**4 of the master equation's solution as printed: a Poisson series of Q_N**k."""
    mean = collision_rate * n_particles * time / 2.0
    k = np.arange(int(mean + 40.0 * math.sqrt(mean) + 40.0))
    ratio = 1.0 - (n_particles + 2.0) / (2.0 * n_particles * (n_particles - 1.0))
    after = INITIAL_SQUARE + gain(n_particles) * (1.0 - ratio**k)
    return float(stats.poisson.pmf(k, mean) @ after)


def change_by_equation(order, time, collision_rate=RATE):
    """Return d/dt of the mean of v**order under eq. (6), of the density (8) at a time.

    rate times (the mean of (v cos + w sin)**order, less that of v**order), w as v and independent.
    """
    shape = exact.shape(time, collision_rate)
    moments = [1.0, *(exact.shape_moment(k, shape) for k in range(2, order + 1, 2))]
    half = order // 2
    mixed = sum(
        math.comb(order, 2 * k)
        * moments[k]
        * moments[half - k]
        * special.beta(k + 0.5, half - k + 0.5)
        / math.pi
        for k in range(half + 1)
    )
    return collision_rate * (mixed - moments[half])


def change_by_solution(order, time, collision_rate=RATE):
    """Return d/dt of the mean of v**order by eq. (8), through the derivative of C(t)."""
    shape = exact.shape(time, collision_rate)
    falling = -collision_rate / 4.0 * math.exp(-collision_rate * time / 8.0) * shape**2
    k = order / 2.0
    slope = k * (1.0 - k) * (3.0 * shape - 1.0) / shape ** (k + 1.0)
    return float(special.gamma(k + 0.5) / math.sqrt(math.pi) * slope * falling)


def mass_of_marginal(n_particles, *, surface):
    """Return the integral over v_1 of the marginal (5) of the uniform density on the unit sphere.

    Parameters
    ----------
    n_particles : int >= 3
    surface : whether each v_1 has the factor sqrt(E / (E - v_1**2)) that turns the measure of the
        smaller sphere, times dv_1, into that of the sphere's surface; eq. (5) prints none
    """
    ratio = math.lgamma(n_particles / 2.0) - math.lgamma((n_particles - 1.0) / 2.0)
    areas = math.exp(ratio) / math.sqrt(math.pi)  # of the unit spheres in N - 1 and N dimensions
    power = (n_particles - 2.0 - surface) / 2.0  # of 1 - v_1**2
    return float(areas * special.beta(0.5, power + 1.0))


# Section 4: the algorithms


def discretized_moment(time, time_step, collision_rate=RATE):
    """Return E v**4 of eq. (10) after time / time_step steps from f0."""
    p = collision_rate * time_step
    moment = INITIAL_SQUARE
    for _ in range(n_steps(time, time_step)):
        moment = (1.0 - p) * moment + p * 0.75 * (moment + MEAN_ENERGY**2)
    return moment


def in_place_moments(time, time_step, collision_rate=RATE):
    """Return E v**4 of (particle 1, all particles) as N grows, updated in place."""
    first, mean = sequential_limit.fourth_moments(0.0, time, time_step, collision_rate)
    return float(first), mean


def mean_rounded(x):
    """Return the mean of Round[x] (Kac paper, 4.1): floor and floor + 1 with their chances."""
    low = math.floor(x)
    return low * (low + 1.0 - x) + (low + 1.0) * (x - low)


def spared_time(time, collision_rate=RATE):
    """Return the mean time from the last collision of particle 1 to the end.

    Given K collisions it is t / (K + 1), the mean of the last gap of K uniform times; K is
    Poisson.
    """
    mean = collision_rate * time
    k = np.arange(int(mean + 40.0 * math.sqrt(mean) + 40.0))
    return float(stats.poisson.pmf(k, mean) @ (time / (k + 1.0)))


def poisson_collisions(n_particles, time, others_rate, collision_rate=RATE):
    """Return the mean number of collisions that the Poisson algorithm simulates.

    Parameters
    ----------
    others_rate : collisions of the other particles per time, in units of the collision rate:
        (N - 2) / 2, or (N - 1) / 2 as printed
    """
    until = time - spared_time(time, collision_rate)
    return collision_rate * (time + others_rate * until)


def norms(one, other):
    """Return (sup of |p(A) - q(A)| over all sets A, half the sum of |p - q|) of two discrete laws.

    Parameters
    ----------
    one, other : float64[n], probabilities of the same points
    """
    gap = np.asarray(one) - np.asarray(other)
    return float(max(gap[gap > 0].sum(), -gap[gap < 0].sum())), float(0.5 * np.abs(gap).sum())
