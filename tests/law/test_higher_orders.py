"""E v_1**6 and E v_1**8 of Kac's process and of Bird's algorithm, against the exact values.

t = 1.7, rate 0.9, N = 2, 3 and 7, ancestral draws.
"""

import pytest
from law import compare

from kacsim import kac
from kacsim.kac.high_moments import ALGORITHMS

TIME, RATE, DRAWS = 1.7, 0.9, 4_000_000


def z_of(algorithm, n, order, expected, seed, time=TIME):
    v = kac.draw(
        algorithm,
        n_particles=n,
        time=TIME,
        n_draws=compare.scaled(DRAWS),
        seed=seed,
        collision_rate=RATE,
    )
    exact = kac.moment(order, time, n, algorithm=expected, collision_rate=RATE)
    return compare.of_mean(v**order, exact)


@pytest.mark.parametrize("order", [6, 8])
@pytest.mark.parametrize("n", [2, 3, 7])
@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_moments_of_higher_order(algorithm, n, order, seed):
    """Null: the exact moment. 4e6 draws err by 0.2 % (order 6) and 0.35 % (order 8).

    They see 0.8 and 1.4 %; Bird and Kac's process differ by 5 to 14 %. Mutants below.
    """
    assert compare.ok(z_of(algorithm, n, order, algorithm, seed))


MUTANTS = {
    "Bird as if it were the exact process": ("bird", 3, 6, "poisson", TIME),
    "the process as if it were Bird's": ("poisson", 3, 8, "bird", TIME),
    "one collision more": ("bird", 7, 6, "bird", TIME + 2.0 / (7 * RATE)),
}


@pytest.mark.parametrize("name", MUTANTS)
def test_mutants_are_caught(name, seed):
    """Negative controls, at the draws of the test."""
    algorithm, n, order, expected, time = MUTANTS[name]
    assert compare.caught(z_of(algorithm, n, order, expected, seed, time))
