"""Exact statements of the Kac paper's sections 2 to 4, against hand-made values and enumeration."""

import itertools
import math
from fractions import Fraction

import numpy as np
import pytest
from scipy import integrate
from unit.test_moments import collision, fourth, sequential_step, synchronous_step

from kacsim import kac
from kacsim.kac import distinct_pairs, nanbu_sequential, nanbu_synchronous, statements

RATE, TIME = 0.9, 1.7


def power(n, **exponents):
    """Return the monomial v_1**a v_2**b ... as a polynomial."""
    return {tuple(exponents.get(f"v{k}", 0) for k in range(1, n + 1)): Fraction(1)}


@pytest.mark.parametrize("n", [2, 3, 4])
def test_means_over_the_sphere(n):
    """E v_1**2 = 1/N, E v_1**4 = 3/(N (N + 2)), E v_1**2 v_2**2 = 1/(N (N + 2)), odd ones 0."""
    below = n * (n + 2)
    assert statements.sphere_mean(power(n, v1=2), n) == Fraction(1, n)
    assert statements.sphere_mean(power(n, v1=4), n) == Fraction(3, below)
    assert statements.sphere_mean(power(n, v1=2, v2=2), n) == Fraction(1, below)
    assert statements.sphere_mean(power(n, v1=3, v2=1), n) == 0


def test_a_walked_polynomial_is_the_mean_over_pairs_and_angles():
    """v_1**3 v_2 at a point, N = 3, by rotating the point itself."""
    point = np.array([0.7, -1.3, 0.4])
    angles = statements.ANGLES
    wanted = 0.0
    for (i, j), (sin, cos, chance) in itertools.product([(0, 1), (0, 2), (1, 2)], angles):
        v = point.copy()
        v[i], v[j] = v[i] * cos + v[j] * sin, v[j] * cos - v[i] * sin
        wanted += float(chance) / 3 * v[0] ** 3 * v[1]
    image = statements.walked(power(3, v1=3, v2=1), 3, angles)
    found = sum(float(c) * np.prod(point ** np.array(e)) for e, c in image.items())
    assert found == pytest.approx(wanted, rel=1e-12)


def test_chances_of_the_angles_are_one():
    assert sum(chance for *_, chance in statements.both_signs()) == 1
    assert sum(chance for *_, chance in statements.ANGLES) == 1
    assert all(sin**2 + cos**2 == 1 for sin, cos, _ in statements.both_signs())


@pytest.mark.parametrize("n", [2, 3])
def test_the_walk_is_self_adjoint_if_angles_are_symmetric(n):
    many = math.comb(n + 4, 4)  # monomials of degree up to 4
    assert statements.unequal_pairs(n, 4, statements.both_signs()) == (0, math.comb(many, 2))
    assert statements.unequal_pairs(n, 4, statements.ANGLES)[0] > 0


def test_collisions_conserve_energy_only_if_they_rotate():
    assert statements.energy_changes(3, statements.both_signs()) == (0, 3 * 4)
    stretched = ((Fraction(3, 5), Fraction(3, 5), Fraction(1)),)
    assert statements.energy_changes(3, stretched) == (3, 3)


def test_momentum_of_a_pair():
    """E over a uniform angle of (c - s - 1)**2 + (c + s - 1)**2 = 4, over E (v + w)**2 = 2."""

    def change(angle):
        cos, sin = math.cos(angle), math.sin(angle)
        return (cos - sin - 1) ** 2 + (cos + sin - 1) ** 2

    mean = integrate.quad(change, 0, 2 * math.pi)[0] / (2 * math.pi)
    assert statements.momentum_change() == pytest.approx(mean / 2)
    assert statements.momentum_change() == pytest.approx(2.0)


@pytest.mark.parametrize("n", [2, 5, 1000])
def test_series_of_collisions(n):
    relaxed = 1 - math.exp(-RATE * (n + 2) * TIME / (4 * (n - 1)))
    wanted = 3.75 + 3 * (n - 1) / (n + 2) * relaxed
    assert statements.series_moment(n, TIME, RATE) == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize("order", [2, 4, 6, 8])
def test_rates_of_change_of_moments(order):
    """By quadrature of eq. (8) a little earlier and later, and by rotating two of its values."""

    def moment(time):
        return integrate.quad(lambda v: v**order * kac.density(v, time, RATE), -30, 30)[0]

    slope = (moment(TIME + 1e-3) - moment(TIME - 1e-3)) / 2e-3
    for change in (statements.change_by_equation, statements.change_by_solution):
        assert change(order, TIME, RATE) == pytest.approx(slope, rel=1e-5, abs=1e-9)
    if order == 4:
        wanted = RATE * (0.75 * (moment(TIME) + 2.25) - moment(TIME))
        assert statements.change_by_equation(4, TIME, RATE) == pytest.approx(wanted)


