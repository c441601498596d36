"""Every kernel gives the same values, draw by draw, as its plain-Python twin.

No statistics. Values agree to 1e-12, since a twin rounds elsewhere; numbers of collisions and the
final state of the stream exactly.
"""

import functools
import itertools
import math

import ancestral_twins
import coupling_twins
import forward_twins
import numpy as np
import pytest
from law.algorithms import own_parameters

from kacsim.kac import draws, forward, perfect, perfect_blocks, readings, tape
from kacsim.kac.constants import RULES, WALKS
from kacsim.kac.samplers import ALGORITHMS, KAC
from kacsim.kernels.lookup import named
from kacsim.streams import new_stream

FORWARD = {
    "nanbu_sequential": functools.partial(forward_twins.nanbu, synchronous=False),
    "nanbu_synchronous": functools.partial(forward_twins.nanbu, synchronous=True),
    "nanbu_babovsky": forward_twins.nanbu_babovsky,
    "bird": forward_twins.bird,
    "poisson": forward_twins.poisson,
    "poisson_printed": forward_twins.poisson,
}
RATE = 0.9
# (particles, time, steps, draws): rare and frequent collisions, more draws than a batch has, steps
# in which all particles collide
SHAPES = [
    (2, 1.7, 10, 200),
    (2, 10.0, 9, 100),
    (3, 1.7, 5, 200),
    (3, 0.3, 2, 1100),
    (6, 9.999999, 9, 40),
    (7, 1.7, 2, 200),
    (7, 1.7, 170, 100),
    (50, 1.7, 10, 40),
    (50, 20.0, 40, 4),
]


def parameters_of(algorithm, engine, shape):
    n, time, steps, _ = shape
    parameters = {
        "algorithm": algorithm,
        "engine": engine,
        "n_particles": n,
        "time": time,
        "collision_rate": RATE,
        **own_parameters(algorithm, time, steps),
    }
    assert KAC.problems(KAC.complete(parameters)) == []
    return parameters


def forward_rows(twin, arguments, n_draws, stream):
    return list(itertools.islice(twin(*arguments, stream), n_draws))


def assert_same_draws(kernel, arguments, rows_of, n_draws, key):
    """Compare values, own collisions, simulated collisions and the stream's final state."""
    streams = new_stream(*key), new_stream(*key)
    velocities, own = np.empty(n_draws), np.empty(n_draws, np.int64)
    simulated = kernel(velocities, own, *arguments, streams[0])
    wanted, wanted_own, wanted_simulated = zip(*rows_of(n_draws, streams[1]), strict=True)
    np.testing.assert_allclose(velocities, wanted, rtol=1e-12, atol=1e-15)
    np.testing.assert_array_equal(own, wanted_own)
    assert simulated == sum(wanted_simulated)
    np.testing.assert_array_equal(*streams)


def assert_same_ancestral_draws(algorithm, arguments, n_draws, seed, history=None):
    """Compare a kernel with its twin; return (capacity, used) of tapes that were too small."""
    kernel, refused = named("kacsim.kac", algorithm, "ancestral"), []

    def rows_of(n_draws, stream):
        twin = history or getattr(ancestral_twins, algorithm)
        rows, too_small = ancestral_twins.draws(twin, arguments, n_draws, stream)
        refused.extend(too_small)
        return rows

    assert_same_draws(kernel, arguments, rows_of, n_draws, (seed, f"twin {algorithm}"))
    return refused


def arguments_of(algorithm, shape):
    return draws.kernel_of(parameters_of(algorithm, "ancestral", shape))[1]


@pytest.mark.parametrize("shape", SHAPES, ids=str)
@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_forward_kernel_gives_the_twins_draws(algorithm, shape, seed):
    kernel, arguments = draws.kernel_of(parameters_of(algorithm, "forward", shape))
    rows_of = functools.partial(forward_rows, FORWARD[algorithm], arguments)
    n_draws = min(shape[3], 200)
    assert_same_draws(kernel, arguments, rows_of, n_draws, (seed, f"twin forward {algorithm}"))


@pytest.mark.parametrize("shape", SHAPES, ids=str)
@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_ancestral_kernel_gives_the_twins_draws(algorithm, shape, seed):
    assert_same_ancestral_draws(algorithm, arguments_of(algorithm, shape), shape[3], seed)


