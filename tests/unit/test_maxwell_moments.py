"""Exact fourth moments of Maxwell molecules against brute force at tiny N.

Brute force: a collision v_i' = (v_i + v_j) / 2 + R (v_i - v_j) / 2 with a uniform rotation R is a
random linear map of all 3 N components, and the (3 N)**4 means of products of four of them are
mapped by the mean of its fourth power. That mean is a sum over the 60 rotations of the
icosahedron: they average products of up to five components of R as all rotations do. Who collides
is enumerated. A synchronous step writes into copies of the particles. No random numbers, no false
alarms.
"""

import itertools
import math

import numpy as np
import pytest
from scipy import linalg

from kacsim.boltzmann import bkw
from kacsim.maxwell import contractions, exchangeable, in_place, moments

RATE, TIME = 0.9, 1.7


def icosahedral():
    """Return the 60 rotations of the icosahedron: products of two that generate them."""
    golden = (1.0 + math.sqrt(5.0)) / 2.0
    fifth = 0.5 * np.array(
        [[golden, -1 / golden, 1], [1 / golden, -1, -golden], [1, golden, -1 / golden]]
    )
    # columns are orthonormal: a turn about an axis through a corner
    third = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    found = [np.eye(3)]
    for rotation in found:
        for generator in (fifth, third):
            product = generator @ rotation
            if not any(np.allclose(product, one) for one in found):
                found.append(product)
        assert len(found) <= 60
    return np.array(found)


ROTATIONS = icosahedral()


def test_rotations_average_as_all_do():
    """Negative control: powers of one component up to the fifth, and not the sixth."""
    assert len(ROTATIONS) == 60
    assert np.allclose(ROTATIONS @ ROTATIONS.transpose(0, 2, 1), np.eye(3))
    direction = np.array([0.6, 0.0, 0.8])
    powers = [((ROTATIONS @ direction)[:, 0] ** k).mean() for k in range(7)]
    assert powers[:6] == pytest.approx([1, 0, 1 / 3, 0, 1 / 5, 0], abs=1e-12)
    assert abs(powers[6] - 1 / 7) > 1e-3


def start(n):
    """Return E v_1a v_1b ..., float64[3 n] * 4, of independent velocities of the BKW mode."""
    one = np.eye(3)
    square = np.einsum("ab,cd->abcd", one, one)
    found = np.zeros((n, 3) * 4)
    for i, k in itertools.product(range(n), repeat=2):
        if i == k:
            equal = square + square.transpose(0, 2, 1, 3) + square.transpose(0, 2, 3, 1)
            found[i, :, i, :, i, :, i] = 12.6 / 15.0 * equal
        else:
            found[i, :, i, :, k, :, k] = square
            found[i, :, k, :, i, :, k] = square.transpose(0, 2, 1, 3)
            found[i, :, k, :, k, :, i] = square.transpose(0, 2, 3, 1)
    return found.reshape((3 * n,) * 4)


def mapped(tensor, matrix):
    for _ in range(4):  # the axis moves to the end each time
        tensor = np.tensordot(tensor, matrix, (0, 1))
    return tensor


def rows(n, i, j, rotation, sign):
    """Return what v_i becomes, as three rows over all components of n velocities."""
    found = np.zeros((3, n, 3))
    found[:, i], found[:, j] = (np.eye(3) + sign * rotation) / 2, (np.eye(3) - sign * rotation) / 2
    return found.reshape(3, 3 * n)


def averaged(tensor, moves):
    """Return the mean of a tensor's maps by (changed, i, j, sign) at every rotation.

    Parameters
    ----------
    moves : list of lists of (changed particle, i, j, sign of R), one list a collision
    """
    n = len(tensor) // 3
    total = np.zeros_like(tensor)
    for rotation in ROTATIONS:
        for move in moves:
            matrix = np.eye(3 * n)
            for changed, i, j, sign in move:
                matrix[3 * changed : 3 * changed + 3] = rows(n, i, j, rotation, sign)
            total += mapped(tensor, matrix)
    return total / (len(ROTATIONS) * len(moves))


def both(i, j):
    return [(i, i, j, 1.0), (j, i, j, -1.0)]


