"""TVN of an exact sampler: its mean is the noise floor of exact multinomials."""

import math

import numpy as np
import pytest
from law import compare

from kacsim import kac
from kacsim.cases import make_case
from kacsim.jobs import sampling
from kacsim.statistics import histogram

WIDTHS = (0.05, 0.1, 0.5)
TREE = {"algorithm": "poisson", "engine": "ancestral", "n_particles": math.inf}
NANBU = {"algorithm": "nanbu_sequential", "engine": "ancestral", "n_particles": 5, "time_step": 1.0}


def counts_of(parameters, n_replicates, seed):
    """Return int[n_replicates, bin] of 1e5 draws each at t = 2, as the pipeline samples them."""
    size = {"n_draws": 100_000, "n_replicates": n_replicates, "seed": seed}
    case = make_case("kac", time=2.0, **parameters, **size)
    assert case.problems() == []
    return np.asarray(sampling.run(case)["counts"][1])


def compared(counts, width):
    """Return (TVN of each replicate, probabilities of eq. (8)) over bins of a width."""
    merged, edges = histogram.coarsen(counts, width)
    expected = histogram.probabilities(lambda v: kac.cumulative(v, 2.0), edges)
    return histogram.total_variation(merged, expected), expected


@pytest.fixture(scope="module")
def exact_counts():
    """Return seed -> counts of exact draws, kept."""
    return compare.kept(lambda seed: counts_of(TREE, compare.scaled(100), seed))


@pytest.fixture(scope="module")
def nanbu_counts(seed):
    return counts_of(NANBU, 20, seed)


@pytest.mark.parametrize("width", WIDTHS)
def test_tvn_of_exact_draws_is_the_noise_floor(width, exact_counts, nanbu_counts, seed):
    """Null: E[TVN] of 1e5 exact multinomial draws. Statistic: z of 100 replicates' mean, their
    spread as error: it sees 2 % of the floor at width 0.1, i.e. 0.0003.

    Mutant: Nanbu with the large step, at the published TVN of about 0.048.
    """
    tvn, expected = compared(exact_counts(seed), width)
    floor = histogram.noise_floor(expected, 100_000)
    assert compare.ok(compare.of_mean(tvn, floor))
    assert compare.caught(compare.of_mean(tvn, 1.3 * floor))
    mutant, _ = compared(nanbu_counts, width)
    assert compare.caught(compare.of_mean(mutant, floor))


def test_spread_of_tvn(exact_counts, seed):
    """The predicted spread leaves correlations out: 100 replicates know theirs to 7 %."""
    tvn, expected = compared(exact_counts(seed), 0.1)
    assert 0.65 < tvn.std(ddof=1) / histogram.noise_spread(expected, 100_000) < 1.35
    assert not 0.65 < 0.5 * tvn.std(ddof=1) / histogram.noise_spread(expected, 100_000) < 1.35


def test_counts_follow_eq_8(exact_counts, nanbu_counts, seed):
    """Null: eq. (8) in the fine bins. Statistic: chi-squared of 1e7 draws, 2 % in a central bin."""
    expected = histogram.probabilities(lambda v: kac.cumulative(v, 2.0), histogram.fine_edges())
    assert compare.ok(compare.of_counts(exact_counts(seed).sum(axis=0), expected))
    assert compare.caught(compare.of_counts(nanbu_counts.sum(axis=0), expected))


def test_published_tvn_of_the_large_step(nanbu_counts):
    """Known by simulation: 0.0486 +- 0.0014 for one replicate, sequential; 20 know it to 0.0003."""
    tvn, _ = compared(nanbu_counts, 0.1)
    assert tvn.mean() == pytest.approx(0.0486, abs=0.0015)
    assert tvn.std(ddof=1) == pytest.approx(0.0014, abs=0.0009)
