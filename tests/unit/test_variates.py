"""The law of every variate: moments, Kolmogorov-Smirnov, fine bins, and the tails."""

import math

import numba
import numpy as np
import pytest
from law import compare
from scipy import special, stats

from kacsim import variate_tables, variates
from kacsim.streams import new_stream

N = 1_000_000
FINE = 20_000_000
N_BINS = 256
SPEED = stats.maxwell(scale=math.sqrt(0.5))


def filler(variate, width=1):
    """Return a compiled loop that fills float64[n, width] with a variate of the stream."""

    @numba.njit
    def fill_one(out, stream):
        for k in range(out.shape[0]):
            out[k, 0] = variate(stream)

    @numba.njit
    def fill_two(out, stream):
        for k in range(out.shape[0]):
            out[k, 0], out[k, 1] = variate(stream)

    return fill_one if width == 1 else fill_two


def draws(variate, name, seed, width=1):
    out = np.empty((compare.scaled(N), width))
    filler(variate, width)(out, new_stream(seed, f"test_variates {name}"))
    return out[:, 0] if width == 1 else out


@numba.njit
def seven(stream):
    return variates.index_below(7, stream)


@numba.njit
def pair_of_seven(stream):
    return variates.pair_below(7, stream)


def geometric(probability):
    scale = variates.gap_scale(probability)

    @numba.njit
    def failures(stream):
        return variates.failures_before_success(scale, stream)

    return failures


def angle(points):
    return np.arctan2(points[:, 1], points[:, 0])


# name -> (draws, exact law)
CONTINUOUS = {
    "uniform": (lambda seed: draws(variates.uniform, "uniform", seed), stats.uniform()),
    "exponential": (lambda seed: draws(variates.exponential, "exponential", seed), stats.expon()),
    "half_normal": (
        lambda seed: draws(variates.half_normal, "half_normal", seed),
        stats.halfnorm(),
    ),
    "maxwell_speed": (
        lambda seed: draws(variates.maxwell_speed, "maxwell_speed", seed),
        SPEED,
    ),
    "squared_cosine": (
        lambda seed: draws(variates.squared_cosine, "squared_cosine", seed),
        stats.beta(0.5, 0.5),
    ),
    "unit_circle": (
        lambda seed: angle(draws(variates.unit_circle, "unit_circle", seed, width=2)),
        stats.uniform(-math.pi, 2.0 * math.pi),
    ),
}
DISCRETE = {
    "index_below": (lambda seed: draws(seven, "index", seed), stats.randint(0, 7)),
    "random_sign": (
        lambda seed: (draws(variates.random_sign, "sign", seed) + 1.0) / 2.0,
        stats.bernoulli(0.5),
    ),
    "failures 0.9": (lambda seed: draws(geometric(0.9), "gap 0.9", seed), stats.geom(0.9, -1)),
    "failures 0.3": (lambda seed: draws(geometric(0.3), "gap 0.3", seed), stats.geom(0.3, -1)),
    "failures 0.008": (lambda seed: draws(geometric(0.008), "gap", seed), stats.geom(0.008, -1)),
}
ALL = CONTINUOUS | DISCRETE


@pytest.mark.parametrize("name", ALL)
def test_moments(name, seed):
    """Null: exact mean and mean square. 1e6 draws see 0.4 % of a standard deviation."""
    make, law = ALL[name]
    values = make(seed)
    assert compare.ok(compare.of_mean(values, law.mean()))
    assert compare.ok(compare.of_mean(values**2, law.var() + law.mean() ** 2))
    mutant = values + 0.015 * law.std()
    assert compare.caught(compare.of_mean(mutant, law.mean()))


@pytest.mark.parametrize("name", CONTINUOUS)
def test_distribution(name, seed):
    """Null: the exact law. Statistic: Kolmogorov-Smirnov, 1e6 draws see a distance of 0.0023."""
    make, law = CONTINUOUS[name]
    values = make(seed)
    assert compare.ok(compare.of_distribution(values, law.cdf))
    mutant = values * 1.02
    assert compare.caught(compare.of_distribution(mutant, law.cdf))


