"""Problems, and the checks that every kind of value shares: one sentence per violation.

Nothing heavy is imported here: the plan, the command line and the Python interface all check
with these functions, so that a wrong value is refused before any work starts.
"""

import itertools
import numbers
from dataclasses import dataclass

OUTSIDE = "a check refuses a value or lets it through unchanged"

MISSING = object()  # the value of a key that should not be there
LARGEST_COUNT = 2**63 - 1  # of draws, points and the like; seeds may be larger
LARGEST = 1e50  # of any parameter: its products stay within double precision


class BudgetError(RuntimeError):
    """A realization whose tree has grown past the budget of nodes."""


@dataclass(frozen=True)
class Problem:
    """A wrong value: ``name = value: sentence``."""

    name: str
    value: object
    allowed: str

    def __str__(self):
        """Return the problem as one line."""
        return f"{self.name} = {self.value!r}: {self.allowed}"


def raise_problems(*groups):
    """Raise ValueError with the first problem of several groups, if there is one."""
    for problem in itertools.chain.from_iterable(groups):
        raise ValueError(str(problem))


def is_number(value):
    """Tell a real number that arithmetic in double precision can stand; nan and inf are none."""
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        return False
    try:
        return abs(float(value)) < LARGEST
    except OverflowError:
        return False


def is_integer(value):
    """Tell an integer; a bool is none."""
    return isinstance(value, numbers.Integral) and not isinstance(value, bool)


def positive(name, value):
    """Yield a problem unless the value is a positive finite number."""
    if not is_number(value) or value < 1.0 / LARGEST:
        yield Problem(name, value, "must be a positive finite number")


def finite(name, value):
    """Yield a problem unless the value is a finite number."""
    if not is_number(value):
        yield Problem(name, value, "must be a finite number")


def at_least(name, value, least):
    """Yield a problem unless the value is a finite number of at least `least`."""
    if not is_number(value) or value < least:
        yield Problem(name, value, f"must be a finite number of at least {least:g}")


def not_negative(name, value):
    """Yield a problem unless the value is a finite number, zero or positive."""
    yield from at_least(name, value, 0)


def count(name, value, least=1):
    """Yield a problem unless the value is an integer of at least `least`."""
    if not is_integer(value) or value < least:
        yield Problem(name, value, f"must be an integer of at least {least}")
    elif value > LARGEST_COUNT and name != "seed":
        yield Problem(name, value, f"must be at most {LARGEST_COUNT}")


def bounded(name, value, least, most):
    """Yield a problem unless the value is an integer between two bounds."""
    if not is_integer(value) or not least <= value <= most:
        yield Problem(name, value, f"must be an integer from {least} to {most}")


def one_of(name, value, allowed):
    """Yield a problem unless the value is one of the allowed words."""
    if value not in allowed:
        yield Problem(name, value, f"must be one of {', '.join(allowed)}")


def each(name, values, check):
    """Yield the problems of a list that must not be empty, value by value."""
    if not isinstance(values, (list, tuple)) or not values:
        yield Problem(name, values, "must be a list of numbers")
        return
    for value in values:
        yield from check(name, value)


def three(name, values):
    """Yield a problem unless there are three values."""
    if len(values) != 3:
        yield Problem(name, values, "must be three numbers, along x, y and z")


def rising(name, values):
    """Yield a problem unless the values grow."""
    if any(b <= a for a, b in itertools.pairwise(values)):
        yield Problem(name, values, "must grow from each value to the next")


def falling(name, values):
    """Yield a problem unless the values fall."""
    if any(b >= a for a, b in itertools.pairwise(values)):
        yield Problem(name, values, "must fall from each value to the next")


def amount(*, n_draws, n_replicates, seed, **_):
    """Yield the problems of the size and the seed of a case."""
    yield from count("n_draws", n_draws)
    yield from count("n_replicates", n_replicates)
    yield from count("seed", seed, least=0)
