"""What variates make of a word of the stream, and of a block of words, against plain twins.

The laws of what is made by blocks are tested here too.
"""

import itertools
import math

import numba
import numpy as np
import pytest
import variate_twins as twins
from law import compare
from scipy import stats

from kacsim import streams, variate_tables, variates
from kacsim.streams import new_stream

MASK = twins.MASK
ENDS = [0, 1, 1023, 1024, 2**10, 2**11, 2**63 - 1, 2**63, 2**63 + 2**11, MASK - 2047, MASK]
SIZES = [(1, 2), (1000, 10**9), (7, 1), (2**31, 2**31 - 1), (999, 2**61)]
N = 1_000_000
FINE = 20_000_000
N_BINS = 256


def words():
    """Return words: random ones, and those where a fixed point or a sign changes."""
    drawn = np.random.default_rng(8).integers(0, 2**64, 3000, np.uint64)
    return [*ENDS, *(word ^ 512 for word in ENDS), *map(int, drawn)]


def stream_of(word):
    """Return a stream of which the next word is given."""
    stream = np.zeros(streams.END, np.uint64)
    stream[streams.PLACE], stream[streams.END - 1] = streams.END - 1, word
    return stream


@pytest.mark.parametrize(("n", "m"), SIZES)
def test_indices_are_the_digits_of_a_word(n, m):
    for word in words():
        first, second = twins.two_below(n, m, word)
        assert variates.index_below(n, stream_of(word)) == first
        assert variates.two_below(n, m, stream_of(word)) == (first, second)
        if n > 1:
            i, j = twins.two_below(n, n - 1, word)
            assert variates.pair_below(n, stream_of(word)) == (i, j if j < i else j + 1)
    ends = {variates.index_below(n, stream_of(word)) for word in (0, MASK)}
    assert ends == {0, n - 1}


def test_uniforms_and_signs_are_the_high_bits_of_a_word():
    for word in words():
        assert variates.uniform(stream_of(word)) == (word >> 11) / 2**53
        assert variates.random_sign(stream_of(word)) == (-1.0 if word >> 63 else 1.0)


def test_points_on_the_circle_are_turned_fixed_ones():
    """Angles to 3e-15, of which the series takes 2.4e-15 at half a step."""
    for word in words():
        angle = twins.turned_by(word)
        point = math.cos(angle), math.sin(angle)
        np.testing.assert_allclose(variates.unit_circle(stream_of(word)), point, atol=3e-15)
        square = variates.squared_cosine(stream_of(word))
        assert square == pytest.approx(math.cos(angle / 2.0) ** 2, abs=3e-15)
        assert 0.0 <= square <= 1.0
    steps = [twins.turned_by(word) for word in (2**63 - 1, 2**63, 2**64 - 1, 0)]
    half = math.pi / variate_tables.POINTS
    np.testing.assert_allclose(
        np.mod(steps, 2.0 * math.pi / 1024), [half, half, 0.0, 0.0], atol=1e-9
    )


def test_a_speed_is_that_of_its_word(seed):
    """Every strip, below the surely good height and above, and the tail."""
    key = seed, "test_words speed"
    for strip, high in itertools.product(range(256), (0, 2**62, 2**63, MASK - 2047)):
        first, second = new_stream(*key, strip), new_stream(*key, strip)
        first[streams.PLACE] = second[streams.PLACE] = streams.END - 1
        first[-1] = second[-1] = strip | high
        wanted = twins.speed(int(streams.next_bits(second)), second)
        assert variates.maxwell_speed(first) == pytest.approx(wanted, rel=1e-14)
        assert streams.same_state(first, second)


@numba.njit
def energies(values, n, stream):
    variates.maxwell_energies(values, np.empty(streams.BLOCK, np.uint64), n, stream)


@numba.njit
def cosines(values, n, stream):
    variates.squared_cosines(values, n, stream)


def shares(n, stream):
    return [variates.squared_cosine(stream) for _ in range(n)]


