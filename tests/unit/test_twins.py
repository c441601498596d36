"""Every kernel gives the same values, draw by draw, as its plain-Python twin (see twins.py)."""

import functools
import itertools
import math

import numpy as np
import pytest
import twins
from law.algorithms import own_parameters

from kacsim.kac import draws, forward, perfect, readings
from kacsim.kac.constants import RULES, WALKS
from kacsim.kac.samplers import ALGORITHMS, ENGINES, KAC
from kacsim.streams import new_stream

TWINS = {
    ("nanbu_sequential", "forward"): functools.partial(twins.nanbu_forward, synchronous=False),
    ("nanbu_sequential", "ancestral"): twins.nanbu_sequential_ancestral,
    ("nanbu_synchronous", "forward"): functools.partial(twins.nanbu_forward, synchronous=True),
    ("nanbu_synchronous", "ancestral"): twins.nanbu_synchronous_ancestral,
    ("nanbu_babovsky", "forward"): twins.nanbu_babovsky_forward,
    ("nanbu_babovsky", "ancestral"): twins.nanbu_babovsky_ancestral,
    ("bird", "forward"): twins.bird_forward,
    ("bird", "ancestral"): twins.bird_ancestral,
    ("poisson", "forward"): twins.poisson_forward,
    ("poisson", "ancestral"): twins.poisson_ancestral,
    ("poisson_printed", "forward"): twins.poisson_forward,
    ("poisson_printed", "ancestral"): twins.poisson_ancestral,
}
# (particles, time, steps, draws); the last two have histories of more than 256 and 512 collisions
SHAPES = [
    (2, 1.7, 10, 200),
    (3, 1.7, 5, 200),
    (7, 1.7, 2, 200),
    (7, 1.7, 170, 100),
    (50, 1.7, 10, 40),
    (50, 20.0, 40, 4),
    (50, 40.0, 80, 4),
]


def parameters_of(algorithm, engine, shape):
    n, time, steps, _ = shape
    parameters = {
        "algorithm": algorithm,
        "engine": engine,
        "n_particles": n,
        "time": time,
        "collision_rate": 0.9,
        **own_parameters(algorithm, time, steps),
    }
    assert KAC.problems(KAC.complete(parameters)) == []
    return parameters


def twin_draws(twin, arguments, n_draws, stream):
    rows = zip(range(n_draws), twin(*arguments, stream), strict=False)
    return list(zip(*(row for _, row in rows), strict=True))


def assert_same_draws(kernel, twin, arguments, n_draws, key):
    """Compare values, own collisions, simulated collisions and the stream's final state."""
    streams = new_stream(*key), new_stream(*key)
    velocities, own = np.empty(n_draws), np.empty(n_draws, np.int64)
    simulated = kernel(velocities, own, *arguments, streams[0])
    wanted, wanted_own, wanted_simulated = twin_draws(twin, arguments, n_draws, streams[1])
    np.testing.assert_allclose(velocities, wanted, rtol=1e-12, atol=1e-15)
    np.testing.assert_array_equal(own, wanted_own)
    assert simulated == sum(wanted_simulated)
    np.testing.assert_array_equal(*streams)
    return max(wanted_simulated)


@pytest.mark.parametrize("shape", SHAPES, ids=str)
@pytest.mark.parametrize(("algorithm", "engine"), TWINS)
def test_kernel_gives_the_twins_draws(algorithm, engine, shape, seed):
    kernel, arguments = draws.kernel_of(parameters_of(algorithm, engine, shape))
    longest = assert_same_draws(
        kernel, TWINS[algorithm, engine], arguments, shape[3], (seed, f"twin {algorithm} {engine}")
    )
    assert longest > {20.0: 256, 40.0: 512}.get(shape[1], 0)


def test_infinitely_many_particles(seed):
    kernel, _ = draws.kernel_of({"algorithm": "poisson", "engine": "ancestral"} | INFINITE)
    assert_same_draws(kernel, twins.poisson_ancestral, (0, 1.53, 0.0), 200, (seed, "twin tree"))


INFINITE = {"n_particles": math.inf, "time": 1.7, "collision_rate": 0.9}


def test_arguments_of_infinitely_many_particles():
    _, arguments = draws.kernel_of({"algorithm": "poisson", "engine": "ancestral"} | INFINITE)
    assert arguments == (0, pytest.approx(1.53), 0.0)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_draws_do_not_depend_on_the_batch(algorithm, engine, seed):
    """One call for ten draws and ten calls give the same values, workspaces of any size included.

    Nanbu-Babovsky's shuffle goes on from the last draw's order: there the first draw only.
    """
    kernel, arguments = draws.kernel_of(parameters_of(algorithm, engine, (50, 30.0, 60, 0)))
    n_draws = 1 if (algorithm, engine) == ("nanbu_babovsky", "forward") else 10
    streams = new_stream(seed, "batch"), new_stream(seed, "batch")
    (together, single), own = np.empty((2, n_draws)), np.empty(n_draws, np.int64)
    kernel(together, own, *arguments, streams[0])
    for k in range(n_draws):
        kernel(single[k : k + 1], own[k : k + 1], *arguments, streams[1])
    np.testing.assert_array_equal(together, single)


