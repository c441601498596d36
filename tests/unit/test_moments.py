"""Exact fourth moments against the published table and against brute force at tiny N.

Brute force: a collision is a random linear map A of the energies x_i = v_i**2, and the second
moments E x x^T, as a vector of N**2, are mapped by E (A kron A). That mean is taken by enumeration
of everything random: who collides, with whom, and at which of four angles, whose cos**2 have the
moments 1/2 and 3/8 of a uniform angle. No random numbers, no false alarms.
"""

import itertools
import math

import numpy as np
import pytest
from law.algorithms import own_parameters
from scipy import linalg

from kacsim import kac
from kacsim.kac import nanbu_babovsky
from kacsim.kac.samplers import TITLES
from kacsim.kernels.lookup import named

ANGLES = np.array([1, 3, 5, 7]) * math.pi / 8
RATE, TIME = 0.9, 1.7
# E v_1**4 at t = 2 and the paper's rate
TABLE = {2: 4.37256, 3: 4.55365, 5: 4.67486, 10: 4.75378, 50: 4.81052, math.inf: 4.82390}
BIRD_TABLE = {5: 4.80912, 50: 4.82785}


def row(n, i, j, angle):
    """Return what v_i**2 becomes: (x_i + x_j) cos(angle)**2, as a row over all x."""
    return math.cos(angle) ** 2 * (np.eye(n)[i] + np.eye(n)[j])


def kron(matrix):
    return np.kron(matrix, matrix)


def collision(n, i, j):
    """Return E (A kron A) of one rotation of the pair."""
    maps = []
    for angle in ANGLES:
        a = np.eye(n)
        a[i], a[j] = row(n, i, j, angle), row(n, i, j, angle + math.pi / 2)
        maps.append(kron(a))
    return np.mean(maps, axis=0)


def sequential_step(n, p):
    step = np.eye(n * n)
    for i in range(n):
        maps = []
        for j, angle in itertools.product(set(range(n)) - {i}, ANGLES):
            a = np.eye(n)
            a[i] = row(n, i, j, angle)
            maps.append(kron(a))
        step = ((1 - p) * np.eye(n * n) + p * np.mean(maps, axis=0)) @ step
    return step


def synchronous_step(n, p):
    """Enumerate every particle's choice: alone, or one of its partners at one of the angles."""
    choices = []
    for i in range(n):
        partners = [k for k in range(n) if k != i]
        chance = p / (len(partners) * len(ANGLES))
        moves = [(chance, row(n, i, j, angle)) for j in partners for angle in ANGLES]
        choices.append([(1 - p, np.eye(n)[i]), *moves])
    step = np.zeros((n * n, n * n))
    for chosen in itertools.product(*choices):
        chances, rows = zip(*chosen, strict=True)
        step += math.prod(chances) * kron(np.array(rows))
    return step


def babovsky_step(n, p):
    """Enumerate the sets of disjoint pairs, for both numbers of pairs that rounding may give."""
    mean = n * p / 2
    step = np.zeros((n * n, n * n))
    for pairs, chance in ((int(mean), 1 - mean % 1), (int(mean) + 1, mean % 1)):
        if chance == 0:
            continue
        steps = []
        for order in itertools.permutations(range(n), 2 * pairs):
            one = np.eye(n * n)
            for i, j in zip(order[::2], order[1::2], strict=True):
                one = collision(n, i, j) @ one
            steps.append(one)
        step += chance * np.mean(steps, axis=0)
    return step


def uniform_pair(n):
    return np.mean([collision(n, *pair) for pair in itertools.combinations(range(n), 2)], axis=0)


def replaced_step(n, p):
    """As `babovsky_step`, the pairs drawn one after another with replacement."""
    mean, one = n * p / 2, uniform_pair(n)
    few = np.linalg.matrix_power(one, int(mean))
    return (1 - mean % 1) * few + (mean % 1) * few @ one


def process(n, rates, mean_time):
    """Return the map of collisions at the given rates of pairs, for a length of time."""
    generator = sum(rate * (collision(n, *pair) - np.eye(n * n)) for pair, rate in rates.items())
    return linalg.expm(generator * mean_time)


def poisson_map(n, mean_time, others):
    """`others`: rate at which the other N - 1 particles collide, in units of the rate."""
    rates = {}
    for pair in itertools.combinations(range(n), 2):
        rates[pair] = 1 / (n - 1) if 0 in pair else others / math.comb(n - 1, 2)
    return process(n, rates, mean_time)


def fourth(total_map, n):
    """Return E v_1**4 from f0: E x**2 = 15/4 on the diagonal, 9/4 elsewhere."""
    start = np.full((n, n), 2.25) + 1.5 * np.eye(n)
    return (total_map @ start.ravel())[0]


STEPS = {
    "nanbu_sequential": sequential_step,
    "nanbu_synchronous": synchronous_step,
    "nanbu_babovsky": babovsky_step,
}


