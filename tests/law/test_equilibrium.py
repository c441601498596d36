"""Epsilon-perfect draws: the equilibrium law of N particles, and the literal algorithm's times."""

import functools

import numpy as np
import pytest
from law import compare

from kacsim import kac
from kacsim.kac import exact, forward, perfect, readings
from kacsim.kac.constants import RULES, WALKS
from kacsim.streams import new_stream

# (particles, energy or None for 3 N / 2, draws)
SHAPES = [(2, 2.3, 1_000_000), (3, None, 1_000_000), (7, None, 400_000), (7, 4.9, 40_000)]
NAME = "kac.draw_equilibrium"


@pytest.mark.parametrize(("n", "energy", "n_draws"), SHAPES)
def test_velocities_follow_the_beta_law(n, energy, n_draws, seed):
    """Null: v_1**2 / E ~ Beta(1/2, (N - 1)/2) with a fair sign; the tolerance adds below 1e-4.

    Statistics: Kolmogorov-Smirnov, z of E v**2 = E / N and of E v**4. 4e5 draws see a distance
    of 0.0036 and 1.2 % of the fourth moment. Mutants: the energy N where 3 N / 2 was drawn, and
    one particle more.
    """
    size = {"n_draws": compare.scaled(n_draws), "seed": seed}
    v, _ = kac.draw_equilibrium(n_particles=n, tolerance=1e-4, energy=energy, **size)
    total = 1.5 * n if energy is None else energy
    law = functools.partial(exact.equilibrium_cumulative, n_particles=n, energy=energy)
    assert compare.ok(compare.of_distribution(v, law))
    assert compare.ok(compare.of_mean(v**2, total / n))
    assert compare.ok(compare.of_mean(v**4, exact.equilibrium_fourth_moment(n, energy)))
    for mutant in (
        {"n_particles": n, "energy": total / 1.5},
        {"n_particles": n + 1, "energy": total},
    ):
        wrong = functools.partial(exact.equilibrium_cumulative, **mutant)
        assert compare.caught(compare.of_distribution(v, wrong))
        moment = exact.equilibrium_fourth_moment(**mutant)
        assert compare.caught(compare.of_mean(v**4, moment))


@pytest.mark.parametrize("n", [3, 7])
def test_draws_of_one_call_are_independent(n, seed):
    """Null: E v_k**2 v_(k+1)**2 = (E v**2)**2. 2e5 pairs see a correlation of 0.01.

    Mutant: energies averaged over neighbours, as if inputs drawn ahead were used twice.
    """
    size = compare.scaled(400_000)
    v, _ = kac.draw_equilibrium(n_particles=n, tolerance=1e-2, n_draws=size, seed=seed)
    square = v**2
    assert compare.ok(compare.of_mean(square[::2] * square[1::2], 2.25))
    mixed = 0.95 * square[::2] + 0.05 * square[1::2]
    assert compare.caught(compare.of_mean(mixed * square[1::2], 2.25))


def literal(n, energy, tolerance, seed):
    """Return (coupling time, mean corner) of the printed algorithm on the first draw's inputs."""
    inputs = perfect.record(n, 150 * n, new_stream(seed, NAME))
    return perfect.couple_literally(n, energy, tolerance, *inputs)


def first_draw(n, energy, tolerance, seed):
    v, times = kac.draw_equilibrium(
        n_particles=n, tolerance=tolerance, n_draws=1, seed=seed, energy=energy
    )
    return times[0], abs(v[0])


@pytest.mark.parametrize("energy", [None, 2.3])
@pytest.mark.parametrize(
    ("n", "tolerance", "n_seeds"),
    [(2, 1e-6, 100), (3, 1e-6, 200), (3, 0.3, 200), (5, 1e-4, 100), (7, 1e-2, 60), (7, 1e-5, 40)],
)
def test_coupling_is_that_of_the_printed_algorithm(n, tolerance, n_seeds, energy, seed):
    """The first n at which D < tolerance, and the corners' mean there: the same, draw by draw."""
    total = 1.5 * n if energy is None else energy
    for k in range(n_seeds):
        time, corner = literal(n, total, tolerance, seed + k)
        found, speed = first_draw(n, energy, tolerance, seed + k)
        assert found == time > 0
        assert speed == pytest.approx(corner[0], abs=1e-7)


def time_on_one_coordinate(n, energy, tolerance, seed):
    """Return the mutant's time: corners compared on v_1 only, not by their distance."""
    images = np.eye(n)
    for step, (p, q, a) in enumerate(
        zip(*perfect.record(n, 1000, new_stream(seed, NAME)), strict=True)
    ):
        images[[p, q]] = a * images[p] + (1.0 - a) * images[q]
        if np.ptp(np.sqrt(energy * images[:, 0])) < tolerance:
            return step + 1
    return None


MUTANTS = {
    "energy N": lambda n, seed: literal(n, 1.0 * n, 1e-2, seed)[0],
    "twice the tolerance": lambda n, seed: literal(n, 1.5 * n, 2e-2, seed)[0],
    "one coordinate": lambda n, seed: time_on_one_coordinate(n, 1.5 * n, 1e-2, seed),
}


