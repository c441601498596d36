"""Independent random streams: the only place that makes one.

The generator is xoshiro256++ 1.0 (Blackman and Vigna, ACM Trans. Math. Softw. 47, 2021), inlined
into the kernels; its 256 bits of state come from numpy's ``SeedSequence``. A stream belongs to a
(seed, name, replicate): results do not depend on the number of jobs or on their order.
"""

import hashlib

import numpy as np
from numba import uint64

from kacsim.kernels.jit import inlined

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
    return np.random.SeedSequence(entropy).generate_state(4, np.uint64)


def _words(number):
    """Return a non-negative integer as its 32-bit words, lowest first, at least one."""
    words = [number & 0xFFFFFFFF]
    while number := number >> 32:
        words.append(number & 0xFFFFFFFF)
    return words


@inlined
def next_bits(stream):
    """Advance the stream by one step; return 64 random bits (uint64)."""
    s0, s1, s2, s3 = stream[0], stream[1], stream[2], stream[3]
    sum03 = s0 + s3
    bits = ((sum03 << uint64(23)) | (sum03 >> uint64(41))) + s0
    shifted = s1 << uint64(17)
    s2 ^= s0
    s3 ^= s1
    stream[1] = s1 ^ s2
    stream[0] = s0 ^ s3
    stream[2] = s2 ^ shifted
    stream[3] = (s3 << uint64(45)) | (s3 >> uint64(19))
    return bits
