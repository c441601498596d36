"""Parameters of samplers by McKean's trees, and their checks, for two families."""

import functools

from kacsim.checks import Problem, is_number, not_negative, one_of
from kacsim.mckean.constants import LARGEST_SPEED, METHODS
from kacsim.mckean.work import mean_leaves
from kacsim.samplers import Parameter, real

OUTSIDE = "a case carries every value that its declaration sets"

METHOD = Parameter(
    "method", "", f"{', '.join(METHODS)}: leaves integrated out, one of them, and with a geometric "
    "number of leaves", functools.partial(one_of, allowed=METHODS), METHODS[0], shown=True,
)  # fmt: skip
CUT = Parameter(
    "cut", "cut", "subtrees of shares below cut / (beta eta^2) are replaced by their mean; 0: none",
    not_negative, 0.0, kind=real,
)  # fmt: skip
MCKEAN = (METHOD, CUT)


def tiny_of(axis):
    """Return the smallest parameters, once for the kernel of every method."""
    return tuple({axis: [1.0], "time": [1.0], "method": method} for method in METHODS)


def far(name, value):
    """Yield a problem unless the value is a speed up to where double precision holds something."""
    yield from not_negative(name, value)
    if is_number(value) and value > LARGEST_SPEED:
        yield Problem(name, value, f"must be at most {LARGEST_SPEED:g}: nothing is left beyond")


def mckean(*, axis, law, time, method, cut, max_nodes, collision_rate=1.0, at_speed=False, **probe):
    """Yield the problems of realizations by McKean's trees at a grid of probes.

    Parameters
    ----------
    axis : name of the grid's first axis
    at_speed : densities of velocities at speeds are drawn
    """
    if method != METHODS[0]:
        if cut > 0.0:
            yield Problem("cut", cut, f"needs method {METHODS[0]}")
        if at_speed and min(probe[axis]) == 0.0:
            yield Problem(axis, 0.0, f"needs method {METHODS[0]}: the variance is infinite there")
    leaves = mean_leaves(max(probe[axis]), collision_rate * max(time), law)
    if cut == 0.0 and leaves > max_nodes:
        sentence = f"a tree has {leaves:.0e} leaves, more than max_nodes; cut = 0.5 spares them"
        yield Problem("time", max(time), sentence)
