"""The mean TVN over all ways to deal draws: against all ways, and against its scatter."""

import itertools

import numpy as np
import pytest

from kacsim.statistics import dealing, histogram

LAW = np.array([0.5, 0.3, 0.2])


def test_the_mean_is_that_over_all_ways_to_deal():
    """Nine draws in three bins, three to a replicate: all 84 choices of one."""
    counts = np.array([[2, 0, 1], [1, 2, 0], [0, 3, 0]])
    draws = np.repeat(np.arange(3), counts.sum(axis=0))
    ways = itertools.combinations(range(draws.size), 3)
    dealt = [np.bincount(draws[list(way)], minlength=3) for way in ways]
    wanted = histogram.total_variation(np.array(dealt), LAW).mean()
    mean = dealing.mean_variation(counts, LAW)
    assert mean.value == pytest.approx(wanted, rel=1e-12)
    assert mean.degrees == 2


def test_an_empty_and_a_full_bin_are_what_they_lack():
    counts = np.array([[7, 0, 0], [7, 0, 0]])
    mean = dealing.mean_variation(counts, LAW)
    assert mean.value == pytest.approx(0.5)
    assert mean.standard_error == 0.0


@pytest.mark.parametrize(("law", "gain"), [(LAW, 4.0), (np.array([0.54, 0.28, 0.18]), 1.0)])
def test_the_scatter_over_many_samples(law, gain):
    """Null: the mean TVN of 400 draws, and an error that is not too small.

    300 samples of 20 replicates. Drawn from the law that they are compared with, the mean scatters
    at least four times less than that of the replicates, elsewhere no more. A mean as of draws
    dealt with replacement, 2 % too large, is seen.
    """
    rng = np.random.default_rng(5)
    counts = rng.multinomial(400, law, (300, 20))
    plain = histogram.total_variation(counts, LAW)
    found = [dealing.mean_variation(sample, LAW) for sample in counts]
    values = np.array([mean.value for mean in found])
    long = histogram.total_variation(rng.multinomial(400, law, 400_000), LAW)
    z = (values.mean() - long.mean()) / np.hypot(values.std() / 300**0.5, long.std() / 400_000**0.5)
    assert abs(z) < 4.0
    assert plain.mean(axis=1).std() > gain * values.std()
    errors = np.array([mean.standard_error for mean in found])
    assert 0.9 < np.sqrt((errors**2).mean()) / values.std() < 1.7
