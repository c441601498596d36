"""Streaming a case: counts, moments and kept values against numpy, replicates on streams of theirs.

No z tests: kernels give the values, numpy the sums.
"""

import math

import numpy as np
import pytest

from kacsim.cases import make_case
from kacsim.jobs import sampling
from kacsim.kac import draws, perfect, perfect_blocks, replicates
from kacsim.kac import sampling as kac_sampling
from kacsim.statistics import histogram
from kacsim.streams import new_stream

SIZE = {"n_draws": replicates.CHUNK + 700, "n_replicates": 3, "seed": 5}


def kac_case(**others):
    parameters = {"algorithm": "bird", "engine": "ancestral", "n_particles": 7, "time": 1.7}
    return make_case("kac", **(parameters | others), **SIZE)


def redrawn(case):
    """Return (velocities, own)[replicate, draw] of the case's streams, in one go each."""
    kernel, arguments = draws.kernel_of(case.parameters)
    velocities = np.empty((case.n_replicates, case.n_draws))
    own = np.empty(velocities.shape, np.int64)
    for k in range(case.n_replicates):
        kernel(velocities[k], own[k], *arguments, new_stream(case.seed, case.id, k))
    return velocities, own


def values_of(samples):
    return {name: np.asarray(variable[1]) for name, variable in samples.items()}


def test_sums_are_numpys():
    case = kac_case()
    found, (velocities, own) = values_of(sampling.run(case)), redrawn(case)
    edges = np.r_[-np.inf, histogram.fine_edges(), np.inf]
    for k, row in enumerate(velocities):
        np.testing.assert_array_equal(found["counts"][k], np.histogram(row, edges)[0])
        for order, moment in zip(found["order"], found["moment"][k], strict=True):
            assert moment == pytest.approx(np.mean(row**order), rel=1e-12)
    np.testing.assert_allclose(found["own_collisions"], own.mean(axis=1))
    np.testing.assert_allclose(found["own_variance"], own.var(axis=1))
    assert len({tuple(row) for row in found["counts"]}) == 3


@pytest.mark.parametrize("threshold", [None, 1.35])
def test_kept_velocities_are_the_first_above_the_threshold(threshold, monkeypatch):
    monkeypatch.setattr(replicates, "KEPT", 900)
    case = kac_case(keep_above=threshold)
    velocities = redrawn(case)[0].ravel()
    above = velocities[velocities > (-math.inf if threshold is None else threshold)]
    np.testing.assert_array_equal(values_of(sampling.run(case))["kept_velocity"], above[:900])


@pytest.mark.parametrize("value", [-math.inf, -1e300, -8.0001, 7.99999, 8.0, 1e300, math.inf])
def test_extreme_values_are_counted_in_the_tails(value):
    counts, sums, kept = np.zeros(322, np.int64), np.zeros(4), np.empty(0)
    replicates.accumulate(np.array([value]), counts, sums, kept, 0, 0.0)
    place = 0 if value < -8.0 else 321 if value >= 8.0 else 320
    assert (counts.sum(), counts[place]) == (1, 1)


def test_progress_counts_draws():
    told = []
    sampling.run(kac_case(), told.append)
    assert told[0] == replicates.CHUNK
    assert told[-1] == SIZE["n_draws"] * SIZE["n_replicates"]
    assert told == sorted(told)


def test_forward_collisions_of_bird_are_all_simulated():
    found = values_of(sampling.run(kac_case(engine="forward")))
    np.testing.assert_array_equal(found["collisions"], math.ceil(math.sqrt(math.pi) / 4 * 7 * 1.7))


def test_coupling_times_are_those_of_the_kernel():
    case = make_case("kac_equilibrium", n_particles=3, tolerance=0.01, **SIZE)
    found = values_of(sampling.run(case))
    velocities, times = np.empty(SIZE["n_draws"]), np.empty((3, SIZE["n_draws"]), np.int64)
    for k in range(3):
        stream = new_stream(case.seed, case.id, k)
        for part in (slice(0, replicates.CHUNK), slice(replicates.CHUNK, None)):
            perfect.couple(velocities[part], times[k, part], 3, 4.5, 0.01, stream)
    np.testing.assert_array_equal(found["coupling_time"], times.ravel())
    np.testing.assert_allclose(found["coupling_mean"], times.mean(axis=1))
    np.testing.assert_allclose(found["coupling_variance"], times.var(axis=1))
    np.testing.assert_array_equal(found["coupling_min"], times.min(axis=1))
    np.testing.assert_array_equal(found["coupling_max"], times.max(axis=1))


