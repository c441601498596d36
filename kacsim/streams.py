"""Independent random streams: the only place that makes one.

The generator is xoshiro256++ 1.0 (Blackman and Vigna, ACM Trans. Math. Softw. 47, 2021) in eight
lanes: independent states from numpy's ``SeedSequence``, whose words are handed out in turn. Lanes
advance side by side in vector registers, a block of words at a time. A stream belongs to a (seed,
name, replicate): results do not depend on the number of jobs or on their order.
"""

import hashlib

import numpy as np
from numba import int64, uint64

from kacsim.kernels.jit import apart, inlined
from kacsim.kernels.lanes import LANES, fill

BLOCK = 256  # words made at a time
PLACE = 4 * LANES
FIRST = PLACE + LANES
END = FIRST + BLOCK

CHUNK = 8192  # draws of one call of a kernel, which are then summed


def new_stream(seed, name="", replicate=0):
    """Return a new stream.

    Parameters
    ----------
    seed : int >= 0, of any size
    name : str, what the stream is for, e.g. a case id; other names give independent streams
    replicate : int >= 0

    Returns
    -------
    uint64[END], advanced in place by the functions of `kacsim.variates`: the lanes' states, the
    place of the next word, a block of words
    """
    words = np.frombuffer(hashlib.sha256(name.encode()).digest(), dtype="<u4")
    # The length first: SeedSequence pads with zeros, so two entropies could coincide without it.
    seed_words = _words(seed)
    entropy = [len(seed_words), *seed_words, *map(int, words), *_words(replicate)]
    stream = np.zeros(END, np.uint64)
    stream[:PLACE] = np.random.SeedSequence(entropy).generate_state(4 * LANES, np.uint64)
    stream[PLACE] = END
    return stream


def _words(number):
    """Return a non-negative integer as its 32-bit words, lowest first, at least one."""
    words = [number & 0xFFFFFFFF]
    while number := number >> 32:
        words.append(number & 0xFFFFFFFF)
    return words


@inlined
def next_bits(stream):
    """Return the stream's next 64 random bits (uint64)."""
    place = stream[PLACE]
    if place == uint64(END):
        refill(stream)
        place = uint64(FIRST)
    stream[PLACE] = place + uint64(1)
    return stream[place]


@inlined
def next_block(n, stream):
    """Take the stream's next words, at least one and at most n; return their (start, stop)."""
    place = int64(stream[PLACE])
    if place == END:
        refill(stream)
        place = FIRST
    stop = min(place + n, END)
    stream[PLACE] = uint64(stop)
    return place, stop


@inlined
def copy_state(stream, copy):
    """Make an array of the same size a copy of a stream."""
    for k in range(END):
        copy[k] = stream[k]


@inlined
def same_state(stream, other):
    """Return whether copies of one stream have handed out equally many words (one lane tells)."""
    return stream[0] == other[0] and stream[PLACE] == other[PLACE]


@apart
def refill(stream):
    """Put a new block of words into the stream."""
    fill(stream, 0, FIRST, END)