@pytest.mark.parametrize("name", MUTANTS)
@pytest.mark.parametrize("n", [3, 7])
def test_mutated_coupling_gives_other_times(name, n, seed):
    """Negative controls: never later than the printed times, and earlier in some of 200 draws."""
    seeds = range(seed, seed + 200)
    pairs = [(MUTANTS[name](n, k), first_draw(n, None, 1e-2, k)[0]) for k in seeds]
    assert all(wrong <= time for wrong, time in pairs)
    assert sum(wrong < time for wrong, time in pairs) > 3


def test_later_draws_of_a_call_have_the_times_of_first_draws(seed):
    """Null: one mean and mean square. 2e4 first draws, equal to the printed algorithm's, and 2e5
    draws of one call see 0.6 of 87 steps. Mutant: twice the tolerance.
    """
    seeds = range(seed, seed + compare.scaled(20_000))
    first = np.array([first_draw(7, None, 1e-2, k)[0] for k in seeds])
    for tolerance, same in ((1e-2, True), (2e-2, False)):
        _, times = kac.draw_equilibrium(
            n_particles=7, tolerance=tolerance, n_draws=compare.scaled(200_000), seed=10**9 + seed
        )
        zs = [compare.of_means(times**k, first**k) for k in (1, 2)]
        assert (compare.ok if same else compare.caught)(*zs)


@pytest.fixture(scope="module")
def both_ways():
    """Return seed -> mean corners from the past and forward, errors and times, kept; N = 3."""

    def draw(seed):
        size = compare.scaled(300_000)
        corners, errors = np.empty((2, size, 3)), np.empty((size, 2))
        times = np.empty((size, 2), np.int64)
        arguments = forward.arguments(n_particles=3, tolerance=1e-4)
        stream = new_stream(seed, "law both ways")
        forward.couple_both_ways(*corners, errors, times, *arguments, stream)
        return corners, errors, times

    return compare.kept(draw)


def test_only_coupling_from_the_past_gives_the_equilibrium(both_ways, seed):
    """Null: v_1 uniform on (0, sqrt(E)) for N = 3, E = 9/2; E v**4 = 4.05 by all particles.

    3e5 draws see 0.22 % of the moment. Mutant: the forward draws, 5 % off.
    """
    (past, onward), _, _ = both_ways(seed)
    radius = np.sqrt(4.5)
    for corners, judge in ((past, compare.ok), (onward, compare.caught)):
        law = functools.partial(np.multiply, 1.0 / radius)
        assert judge(compare.of_distribution(corners[:, 0], law))
        assert judge(compare.of_mean((corners**4).mean(axis=1), 4.05))


def test_both_ways_take_the_same_time(both_ways, seed):
    """Null: products of as many independent steps have one law in either order.

    3e5 pairs see 0.07 of 14 steps. Mutant: one step more.
    """
    _, _, times = both_ways(seed)
    gap = (times[:, 0] - times[:, 1]).astype(float)
    assert compare.ok(compare.of_mean(gap, 0.0))
    assert compare.caught(compare.of_mean(gap + 1.0, 0.0))


def test_no_draw_is_an_epsilon_from_where_more_steps_take_it(both_ways, seed):
    """Exactly: by a power of two, and in the limit. Some draws are a tenth of it away."""
    _, errors, _ = both_ways(seed)
    assert errors.max() < 1e-4
    assert (errors.max(axis=0) > 1e-5).all()


def test_the_printed_reading_has_the_times_of_the_sampler(seed):
    """Null: mean and mean square of the times of `draw_equilibrium`. 1e5 draws see 0.5 %.

    Mutants: each other rule of stopping.
    """
    n, size, tolerance = 7, compare.scaled(100_000), 1e-2
    _, wanted = kac.draw_equilibrium(n_particles=n, tolerance=tolerance, n_draws=size, seed=seed)
    times = np.zeros((size, len(RULES), 1), np.int64)
    over_radius = [tolerance / np.sqrt(1.5 * n)]
    bound = readings.arguments(n_particles=n, walk="printed", tolerance=over_radius)
    readings.stopping_times(times, *bound, new_stream(seed, "law readings"))
    zs = [compare.of_means(times[:, 0, 0] ** k, wanted**k) for k in (1, 2)]
    assert compare.ok(*zs)
    for rule in range(1, len(RULES)):
        assert compare.caught(compare.of_means(times[:, rule, 0], wanted))


def test_two_particles_meet_in_the_first_step_that_moves_them(seed):
    """Exactly: with N = 2 both corners have one energy in all, whatever the angle.

    Null: drawn with replacement a pair is one with probability 1/2, so that times have mean 2.
    """
    times = np.zeros((compare.scaled(1000), len(RULES), 1), np.int64)
    for walk in WALKS:
        bound = readings.arguments(n_particles=2, walk=walk, tolerance=[0.3])
        readings.stopping_times(times, *bound, new_stream(seed, f"law two {walk}"))
        largest = times[:, 0, 0].astype(float)
        if walk == "replacement":
            assert compare.ok(compare.of_mean(largest, 2.0))
        else:
            assert (largest == 1.0).all()