@pytest.mark.parametrize("n", [0, 1, 7, 256, 700])
@pytest.mark.parametrize("taken", [0, 1, 200, 255, 256])
@pytest.mark.parametrize(("bulk", "twin"), [(energies, twins.energies), (cosines, shares)])
def test_blocks_give_the_twins_values(bulk, twin, taken, n, seed):
    """From every place in a block, whole blocks or not; what is beyond n is left alone."""
    first, second = (new_stream(seed, "test_words bulk", taken) for _ in range(2))
    for stream in (first, second):
        for _ in range(taken):
            streams.next_bits(stream)
    values = np.full(n + 3, -1.0)
    bulk(values, n, first)
    np.testing.assert_allclose(values[:n], twin(n, second), rtol=1e-13)
    np.testing.assert_array_equal(first, second)
    np.testing.assert_array_equal(values[n:], -1.0)


ENERGY, SHARE = stats.gamma(1.5), stats.beta(0.5, 0.5)
BULK = {"energies": (energies, ENERGY, 1.5), "cosines": (cosines, SHARE, 0.5)}


@pytest.fixture(scope="module")
def drawn():
    """Return name -> seed -> many draws, which were asked for in numbers that fill no block."""

    def draw(name):
        def make(seed):
            values, stream = np.empty((compare.scaled(N) // 1000, 1000)), new_stream(seed, name)
            for row in values:
                BULK[name][0](row, row.size, stream)
            return values.ravel()

        return compare.kept(make)

    return {name: draw(name) for name in BULK}


@pytest.mark.parametrize("name", BULK)
def test_law_of_blocks(name, drawn, seed):
    """Null: the exact law, neighbours independent. 1e6 draws see a distance of 0.0023.

    Mutants: 2 % more, and a hundredth of each draw's neighbour added.
    """
    values, (_, law, mean) = drawn[name](seed), BULK[name]
    assert compare.ok(compare.of_distribution(values, law.cdf))
    assert compare.caught(compare.of_distribution(1.02 * values, law.cdf))
    apart = values - mean
    assert compare.ok(compare.of_mean(apart[1:] * apart[:-1], 0.0))
    mixed = apart[1:] + 0.01 * apart[:-1]
    assert compare.caught(compare.of_mean(mixed * apart[:-1], 0.0))


@numba.njit
def energy_levels(values, n, stream):
    """Fill with the chances of a greater energy."""
    energies(values, n, stream)
    for k in range(n):
        x = math.sqrt(values[k])
        values[k] = math.erfc(x) + 2.0 / math.sqrt(math.pi) * x * math.exp(-x * x)


@numba.njit
def share_levels(values, n, stream):
    cosines(values, n, stream)
    for k in range(n):
        values[k] = 2.0 / math.pi * math.asin(math.sqrt(values[k]))


@numba.njit
def count(fill, counts, power, lots, stream):
    values = np.empty(1000)
    for _ in range(lots):
        fill(values, values.size, stream)
        for x in values:
            counts[min(int(x**power * counts.size), counts.size - 1)] += 1


@pytest.mark.parametrize("fill", [energy_levels, share_levels])
def test_law_of_blocks_in_fine_bins(fill, seed):
    """Null: P(X > x) is uniform, the tail and the neighbourhood of 0 being the end bins.

    Statistic: chi-squared. 2e7 draws see 1.5 % in one of 256 bins. Mutant: a power of 1.004.
    """
    stream, lots = new_stream(seed, "test_words fine"), compare.scaled(FINE) // 1000
    for power, judge in ((1.0, compare.ok), (1.004, compare.caught)):
        counts = np.zeros(N_BINS, np.int64)
        count(fill, counts, power, lots, stream)
        assert judge(compare.of_counts(counts, np.full(N_BINS, 1.0 / N_BINS)))


@numba.njit
def count_pairs(counts, n, stream):
    for _ in range(n):
        i, j = variates.two_below(*counts.shape, stream)
        counts[i, j] += 1


def test_two_indices_are_independent(seed):
    """Null: 5 * 7 equal chances. 4e6 draws see 1 % in a cell. Mutant: both from the high bits."""
    counts, n = np.zeros((5, 7), np.int64), compare.scaled(4 * N)
    count_pairs(counts, n, new_stream(seed, "test_words pairs"))
    assert compare.ok(compare.of_counts(counts.ravel(), np.full(35, 1 / 35)))
    u = np.random.default_rng(seed).random(10_000)
    counts = np.bincount(7 * (5 * u).astype(int) + (7 * u).astype(int), minlength=35)
    assert compare.caught(compare.of_counts(counts, np.full(35, 1 / 35)))