@pytest.mark.parametrize("name", DISCRETE)
def test_probabilities(name, seed):
    """Null: the exact probabilities. Statistic: chi-squared, 1e6 draws see about 1 % in a bin.

    Mutant: a twentieth of the values lost, i.e. 0.
    """
    make, law = DISCRETE[name]
    values = make(seed).astype(int)
    assert values.min() >= 0
    p = law.pmf(np.arange(values.max() + 1))
    counts = np.bincount(values)
    assert compare.ok(compare.of_counts(np.r_[counts, 0], np.r_[p, 1.0 - p.sum()]))
    mutant = np.where(np.arange(values.size) % 20 == 0, 0, values)
    counts = np.bincount(mutant, minlength=p.size)
    assert compare.caught(compare.of_counts(np.r_[counts, 0], np.r_[p, 1.0 - p.sum()]))


@pytest.mark.parametrize(("p", "failures"), [(1.0, 0), (1e-12, None)])
def test_geometric_extremes(p, failures, seed):
    """Certain success never fails first; a rare one fails about 1 / p times."""
    stream, n = new_stream(seed, "test_variates extremes"), compare.scaled(1000)
    values = [variates.failures_before_success(variates.gap_scale(p), stream) for _ in range(n)]
    if failures is None:
        assert compare.ok(compare.of_mean(np.array(values) * p, 1.0))
        assert min(values) > 1e6
    else:
        assert values == [failures] * n


def test_pairs_are_uniform_ordered_pairs(seed):
    """Null: 42 equal chances. 1e6 draws see 3 % in a pair. Mutant: j may be i, then i + 1."""
    pairs = draws(pair_of_seven, "pair", seed, width=2).astype(int)
    assert (pairs[:, 0] != pairs[:, 1]).all()
    chances = (1.0 - np.eye(7)).ravel() / 42.0
    counts = np.bincount(pairs @ [7, 1], minlength=49)
    assert compare.ok(compare.of_counts(counts, np.maximum(chances, 1e-12)))
    i, j = np.random.default_rng(seed).integers(0, 7, (2, N))
    j = np.where(i == j, (i + 1) % 7, j)
    counts = np.bincount(7 * i + j, minlength=49)
    assert compare.caught(compare.of_counts(counts, np.maximum(chances, 1e-12)))


def test_points_are_on_the_circle_and_uncorrelated(seed):
    """Null: E cos = E sin = E cos sin = 0, E cos**2 = 1/2. Mutant: angles of half the circle."""
    points = draws(variates.unit_circle, "circle", seed, width=2)
    np.testing.assert_allclose((points**2).sum(axis=1), 1.0, atol=4e-16)
    cos, sin = points.T
    for values, exact in ((cos, 0.0), (sin, 0.0), (cos * sin, 0.0), (cos**2, 0.5), (cos**4, 0.375)):
        assert compare.ok(compare.of_mean(values, exact))
    half = np.abs(angle(points)) / 2.0
    assert compare.caught(compare.of_mean(np.sin(half), 0.0))


@numba.njit
def exponential_level(stream):
    return math.exp(-variates.exponential(stream))


@numba.njit
def half_normal_level(stream):
    return math.erfc(variates.half_normal(stream) / math.sqrt(2.0))


@numba.njit
def speed_level(stream):
    x = variates.maxwell_speed(stream)
    return math.erfc(x) + 2.0 / math.sqrt(math.pi) * x * math.exp(-x * x)


@numba.njit
def circle_level(stream):
    cos, sin = variates.unit_circle(stream)
    return 0.5 + math.atan2(sin, cos) / (2.0 * math.pi)


@numba.njit
def squared_cosine_level(stream):
    return 2.0 / math.pi * math.asin(math.sqrt(variates.squared_cosine(stream)))


LEVELS = {
    "exponential": exponential_level,
    "half_normal": half_normal_level,
    "maxwell_speed": speed_level,
    "unit_circle": circle_level,
    "squared_cosine": squared_cosine_level,
}


