"""Kernels of the chapter against slow plain twins on the same stream; the streaming."""

import math

import numpy as np
import pytest

from kacsim.cases import make_case
from kacsim.jobs import sampling
from kacsim.kernels import sources
from kacsim.streams import new_stream, next_bits
from kacsim.techniques import (
    exact,
    identity,
    injection,
    integration,
    inverse_transform,
    model,
    pairs,
    particles,
    rejection,
)
from kacsim.techniques import sampling as streaming
from kacsim.techniques.constants import SUPPORT
from kacsim.variates import uniform

SIZE = {"n_draws": streaming.CHUNK + 700, "n_replicates": 3, "seed": 5}


def plain_uniforms(stream):
    """Yield the uniforms of a stream, advanced from Python."""
    while True:
        yield uniform.py_func(stream)


@pytest.fixture(autouse=True)
def quiet():
    with np.errstate(over="ignore"):
        yield


def test_table_twin():
    table = inverse_transform.law_table("kac_initial", 7)
    values, u = np.empty(200), plain_uniforms(new_stream(1, "a"))
    last = inverse_transform.through_table(values, table, new_stream(1, "a"))
    places = np.array([7 * next(u) for _ in range(200)])
    np.testing.assert_allclose(values, np.interp(places, np.arange(8), table), rtol=1e-12)
    assert last == (places >= 6).sum()


def test_nodes_of_a_table_are_quantiles():
    for law in ("exponential", "ramp", "triangle", "kac_initial"):
        table = inverse_transform.law_table(law, 9)
        assert (table[0], table[-1]) == SUPPORT[law]
        u = exact.CUMULATIVES[law](table)
        np.testing.assert_allclose(u, u[0] + (u[-1] - u[0]) * np.arange(10) / 9, atol=1e-12)


@pytest.mark.parametrize("envelope", ["constant", "closer"])
def test_rejection_twin(envelope):
    arguments = rejection.arguments("kac_initial", envelope)
    values, u = np.empty(60), plain_uniforms(new_stream(2, "b"))
    trials = rejection.draw(values, *arguments, new_stream(2, "b"))
    wanted, many = [], 0
    while len(wanted) < 60:
        many += 1
        first, second = next(u), next(u)
        if envelope == "constant":
            v, height = -5.0 + 10.0 * first, exact.TOPS["kac_initial"]
        else:
            w = 2.0 * first - 1.0
            v = math.copysign(math.sqrt(-1.5 * math.log(1.0 - abs(w))), w)
            height = float(exact.closer_envelope(v))
        if second * height < exact.DENSITIES["kac_initial"](v):
            wanted.append(v)
    np.testing.assert_allclose(values, wanted, rtol=1e-9)
    assert trials == many


def test_the_closer_envelope_is_above_f0_and_touches_it():
    v = np.linspace(0.01, 6.0, 10_001)
    ratio = exact.DENSITIES["kac_initial"](v) / exact.closer_envelope(v)
    assert ratio.max() == pytest.approx(1.0, abs=1e-6)
    areas = [exact.CLOSER_TOP / exact.NARROW]
    for b in (0.6, 0.73):
        top = 2 / math.sqrt(math.pi) * math.exp(-0.5) / math.sqrt(2 * (1 - b))
        areas.append(top / b)
    assert areas[0] < min(areas[1:])


def test_poisson_number_is_the_inverse_of_its_cumulative_function():
    from scipy import stats

    for mean in (0.3, 4.7, 320.0):
        stream, u = new_stream(3, "c"), plain_uniforms(new_stream(3, "c"))
        for _ in range(20):
            found = injection.poisson_number(mean, stream)
            assert found == stats.poisson.ppf(np.nextafter(next(u), 1.0), mean)


def test_selection_twin():
    ranges = np.array([0.0, 0.4, 0.4, 1.7, 2.0])
    indices, u = np.empty(300, np.int64), plain_uniforms(new_stream(4, "d"))
    particles.select(indices, ranges, new_stream(4, "d"))
    wanted = np.searchsorted(ranges, [2.0 * next(u) for _ in range(300)], side="right") - 1
    np.testing.assert_array_equal(indices, wanted)
    assert 1 not in indices


def test_points_in_a_sphere_twin():
    counts, u = np.empty(3, np.int64), plain_uniforms(new_stream(5, "e"))
    integration.count_good(counts, np.array([5, 60, 200]), 3, new_stream(5, "e"))
    points = np.array([[next(u) for _ in range(3)] for _ in range(200)])
    inside = ((points**2).sum(axis=1) <= 1.0).cumsum()
    np.testing.assert_array_equal(counts, inside[[4, 59, 199]])


