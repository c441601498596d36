"""Maxwell molecules: collisions, twins of both engines, what is refused, sums of samples."""

import functools
import itertools
import math

import ancestral_twins
import maxwell_twins
import numba
import numpy as np
import pytest
import test_twins
from law.algorithms import own_parameters

from kacsim import maxwell, variates
from kacsim.cases import make_case
from kacsim.jobs import sampling
from kacsim.kac import tape
from kacsim.kac.samplers import ENGINES
from kacsim.maxwell import draws, model
from kacsim.maxwell.samplers import MAXWELL
from kacsim.statistics import histogram
from kacsim.streams import new_stream

# (particles, time, steps, draws)
SHAPES = [(2, 1.7, 10, 100), (3, 0.3, 2, 700), (7, 1.7, 2, 100), (50, 1.7, 10, 20)]
ENSEMBLE = [[0.3, -1.7, 0.1], [2.9, 1e-8, -2.0], [41.0, 0.5, 0.0], [-0.7, 1.1, 3.0]]


@pytest.fixture
def stream(seed):
    return new_stream(seed, "test_maxwell")


def test_a_collision_conserves_momentum_and_energy(stream):
    """To a few units of the last place of the largest speed; nobody else is touched."""
    v = np.array(ENSEMBLE)
    for i, j in itertools.islice(itertools.cycle([(0, 1), (3, 2), (1, 3)]), 300):
        before = v.copy()
        model.collide(v, i, j, stream)
        np.testing.assert_allclose(v[i] + v[j], before[i] + before[j], atol=4e-14)
        energy = (before[[i, j]] ** 2).sum()
        assert (v[[i, j]] ** 2).sum() == pytest.approx(energy, rel=2e-15 * 8)
        assert not np.allclose(v[i], before[i])
        rest = [k for k in range(4) if k not in (i, j)]
        np.testing.assert_array_equal(v[rest], before[rest])


def test_deflect_is_the_first_half_of_collide(stream):
    v, new = np.array(ENSEMBLE), np.full((3, 3), 7.0)
    model.deflect(new, 1, v, 3, 0, stream.copy())
    np.testing.assert_array_equal(v, ENSEMBLE)
    in_place = v.copy()
    model.deflect(in_place, 3, in_place, 3, 0, stream.copy())
    model.collide(v, 3, 0, stream)
    np.testing.assert_array_equal(new, [[7.0] * 3, v[3], [7.0] * 3])
    np.testing.assert_array_equal(in_place, [*ENSEMBLE[:3], v[3]])


def test_copies_are_of_one_velocity():
    v, new = np.array(ENSEMBLE), np.zeros((2, 3))
    model.copy(new, 1, v, 2)
    np.testing.assert_array_equal(new, [[0.0] * 3, ENSEMBLE[2]])


@numba.njit
def bulk(x, y, z, n, stream):
    variates.directions(x, y, z, n, stream)


@pytest.mark.parametrize("n", [0, 1, 255, 700])
@pytest.mark.parametrize("taken", [0, 200])
def test_directions_are_those_drawn_one_at_a_time(taken, n, seed):
    """Heights first, then angles; what is beyond n is left alone."""
    first, second = (new_stream(seed, "bulk", taken) for _ in range(2))
    for _ in range(taken):
        variates.uniform(first), variates.uniform(second)
    found = np.full((3, n + 2), 5.0)
    bulk(*found, n, first)
    wanted = np.array(maxwell_twins.points(n, second)).reshape(n, 3)
    np.testing.assert_allclose(found[:, :n].T, wanted, rtol=1e-14, atol=1e-15)
    np.testing.assert_allclose((found[:, :n] ** 2).sum(axis=0), 1.0, atol=1e-15)
    assert (found[:, n:] == 5.0).all()
    np.testing.assert_array_equal(first, second)


def bound(algorithm, engine, shape):
    """Return (kernel, arguments)."""
    n, time, steps, _ = shape
    given = {"algorithm": algorithm, "engine": engine, "n_particles": n, "time": time}
    given |= own_parameters(algorithm, time, steps)
    assert MAXWELL.problems(MAXWELL.complete(given)) == []
    return draws.kernel_of(given)


def assert_same_draws(kernel, arguments, rows, n_draws, key):
    """Compare velocities, own collisions, simulated collisions and the stream's final state."""
    streams = new_stream(*key), new_stream(*key)
    velocities, own = np.empty((n_draws, 3)), np.empty(n_draws, np.int64)
    simulated = kernel(velocities, own, *arguments, streams[0])
    wanted, wanted_own, wanted_simulated = zip(*rows(streams[1]), strict=True)
    np.testing.assert_allclose(velocities, wanted, rtol=1e-12, atol=1e-12)
    np.testing.assert_array_equal(own, wanted_own)
    assert simulated == sum(wanted_simulated)
    np.testing.assert_array_equal(*streams)


