"""Independent random streams: the only place that makes one.

The generator is xoshiro256++ 1.0 (Blackman and Vigna, ACM Trans. Math. Softw. 47, 2021), inlined
into the kernels; its 256 bits of state come from numpy's ``SeedSequence``. A stream belongs to a
(seed, name, replicate): results do not depend on the number of jobs or on their order.
"""

import hashlib

import numpy as np
from numba import int64, uint64

from kacsim.kernels.jit import apart, inlined
from kacsim.kernels.lanes import LANES, fill

# A stream is one array: the lanes' states, the place of the next word, words.
PLACE = 4 * LANES
FIRST = PLACE + LANES
BLOCK = 256  # words made at a time
END = FIRST + BLOCK

CHUNK = 8192  # draws of one call of a kernel, which are then summed


def new_stream(seed, name="", replicate=0):
    """Return the state of one stream.

    Parameters
    ----------
    seed : int >= 0, of any size
    name : str, what the stream is for, e.g. a case id; other names give independent streams
    replicate : int >= 0

    Returns
    -------
    uint64[4], advanced in place by the functions of `kacsim.variates`
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
    """Return the stream's next words as a part of it, at least one and at most n."""
    place = int64(stream[PLACE])
    if place == END:
        refill(stream)
        place = FIRST
    stop = min(place + n, END)
    stream[PLACE] = uint64(stop)
    return place, stop


@apart
def refill(stream):
    """Put new words into the buffer."""
    fill(stream, 0, FIRST, END)
