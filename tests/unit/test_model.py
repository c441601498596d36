"""Kac's model: what a collision conserves, and the initial law f0."""

import math

import numba
import numpy as np
import pytest
from law import compare
from scipy import stats

from kacsim.kac import model
from kacsim.streams import new_stream
from kacsim.variates import squared_cosine, unit_circle

N = 1_000_000
F0_SQUARE = stats.gamma(1.5)


@pytest.fixture
def stream(seed):
    return new_stream(seed, "test_model")


@pytest.mark.parametrize("pair", [(0, 1), (4, 2)])
def test_collide_rotates_the_pair_and_nothing_else(pair, stream):
    """v_i**2 + v_j**2 is kept to rounding: a few units of the last place, at every collision."""
    v = np.array([0.3, -1.7, 2.9, 1e-8, 41.0])
    for _ in range(1000):
        before = v.copy()
        cos, sin = unit_circle(stream.copy())
        model.collide(v, *pair, stream)
        assert np.sum(v[[*pair]] ** 2) == pytest.approx(np.sum(before[[*pair]] ** 2), rel=2e-15)
        i, j = pair
        assert v[i] == before[i] * cos + before[j] * sin
        assert v[j] == before[j] * cos - before[i] * sin
        rest = [k for k in range(v.size) if k not in pair]
        np.testing.assert_array_equal(v[rest], before[rest])


def test_energy_of_an_ensemble_does_not_drift(stream):
    """After 1e5 collisions the sum of v**2 is off by no more than a random walk of roundings."""
    v = np.array([model.initial_velocity(stream) for _ in range(7)])
    before = np.sum(v**2)
    for k in range(100_000):
        model.collide(v, k % 7, (k + 1 + k % 5) % 7, stream)
    assert np.sum(v**2) == pytest.approx(before, rel=1e-12)


def test_deflect_is_the_first_half_of_collide(stream):
    v = np.array([0.3, -1.7])
    new = np.array([7.0, 7.0, 7.0])
    model.deflect(new, 1, v, 0, 1, stream.copy())
    np.testing.assert_array_equal(v, [0.3, -1.7])
    model.collide(v, 0, 1, stream)
    np.testing.assert_array_equal(new, [7.0, v[0], 7.0])


def test_signed_root(stream):
    values = [model.signed_root(2.25, stream) for _ in range(100)]
    assert set(values) == {-1.5, 1.5}


@numba.njit
def fill(velocities, shared, rotated, stream):
    """Draw under f0, and the energy of one particle after a collision of 1.3 and 0.4."""
    both = np.empty(2)
    for k in range(velocities.size):
        velocities[k] = model.initial_velocity(stream)
        shared[k] = 1.7 * squared_cosine(stream)
        both[:] = math.sqrt(1.3), -math.sqrt(0.4)
        model.collide(both, 0, 1, stream)
        rotated[k] = both[0] ** 2


@pytest.fixture(scope="module")
def drawn():
    """Return seed -> draws by name, kept."""

    def draw(seed):
        arrays = np.empty((3, compare.scaled(N)))
        fill(*arrays, new_stream(seed, "test_model fill"))
        return dict(zip(("velocity", "shared", "rotated"), arrays, strict=True))

    return compare.kept(draw)


def test_initial_law(drawn, seed):
    """Null: v**2 ~ Gamma(3/2), the sign is fair. 1e6 draws see a distance of 0.0023.

    Mutant: a mean energy of 3, that of three normals without the half.
    """
    v = drawn(seed)["velocity"]
    assert compare.ok(compare.of_distribution(v**2, F0_SQUARE.cdf))
    assert compare.ok(compare.of_energy(v))
    assert compare.ok(compare.of_fourth(v, 15.0 / 4.0))
    assert compare.ok(compare.of_share((v > 0.0).sum(), v.size, 0.5))
    assert compare.caught(compare.of_distribution(1.02 * v**2, F0_SQUARE.cdf))
    assert compare.caught(compare.of_distribution(2.0 * v**2, F0_SQUARE.cdf))


def test_sharing_energies_is_the_law_of_a_rotation(drawn, seed):
    """Null: one law. Statistic: two-sample Kolmogorov-Smirnov, 1e6 draws see 0.0032.

    Mutant: a uniform share in place of that of a uniform angle.
    """
    found = drawn(seed)
    assert compare.ok(compare.of_distributions(found["shared"], found["rotated"]))
    uniform = 1.7 * F0_SQUARE.cdf(found["velocity"] ** 2)
    assert compare.caught(compare.of_distributions(uniform, found["rotated"]))
