"""Intervals for means of infinite variance, on Pareto samples whose law is known."""

import math

import numpy as np
import pytest
from scipy import integrate, stats

from kacsim.statistics import stable

INDEX, SCALE = 1.6, 2.5  # P(X > x) = (x / SCALE)**-INDEX
MEAN = SCALE * INDEX / (INDEX - 1.0)
RUNS, BLOCKS, BLOCK = 600, 50, 100


def pareto(rng, runs=RUNS):
    return SCALE * rng.random((runs, BLOCKS, BLOCK)) ** (-1.0 / INDEX)


def covered(low, high):
    return ((low < MEAN) & (high > MEAN)).mean()


SPREAD = math.sqrt(stable.LEVEL * (1.0 - stable.LEVEL) / RUNS)


def test_the_constant_is_that_of_the_tail(seed):
    values = pareto(np.random.default_rng(seed), runs=1)[0]
    many = np.tile(values.max(axis=-1), (1, 1))
    found = stable.frechet_constant(many, BLOCK, INDEX)
    # The mean of 50 exponential variates, and blocks of 100 are not endless: 1 %.
    assert found[0] == pytest.approx(SCALE**INDEX, rel=4.0 / math.sqrt(BLOCKS) + 0.01)


def test_the_stable_interval_covers_as_often_as_it_says(seed):
    """With the right constant; half of it, or another index, do not."""
    values = pareto(np.random.default_rng(seed))
    mean, n = values.mean(axis=(1, 2)), BLOCKS * BLOCK
    share = covered(*stable.stable_interval(mean, n, SCALE**INDEX, INDEX))
    assert abs(share - stable.LEVEL) < 4.0 * SPREAD + 0.02
    for constant, index in ((0.2 * SCALE**INDEX, INDEX), (SCALE**INDEX, 1.3)):
        wrong = covered(*stable.stable_interval(mean, n, constant, index))
        assert abs(wrong - stable.LEVEL) > 4.0 * SPREAD + 0.02


def test_the_stable_interval_fails_as_often_on_either_side(seed):
    """Turned over, the skewed law's interval covers nearly as often, but fails on one side."""
    values = pareto(np.random.default_rng(seed))
    mean, n = values.mean(axis=(1, 2)), BLOCKS * BLOCK
    low, high = stable.stable_interval(mean, n, SCALE**INDEX, INDEX)
    side = 0.5 - stable.LEVEL / 2.0
    room = 4.0 * math.sqrt(side * (1.0 - side) / RUNS) + 0.02
    for share in ((low > MEAN).mean(), (high < MEAN).mean()):
        assert abs(share - side) < room


def test_the_constant_from_the_largest_serves(seed):
    values = pareto(np.random.default_rng(seed))
    constant = stable.frechet_constant(values.max(axis=-1), BLOCK, INDEX)
    assert constant.shape == (RUNS,)
    share = covered(
        *stable.stable_interval(values.mean(axis=(1, 2)), BLOCKS * BLOCK, constant, INDEX)
    )
    assert abs(share - stable.LEVEL) < 4.0 * SPREAD + 0.03


def test_quantiles_hold_the_level_of_the_stable_law():
    """By an integral of its characteristic function, Gil-Pelaez."""
    below, above = stable.quantiles(INDEX)
    skew = math.tan(0.5 * math.pi * INDEX)

    def cumulative(x):
        def part(t):
            angle = t**INDEX * skew - t * x
            return math.exp(-(t**INDEX)) * math.sin(angle) / t

        return 0.5 - integrate.quad(part, 0.0, 12.0, limit=400)[0] / math.pi

    assert cumulative(above) - cumulative(below) == pytest.approx(stable.LEVEL, abs=2e-4)
    assert cumulative(below) == pytest.approx(0.5 - stable.LEVEL / 2.0, abs=2e-4)


def test_blocks_tell_the_interval_of_a_normal_law(seed):
    rng = np.random.default_rng(seed)
    values = MEAN + 0.7 * rng.standard_normal((RUNS, BLOCKS, BLOCK))
    low, high = stable.blocked_interval(values.mean(axis=-1), (values**2).mean(axis=-1), BLOCK)
    assert abs(covered(low, high) - stable.LEVEL) < 4.0 * SPREAD + 0.03
    error = 0.7 / math.sqrt(BLOCKS * BLOCK)
    assert np.median(high - low) == pytest.approx(2.0 * error, rel=0.1)


def test_blocks_tell_a_skewed_law_better_than_its_deviation(seed):
    values = pareto(np.random.default_rng(seed))
    mean, square = values.mean(axis=-1), (values**2).mean(axis=-1)
    blocks = covered(*stable.blocked_interval(mean, square, BLOCK))
    whole = mean.mean(axis=-1)
    error = np.sqrt((square.mean(axis=-1) - whole**2) / (BLOCKS * BLOCK))
    assert abs(blocks - stable.LEVEL) < abs(covered(whole - error, whole + error) - stable.LEVEL)
    assert stats.norm.cdf(1.0) - stats.norm.cdf(-1.0) == pytest.approx(stable.LEVEL)
