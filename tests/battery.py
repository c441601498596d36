"""Write the package's random bits to standard output, for a battery of tests.

python tests/battery.py | dieharder -a -g 200
"""

import sys

import numba
import numpy as np

from kacsim.streams import new_stream, next_bits


@numba.njit
def fill(buffer, stream):
    """Fill a uint64 array with consecutive outputs of the stream."""
    for k in range(buffer.size):
        buffer[k] = next_bits(stream)


def main():
    """Write until the reader closes the pipe."""
    stream, buffer = new_stream(1, "battery"), np.empty(1 << 16, np.uint64)
    try:
        while True:
            fill(buffer, stream)
            sys.stdout.buffer.write(buffer.tobytes())
    except BrokenPipeError:
        sys.stderr.close()


if __name__ == "__main__":
    main()