def test_entry_into_the_cuboid_twin():
    """Paths in small steps from outside: the face that they cross first, or none."""
    rng, half = np.random.default_rng(3), np.array([1.1, 1.7, 0.6])
    faces = []
    for _ in range(800):
        start, velocity = rng.uniform(-3, 3, 3), rng.normal(0, 4, 3)
        path = start + np.linspace(0, 0.5, 4001)[:, None] * velocity
        inside = (np.abs(path) <= half).all(axis=1)
        moved = start.copy()
        face = injection.entry(moved, velocity, half, 0.5)
        faces.append(face)
        if inside[0] or not inside.any():
            assert face == -1 or not inside.any()
            continue
        np.testing.assert_allclose(moved, path[np.argmax(inside)], atol=1e-2)
        assert abs(moved[face // 2]) == pytest.approx(half[face // 2])
        assert np.sign(moved[face // 2]) == (1 if face % 2 else -1)
    assert {0, 1, 2, 3, 4, 5, -1} == set(faces)


def test_the_identity_is_compiled_again_when_its_variates_change():
    definitions, _ = sources.closure(frozenset([("kacsim.techniques.identity", "draw")]))
    assert ("kacsim.variates", "half_normal") in definitions


def test_uniforms_are_counted_exactly():
    before = new_stream(6, "f")
    after = before.copy()
    for _ in range(137):
        next_bits.py_func(after)
    assert model.uniforms_between(before, after) == 137


def test_sums_of_a_streamed_law_are_numpys():
    case = make_case("identity", **SIZE)
    found = {name: np.asarray(v[1]) for name, v in sampling.run(case).items()}
    for k in range(3):
        values, stream = np.empty(SIZE["n_draws"]), new_stream(5, case.id, k)
        identity.draw(values, stream)
        u = exact.CUMULATIVES["kac_initial"](values)
        cells = np.bincount((u * streaming.CELLS).astype(int), minlength=streaming.CELLS)
        assert np.abs(found["counts"][k] - cells).sum() <= 4  # rounding at an edge
        means = [np.mean(values**power) for power in streaming.POWERS]
        np.testing.assert_allclose(found["moment"][k], means, rtol=1e-9)
        assert 3.0 < found["uniforms"][k] < 3.2
    assert len({tuple(row) for row in found["counts"]}) == 3


def test_numbers_of_injected_particles_add_up():
    gas = {"density": 2.0, "temperature": 1.7, "drift": [0.4, 0.0, -0.3], "step": 0.2}
    for sampler in ("injection", "outer_gas"):
        case = make_case(sampler, **gas, half_width=[1.0, 1.5, 0.7], **(SIZE | {"n_draws": 300}))
        found = {name: np.asarray(v[1]) for name, v in sampling.run(case).items()}
        many = (found["steps"] * np.arange(streaming.MOST + 1)).sum(axis=-1)
        np.testing.assert_array_equal(many, found["sum"][..., 0])
        np.testing.assert_array_equal(found["speeds"].sum(axis=-1), many)
        assert (found["steps"].sum(axis=-1) == 300).all()
        assert found["kept"].shape[0] == min(streaming.KEPT, many.sum())


@pytest.mark.parametrize("way", ["flight", "steps", "derivative"])
def test_pairs_are_counted_and_summed(way):
    """The streaming of correlated pairs, against its kernel run in one go."""
    case = make_case("entering_pairs", way=way, correlation=-0.3, **SIZE)
    found = sampling.run(case)
    edges = found["edge"][1]
    for replicate in range(3):
        drawn = np.empty((case.n_draws, 2))
        stream = new_stream(5, case.id, replicate)
        getattr(pairs, f"by_{way}")(drawn, -0.3, stream)
        np.testing.assert_allclose(found["mean"][1][replicate], drawn.mean(axis=0))
        np.testing.assert_allclose(found["product"][1][replicate], drawn.prod(axis=1).mean())
        counts, _ = np.histogram(drawn[:, 1], np.r_[-np.inf, edges, np.inf])
        np.testing.assert_array_equal(found["counts"][1][replicate], counts)


def test_circles_by_the_sampler():
    case = make_case("circle_lattice", smallest=2, largest=9, n_edges=4, **SIZE)
    found = sampling.run(case)
    np.testing.assert_array_equal(found["edge"][1], [2, 3, 5, 9])
    known = [integration.lattice_count(2, int(edge)) for edge in found["edge"][1]]
    np.testing.assert_array_equal(found["inside"][1], known)