def bin_counts(level, power, n, stream):
    """Return the counts of P(X > x)**power in equal bins, n draws of x."""

    @numba.njit
    def count(counts, stream):
        for _ in range(n):
            counts[min(int(level(stream) ** power * N_BINS), N_BINS - 1)] += 1

    counts = np.zeros(N_BINS, np.int64)
    count(counts, stream)
    return counts


@pytest.mark.parametrize("name", LEVELS)
def test_distribution_in_fine_bins(name, seed):
    """Null: P(X > x) is uniform. Statistic: chi-squared on 256 bins.

    2e7 draws see 1.5 % in one bin and 0.3 % in all of them. Mutant: a power of 1.004.
    """
    stream, n = new_stream(seed, f"test_variates fine {name}"), compare.scaled(FINE)
    expected = np.full(N_BINS, 1.0 / N_BINS)
    assert compare.ok(compare.of_counts(bin_counts(LEVELS[name], 1.0, n, stream), expected))
    assert compare.caught(compare.of_counts(bin_counts(LEVELS[name], 1.004, n, stream), expected))


def tail_of(variate, least, n, stream):
    """Return the values above `least` among n draws."""

    @numba.njit
    def keep(out, stream):
        found = 0
        for _ in range(n):
            x = variate(stream)
            if x > least:
                out[found] = x
                found += 1
        return found

    out = np.empty(n // 200)
    return out[: keep(out, stream)]


@numba.njit
def negative_speed(stream):
    return -variates.maxwell_speed(stream)


class Negative:
    """The law of a speed with its sign changed."""

    @staticmethod
    def sf(x):
        return SPEED.cdf(-x)


@pytest.mark.parametrize(
    ("variate", "least", "law"),
    [
        (variates.exponential, 7.7, stats.expon()),
        (variates.half_normal, 3.66, stats.halfnorm()),
        (variates.maxwell_speed, variate_tables.SPEED_TAIL, SPEED),
        (variates.maxwell_speed, 3.1, SPEED),
        (negative_speed, -0.75 * variate_tables.SPEED_EDGE[1], Negative),
    ],
    ids=["exponential", "half_normal", "speed", "high_speed", "low_speed"],
)
def test_tail(variate, least, law, seed):
    """Null: P(X > x) beyond the layers, or near a speed of 0, and the law of X there.

    Statistics: binomial z and Kolmogorov-Smirnov. 4e7 draws leave at least 10000 in the tail: they
    see 4 % of its probability. Mutants: a share 10 % too large, excesses 20 % too long.
    """
    n, share = compare.scaled(2 * FINE), law.sf(least)
    tail = tail_of(variate, least, n, new_stream(seed, f"test_variates tail {least}"))
    assert compare.ok(compare.of_share(tail.size, n, share))
    assert compare.caught(compare.of_share(tail.size, n, share / 1.1))

    def cumulative(x):
        return 1.0 - law.sf(x) / share

    assert compare.ok(compare.of_distribution(tail, cumulative))
    mutant = least + 1.2 * (tail - least)
    assert compare.caught(compare.of_distribution(mutant, cumulative))


@pytest.mark.parametrize("p", [1e-9, 0.17, 0.999])
def test_gap_scale(p):
    assert special.expm1(-1.0 / variates.gap_scale(p)) == pytest.approx(-p, rel=1e-9)


def test_gap_scale_at_certainty():
    assert variates.gap_scale(1.0) == 0.0


def test_trials_that_hardly_ever_succeed_leave_a_whole_number(seed):
    """Gaps beyond the whole numbers of 64 bits, with a chance of 0 or near it."""
    for p in (0.0, 1e-25, 1e-300):
        stream = new_stream(seed, "test_variates never")
        gaps = [variates.failures_before_success(variates.gap_scale(p), stream) for _ in range(9)]
        assert gaps == [variates.MOST_FAILURES] * 9
    assert variates.gap_scale(0.0) == math.inf
