"""Bins, TVN and its noise floor."""

import math

import numpy as np
import pytest
from law import compare
from scipy import stats

from kacsim import kac
from kacsim.statistics import histogram

WIDTHS = (0.05, 0.1, 0.2, 0.25, 0.4, 0.5, 0.8, 1.0)


@pytest.fixture
def fine_counts():
    return np.arange(3 * (histogram.FINE_BINS + 2)).reshape(3, -1)


def test_fine_edges_cover_the_line_between_the_tails():
    edges = histogram.fine_edges()
    assert (edges[0], edges[-1], edges.size) == (-8.0, 8.0, 321)
    np.testing.assert_allclose(np.diff(edges), 0.05, rtol=1e-12)


@pytest.mark.parametrize("width", WIDTHS)
def test_coarsen_merges_whole_bins_and_keeps_the_tails(width, fine_counts):
    counts, edges = histogram.coarsen(fine_counts, width)
    np.testing.assert_allclose(np.diff(edges), width, rtol=1e-12)
    assert counts.shape == (3, edges.size + 1)
    np.testing.assert_array_equal(counts[:, [0, -1]], fine_counts[:, [0, -1]])
    np.testing.assert_array_equal(counts.sum(axis=1), fine_counts.sum(axis=1))
    fine = histogram.fine_edges()
    for place in (0, edges.size // 2, edges.size - 2):
        inside = (fine[:-1] > edges[place] - 1e-9) & (fine[:-1] < edges[place + 1] - 1e-9)
        assert counts[1, place + 1] == fine_counts[1, 1:-1][inside].sum()


@pytest.mark.parametrize("width", [0.0, -0.1, 0.03, 0.07, 0.15, 0.3, 5.0, 32.0])
def test_coarsen_refuses_a_width_that_does_not_fit(width, fine_counts):
    with pytest.raises(ValueError, match=rf"bin_width = {width}: must be a multiple of 0\.05"):
        histogram.coarsen(fine_counts, width)


def test_probabilities_include_both_tails():
    edges = np.array([-1.0, 0.0, 2.0])
    law = stats.norm()
    p = histogram.probabilities(law.cdf, edges)
    expected = [law.cdf(-1), 0.5 - law.cdf(-1), law.cdf(2) - 0.5, law.sf(2)]
    np.testing.assert_allclose(p, expected, rtol=1e-12)


def test_total_variation_keeps_its_half():
    """Known: shares (0.5, 0.3, 0.2) against thirds differ by 1/6, 1/30, 2/15; half the sum 1/6."""
    third = np.full(3, 1.0 / 3.0)
    assert histogram.total_variation([5, 3, 2], third) == pytest.approx(1.0 / 6.0)
    assert histogram.total_variation([9, 9, 9], third) == 0.0
    assert histogram.total_variation([7, 0], np.array([0.0, 1.0])) == 1.0
    stacked = histogram.total_variation([[5, 3, 2], [9, 9, 9]], third)
    np.testing.assert_allclose(stacked, [1.0 / 6.0, 0.0])


def published_bins():
    edges = histogram.coarsen(np.zeros(histogram.FINE_BINS + 2, int), 0.1)[1]
    return histogram.probabilities(lambda v: kac.cumulative(v, 2.0), edges)


@pytest.mark.parametrize(
    ("expected", "n_draws"),
    [
        (np.array([0.5, 0.3, 0.2]), 11),
        (np.array([0.001, 0.199, 0.8]), 40),
        (published_bins(), 100_000),
    ],
    ids=["few", "rare", "published"],
)
def test_noise_floor_is_the_mean_of_exact_multinomials(expected, n_draws, seed):
    """Null: E[TVN]. 4000 histograms see a floor that is 0.5 % off (at the published size).

    Mutant: the sup-definition's extra half.
    """
    rng = np.random.default_rng([seed, 10])
    tvn = histogram.total_variation(
        rng.multinomial(n_draws, expected, compare.scaled(4000)), expected
    )
    floor = histogram.noise_floor(expected, n_draws)
    assert compare.ok(compare.of_mean(tvn, floor))
    assert compare.caught(compare.of_mean(tvn, floor / 2.0))


def test_noise_floor_is_exact_for_one_draw():
    """One draw in bin k: TVN = 1 - p_k, of mean 1 - sum p**2."""
    p = np.array([0.5, 0.3, 0.2])
    assert histogram.noise_floor(p, 1) == pytest.approx(1.0 - (p**2).sum(), rel=1e-14)


def test_noise_floor_approaches_the_root_formula_and_the_published_level():
    p = published_bins()
    root = 0.5 * np.sqrt(2.0 * p * (1.0 - p) / (math.pi * 1e5)).sum()
    assert histogram.noise_floor(p, 100_000) == pytest.approx(root, rel=2e-3)
    assert histogram.noise_floor(p, 100_000) == pytest.approx(0.0093, abs=1e-4)


def test_noise_floor_of_a_certain_bin_is_zero():
    assert histogram.noise_floor([0.0, 1.0, 0.0], 100) == 0.0


def test_noise_spread_is_a_little_above_the_spread_of_exact_multinomials(seed):
    """Correlations lower the spread of the published TVN by less than 10 %.

    4000 histograms know it to 1.1 %. Mutant: the spread without the half.
    """
    rng, p = np.random.default_rng([seed, 11]), published_bins()
    tvn = histogram.total_variation(rng.multinomial(100_000, p, 4000), p)
    assert 0.90 < tvn.std() / histogram.noise_spread(p, 100_000) < 1.04
    assert not 0.90 < 0.5 * tvn.std() / histogram.noise_spread(p, 100_000) < 1.04
