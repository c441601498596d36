"""Injection through faces: fluxes, numbers, positions and velocities, against closed forms."""

import functools
import math

import numpy as np
import pytest
from law import compare

from kacsim import techniques
from kacsim.cases import make_case
from kacsim.jobs.sampling import run
from kacsim.techniques import flux, pair_laws, particles
from kacsim.techniques.constants import FACES

BOX, TEMPERATURE, STEP = [1.1, 1.7, 0.6], 1.7, 0.2
DRIFTS = [(0.0, 0.0, 0.0), (0.9, -0.4, 0.0)]


@pytest.fixture(scope="module", params=DRIFTS, ids=str)
def injected(request):
    """Return a drift, and seed -> (number of steps, what has come in), kept."""

    def draw(seed):
        state = {"density": 2.3, "temperature": TEMPERATURE, "drift": request.param}
        size = {"n_steps": compare.scaled(40_000), "seed": seed}
        return size["n_steps"], techniques.inject(**state, half_width=BOX, step=STEP, **size)

    return request.param, compare.kept(draw)


def inward(drift, face):
    return (1.0 - 2.0 * (face % 2)) * drift[face // 2]


def test_numbers_are_poisson_with_the_flux(injected, seed):
    """Null: Poisson with F_j dt at every face. 24 z with both drifts.

    Statistics: chi-squared of the numbers per step, and the mean: 4e4 steps see 1.5 %. Mutants: the
    printed limits L_y twice at the faces normal to x, and the rate F_j.
    """
    drift, drawn = injected
    n_steps, (face, _, _, step) = drawn(seed)
    means = flux.face_rates(2.3, TEMPERATURE, drift, BOX) * STEP
    for j in range(len(FACES)):
        numbers = np.bincount(step[face == j], minlength=n_steps)
        k = np.arange(30)
        law = np.exp(k * math.log(means[j]) - means[j] - [math.lgamma(i + 1.0) for i in k])
        counts = np.bincount(np.minimum(numbers, 29), minlength=30)
        assert compare.ok(compare.of_counts(counts, law))
        spread = math.sqrt(means[j] / n_steps)
        assert compare.ok((numbers.mean() - means[j]) / spread)
        if j < 2:
            assert compare.caught((numbers.mean() - means[j] * BOX[1] / BOX[2]) / spread)
        assert compare.caught((numbers.mean() - means[j] / STEP) / spread)


def test_velocities_are_weighted_by_the_normal_one(injected, seed):
    """Null: v f(v) normal to the face, f tangential, positions uniform. 42 z with both drifts.

    Statistics: Kolmogorov-Smirnov and moments, three of them pooled over the faces. Mutants:
    velocities drawn from f restricted to inward ones, and from v f(v) without the drift.
    """
    drift, drawn = injected
    _, (face, position, velocity, _) = drawn(seed)
    rng = np.random.default_rng(5)
    pooled = []
    for j in range(len(FACES)):
        axis, sign = j // 2, 1.0 - 2.0 * (j % 2)
        own, place = velocity[face == j], position[face == j]
        normal = sign * own[:, axis]
        assert (normal > 0.0).all()
        np.testing.assert_array_equal(place[:, axis], -sign * BOX[axis])
        law = functools.partial(flux.cumulative, drift=inward(drift, j), temperature=TEMPERATURE)
        assert compare.ok(compare.of_distribution(normal, law))
        mean = flux.moment(1, inward(drift, j), TEMPERATURE)
        assert compare.ok(compare.of_mean(normal, mean))
        z = compare.of_mean(normal**2, flux.moment(2, inward(drift, j), TEMPERATURE))
        assert compare.ok(z)
        plain = rng.normal(inward(drift, j), math.sqrt(TEMPERATURE), 4 * normal.size)
        plain = plain[plain > 0.0]
        assert compare.caught(compare.of_distribution(plain, law))
        assert compare.caught(compare.of_mean(plain, mean))
        if drift[axis]:
            still = functools.partial(flux.cumulative, drift=0.0, temperature=TEMPERATURE)
            assert compare.caught(compare.of_distribution(normal, still))
        for k in {0, 1, 2} - {axis}:
            pooled.append((place[:, k] / BOX[k], (own[:, k] - drift[k]) / math.sqrt(TEMPERATURE)))
    places, thermal = (np.concatenate(part) for part in zip(*pooled, strict=True))
    assert np.abs(places).max() < 1.0
    assert compare.ok(compare.of_mean(places**2, 1.0 / 3.0))
    assert compare.ok(compare.of_mean(thermal**2, 1.0))
    assert compare.ok(compare.of_mean(places, 0.0))


@pytest.mark.parametrize("sampler", ["outer_gas", "injection"])
def test_the_gas_outside_gives_the_same(sampler, seed):
    """Null: straight flight of a gas that knows no fluxes, and the sampler of the injection.

    24 z: numbers and v_n at six faces. Mutant: the printed limits.
    """
    state = {"density": 2.3, "temperature": TEMPERATURE, "drift": list(DRIFTS[1])}
    size = {"n_draws": compare.scaled(20_000) // 4, "n_replicates": 4, "seed": seed}
    case = make_case(sampler, **state, half_width=BOX, step=STEP, **size)
    sums = run(case)["sum"][1].sum(axis=0)
    means = flux.face_rates(*state.values(), BOX) * STEP * 4 * size["n_draws"]
    for j in range(len(FACES)):
        count, first, square = sums[j, :3]
        assert compare.ok((count - means[j]) / math.sqrt(means[j]))
        speed = flux.moment(1, inward(DRIFTS[1], j), TEMPERATURE)
        spread = math.sqrt(square / count - (first / count) ** 2)
        assert compare.ok((first / count - speed) / spread * math.sqrt(count))
    assert compare.caught((sums[0, 0] - means[0] * BOX[1] / BOX[2]) / math.sqrt(means[0]))


@pytest.mark.parametrize("weighted", [False, True])
def test_particles_are_chosen_by_their_flux(weighted, seed):
    """Null: particle k with probability w_k max(0, n . v_k) over their sum. 4 z.

    Mutants: weights alone, as without the flux, and the flux without weights.
    """
    rng = np.random.default_rng(7)
    v, w = rng.normal(0.3, 1.3, (50, 3)), 0.5 + rng.random(50)
    normal = np.array([0.5, -1.2, 0.7])
    weights = w if weighted else None
    size = {"n_draws": compare.scaled(200_000), "seed": seed}
    chosen = techniques.inject_particles(v, normal=normal, weights=weights, **size)
    lengths = np.maximum(0.0, v @ normal) * (w if weighted else 1.0)
    counts = np.bincount(chosen, minlength=50)
    inside = lengths > 0.0
    assert counts[~inside].sum() == 0
    share = lengths[inside] / lengths.sum()
    assert compare.ok(compare.of_counts(counts[inside], share))
    speeds = (v @ normal)[chosen]
    mean = (share * (v @ normal)[inside]).sum()
    assert compare.ok(compare.of_mean(speeds, mean))
    flat = np.where(inside, w, 0.0)[inside]
    assert compare.caught(compare.of_counts(counts[inside], flat / flat.sum()))
    if weighted:
        bare = np.maximum(0.0, v @ normal)[inside]
        assert compare.caught(compare.of_counts(counts[inside], bare / bare.sum()))


@pytest.mark.parametrize("way", ["flight", "steps", "derivative"])
def test_pairs_that_are_correlated(way, seed):
    """Null: v f(v) normal to the face; along it the exact mean, or that of the printed steps. 6 z.

    1e6 pairs see 0.5 % of the exact mean along the face. Mutants: the other mean, and f(v) alone.
    """
    n = compare.scaled(1_000_000)
    size = {"n_draws": n // 10, "n_replicates": 10, "seed": seed}
    case = make_case("entering_pairs", way=way, correlation=0.7, **size)
    normal, along = run(case)["mean"][1].mean(axis=0)
    w = np.linspace(-8.0, 9.0, 1701)
    density, wrong = pair_laws.entering_density(w, 0.7), pair_laws.printed_mean(0.7)
    right = pair_laws.exact_mean(0.7)
    if way == "steps":
        density, right, wrong = pair_laws.printed_density(w, 0.7), wrong, right
    spread = math.sqrt(np.trapezoid(density * (w - right) ** 2, w) / n)
    assert compare.ok((along - right) / spread)
    assert compare.caught((along - wrong) / spread)
    spread = math.sqrt((2.0 - math.pi / 2.0) / n)
    assert compare.ok((normal - math.sqrt(math.pi / 2.0)) / spread)
    assert compare.caught((normal - math.sqrt(2.0 / math.pi)) / spread)


def test_the_real_index_range_adds_up():
    """No z: lengths of the ranges are weights times inward speeds."""
    v = np.array([[1.0, 0, 0], [-2.0, 0, 0], [0.5, 3.0, 0]])
    ranges = particles.index_range(v, [2.0, 5.0, 1.0], (1.0, 0.0, 0.0))
    np.testing.assert_allclose(ranges, [0.0, 2.0, 2.0, 2.5])


@pytest.mark.parametrize("drift", [-9.0, -1.3, -0.4, 0.0, 0.7, 5.0])
def test_closed_forms_are_integrals(drift):
    """No z: flux, moments and cumulative function against quadrature."""
    from scipy import integrate

    def f(v, power):
        return v**power * math.exp(-((v - drift) ** 2) / (2 * 1.7)) / math.sqrt(2 * math.pi * 1.7)

    low = [integrate.quad(f, 0, max(1.0, drift + 20), (k,), epsabs=0)[0] for k in range(4)]
    np.testing.assert_allclose(flux.half_moments(drift, 1.7, 1), low[:2], rtol=1e-7)
    if drift > -5.0:  # beyond, the recursion of the moments cancels
        assert flux.moment(2, drift, 1.7) == pytest.approx(low[3] / low[1], rel=1e-6)
        part = integrate.quad(f, 0, 1.2, (1,))[0] / low[1]
        assert flux.cumulative(1.2, drift, 1.7) == pytest.approx(part, rel=1e-7)
