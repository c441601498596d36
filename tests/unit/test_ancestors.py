"""Numbers of ancestors' collisions: by enumeration of sets of particles, and as drawn."""

import itertools
import math

import numpy as np
import pytest
from law import compare
from scipy import linalg

from kacsim.kac import ancestors, draws
from kacsim.streams import new_stream

RATE, TIME = 0.9, 1.7


def by_enumeration(n, span):
    """Return the mean number of collisions that touch the ancestors of particle 0.

    The state is the set of ancestors. Each pair collides at the rate 1 / (n - 1) and, if it
    touches the set, joins it; the last unknown of the linear system counts such collisions.
    """
    sets = [frozenset(s) for k in range(n) for s in itertools.combinations(range(n), k + 1)]
    place = {one: k for k, one in enumerate(sets)}
    system = np.zeros((len(sets) + 1, len(sets) + 1))
    for one, pair in itertools.product(sets, itertools.combinations(range(n), 2)):
        if one & set(pair):
            system[place[one], place[one]] -= 1.0 / (n - 1)
            system[place[one | set(pair)], place[one]] += 1.0 / (n - 1)
            system[-1, place[one]] += 1.0 / (n - 1)
    return linalg.expm(system * span)[-1, place[frozenset([0])]]


@pytest.mark.parametrize("n", [2, 3, 5])
@pytest.mark.parametrize("time", [0.3, TIME, 6.0])
def test_collisions_by_enumeration(n, time):
    wanted = by_enumeration(n, RATE * time)
    assert ancestors.expected_collisions(time, n, RATE) == pytest.approx(wanted, rel=1e-6)


def test_many_particles_have_a_yule_process():
    endless = ancestors.expected_collisions(TIME, collision_rate=RATE)
    assert endless == math.expm1(RATE * TIME)
    assert ancestors.expected_collisions(TIME, 10**7, RATE) == pytest.approx(endless, rel=1e-5)
    assert ancestors.expected_collisions(TIME, 20, RATE) < 0.95 * endless


@pytest.mark.parametrize("n", [3, 7, 50])
def test_the_exact_process_draws_as_many_collisions(n, seed):
    """Null: the mean of the ancestral engine. 400 batches of 1000 draws see 0.6 % of it.

    Mutant: collisions of two ancestors counted for both, s in place of s (1 - (s - 1)/2 (N - 1)).
    """
    parameters = {"algorithm": "poisson", "engine": "ancestral", "n_particles": n, "time": TIME}
    kernel, arguments = draws.kernel_of(parameters | {"collision_rate": RATE})
    stream, buffers = new_stream(seed, f"ancestors {n}"), (np.empty(1000), np.empty(1000, int))
    batches = range(compare.scaled(400))
    means = np.array([kernel(*buffers, *arguments, stream) / 1000 for _ in batches])
    exact = ancestors.expected_collisions(TIME, n, RATE)
    assert compare.ok(compare.of_mean(means, exact))
    assert compare.caught(compare.of_mean(means, 1.03 * exact))
