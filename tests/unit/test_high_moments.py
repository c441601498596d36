"""Moments of v_1 up to order 12, against enumeration of angles, closed forms and limits.

Enumeration: a collision is a random linear map A of the energies, and the means of all products
of k energies, a tensor of N**k entries, are mapped by the mean of A in each index. Angles equally
spaced over half a turn give trigonometric polynomials their exact mean. No draws.
"""

import itertools
import math

import numpy as np
import pytest
from scipy import special

from kacsim import kac
from kacsim.kac import exact, high_moments, nanbu_sequential, sequential_limit, statements

RATE, TIME = 0.9, 1.7
ORDERS = (4, 6, 8, 10, 12)
ANGLES = (np.arange(16) + 0.25) * math.pi / 16


def moment(order, n, algorithm="poisson", time=TIME):
    return kac.moment(order, time, n, algorithm=algorithm, collision_rate=RATE)


def energies(power):
    """Return E x**power under Gamma(3/2, 1)."""
    return special.gamma(1.5 + power) / special.gamma(1.5)


def collide(tensor, n):
    """Return the mean over pairs and angles of the tensor of means, one collision earlier."""
    total = np.zeros_like(tensor)
    for i, j in itertools.combinations(range(n), 2):
        for angle in ANGLES:
            a = np.eye(n)
            a[i, [i, j]] = math.cos(angle) ** 2
            a[j, [i, j]] = math.sin(angle) ** 2
            new = tensor
            for axis in range(tensor.ndim):
                new = np.moveaxis(np.tensordot(a, new, (1, axis)), 0, axis)
            total += new
    return total / (len(ANGLES) * math.comb(n, 2))


@pytest.mark.parametrize(("n", "order"), [(2, 4), (2, 12), (3, 6), (3, 12), (4, 10)])
def test_bird_by_enumeration(n, order):
    degree = order // 2
    tensor = np.zeros((n,) * degree)
    for place in itertools.product(range(n), repeat=degree):
        counts = np.bincount(place, minlength=n)
        tensor[place] = math.prod(energies(k) for k in counts)
    for _ in range(math.ceil(RATE * n * TIME / 2)):
        tensor = collide(tensor, n)
    assert moment(order, n, "bird") == pytest.approx(tensor[(0,) * degree], rel=1e-12)


@pytest.mark.parametrize("order", [2, *ORDERS])
def test_two_particles(order):
    """After one collision, or many, x_1 is an arcsine share of all energy, Gamma(3, 1)."""
    degree = order // 2
    mixed = special.gamma(3.0 + degree) / 2.0 * special.beta(degree + 0.5, 0.5) / math.pi
    untouched = math.exp(-RATE * TIME)
    wanted = untouched * energies(degree) + (1.0 - untouched) * mixed
    assert moment(order, 2) == pytest.approx(wanted, rel=1e-12)
    assert moment(order, 2, "bird") == pytest.approx(mixed, rel=1e-12)


@pytest.mark.parametrize("n", [2, 3, 7, 50, 201, 1000, 10**9, math.inf])
@pytest.mark.parametrize("algorithm", high_moments.ALGORITHMS)
def test_order_four_is_the_fourth_moment(algorithm, n):
    wanted = kac.fourth_moment(TIME, n, algorithm=algorithm, collision_rate=RATE)
    assert moment(4, n, algorithm) == pytest.approx(wanted, rel=1e-13)
    assert moment(2, n, algorithm) == pytest.approx(1.5, rel=1e-13)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("algorithm", high_moments.ALGORITHMS)
def test_many_particles(algorithm, order):
    """The departure from eq. (8) falls as 1/N: at 10**9 it is less than 1e-8 of the moment."""
    limit = moment(order, math.inf)
    assert moment(order, 10**9, algorithm) == pytest.approx(limit, rel=1e-8)
    misses = [moment(order, n, "poisson") - limit for n in (10_000, 20_000, 40_000)]
    assert misses[0] / misses[1] == pytest.approx(2.0, rel=0.01)
    assert misses[1] / misses[2] == pytest.approx(2.0, rel=0.01)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("n", [2, 3, 7, 50])