@pytest.mark.parametrize("shape", [(3, 20.0, 40, 20), (300, 3.5, 7, 60)], ids=str)
@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_a_tape_that_is_too_small_is_enlarged(algorithm, shape, seed, monkeypatch):
    """From a tape of 32 collisions and one ancestor on."""
    monkeypatch.setattr(tape, "LEAST", 2 * tape.EVENTS)
    arguments = arguments_of(algorithm, shape)
    assert assert_same_ancestral_draws(algorithm, arguments, shape[3], seed)


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_a_tape_that_overflows_in_the_middle_of_a_batch(algorithm, seed, monkeypatch):
    """Two histories of mean length fill it, so that half of the second ones do not fit."""
    shape = 50, 30.0, 60, 60
    arguments, few = arguments_of(algorithm, shape), np.empty(30)
    collisions = named("kacsim.kac", algorithm, "ancestral")(
        few, np.empty(30, np.int64), *arguments, new_stream(seed, "length")
    )
    monkeypatch.setattr(tape, "LEAST", 2 * collisions // 30)
    refused = assert_same_ancestral_draws(algorithm, arguments, shape[3], seed)
    assert [used for _, used in refused if used > 0]


# (particles, time, steps, draws): more collisions than the first tape holds, and more ancestors
LONG = [(50, 200.0, 400, 3), (1000, 13.0, 26, 4)]


@pytest.mark.parametrize("shape", LONG, ids=str)
@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_long_histories(algorithm, shape, seed):
    refused = assert_same_ancestral_draws(algorithm, arguments_of(algorithm, shape), shape[3], seed)
    assert refused[0][0] == tape.LEAST


INFINITE = {"n_particles": math.inf, "time": 1.7, "collision_rate": RATE}


@pytest.mark.parametrize(("time", "n_draws", "is_long"), [(1.7, 600, False), (7.0, 12, True)])
def test_infinitely_many_particles(time, n_draws, is_long, seed):
    parameters = {"algorithm": "poisson", "engine": "ancestral"} | INFINITE | {"time": time}
    arguments = draws.kernel_of(parameters)[1]
    assert bool(assert_same_ancestral_draws("poisson", arguments, n_draws, seed)) == is_long


def test_arguments_of_infinitely_many_particles():
    """Two of the at most 1e6 ancestors must never meet, and the ways to touch one be 64 bits."""
    _, (n, mean, pair_rate) = draws.kernel_of(
        {"algorithm": "poisson", "engine": "ancestral"} | INFINITE
    )
    assert (mean, pair_rate) == (pytest.approx(1.53), 0.0)
    assert 10**18 < n < 2**62


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_forward_draws_do_not_depend_on_the_call(algorithm, seed):
    """One call for ten draws and ten calls give the same values.

    Nanbu-Babovsky's shuffle goes on from the last draw's order: there the first draw only.
    """
    kernel, arguments = draws.kernel_of(parameters_of(algorithm, "forward", (50, 30.0, 60, 0)))
    n_draws = 1 if algorithm == "nanbu_babovsky" else 10
    streams = new_stream(seed, "batch"), new_stream(seed, "batch")
    (together, single), own = np.empty((2, n_draws)), np.empty(n_draws, np.int64)
    kernel(together, own, *arguments, streams[0])
    for k in range(n_draws):
        kernel(single[k : k + 1], own[k : k + 1], *arguments, streams[1])
    np.testing.assert_array_equal(together, single)


def test_the_other_readings_twin_gives_other_draws(seed):
    """Negative control of the comparison itself."""
    shape = (7, 1.7, 2, 200)
    kernel, arguments = draws.kernel_of(parameters_of("nanbu_synchronous", "forward", shape))
    rows_of = functools.partial(forward_rows, FORWARD["nanbu_sequential"], arguments)
    with pytest.raises(AssertionError, match=r"Not equal to tolerance|not equal"):
        assert_same_draws(kernel, arguments, rows_of, 200, (seed, "other reading"))
    arguments = arguments_of("nanbu_sequential", shape)
    with pytest.raises(AssertionError, match=r"Not equal to tolerance|not equal"):
        assert_same_ancestral_draws(
            "nanbu_sequential", arguments, 200, seed, ancestral_twins.nanbu_synchronous
        )


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
        wanted, wanted_time = coupling_twins.couple(n, energy, tolerance, new_stream(*key))
        assert (time[0], abs(velocity[0])) == (wanted_time, pytest.approx(wanted, rel=1e-12))


@pytest.mark.parametrize(
    ("n", "block", "n_draws"),
    [(2, 0, 50), (2, 3, 20), (3, 1, 200), (3, 2, 200), (4, 5, 100), (7, 60, 40), (6, 1030, 3)],
)
def test_perfect_draws_are_the_twins(n, block, n_draws, seed):
    """Short blocks, of which many fail at every step of the sweep, and such as fill a lot."""
    energy, key = 1.3 * n, (seed, "twin perfect")
    velocities, streams = np.empty(n_draws), (new_stream(*key), new_stream(*key))
    blocks = perfect_blocks.draw_beginnings(velocities, n, energy, block, streams[0])
    twin = coupling_twins.perfect(n, energy, block, streams[1])
    wanted, numbers = zip(*itertools.islice(twin, n_draws), strict=True)
    np.testing.assert_allclose(velocities, wanted, rtol=1e-9, atol=1e-9)
    assert blocks == numbers[-1]
    np.testing.assert_array_equal(*streams)


@pytest.mark.parametrize("n", [2, 3, 6])
@pytest.mark.parametrize("walk", WALKS)
def test_stopping_times_are_the_twins(walk, n, seed):
    """Every rule at every tolerance; the kernel looks again only where a step changed a pair."""
    key, tolerance, n_draws = (seed, "twin readings"), [0.5, 0.1, 0.03, 1e-4], 30
    times = np.zeros((n_draws, len(RULES), len(tolerance)), np.int64)
    bound = readings.arguments(n_particles=n, walk=walk, tolerance=tolerance)
    streams = new_stream(*key), new_stream(*key)
    readings.stopping_times(times, *bound, streams[0])
    twin = coupling_twins.stopping_times(n, walk, tolerance, streams[1])
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
    twin = coupling_twins.couple_both_ways(n, energy, tolerance, streams[1])
    rows = list(itertools.islice(twin, size))
    back, onward, wanted, apart = (np.array(column) for column in zip(*rows, strict=True))
    np.testing.assert_array_equal(times, wanted)
    np.testing.assert_allclose(corners, [back, onward], rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(errors, apart, rtol=1e-6, atol=1e-13)
    np.testing.assert_array_equal(*streams)