def uniform_pair(tensor):
    pairs = itertools.combinations(range(len(tensor) // 3), 2)
    return averaged(tensor, [both(*pair) for pair in pairs])


def sequential_step(tensor, p):
    n = len(tensor) // 3
    for i in range(n):
        moves = [[(i, i, j, 1.0)] for j in range(n) if j != i]
        tensor = (1 - p) * tensor + p * averaged(tensor, moves)
    return tensor


def synchronous_step(tensor, p):
    n = len(tensor) // 3
    twice = mapped(tensor, np.vstack([np.eye(3 * n)] * 2))
    for i in range(n):
        moves = [[(n + i, i, j, 1.0)] for j in range(n) if j != i]
        twice = (1 - p) * twice + p * averaged(twice, moves)
    return twice[(slice(3 * n, None),) * 4]


def fourth(tensor):
    """Return E |v_1|**4."""
    return float(np.einsum("aabb", tensor[:3, :3, :3, :3]))


STEPS = {"nanbu_sequential": sequential_step, "nanbu_synchronous": synchronous_step}


@pytest.mark.parametrize(
    ("algorithm", "n", "steps"),
    [("nanbu_sequential", 2, 3), ("nanbu_sequential", 3, 2), ("nanbu_synchronous", 2, 3)],
)
def test_nanbu_by_enumeration(algorithm, n, steps):
    tensor = start(n)
    for _ in range(steps):
        tensor = STEPS[algorithm](tensor, RATE * TIME / steps)
    assert exactly(algorithm, n, steps) == pytest.approx(fourth(tensor), rel=1e-12)


def exactly(algorithm, n, steps=None):
    step = {} if steps is None else {"time_step": TIME / steps}
    return moments.fourth_moment(TIME, n, algorithm=algorithm, collision_rate=RATE, **step)


@pytest.mark.parametrize("n", [2, 3])
def test_bird_and_the_process_by_enumeration(n):
    """The process: the number of collisions follows Poisson's law."""
    mean, tensor = RATE * n * TIME / 2, start(n)
    total, chance, bird = 0.0, math.exp(-mean), math.ceil(mean)
    for k in range(25):
        if k == bird:
            assert exactly("bird", n) == pytest.approx(fourth(tensor), rel=1e-12)
        total += chance * fourth(tensor)
        chance *= mean / (k + 1)
        tensor = uniform_pair(tensor)
    assert exactly("poisson", n) == pytest.approx(total, rel=1e-10)


def test_the_printed_rate_by_enumeration():
    """At N = 3 particle 1 collides at the rate 1, the two others at 1: pairs at 1/2, 1/2 and 1."""
    rate, tensor, total = 2.0, start(3), 0.0
    chance = math.exp(-rate * RATE * TIME)
    for k in range(25):
        total += chance * fourth(tensor)
        chance *= rate * RATE * TIME / (k + 1)
        tensor = averaged(tensor, [both(0, 1), both(0, 2), both(1, 2), both(1, 2)])
    assert exactly("poisson_printed", 3) == pytest.approx(total, rel=1e-10)


@pytest.mark.parametrize("n", [3, 4, 5, 50])
def test_a_first_particle_like_the_others(n):
    """With equal rates of all pairs the larger system gives what the one of seven means does."""
    products, change = exchangeable.with_first(n, 1.0 / (n - 1.0))
    initial = [contractions.INITIAL[contractions.kind(product)] for product in products]
    found = linalg.expm(RATE * TIME * change)[0] @ initial
    assert found == pytest.approx(exactly("poisson", n), rel=1e-12)


@pytest.mark.parametrize("n", [4, 5, 7])
def test_means_of_the_process(n):
    """The equations as derived by hand, E' of each mean over rate and time."""
    first = [
        [-1 / 3, 2 / 3, -1 / 3, 0, 0, 0, 0],
        [1 / 3, -2 / 3, 1 / 3, 0, 0, 0, 0],
        [0, 1 / 3, -1, 0, 1, -1 / 3, 0],
        [0, 0, 0, -1 / 3, -1 / 3, 2 / 3, 0],
        [0, -1 / 6, 1 / 2, 0, -1 / 2 - (n - 3) / 2, 1 / 6 + (n - 3) / 6, (n - 3) / 3],
        [0, 0, 0, 2 / 3, 2 / 3, -4 / 3, 0],
        [0, 0, 0, 0, 2, -2 / 3, -4 / 3],
    ]
    factors = np.array([n - 1, 1, n - 2, n - 2, 1, 1, 1])
    expected = factors[:, None] * np.array(first) / (n - 1)
    assert exchangeable.generator(n) == pytest.approx(expected, abs=1e-14)


def enumerated(product, n, choices):
    """Return the row of a product over all the ways to collide: (chance, [(signs, i, j)])."""
    row = np.zeros(7)
    for chance, collisions, names in choices:
        polynomial = {tuple((names[a], names[b]) for a, b in product): 1.0}
        for signs, i, j in collisions:
            polynomial = contractions.scattered(polynomial, signs, i, j)
        for one, coefficient in polynomial.items():
            row[contractions.kind(one)] += chance * coefficient
    return row


def synchronous_choices(product, n, p):
    """Yield every choice of the particles in a product; new velocities are called -1, -2, ..."""
    k = 1 + max(map(max, product))
    for partners in itertools.product(range(n), repeat=k):  # oneself: no collision
        chance, collisions, names = 1.0, [], {}
        for i, partner in enumerate(partners):
            chance *= 1 - p if partner == i else p / (n - 1)
            names[i] = i if partner == i else -1 - i
            if partner != i:
                collisions.append(({-1 - i: 1.0}, i, partner))
        yield chance, collisions, names


def babovsky_choices(n, pairs):
    names = {i: i for i in range(n)}
    orders = list(itertools.permutations(range(n), 2 * pairs))
    for order in orders:
        collisions = [
            ({i: 1.0, j: -1.0}, i, j) for i, j in zip(order[::2], order[1::2], strict=True)
        ]
        yield 1 / len(orders), collisions, names


@pytest.mark.parametrize("n", [2, 3, 4, 5])
def test_synchronous_step_by_enumeration(n):
    step = exchangeable.old_level(n, 0.6)
    for row, product in zip(step, contractions.SMALLEST, strict=True):
        if max(map(max, product)) < n:
            expected = enumerated(product, n, synchronous_choices(product, n, 0.6))
            assert row == pytest.approx(expected, abs=1e-13)


@pytest.mark.parametrize(("n", "pairs"), [(2, 1), (3, 1), (4, 1), (4, 2), (5, 2)])
def test_disjoint_pairs_by_enumeration(n, pairs):
    step = exchangeable.disjoint_pairs(n, pairs)
    for row, product in zip(step, contractions.SMALLEST, strict=True):
        if max(map(max, product)) < n:
            assert row == pytest.approx(
                enumerated(product, n, babovsky_choices(n, pairs)), abs=1e-13
            )


def test_one_pair_is_a_uniform_pair():
    """With the number of pairs random a step keeps the exact process's rates to first order."""
    for n in (4, 9):
        change = exchangeable.disjoint_pairs(n, 1) - np.eye(7)
        assert change == pytest.approx(2 / n * exchangeable.generator(n), abs=1e-14)


@pytest.mark.parametrize(
    "algorithm", ["bird", "poisson", "poisson_printed", "nanbu_babovsky", "nanbu_synchronous"]
)
def test_limit_of_many_particles(algorithm):
    steps = 4 if algorithm.startswith("nanbu") else None
    limit = exactly(algorithm, math.inf, steps)
    errors = [exactly(algorithm, n, steps) - limit for n in (10**4, 10**5)]
    assert abs(errors[0]) < 2e-3
    # Bird's rounding has an error of its own of this order.
    assert abs(errors[1]) < (3e-5 if algorithm == "bird" else 0.11 * abs(errors[0]))


def test_infinitely_many_particles_are_the_bkw_mode():
    k = bkw.shape(RATE * TIME)
    assert exactly("poisson", math.inf) == pytest.approx(15 * k * (2 - k), rel=1e-14)
    assert exactly("bird", 10**9) == pytest.approx(15 * k * (2 - k), rel=1e-8)
    assert exactly("nanbu_babovsky", math.inf, 10**4) == pytest.approx(15 * k * (2 - k), rel=1e-4)


def test_many_particles_in_place():
    """The polynomial in 1 / N, against all means of 22 particles, and the limit's own order."""
    p, steps = RATE * TIME / 3, 3
    assert exactly("nanbu_sequential", 22, 3) == pytest.approx(
        in_place.in_place(22, p, steps), abs=1e-8
    )
    series = in_place.endless_in_place(p, steps)
    assert exactly("nanbu_sequential", 10**7, 3) == pytest.approx(series[0], abs=1e-5)


def test_limit_in_place_by_a_chain_of_many():
    """The same equations on a grid of places: d of each, the mean kept up to date."""
    p, steps, n = 0.5, 4, 20_000
    deficit = np.full(n, 2.4)
    for _ in range(steps):
        mean = deficit.mean()
        for i in range(n):
            new = (1 - 2 * p / 3) * deficit[i] + p / 3 * mean
            mean += (new - deficit[i]) / n
            deficit[i] = new
    series = in_place.endless_in_place(p, steps)
    places = (np.arange(n) + 0.5) / n
    found = np.polynomial.polynomial.polyval(places, series)
    assert 15 - deficit == pytest.approx(found, abs=1e-4)


def test_small_changes_to_large_powers():
    """(1 + x)**m where 1 + x loses digits of x."""
    change = 1e-9 * exchangeable.generator(5)
    assert exchangeable.power(change, 10**9) == pytest.approx(
        exchangeable.power(1e-3 * exchangeable.generator(5), 10**3), abs=1e-3
    )
    assert exchangeable.power(np.array([[-1e-9]]), 10**9)[0, 0] == pytest.approx(
        math.exp(-1.0 - 5e-10), rel=1e-14
    )


def test_algorithms_differ():
    values = [exactly(name, 6, 2 if name.startswith("nanbu") else None) for name in moments.MOMENTS]
    assert min(abs(a - b) for a, b in itertools.combinations(values, 2)) > 0.01


@pytest.mark.parametrize(
    ("given", "name"),
    [
        ({"n_particles": 1}, "n_particles"),
        ({"time": -1.0}, "time"),
        ({"time": math.inf}, "time"),
        ({"algorithm": "posson"}, "algorithm"),
        ({"collision_rate": 0.0}, "collision_rate"),
        ({"algorithm": "nanbu_babovsky"}, "time_step"),
        ({"algorithm": "nanbu_babovsky", "time_step": 0.3}, "time_step"),
        (
            {"algorithm": "nanbu_synchronous", "time_step": 2.0, "n_particles": math.inf},
            "time_step",
        ),
        ({"time_step": 0.5}, "time_step"),
    ],
)
def test_wrong_arguments_are_named(given, name):
    with pytest.raises(ValueError, match=rf"\A{name} = "):
        moments.fourth_moment(**{"time": 2.0, "n_particles": 7} | given)