def test_equilibrium(n, order):
    late = moment(order, n, time=1e3)
    assert late == pytest.approx(moment(order, n, time=math.inf), rel=1e-10)
    energy, weights = special.roots_genlaguerre(20, 1.5 * n - 1.0)
    beta = special.beta(0.5 + order // 2, 0.5 * (n - 1)) / special.beta(0.5, 0.5 * (n - 1))
    mean = (weights * energy ** (order // 2)).sum() / weights.sum()
    assert late == pytest.approx(beta * mean, rel=1e-9)
    assert moment(4, n, time=math.inf) == pytest.approx(exact.drawn_fourth_moment(n), rel=1e-14)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("n", [2, 5, 30, 1000])
def test_bird_with_a_poisson_number_is_the_process(n, order):
    mixed = high_moments.bird_of_poisson(order, TIME, n, RATE)
    assert mixed == pytest.approx(moment(order, n), rel=1e-10)


@pytest.mark.parametrize("order", ORDERS)
def test_bird_with_a_fixed_number_is_not(order):
    """Negative control of the identity."""
    assert abs(moment(order, 5, "bird") / moment(order, 5) - 1.0) > 0.005


@pytest.mark.parametrize("n", [190, 200, 201, 400])
def test_powers_by_logarithm_and_by_multiplication(n):
    step = 2.0 / n * high_moments.generator(6, n)
    direct = np.linalg.matrix_power(np.eye(len(step)) + step, 4 * n)
    assert high_moments.power(step, 4 * n, n) == pytest.approx(direct, rel=1e-11, abs=1e-13)


def test_partitions():
    assert [len(list(high_moments.partitions(k))) for k in range(1, 7)] == [1, 2, 3, 5, 7, 11]


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"order": 5}, "order = 5"),
        ({"order": 14}, "order = 14"),
        ({"n_particles": 1}, "n_particles = 1"),
        ({"time": -1.0}, "time = -1.0"),
        ({"time": math.inf, "algorithm": "bird"}, "infinity needs poisson"),
        ({"algorithm": "nanbu_sequential"}, "algorithm = 'nanbu_sequential'"),
        ({"collision_rate": 0.0}, "collision_rate = 0.0"),
    ],
)
def test_wrong_arguments(wrong, said):
    with pytest.raises(ValueError, match=said):
        kac.moment(**{"order": 4, "time": 1.0, "n_particles": 5} | wrong)


# Nanbu's algorithm updated in place, infinitely many particles


def finite(n, time, step):
    process = {"time": time, "time_step": step, "collision_rate": RATE}
    return nanbu_sequential.second_moments(n_particles=n, **process)


@pytest.mark.parametrize(("time", "step"), [(2.0, 1.0), (1.7, 0.34), (1.0, 1.0)])
def test_the_limit_of_updates_in_place(time, step):
    """N times the difference settles: 1/N is its rate, and the rest falls by 4 when N doubles."""
    at, mean = sequential_limit.fourth_moments([0.0, 0.5, 1.0], time, step, RATE)
    errors = []
    for n in (50, 100, 200):
        moments = finite(n, time, step)
        found = [moments[0, 0], moments[n // 2, n // 2], moments[-1, -1], moments.trace() / n]
        errors.append(n * (np.array(found) - [*at, mean]))
    first, second, third = errors
    assert (np.abs(third) < 6.0).all()
    assert second - third == pytest.approx((first - second) / 2.0, rel=0.2, abs=0.01)
    assert 2.0 * third - second == pytest.approx(third, abs=0.1)


def test_small_steps_forget_the_order():
    at, mean = sequential_limit.fourth_moments([0.0, 1.0], TIME, TIME / 2000, RATE)
    wanted = kac.fourth_moment(TIME, collision_rate=RATE)
    assert [*at, mean] == pytest.approx([wanted] * 3, rel=2e-4)


def test_the_printed_formula_is_not_the_limit():
    """Its value is that of the other reading; the paper's rate, t = 2, step 1."""
    at, mean = sequential_limit.fourth_moments(0.0, 2.0, 1.0)
    assert [float(at), mean] == pytest.approx([4.9732, 5.1244], abs=5e-5)
    assert statements.discretized_moment(2.0, 1.0) == pytest.approx(4.9323, abs=5e-4)


def test_updates_in_place_by_quadrature():
    """One step: particles of lower place are updated already, with the same mean as this one."""
    p, start = RATE * 1.0, 3.75
    (early, late), _ = sequential_limit.fourth_moments([0.0, 1.0], 1.0, 1.0, RATE)
    assert early == pytest.approx((1 - p) * start + p * (0.75 * start + 27 / 16), rel=1e-14)
    # b(u) = c + (start - c) exp(3 p u / 8), by b' = 3 p / 8 (b - c)
    rest = (0.625 * start - 27 / 16) / 0.375
    last = rest + (start - rest) * math.exp(0.375 * p)
    assert late == pytest.approx(
        (1 - p) * start + p * (0.375 * (start + last) + 27 / 16), rel=1e-14
    )


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((0.0, 1.0, 0.3), "time_step = 0.3"),
        ((0.0, 4.0, 2.0), "time_step = 2.0"),
        ((1.5, 1.0, 0.5), "places = "),
        ((0.0, -1.0, 0.5), "time = -1.0"),
    ],
)
def test_wrong_places_and_steps(arguments, said):
    with pytest.raises(ValueError, match=said):
        sequential_limit.fourth_moments(*arguments)