def test_mass_of_the_printed_marginal():
    """N = 3: pi / 4 without the factor; N = 4: 8 / (3 pi); 1 with it."""
    assert statements.mass_of_marginal(3, surface=False) == pytest.approx(math.pi / 4)
    assert statements.mass_of_marginal(4, surface=False) == pytest.approx(8 / (3 * math.pi))
    for n in (3, 4, 50, 2000):
        assert statements.mass_of_marginal(n, surface=True) == pytest.approx(1.0)


def test_moment_of_the_discretized_equation():
    """Two steps by hand, a' = (1 - p) a + 3/4 p (a + 9/4), and the limit of small steps."""
    p = RATE * TIME / 2
    one = (1 - p) * 3.75 + 0.75 * p * 6.0
    two = (1 - p) * one + 0.75 * p * (one + 2.25)
    assert statements.discretized_moment(TIME, TIME / 2, RATE) == pytest.approx(two)
    small = statements.discretized_moment(TIME, TIME / 4000, RATE)
    assert small == pytest.approx(kac.fourth_moment(TIME, collision_rate=RATE), rel=1e-4)


@pytest.mark.parametrize("steps", [2, 5])
def test_moments_updated_in_place_are_the_limit_of_many_particles(steps):
    """Errors of order 1/N cancel between N and 2 N."""
    found = []
    for n in (200, 400):
        moments = nanbu_sequential.second_moments(
            n_particles=n, time=TIME, time_step=TIME / steps, collision_rate=RATE
        )
        found.append((moments[0, 0], moments.trace() / n))
    wanted = 2 * np.array(found[1]) - np.array(found[0])
    limits = statements.in_place_moments(TIME, TIME / steps, RATE)
    assert limits == pytest.approx(wanted, rel=2e-4)
    assert limits[1] - limits[0] > 0.02


@pytest.mark.parametrize("n", [2, 3])
@pytest.mark.parametrize(
    ("module", "step"),
    [(nanbu_sequential, sequential_step), (nanbu_synchronous, synchronous_step)],
)
def test_mean_square_of_the_energy_by_enumeration(module, step, n):
    """E (sum of x)**2, from all of E x_i x_j."""
    total = np.linalg.matrix_power(step(n, RATE * TIME / 3), 3)
    wanted = (total @ (np.full((n, n), 2.25) + 1.5 * np.eye(n)).ravel()).sum()
    found = module.second_moments(n_particles=n, time=TIME, time_step=TIME / 3, collision_rate=RATE)
    square = np.sum(found) if module is nanbu_sequential else n * (found[0] + (n - 1) * found[1])
    assert square == pytest.approx(wanted, rel=1e-12)


def test_rounding_and_collisions_spared():
    assert statements.mean_rounded(4.3) == pytest.approx(4.3)
    never = 1 - math.exp(-RATE * TIME)
    assert statements.spared_time(TIME, RATE) == pytest.approx(never / RATE)
    wanted = RATE * TIME + 24.0 * (RATE * TIME - never)
    assert statements.poisson_collisions(50, TIME, 24.0, RATE) == pytest.approx(wanted)


def test_norms_of_two_laws_on_three_points():
    """The largest difference is that of the set {0}, 0.4; all differences sum to 0.8."""
    assert statements.norms([0.6, 0.3, 0.1], [0.2, 0.5, 0.3]) == pytest.approx((0.4, 0.4))


@pytest.mark.parametrize(("n", "steps"), [(3, 2), (4, 1), (4, 3)])
def test_distinct_pairs_by_enumeration(n, steps):
    """All orders of distinct pairs, for both numbers of pairs that rounding may give."""
    mean = RATE * n * TIME / steps / 2
    pairs, total = list(itertools.combinations(range(n), 2)), 0.0
    for many, chance in ((int(mean), 1 - mean % 1), (int(mean) + 1, mean % 1)):
        maps = []
        for order in itertools.permutations(pairs, many):
            one = np.eye(n * n)
            for pair in order:
                one = collision(n, *pair) @ one
            maps.append(one)
        total = total + chance * np.mean(maps, axis=0)
    found = distinct_pairs.fourth_moment(
        n_particles=n, time=TIME, time_step=TIME / steps, collision_rate=RATE
    )
    assert found == pytest.approx(fourth(np.linalg.matrix_power(total, steps), n), rel=1e-11)


def test_the_partitions_of_a_sequence_are_counted_by_bell():
    assert [len(distinct_pairs._partitions(n)) for n in range(7)] == [1, 1, 2, 5, 15, 52, 203]
