"""Write the package's random bits to standard output, for a battery of tests.

python tests/battery.py --streams 8192 --seed 1 | dieharder -a -g 200

Many streams are written word by word, the first word of each, then the second of each: streams that
depended on each other, which a battery over one of them cannot see, would be neighbours.
"""

import argparse
import sys

import numba
import numpy as np

from kacsim.streams import new_stream, next_bits


@numba.njit
def fill(buffer, streams):
    """Fill uint64[rows, streams], row by row, with the next output of each stream."""
    for row in range(buffer.shape[0]):
        for k in range(buffer.shape[1]):
            buffer[row, k] = next_bits(streams[k])


def main():
    """Write until the reader closes the pipe."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--streams", type=int, default=1, help="as many replicates of one name")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    streams = np.array([new_stream(options.seed, "battery", k) for k in range(options.streams)])
    buffer = np.empty((max(1, (1 << 16) // options.streams), options.streams), np.uint64)
    try:
        while True:
            fill(buffer, streams)
            sys.stdout.buffer.write(buffer.tobytes())
    except BrokenPipeError:
        sys.stderr.close()


if __name__ == "__main__":
    main()
