"""The second moment of Algorithm 6 in a uniform gas, against other programs of the same."""

import math

import numpy as np
import pytest
from scipy import integrate

from kacsim.boltzmann import bkw, null_moment
from kacsim.boltzmann.model import bkw_leaf
from kacsim.boltzmann.uniform_tree import estimate_moment
from kacsim.streams import new_stream
from kacsim.variates import exponential, half_normal, uniform


def correlations_in_vectors(time, n_draws, rng):
    """Return both correlations with their errors, from pairs of Maxwellian vectors."""
    first, second = (rng.standard_normal((n_draws, 3)) for _ in range(2))
    direction = rng.standard_normal((n_draws, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    half = 0.5 * np.linalg.norm(first - second, axis=1, keepdims=True) * direction
    middle = 0.5 * (first + second)
    h = [
        bkw.relative_of_shape((one**2).sum(axis=1), bkw.shape(time))
        for one in (first, second, middle + half, middle - half)
    ]
    values = h[0] * h[2] * h[3], h[0] * h[1] * h[2] * h[3]
    return [(one.mean(), one.std() / math.sqrt(n_draws)) for one in values]


@pytest.mark.parametrize("time", [0.0, 1.7])
def test_correlations_are_those_of_vectors(time, seed):
    rng = np.random.default_rng(seed)
    drawn = correlations_in_vectors(time, 400_000, rng)
    for exact, (mean, error) in zip(null_moment.correlations(time), drawn, strict=True):
        assert abs(mean - exact) < 4.5 * error
        assert error < 0.003


def test_known_values():
    """Of another program: parts of chi at the start, times of infinite variance, two moments."""
    assert null_moment.correlations(0.0) == pytest.approx((1.0554306, 1.1115240), abs=1e-7)
    for ratio, time in ((1.4, 2.471), (1.6, 3.427), (1.8, 5.091), (2.0, 9.563)):
        assert null_moment.critical_time(ratio) == pytest.approx(time, abs=6e-4)
    assert math.isinf(null_moment.critical_time(2.2))
    moments = null_moment.second_moment([1.0, 10.0], 2.2)
    assert moments == pytest.approx([1.10225, 1.03742], abs=6e-6)


def test_equilibrium_of_correlations_and_moments():
    """h = 1 gives chi = 1 - a, and G = 1 stays where it is."""
    assert null_moment.chi(500.0, 1.6) == pytest.approx(1.0 - 1.0 / 1.6, abs=1e-12)
    first, second = null_moment.correlations(500.0)
    assert (first, second) == pytest.approx((1.0, 1.0), abs=1e-12)


def test_the_moment_obeys_its_equation():
    """In G itself, by another method and with the correlations at each time."""
    ratio = 1.6

    def change(time, g):
        one, both = null_moment.correlations(float(time))
        return -2.0 * g + 2.0 * g**2 / ratio + 2.0 * (one - both / ratio)

    found = integrate.solve_ivp(
        change, (0.0, 2.0), [bkw.INITIAL_SECOND_MOMENT], "RK45", rtol=1e-9, atol=1e-12
    )
    wanted = float(found.y[0, -1])
    assert float(null_moment.second_moment(2.0, ratio)) == pytest.approx(wanted, rel=1e-7)


def test_moments_are_infinite_from_their_time_on():
    end = null_moment.critical_time(1.4)
    found = null_moment.second_moment([0.0, 0.99 * end, 1.01 * end, 50.0], 1.4)
    assert found[0] == pytest.approx(bkw.INITIAL_SECOND_MOMENT)
    assert 10.0 < found[1] < math.inf
    assert math.isinf(found[2])
    assert math.isinf(found[3])


def test_the_safe_ratio_is_where_it_changes():
    safe = null_moment.safe_ratio()
    assert 2.0 < safe < 2.2
    assert math.isinf(null_moment.critical_time(safe + 1e-5))
    assert math.isfinite(null_moment.critical_time(safe - 1e-4))


def test_the_best_ratio_is_a_minimum():
    ratio, work = null_moment.best_ratio(2.0)
    for other in (0.97 * ratio, 1.03 * ratio):
        excess = float(null_moment.second_moment(2.0, other)) - float(bkw.mean_square(2.0))
        assert float(null_moment.mean_calls(2.0, other)) * excess > work


def twin(ratio, time, stream):
    """Return (W, calls) by recursion in energies, as the kernel draws them."""
    z = half_normal(stream)
    calls = [0]

    def value(x, time):
        calls[0] += 1
        time -= exponential(stream) / ratio
        if time <= 0.0:
            return bkw_leaf(x)
        along = half_normal(stream)
        total = x + along * along + 2.0 * exponential(stream)
        reach = math.sqrt(max(0.0, total * total - 4.0 * x * along * along))
        after = (total + (2.0 * uniform(stream) - 1.0) * reach) / 2.0
        own = value(x, time)
        partner = value(total - x, time)
        return own + (value(after, time) * value(total - after, time) - own * partner) / ratio

    return value(z * z + 2.0 * exponential(stream), time), calls[0]


@pytest.mark.parametrize("ratio", [0.8, 1.9])
def test_realizations_are_those_of_the_twin(ratio, seed):
    streams = [new_stream(seed, f"uniform {ratio}") for _ in range(2)]
    values, nodes = np.empty(60), np.empty(60, np.int64)
    assert estimate_moment(values, nodes, ratio, 0.9, 10**6, streams[0])
    wanted, calls = zip(*(twin(ratio, 0.9, streams[1]) for _ in range(60)), strict=True)
    np.testing.assert_allclose(values, wanted, rtol=1e-10)
    np.testing.assert_array_equal(nodes, calls)
    np.testing.assert_array_equal(*streams)
    assert max(calls) > 20


def test_a_budget_is_kept(seed):
    values, nodes = np.empty(60), np.empty(60, np.int64)
    assert not estimate_moment(values, nodes, 1.9, 2.0, 50, new_stream(seed))
    assert -1 in nodes


def test_the_same_bits_each_time():
    """Also of what is kept for the next call: scipy's own weights hang on a random order."""
    times, found = np.linspace(0.1, 2.0, 7), []
    for _ in range(3):
        null_moment._tables.cache_clear()
        null_moment._solved.cache_clear()
        found.append(null_moment.second_moment(times, 1.5).tobytes())
    assert found[0] == found[1] == found[2]
