"""The streams: xoshiro256++ as published, and a stream of its own for every seed, name, replicate.

Two z tests of 6.3e-5.
"""

import itertools
import os
import subprocess
import sys

import numpy as np
import pytest
import variate_twins as twins
from law import compare

from kacsim import streams
from kacsim.streams import LANES

MASK = 2**64 - 1
# First outputs from the state (1, 2, 3, 4), as listed for the authors' reference implementation.
PUBLISHED = [
    41943041,
    58720359,
    3588806011781223,
    3591011842654386,
    9228616714210784205,
    9973669472204895162,
    14011001112246962877,
    12406186145184390807,
    15849039046786891736,
    10450023813501588000,
]
# (seed, name, replicate): neighbours, and those whose words could be read in two ways.
KEYS = [
    (0, "", 0),
    (0, "", 1),
    (0, "", 2**32),
    (0, "", 2**32 + 1),
    (1, "", 0),
    (1, "", 1),
    (1, "a", 0),
    (1, "b", 0),
    (1, "ab", 0),
    (1, "a\0", 0),
    (2**32, "", 0),
    (2**32 + 1, "", 0),
    (1 + 2**64, "", 0),
    (2**64, "", 0),
    (2**64, "", 1),
    (2**65, "", 0),
    (2**96, "", 0),
    (10**30, "", 0),
    (10**30 + 1, "", 0),
]


STATES = [
    (1, 2, 3, 4),
    (MASK,) * 4,
    (1 << 63, 0, 0, 1),
    tuple(range(MASK - 3, MASK + 1)),
    (0, 0, 0, 1),
    (5, MASK, 1 << 32, 1 << 31),
    (1, 0, 0, 0),
    (0, 1 << 63, 0, 0),
]


def outputs(stream, n):
    return [int(streams.next_bits(stream)) for _ in range(n)]


def stream_of(states):
    """Return a stream that nothing was taken from, whose lanes have these states."""
    stream = np.zeros(streams.END, np.uint64)
    stream[: streams.PLACE] = np.array(states, np.uint64).T.ravel()
    stream[streams.PLACE] = streams.END
    return stream


def test_reference_gives_the_published_numbers():
    generator = twins.xoshiro((1, 2, 3, 4))
    assert [next(generator)[0] for _ in PUBLISHED] == PUBLISHED


def test_every_lane_gives_the_published_numbers():
    stream = stream_of([(1, 2, 3, 4)] * LANES)
    words = np.reshape(outputs(stream, LANES * len(PUBLISHED)), (-1, LANES))
    np.testing.assert_array_equal(words.T, np.array([PUBLISHED] * LANES, np.uint64))


def test_lanes_follow_the_reference_in_value_and_state():
    stream = stream_of(STATES)
    generators = [twins.xoshiro(state) for state in STATES]
    for _ in range(5):
        rounds = [[next(one) for one in generators] for _ in range(streams.BLOCK // LANES)]
        assert outputs(stream, streams.BLOCK) == [word for row in rounds for word, _ in row]
        assert twins.lanes_of(stream) == [state for _, state in rounds[-1]]


@pytest.mark.parametrize("sizes", [(300, 1, 7), (1, 256, 255), (32, 1000), (255,)], ids=str)
def test_blocks_and_single_words_take_turns_in_order(sizes):
    """What a block gives ends with the words that are there: the rest is the next block's."""
    stream = streams.new_stream(3, "blocks")
    wanted, found = twins.words_of(stream.copy()), []
    for size in sizes * 4:
        left = twins.left_in_block(stream)
        start, stop = streams.next_block(size, stream)
        assert stop - start == min(size, left)
        found += map(int, stream[start:stop])
        found += outputs(stream, 3)
    assert found == list(itertools.islice(wanted, len(found)))


def test_states_are_compared_by_the_words_that_were_taken():
    stream = streams.new_stream(3, "same")
    before = stream.copy()
    for _ in range(2 * streams.BLOCK + 1):
        assert streams.same_state(stream, before)
        outputs(stream, 1)
        assert not streams.same_state(stream, before)
        outputs(before, 1)


def test_a_copy_goes_on_from_the_same_place():
    stream = streams.new_stream(3, "copy")
    outputs(stream, 77)
    copy = np.zeros_like(stream)
    streams.copy_state(stream, copy)
    assert outputs(copy, 400) == outputs(stream, 400)


def test_lanes_of_all_streams_are_distinct():
    """500 neighbours' 4000 states of four words, none of which occurs twice."""
    found = [streams.new_stream(k // 50, "case", k % 50)[: streams.PLACE] for k in range(500)]
    assert np.unique(found).size == 500 * streams.PLACE


def test_streams_differ_by_seed_name_and_replicate():
    words = [streams.new_stream(*key)[: streams.PLACE] for key in KEYS]
    assert np.unique(words).size == len(KEYS) * streams.PLACE


@pytest.mark.parametrize("key", KEYS[::6])
def test_same_arguments_same_bits_in_an_array_of_its_own(key):
    first, second = streams.new_stream(*key), streams.new_stream(*key)
    assert (first.dtype, first.shape) == (np.uint64, (streams.END,))
    expected = outputs(first, 5)
    assert outputs(second, 5) == expected


def test_same_bits_in_another_process():
    """The name enters by a hash that does not change from process to process."""
    code = "from kacsim.streams import new_stream; print(*new_stream(3, 'kac-bird', 2))"
    environment = os.environ | {"PYTHONHASHSEED": "77", "PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-c", code]
    answer = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert [int(word) for word in answer.stdout.split()] == list(
        map(int, streams.new_stream(3, "kac-bird", 2))
    )


def correlation_z(a, b):
    """Return z of the number of equal bits of two streams: half of them if independent."""
    differing = sum((x ^ y).bit_count() for x, y in zip(a, b, strict=True))
    return compare.of_share(differing, 64 * len(a), 0.5)


def test_replicates_are_uncorrelated(seed):
    """Null: bits of different streams agree half the time. 3.2e6 bits see a share of 0.5011.

    Negative control: a stream against itself, as if the replicate did not enter.
    """
    n = compare.scaled(50_000)
    first, second = (outputs(streams.new_stream(seed, "case", k), n) for k in range(2))
    assert compare.ok(correlation_z(first, second))
    assert compare.caught(correlation_z(first, first))


def test_lanes_are_uncorrelated(seed):
    """Null: bits of neighbouring lanes agree half the time. 3.2e6 bits see a share of 0.5011.

    Negative control: a lane against itself, as if all had one state.
    """
    words = np.array(outputs(streams.new_stream(seed, "lanes"), compare.scaled(100_000)), object)
    lanes = words.reshape(-1, LANES).T
    assert compare.ok(correlation_z(np.concatenate(lanes[::2]), np.concatenate(lanes[1::2])))
    assert compare.caught(correlation_z(lanes[0], lanes[0]))
