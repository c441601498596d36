"""What numba lacks and LLVM has, against Python integers: lanes of a generator, a long product."""

import itertools

import numba
import numpy as np
import pytest

from kacsim.kernels import lanes, wide
from kacsim.kernels.jit import inlined

MASK = 2**64 - 1
EDGES = [0, 1, 2, 2**32 - 1, 2**32, 2**32 + 1, 2**63 - 1, 2**63, MASK - 1, MASK]


@numba.njit
def compiled_fill(array, state, start, stop):
    lanes.fill(array, state, start, stop)


@inlined
def borrowed(array, state, start, stop):
    """Fill as `kacsim.streams` does, without references."""
    lanes.fill(array, state, start, stop)


@numba.njit
def compiled_product(a, b):
    return wide.product(a, b)


# (place of the states, first place filled, one past the last): states before and behind, at places
# that no vector is aligned to, one word of each lane and none
@pytest.mark.parametrize(
    ("state", "start", "stop"), [(0, 33, 289), (3, 40, 48), (301, 5, 205), (0, 32, 32)]
)
@pytest.mark.parametrize("fill", [compiled_fill, borrowed])
def test_lanes_are_filled_as_in_python(fill, state, start, stop):
    before = np.random.default_rng(4).integers(0, 2**64, 340, np.uint64)
    array, wanted = before.copy(), before.copy()
    for _ in range(3):
        fill(array, state, start, stop)
        lanes.fill(wanted, state, start, stop)
        np.testing.assert_array_equal(array, wanted)
    changed = np.flatnonzero(array != before)
    of_state = np.arange(state, state + 4 * lanes.LANES)
    expected = np.r_[of_state, np.arange(start, stop)] if stop > start else []
    np.testing.assert_array_equal(changed, np.sort(expected))


def test_products_are_pythons():
    rng = np.random.default_rng(5)
    pairs = [*itertools.product(EDGES, EDGES), *rng.integers(0, 2**64, (500, 2), np.uint64)]
    for a, b in pairs:
        high, low = divmod(int(a) * int(b), 2**64)
        given = np.uint64(a), np.uint64(b)
        assert wide.product(*given) == (high, low)
        assert compiled_product(*given) == (high, low)
