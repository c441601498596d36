"""Plain-Python twins of the generator and of variates, on integers and one word at a time."""

import math

from kacsim import streams, variate_tables
from kacsim import variates as random

MASK = 2**64 - 1


def rotate(x, k):
    return ((x << k) | (x >> (64 - k))) & MASK


def xoshiro(state):
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


def lanes_of(stream):
    """Return the states of a stream's generators, four words each."""
    words = [int(word) for word in stream[: 4 * streams.LANES]]
    return [tuple(words[lane :: streams.LANES]) for lane in range(streams.LANES)]


def words_of(stream):
    """Yield the words of a new stream: one of each of its generators in turn, without end."""
    generators = [xoshiro(state) for state in lanes_of(stream)]
    while True:
        yield from (next(generator)[0] for generator in generators)


def left_in_block(stream):
    """Return how many words the stream hands out before it makes a new block of them, or all."""
    return streams.END - int(stream[streams.PLACE]) or streams.BLOCK


def two_below(n, m, word):
    """Return a number below n and one below m: the digits of word / 2**64 to these bases."""
    first, rest = divmod(word * n, 2**64)
    return first, rest * m // 2**64


def turned_by(word):
    """Return an angle: one of equally many steps around the circle, and half a step to each side.

    The lowest bits choose the step, the others are a signed fraction.
    """
    points = variate_tables.POINTS
    fraction = (word >> 11) / 2**53
    return 2 * math.pi / points * (word % points + fraction - (fraction >= 0.5))


def speed(word, stream):
    """Return a variate of density 4 / sqrt(pi) x**2 exp(-x**2), of which one word is drawn.

    Boxes of equal area stand side by side below the density's maximum of 1, a tail after them. A
    height within a box that is surely below the density is as good as a place.
    """
    box, height = word % 256, (word >> 11) / 2**53
    left, width = variate_tables.SPEED_EDGE[box], variate_tables.SPEED_WIDTH[box]
    if box == 255:
        return speed_in_tail(left, stream)
    least, most = variate_tables.SPEED_LEAST[box], variate_tables.SPEED_LARGEST[box]
    sure = math.floor(least / most * 2**53) / 2**53
    if height < sure:
        return left + height / sure * width
    x = left + random.uniform(stream) * width
    if least + random.uniform(stream) * (most - least) < x**2 * math.exp(1 - x**2):
        return x
    return speed(int(streams.next_bits(stream)), stream)


def speed_in_tail(least, stream):
    """Return a speed beyond `least`: its square exceeds least**2 by a thinned exponential share."""
    while True:
        share = random.exponential(stream) / (least**2 - 0.5)
        if random.uniform(stream) < math.sqrt(1 + share) * math.exp(-share / 2):
            return least * math.sqrt(1 + share)


def energies(n, stream):
    """Return n squared speeds: of the rest of a block of words first what they surely give."""
    found = []
    while len(found) < n:
        here = min(n - len(found), left_in_block(stream))
        words = [int(streams.next_bits(stream)) for _ in range(here)]
        found += [speed(word, stream) ** 2 for word in words]
    return found
