"""The statistics of the law tests: standard normal under the null, large under a mutant."""

import numpy as np
import pytest
from law import compare
from scipy import special, stats

REPEATS = 400
SIZE = 2000


def _multinomial(rng, tilt=0.0):
    p = np.array([0.4 - tilt, 0.3, 0.2, 0.0995 + tilt, 0.0005])
    return compare.of_counts(rng.multinomial(SIZE, p), [0.4, 0.3, 0.2, 0.0995, 0.0005])


# name -> statistic of new data; a shift of 0 is the null, others are mutants
STATISTICS = {
    "of_mean": lambda rng, shift: compare.of_mean(rng.normal(shift, 2.0, SIZE), 0.0),
    "of_means": lambda rng, shift: compare.of_means(
        rng.normal(shift, 2.0, SIZE), rng.normal(0.0, 1.0, SIZE // 2)
    ),
    "of_share": lambda rng, shift: compare.of_share(rng.binomial(SIZE, 0.3 + shift / 4), SIZE, 0.3),
    "of_distribution": lambda rng, shift: compare.of_distribution(
        rng.normal(shift, 1.0, SIZE), special.ndtr
    ),
    "of_distributions": lambda rng, shift: compare.of_distributions(
        rng.normal(shift, 1.0, SIZE), rng.normal(0.0, 1.0, SIZE // 2)
    ),
    "of_counts": lambda rng, shift: _multinomial(rng, shift / 4),
    "of_histograms": lambda rng, shift: compare.of_histograms(
        rng.normal(shift, 1.0, SIZE), rng.normal(0.0, 1.0, SIZE // 2)
    ),
    "of_squares": lambda rng, shift: compare.of_squares(rng.normal(12.0 * shift, 1.0, 5)),
    "of_energy": lambda rng, shift: compare.of_energy(
        np.sqrt(stats.gamma.rvs(1.5, size=SIZE, random_state=rng)) * (1.0 + shift / 4)
    ),
}


@pytest.mark.parametrize("name", STATISTICS)
def test_z_is_standard_normal_under_the_null(name, seed):
    """Null: p-values uniform, 400 of them. Sees a mean that is off by 0.06.

    Kolmogorov-Smirnov p-values are asymptotic, hence a little too large at 2000 draws.
    """
    rng = np.random.default_rng([seed, 1])
    z = np.array([STATISTICS[name](rng, 0.0) for _ in range(compare.scaled(REPEATS))])
    p = 2.0 * special.ndtr(-np.abs(z))
    assert compare.ok(compare.of_mean(p, 0.5))
    assert compare.ok(compare.of_mean((p - 0.5) ** 2, 1.0 / 12.0))


@pytest.mark.parametrize("name", STATISTICS)
def test_z_grows_under_a_mutant(name, seed):
    """Negative control: a shift of 0.8 standard deviations or so."""
    rng = np.random.default_rng([seed, 2])
    assert compare.caught(STATISTICS[name](rng, 0.8))


@pytest.mark.parametrize("z", [0.0, 0.5, 1.0, 4.0, 6.0, 8.0])
def test_of_p_inverts_the_normal_law(z):
    assert compare.of_p(2.0 * special.ndtr(-z)) == pytest.approx(z, abs=1e-9)


def test_of_fourth_has_the_mean_of_the_fourth_power(seed):
    """The control variate changes the noise, not the mean: exact 15/4 under f0, 1e6 draws."""
    rng = np.random.default_rng([seed, 3])
    v = np.sqrt(stats.gamma.rvs(1.5, size=compare.scaled(1_000_000), random_state=rng))
    assert compare.ok(compare.of_fourth(v, 15.0 / 4.0))
    assert compare.ok(compare.of_mean(v**4, 15.0 / 4.0))
    assert compare.caught(compare.of_fourth(v, 3.80))


def test_two_sample_distance_is_scipys(seed):
    rng = np.random.default_rng([seed, 4])
    a, b = rng.normal(0.02, 1.0, 5000), rng.normal(0.0, 1.0, 3000)
    expected = stats.ks_2samp(a, b, method="asymp").pvalue
    mine = 2.0 * special.ndtr(-compare.of_distributions(a, b))
    assert mine == pytest.approx(expected, rel=0.1)