@pytest.mark.parametrize(
    ("kernel_of", "twin"),
    [
        (("nanbu_synchronous", "forward"), TWINS["nanbu_sequential", "forward"]),
        (("nanbu_sequential", "ancestral"), TWINS["nanbu_synchronous", "ancestral"]),
    ],
)
def test_the_other_readings_twin_gives_other_draws(kernel_of, twin, seed):
    """Negative control of the comparison itself."""
    kernel, arguments = draws.kernel_of(parameters_of(*kernel_of, (7, 1.7, 2, 0)))
    with pytest.raises(AssertionError, match=r"Not equal to tolerance|not equal"):
        assert_same_draws(kernel, twin, arguments, 200, (seed, "other reading"))


@pytest.mark.parametrize(
    ("n", "tolerance", "n_seeds"), [(2, 1e-6, 40), (3, 1e-9, 40), (7, 1e-6, 20), (50, 1e-2, 2)]
)
def test_couple_gives_the_twins_draws(n, tolerance, n_seeds, seed):
    """First draws of many streams: the blocks a kernel draws ahead do not matter to them."""
    for replicate in range(n_seeds):
        energy = 1.3 * n
        velocity, time = np.empty(1), np.empty(1, np.int64)
        key = (seed, "twin couple", replicate)
        perfect.couple(velocity, time, n, energy, tolerance, new_stream(*key))
        wanted, wanted_time = twins.couple(n, energy, tolerance, new_stream(*key))
        assert (time[0], abs(velocity[0])) == (wanted_time, pytest.approx(wanted, rel=1e-12))


@pytest.mark.parametrize("n", [2, 3, 6])
@pytest.mark.parametrize("walk", WALKS)
def test_stopping_times_are_the_twins(walk, n, seed):
    """Every rule at every tolerance; the kernel looks again only where a step changed a pair."""
    key, tolerance, n_draws = (seed, "twin readings"), [0.5, 0.1, 0.03, 1e-4], 30
    times = np.zeros((n_draws, len(RULES), len(tolerance)), np.int64)
    bound = readings.arguments(n_particles=n, walk=walk, tolerance=tolerance)
    streams = new_stream(*key), new_stream(*key)
    readings.stopping_times(times, *bound, streams[0])
    twin = twins.stopping_times(n, walk, tolerance, streams[1])
    wanted = [[found[rule] for rule in RULES] for found in itertools.islice(twin, n_draws)]
    np.testing.assert_array_equal(times, wanted)
    np.testing.assert_array_equal(*streams)


def test_a_single_precision_walk_stops_as_in_double_precision(seed):
    """Where rounding is far below the tolerance: the same inputs, the same times."""
    key, tolerance, n_draws = (seed, "single"), [0.3, 0.02], 40
    times, single = np.zeros((n_draws, 8, 2), np.int64), np.zeros((n_draws, 1, 2), np.int64)
    bound = readings.arguments(n_particles=2, walk="printed", tolerance=tolerance)
    readings.stopping_times(times, *bound, new_stream(*key))
    readings.stopping_times_single(single, 2, np.array(tolerance), new_stream(*key))
    np.testing.assert_array_equal(times[:, :1], single)


@pytest.mark.parametrize(("n", "tolerance"), [(2, 0.1), (3, 1e-4), (5, 1e-2)])
def test_coupling_both_ways_gives_the_twins_draws(n, tolerance, seed):
    energy, size, key = 1.3 * n, 12, (seed, "twin both ways")
    corners, errors = np.empty((2, size, n)), np.empty((size, 2))
    times, streams = np.empty((size, 2), np.int64), (new_stream(*key), new_stream(*key))
    arguments = forward.arguments(n_particles=n, tolerance=tolerance, energy=energy)
    forward.couple_both_ways(*corners, errors, times, *arguments, streams[0])
    twin = twins.couple_both_ways(n, energy, tolerance, streams[1])
    rows = list(itertools.islice(twin, size))
    back, onward, wanted, apart = (np.array(column) for column in zip(*rows, strict=True))
    np.testing.assert_array_equal(times, wanted)
    np.testing.assert_allclose(corners, [back, onward], rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(errors, apart, rtol=1e-6, atol=1e-13)
    np.testing.assert_array_equal(*streams)
