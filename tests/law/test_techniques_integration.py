"""Integration on lattices and with points, against volumes and areas in closed form."""

import math

import numpy as np
import pytest
from law import compare

from kacsim import techniques
from kacsim.cases import make_case
from kacsim.jobs.sampling import run
from kacsim.streams import new_stream
from kacsim.techniques import exact, integration


@pytest.mark.parametrize("dimension", [2, 4, 7])
def test_random_points_find_the_volume(dimension, seed):
    """3 z of a share; 1e6 points see 1 % of the volume in 7 dimensions and 0.2 % in 2.

    Mutant: one dimension less.
    """
    share, error = techniques.sphere_volume(dimension, compare.scaled(1_000_000), seed=seed)
    assert compare.ok((share - exact.ball_volume(dimension)) / error)
    assert compare.caught((share - exact.ball_volume(dimension - 1)) / error)


@pytest.mark.parametrize("generator", ["good", "exhausted", "congruential", "sobol"])
def test_errors_of_the_generators(generator, seed):
    """2 z: mean of 60 squared errors of 2**14 points in 4 dimensions, exact for random points.

    The bad generators have not run out yet; the congruential one is too even already, and so is the
    Sobol sequence: they are the mutants.
    """
    size = {"n_draws": 1, "n_replicates": compare.scaled(60), "seed": seed}
    case = make_case("sphere_points", generator=generator, dimension=[4], n_points=[2**14], **size)
    share = run(case)["inside"][1][0, :, 0] / 2**14
    squares = (share / exact.ball_volume(4) - 1.0) ** 2 * 2**14 / exact.point_error(4) ** 2
    z = (squares.mean() - 1.0) / math.sqrt(2.0 / squares.size)
    if generator == "sobol":
        assert squares.mean() < 0.4
    elif generator != "congruential":
        assert compare.ok(z)


@pytest.mark.parametrize("generator", ["exhausted", "congruential"])
def test_bad_generators_repeat_themselves(generator, seed):
    """No z: a second cycle adds what the first added, so that nothing is learned."""
    period = {"exhausted": integration.EXHAUSTED, "congruential": 4 * integration.PERIOD}[generator]
    points = np.array([period // 4, period // 2])
    counts = {}
    for name in (generator, "good"):
        counts[name] = np.empty(2, np.int64)
        getattr(integration, f"count_{name}")(counts[name], points, 4, new_stream(seed, "bad"))
    assert counts[generator][1] == 2 * counts[generator][0]
    assert counts["good"][1] != 2 * counts["good"][0]


@pytest.mark.parametrize(("dimension", "edge"), [(1, 5), (2, 9), (3, 10), (4, 7), (5, 4)])
def test_lattice_counts_every_point(dimension, edge):
    """No z: the convolution against points one by one, those on the sphere included."""
    odd = 2 * np.arange(1, edge + 1) - 1
    squares = np.stack(np.meshgrid(*[odd] * dimension)).reshape(dimension, -1) ** 2
    wanted = int((squares.sum(axis=0) <= 4 * edge**2).sum())
    assert techniques.lattice_count(dimension, edge) == wanted


def test_lattice_of_the_published_size():
    """No z: 10**8 points in 4 dimensions; S = sum of sigma(m) over odd m up to M**2 (Jacobi)."""
    m = np.arange(1, 10_001, 2)
    sigma = sum(int(d) * ((10_000 // d + 1) // 2) for d in m)
    assert techniques.lattice_count(4, 100) == sigma


@pytest.mark.parametrize("exponent", [0.3, 1.4])
def test_area_of_exercise_3(exponent, seed):
    """8 z: both ways, their mean and their mean square error, over 4000 streams.

    Mutant: the area of another exponent.
    """
    size = {"n_draws": 1, "n_replicates": compare.scaled(4000), "seed": seed}
    case = make_case("area", exponent=exponent, n_points=[50, 2000], **size)
    found = run(case)["estimate"][1]
    for k, way in enumerate(("hits", "heights")):
        values = found[k, :, 1]
        assert compare.ok(compare.of_mean(values, exact.area(exponent)))
        assert compare.caught(compare.of_mean(values, exact.area(exponent + 0.1)))
        squares = (values / exact.area(exponent) - 1.0) ** 2
        assert compare.ok(compare.of_mean(squares, exact.area_error(exponent, way) ** 2 / 2000))


def test_any_function(seed):
    """1 z: the integral of exp over [-1, 2]. Mutant: over [-1, 1.9]."""
    size = {"n_points": compare.scaled(300_000), "seed": seed}
    value, error = techniques.integrate(np.exp, -1.0, 2.0, **size)
    assert compare.ok((value - (math.exp(2) - math.exp(-1))) / error)
    assert compare.caught((value - (math.exp(1.9) - math.exp(-1))) / error)
