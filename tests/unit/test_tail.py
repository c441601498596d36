"""Tail counts and exact binomial intervals."""

import numpy as np
import pytest
from scipy import stats

from kacsim.statistics import histogram, tail


@pytest.fixture(scope="module")
def sample(seed):
    """Return values away from bin edges, and their fine counts with tails."""
    rng = np.random.default_rng([seed, 20])
    places = rng.integers(-200, 200, 5000)
    values = 0.05 * places + 0.02
    edges = histogram.fine_edges()
    inner, _ = np.histogram(values, edges)
    counts = np.r_[(values < edges[0]).sum(), inner, (values > edges[-1]).sum()]
    return values, counts


@pytest.mark.parametrize("threshold", [0.0, 0.05, 3.0, 3.15, 7.95, 8.0])
def test_counts_beyond(threshold, sample):
    values, counts = sample
    assert tail.counts_beyond(counts, threshold) == (values > threshold).sum()
    both = tail.counts_beyond(counts, threshold, both_sides=True)
    assert both == (np.abs(values) > threshold).sum()


@pytest.mark.parametrize("threshold", [0.03, 3.01, 8.05, 11.0])
def test_threshold_must_be_an_edge(threshold, sample):
    with pytest.raises(ValueError, match=rf"threshold = {threshold}: must be a multiple of 0\.05"):
        tail.counts_beyond(sample[1], threshold)


@pytest.mark.parametrize("confidence", [0.9, 0.95])
@pytest.mark.parametrize(("successes", "n"), [(0, 7), (1, 7), (7, 7), (130, 100_000), (3, 10**6)])
def test_clopper_pearson_is_scipys(successes, n, confidence):
    test = stats.binomtest(successes, n).proportion_ci(confidence, method="exact")
    mine = tail.clopper_pearson(successes, n, confidence)
    assert mine == pytest.approx((test.low, test.high), rel=1e-9)