@pytest.mark.parametrize("shape", SHAPES, ids=str)
@pytest.mark.parametrize("algorithm", maxwell.ALGORITHMS)
def test_forward_kernel_gives_the_twins_draws(algorithm, shape, seed):
    kernel, arguments = bound(algorithm, "forward", shape)
    twin = functools.partial(test_twins.FORWARD[algorithm], law=maxwell_twins.Forward)
    rows = functools.partial(test_twins.forward_rows, twin, arguments, shape[3])
    assert_same_draws(kernel, arguments, rows, shape[3], (seed, f"forward {algorithm}"))


@pytest.mark.parametrize("shape", SHAPES, ids=str)
@pytest.mark.parametrize("algorithm", maxwell.ALGORITHMS)
def test_ancestral_kernel_gives_the_twins_draws(algorithm, shape, seed, monkeypatch):
    """On a tape, to begin with, that is too small for most shapes."""
    monkeypatch.setattr(tape, "LEAST", 4 * tape.EVENTS)
    kernel, arguments = bound(algorithm, "ancestral", shape)
    twin = getattr(ancestral_twins, algorithm)

    def rows(stream):
        return ancestral_twins.draws(twin, arguments, shape[3], stream, maxwell_twins.Ancestral)[0]

    assert_same_draws(kernel, arguments, rows, shape[3], (seed, f"ancestral {algorithm}"))


def test_velocities_have_three_components_and_the_same_bits_each_time():
    given = {"n_particles": 10**9, "time": 2.0, "n_draws": 700}
    v = maxwell.draw("bird", seed=3, **given)
    assert v.shape == (700, 3)
    np.testing.assert_array_equal(v, maxwell.draw("bird", seed=3, **given))
    assert not np.isin(v, maxwell.draw("bird", seed=4, **given)).any()
    assert len(np.unique(v)) == v.size


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"algorithm": "birds"}, "algorithm = 'birds': "),
        ({"n_particles": 1}, "n_particles = 1: "),
        ({"n_particles": math.inf}, "n_particles = inf: infinity needs ancestral poisson"),
        ({"n_particles": 10**9, "engine": "forward"}, "n_particles = 1000000000: must be at most"),
        ({"time": 0.0}, "time = 0"),
        ({"n_particles": 10**9, "time": 60.0}, "time = 60.0: must be earlier"),
        ({"engine": "backward"}, "engine = 'backward': "),
        ({"time_step": 0.5}, "time_step = 0.5: bird has no such parameter"),
        ({"algorithm": "nanbu_sequential"}, "time_step = None: "),
        ({"algorithm": "nanbu_sequential", "time_step": 0.3}, "time_step = 0.3: must divide"),
        ({"algorithm": "nanbu_sequential", "time_step": 2.0}, "collision_rate [*] time_step <= 1"),
        ({"n_draws": 0}, "n_draws = 0: "),
        ({"seed": -1}, "seed = -1: "),
    ],
    ids=str,
)
def test_what_cannot_be_drawn_is_refused(changed, message):
    given = {"algorithm": "bird", "n_particles": 7, "time": 2.0, "n_draws": 3, "seed": 1} | changed
    with pytest.raises(ValueError, match=message):
        maxwell.draw(given.pop("algorithm"), **given)


@pytest.mark.parametrize("engine", ENGINES)
def test_sums_are_those_of_the_draws(engine):
    """Two replicates of more draws than a call of the kernel makes, drawn again."""
    size = {"n_draws": 9000, "n_replicates": 2, "seed": 5}
    given = {"algorithm": "bird", "engine": engine, "n_particles": 7, "time": 1.3}
    case = make_case("maxwell", **given, keep_above=3.5, **size)
    found = {name: values for name, (_, values, _) in sampling.run(case).items()}
    kernel, arguments = draws.kernel_of(case.parameters)
    kept = []
    for row in range(2):
        stream, parts = new_stream(5, case.id, row), []
        for n in (8192, 808):
            v, own = np.empty((n, 3)), np.empty(n, np.int64)
            collisions = kernel(v, own, *arguments, stream)
            parts.append((v, own, collisions))
        v, own = np.concatenate([p[0] for p in parts]), np.concatenate([p[1] for p in parts])
        speed = np.sqrt((v**2).sum(axis=1))
        moments = [(speed**k).mean() for k in (2, 4, 6, 8)]
        np.testing.assert_allclose(found["moment"][row], moments, rtol=1e-12)
        assert found["square_x"][row] == pytest.approx((v[:, 0] ** 2).mean(), rel=1e-12)
        edges = np.r_[-np.inf, histogram.fine_edges(), np.inf]
        np.testing.assert_array_equal(found["counts"][row], np.histogram(speed, edges)[0])
        assert found["collisions"][row] == sum(p[2] for p in parts) / 9000
        assert found["own_collisions"][row] == own.mean()
        assert found["own_variance"][row] == pytest.approx(own.var(), rel=1e-12)
        kept += list(speed[speed > 3.5])
    np.testing.assert_allclose(found["kept_speed"], kept, rtol=1e-14)
