"""The perfect sampler: what a block makes of all states, how long it is, and its limits."""

import itertools
import math

import coupling_twins
import numpy as np
import pytest

from kacsim import kac
from kacsim.cases import make_case
from kacsim.kac import perfect_blocks
from kacsim.kac.contraction import blocks_per_draw, chosen_block, contraction_rate
from kacsim.streams import new_stream


@pytest.mark.parametrize(("n", "block"), [(2, 0), (3, 3), (4, 15), (6, 60)])
def test_a_block_that_succeeds_makes_all_states_one(n, block, seed):
    """Exactly, but for rounding; of those that fail the corners are not all one."""
    blocks = coupling_twins.blocks(n, block, new_stream(seed, "one state"))
    found = list(itertools.islice(blocks, 200))
    together = [spread for _, succeeds, spread in found if succeeds]
    apart = [spread for _, succeeds, spread in found if not succeeds]
    assert len(together) > 20
    assert max(together) < 1e-12
    assert all(spread > 1e-9 for spread in apart)
    assert bool(apart) == (n > 2)


def blocks_in_trials(n, block, n_draws, seed):
    """Return blocks per draw, that before the first draw not counted, and the standard error."""
    blocks = perfect_blocks.draw_beginnings(
        np.empty(n_draws), n, 1.0, block, new_stream(seed, f"blocks {n} {block}")
    )
    mean = blocks / (n_draws + 1)
    return mean, math.sqrt(mean * max(mean - 1.0, 1e-3) / n_draws)


@pytest.mark.parametrize(
    ("n", "block"), [(2, 0), (3, 2), (3, 5), (4, 18), (7, 92), (10, 150), (10, 200), (20, 690)]
)
def test_the_formula_has_as_many_blocks_as_trials(n, block, seed):
    """Within 15 %, and 5 standard errors of 4000 draws: an estimate of the time that it takes."""
    mean, error = blocks_in_trials(n, block, 4000, seed)
    assert abs(blocks_per_draw(n, block) / mean - 1.0) < 0.15 + 5.0 * error / mean


@pytest.mark.parametrize("n", [3, 4, 7, 10, 20])
def test_another_length_takes_hardly_less_work(n, seed):
    """Steps per draw in trials, half as long a block to twice as long; within 12 %."""

    def work(block):
        return blocks_in_trials(n, block, 20_000, seed)[0] * (block + n)

    chosen = chosen_block(n)
    others = [max(n - 2, round(chosen * factor)) for factor in (0.6, 0.75, 0.9, 1.1, 1.5)]
    assert work(chosen) < 1.12 * min(map(work, others))


def test_no_rounding_decides_how_long_a_block_is():
    """Bits follow from it, and logarithms differ in the last place from machine to machine."""
    for n in range(3, 1001):
        needed = (9.4 * math.log(n) - 7.9) / -math.log1p(-contraction_rate(n))
        assert abs(needed - round(needed)) > 1e-6
        assert chosen_block(n) == math.floor(needed) + 1
    assert chosen_block(2) == 0


@pytest.mark.parametrize(
    ("n", "block", "words"),
    [
        (3, 0, "block = 0: no block succeeds with fewer than n_particles - 2 steps"),
        (50, 47, "block = 47: no block succeeds with fewer"),
        (50, 1000, "block = 1000: must be longer: fewer than one block in 100 would succeed"),
        (2, -1, "block = -1: "),
        (1001, None, "n_particles = 1001: must be at most 1000"),
    ],
)
def test_what_would_not_end_is_refused(n, block, words):
    case = make_case("kac_perfect", n_particles=n, block=block, n_draws=1, n_replicates=1, seed=1)
    (problem,) = case.problems()
    assert str(problem).startswith(words)


@pytest.mark.parametrize("n", [2, 3, 50, 300])
def test_one_draw_is_within_the_sphere(n):
    (v,) = kac.draw_perfect(n_particles=n, n_draws=1, seed=3, energy=0.7)
    assert 0.0 < abs(v) < math.sqrt(0.7)


def test_draws_are_those_of_the_kernel_and_the_same_again():
    one, two = (kac.draw_perfect(n_particles=4, n_draws=300, seed=5) for _ in range(2))
    np.testing.assert_array_equal(one, two)
    wanted = np.empty(300)
    stream = new_stream(5, "kac.draw_perfect")
    perfect_blocks.draw_beginnings(wanted, 4, 6.0, chosen_block(4), stream)
    np.testing.assert_array_equal(one, wanted)
    assert (kac.draw_perfect(n_particles=4, n_draws=300, seed=6) != one).any()


def states(n, seed):
    """Return images of which the last column is a state among those that corners have come to."""
    random = np.random.default_rng(seed)
    images = random.gamma(5.0, size=(n, n + 1))
    images /= images.sum(axis=0)
    weights = random.random(n)
    images[:, n] = images[:, :n] @ (weights / weights.sum())
    return images


def test_bounds_hold_all_that_is_neither_last_nor_before(seed):
    """Of the first k particles and of the last one nothing is counted; a slack widens both ways."""
    rest, least, most = np.empty(6), np.empty(5), np.empty(5)
    for part in range(40):
        images = states(5, [seed, part])
        perfect_blocks.set_rests(images, rest, least, most, 0.25)
        for k in range(3):
            sums = images[k + 1 : 4, :5].sum(axis=0)
            assert least[k] == pytest.approx(0.75 * sums.min())
            assert most[k] == pytest.approx(1.25 * sums.max())
        assert least[3] == most[3] == 0.0


def test_equal_sums_never_fail(seed):
    """All states one before the sweep, where the share may be rounded to 1: it succeeds."""
    images = np.tile(np.array([[0.2], [0.5], [0.3]]), 4)
    state, work = np.empty(3), (np.empty(4), np.empty(3), np.empty(3))
    stream = new_stream(seed, "equal")
    for _ in range(2000):
        assert perfect_blocks.sweep(images, state, *work, 0.0, stream)
        assert state.sum() == pytest.approx(1.0, abs=1e-15)