def exactly(algorithm, n, steps=None):
    given = own_parameters(algorithm, TIME, steps)
    return kac.fourth_moment(TIME, n, algorithm=algorithm, collision_rate=RATE, **given)


def replaced(n, steps):
    return nanbu_babovsky.fourth_moment_with_replacement(
        n_particles=n, time=TIME, time_step=TIME / steps, collision_rate=RATE
    )


@pytest.mark.parametrize(("n", "steps"), [(2, 2), (2, 5), (3, 5), (3, 17)])
@pytest.mark.parametrize("algorithm", STEPS)
def test_stepped_moments_by_enumeration(algorithm, n, steps):
    total = np.linalg.matrix_power(STEPS[algorithm](n, RATE * TIME / steps), steps)
    assert exactly(algorithm, n, steps) == pytest.approx(fourth(total, n), rel=1e-12)


@pytest.mark.parametrize(("algorithm", "n"), [("nanbu_sequential", 5), ("nanbu_babovsky", 4)])
def test_stepped_moments_with_more_particles(algorithm, n):
    total = np.linalg.matrix_power(STEPS[algorithm](n, RATE * TIME / 4), 4)
    assert exactly(algorithm, n, 4) == pytest.approx(fourth(total, n), rel=1e-12)


@pytest.mark.parametrize(("n", "steps"), [(2, 2), (3, 5), (5, 3)])
def test_replacement_by_enumeration(n, steps):
    p = RATE * TIME / steps
    total = np.linalg.matrix_power(replaced_step(n, p), steps)
    assert replaced(n, steps) == pytest.approx(fourth(total, n), rel=1e-12)


@pytest.mark.parametrize("n", [2, 3, 4, 5])
def test_bird_by_enumeration(n):
    total = np.linalg.matrix_power(uniform_pair(n), math.ceil(RATE * n * TIME / 2))
    assert exactly("bird", n) == pytest.approx(fourth(total, n), rel=1e-12)


@pytest.mark.parametrize("n", [3, 4, 5])
@pytest.mark.parametrize(("algorithm", "others"), [("poisson", -2), ("poisson_printed", -1)])
def test_poisson_by_enumeration(algorithm, others, n):
    total = poisson_map(n, RATE * TIME, (n + others) / 2)
    assert exactly(algorithm, n) == pytest.approx(fourth(total, n), rel=1e-11)


@pytest.mark.parametrize("algorithm", ["poisson", "poisson_printed"])
def test_poisson_of_two_particles(algorithm):
    total = process(2, {(0, 1): 1.0}, RATE * TIME)
    assert exactly(algorithm, 2) == pytest.approx(fourth(total, 2), rel=1e-12)


@pytest.mark.parametrize(("n", "moment"), TABLE.items())
def test_published_table(n, moment):
    assert kac.fourth_moment(2.0, n) == pytest.approx(moment, abs=5e-6)


@pytest.mark.parametrize(("n", "moment"), BIRD_TABLE.items())
def test_published_table_of_bird(n, moment):
    assert kac.fourth_moment(2.0, n, algorithm="bird") == pytest.approx(moment, abs=5e-6)


@pytest.mark.parametrize("n", [5, 6])
def test_algorithms_differ(n):
    """Negative control of the enumeration: every algorithm has a moment of its own."""
    values = [exactly(algorithm, n) for algorithm in ("poisson", "poisson_printed", "bird")]
    values += [exactly(algorithm, n, 2) for algorithm in STEPS]
    values.append(replaced(n, 2))
    assert min(abs(a - b) for a, b in itertools.combinations(values, 2)) > 0.01


@pytest.mark.parametrize("algorithm", [*STEPS, "poisson_printed", "bird"])
def test_limit_of_many_particles_and_small_steps(algorithm):
    """All algorithms tend to the Kac equation, with an error of order 1/N and the step."""
    steps = 200 if algorithm in STEPS else None
    reference = kac.fourth_moment(TIME, collision_rate=RATE)
    assert exactly(algorithm, 100, steps) == pytest.approx(reference, rel=6e-3)


@pytest.mark.parametrize("n", [2, 7, 50])
def test_equilibrium_of_the_process_is_that_of_the_beta_law_on_average(n):
    """Long times: 3/(N (N + 2)) E (sum v**2)**2, the energy being random at time 0."""
    mean_square = n * 15 / 4 + n * (n - 1) * 9 / 4
    limit = 3 * mean_square / (n * (n + 2))
    assert kac.fourth_moment(1e3, n) == pytest.approx(limit, rel=1e-12)
    assert kac.fourth_moment(0.0, n) == 15 / 4


@pytest.mark.parametrize("algorithm", kac.ALGORITHMS)
def test_every_algorithm_is_a_module_of_its_name(algorithm):
    for attribute in ("arguments", "forward", "ancestral", "fourth_moment"):
        assert callable(named("kacsim.kac", algorithm, attribute))
    assert TITLES[algorithm]
    given = own_parameters(algorithm, 1.0, 2)
    assert 3.0 < kac.fourth_moment(1.0, 7, algorithm=algorithm, **given) < 8.0
