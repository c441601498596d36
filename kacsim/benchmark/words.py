"""The random words that a kernel takes from its stream, and what they cost alone."""

import numpy as np
from numba import int64, uint64

from kacsim.kernels.jit import kernel
from kacsim.streams import BLOCK, PLACE, next_bits, next_block, refill


def used(before, after, most_blocks=10**9):
    """Return how many words lie between two states of one stream.

    Parameters
    ----------
    before, after : streams, left alone
    most_blocks : int, how far to look

    Raises
    ------
    ValueError
        The second is no state of the first within so many blocks.
    """
    blocks = _blocks_between(before.copy(), after, most_blocks)
    if blocks < 0:
        raise ValueError(f"after: is no state of the stream within {most_blocks} blocks")
    return blocks * BLOCK + int(after[PLACE]) - int(before[PLACE])


@kernel
def _blocks_between(walker, goal, most):
    for blocks in range(most):
        if np.array_equal(walker[:PLACE], goal[:PLACE]):
            return blocks
        refill(walker)
    return -1


@kernel
def add_by_calls(n, stream):
    """Return the sum of the stream's next n words, each by a call."""
    total = uint64(0)
    for _ in range(n):
        total += next_bits(stream)
    return total


@kernel
def add_in_blocks(n, stream):
    """Return the sum of the stream's next n words, as many at a time as there are."""
    total, done = uint64(0), int64(0)
    while done < n:
        start, stop = next_block(n - done, stream)
        for word in stream[start:stop]:
            total += word
        done += stop - start
    return total


@kernel
def move(source, target, n):
    """Copy n words to and fro between two arrays of the same size."""
    left = int64(n)
    while left > 0:
        part = min(left, source.size)
        for k in range(part):
            target[k] = source[k]
        left -= part
        part = min(left, source.size)
        for k in range(part):
            source[k] = target[k]
        left -= part
