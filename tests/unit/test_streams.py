"""The streams: xoshiro256++ as published, and a stream of its own for every seed, name, replicate.

One z test of 6.3e-5.
"""

import os
import subprocess
import sys

import numpy as np
import pytest
from law import compare

from kacsim import streams

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


def rotate(x, k):
    return ((x << k) | (x >> (64 - k))) & MASK


def reference(state):
    """Yield (output, next state) of xoshiro256++ 1.0, from its description, on Python integers."""
    s = list(state)
    while True:
        output = (rotate((s[0] + s[3]) & MASK, 23) + s[0]) & MASK
        t = (s[1] << 17) & MASK
        s[2] ^= s[0]
        s[3] ^= s[1]
        s[1] ^= s[2]
        s[0] ^= s[3]
        s[2] ^= t
        s[3] = rotate(s[3], 45)
        yield output, tuple(s)


def outputs(state, n):
    return [int(streams.next_bits(state)) % 2**64 for _ in range(n)]


def test_reference_gives_the_published_numbers():
    generator = reference((1, 2, 3, 4))
    assert [next(generator)[0] for _ in PUBLISHED] == PUBLISHED


def test_generator_gives_the_published_numbers():
    assert outputs(np.array([1, 2, 3, 4], np.uint64), len(PUBLISHED)) == PUBLISHED


@pytest.mark.parametrize(
    "state", [(1, 2, 3, 4), (MASK,) * 4, (1 << 63, 0, 0, 1), tuple(range(MASK - 3, MASK + 1))]
)
def test_generator_follows_the_reference_in_value_and_state(state):
    mine, generator = np.array(state, np.uint64), reference(state)
    for _ in range(1000):
        expected, after = next(generator)
        assert outputs(mine, 1) == [expected]
        assert tuple(map(int, mine)) == after


def test_streams_differ_by_seed_name_and_replicate():
    states = {tuple(map(int, streams.new_stream(*key))) for key in KEYS}
    assert len(states) == len(KEYS)
    words = [word for state in states for word in state]
    assert len(set(words)) == len(words)


@pytest.mark.parametrize("key", KEYS[::6])
def test_same_arguments_same_bits_in_an_array_of_its_own(key):
    first, second = streams.new_stream(*key), streams.new_stream(*key)
    assert (first.dtype, first.shape) == (np.uint64, (4,))
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