@pytest.mark.parametrize("energy", [None, 2.3])
def test_perfect_draws_are_counted_over_their_range_and_beside_later_ones(energy):
    """Each start of the kernel is a chain of its own: products are of draws of one start."""
    case = make_case("kac_perfect", n_particles=3, energy=energy, block=4, **SIZE)
    found, total = values_of(sampling.run(case)), 4.5 if energy is None else energy
    edges = math.sqrt(total) * np.linspace(-1.0, 1.0, 8193)
    for k in range(3):
        stream, blocks = new_stream(case.seed, case.id, k), 0
        parts = [np.empty(replicates.CHUNK), np.empty(700)]
        for part in parts:
            blocks += perfect_blocks.draw_beginnings(part, 3, total, 4, stream)
        counts = np.histogram(np.concatenate(parts), edges)[0]
        np.testing.assert_array_equal(found["level_counts"][k], counts)
        assert found["blocks"][k] == blocks / SIZE["n_draws"]
        for lag in range(1, 5):
            x = [part**2 / total - 1.0 / 3.0 for part in parts]
            products = np.concatenate([part[lag:] * part[:-lag] for part in x])
            assert found["lag_product"][k, lag - 1] == pytest.approx(products.mean())
        square = np.concatenate(parts) ** 2
        assert found["moment"][k, 1] == pytest.approx((square**2).mean())


@pytest.mark.parametrize("value", [-1.0, -0.99999, 0.0, 0.99999, 1.0])
def test_levels_at_the_ends_of_the_range(value):
    levels, products = np.zeros(8192, np.int64), np.zeros(4)
    kac_sampling.count_levels(np.array([3.0 * value]), 9.0, 5, levels, products)
    place = {-1.0: 0, -0.99999: 0, 0.0: 4096}.get(value, 8191)
    assert (levels.sum(), levels[place]) == (1, 1)
    assert (products == 0.0).all()


def test_recorded_corners_are_coupled_runs():
    """D is below the tolerance at the end, never grows, and stays at a repeated pair."""
    size = {"n_draws": 20, "n_replicates": 1, "seed": 5}
    found = values_of(sampling.run(make_case("kac_corners", n_particles=4, tolerance=1e-3, **size)))
    corners, n_repeated = found["corner"], 0
    np.testing.assert_allclose((corners**2).sum(axis=2), 6.0, rtol=1e-7)
    np.testing.assert_array_equal(corners[0], math.sqrt(6.0) * np.eye(4))
    for k, row in enumerate(found["diameter"]):
        path = row[np.isfinite(row)]
        assert path[-1] < 1e-3
        assert np.diff(path).max() <= 1e-9
        repeated = found["same_pair"][k, 1 : path.size].astype(bool)
        n_repeated += repeated.sum()
        np.testing.assert_allclose(path[1:][repeated], path[:-1][repeated], rtol=1e-6)
    assert n_repeated > 0


def test_recorded_corners_begin_at_the_coupling_time():
    """The first run's inputs take D below the tolerance; without the earliest step they do not."""
    size = {"n_draws": 1, "n_replicates": 1, "seed": 5}
    found = values_of(sampling.run(make_case("kac_corners", n_particles=4, tolerance=1e-3, **size)))
    inputs = [found[name] for name in ("first", "second", "squared_sine")]
    ends = [perfect.trajectory(4, 6.0, *(x[k:] for x in inputs))[-1] for k in (0, 1)]
    np.testing.assert_array_equal(ends[0], found["corner"][-1])
    assert perfect.diameter(ends[0]) < 1e-3 <= perfect.diameter(ends[1])
