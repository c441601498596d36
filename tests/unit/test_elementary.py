"""Elementary functions against mpmath: a million arguments each, and the edges.

The C library's extended precision, where the machine has it, tells which of the million err most;
those are measured. No random stream, no statistics: the arguments are the same in every run.
"""

import math

import mpmath
import numba
import numpy as np
import pytest

from kacsim.boltzmann.constants import LARGEST_PHASE
from kacsim.elementary import circular, exponential, gaussian, logarithm

N = 1_000_000
MEASURED = 400  # by mpmath, of the arguments of each range
EXTENDED = np.finfo(np.longdouble).nmant >= 63
mpmath.mp.prec = 250


def compiled(function):
    """Return the function of arrays: float64[n] -> float64[n]."""

    @numba.njit(error_model="numpy")
    def fill(x, out):
        for k in range(x.size):
            out[k] = function(x[k])

    def of_array(x):
        out = np.empty(x.size)
        fill(np.ascontiguousarray(x), out)
        return out

    return of_array


def units(value, exact):
    """Return the error of a float in units in the last place."""
    nearest = float(exact)
    if not math.isfinite(nearest):
        return 0.0 if value == nearest else math.inf
    unit = mpmath.mpf(float(np.spacing(abs(nearest))))
    return float(abs(mpmath.mpf(float(value)) - exact) / unit)


def worst(function, exact, extended, x):
    """Return (largest error, its argument) of a function of arrays."""
    values = function(x)
    if extended and EXTENDED:
        with np.errstate(all="ignore"):
            near = extended(x.astype(np.longdouble))
            error = np.abs(values - near) / np.spacing(np.abs(near.astype(float)))
        chosen = np.argsort(np.nan_to_num(error.astype(float), nan=np.inf))[-MEASURED:]
    else:
        chosen = np.linspace(0, x.size - 1, min(x.size, 10 * MEASURED)).astype(int)
    found = [(units(values[k], exact(mpmath.mpf(float(x[k])))), float(x[k])) for k in chosen]
    return max(found)


def spread(*ranges):
    """Return N arguments from ranges (low, high), alike from each."""
    rng = np.random.default_rng(1)
    return [rng.uniform(low, high, N // len(ranges)) for low, high in ranges]


def neighbours(points):
    """Return the points and the floats beside them."""
    points = np.asarray(points, dtype=float)
    return np.r_[np.nextafter(points, -np.inf), points, np.nextafter(points, np.inf)]


def powers(low, high, base=10.0):
    """Return N // 4 numbers of both signs whose logarithms are spread evenly."""
    sizes = base ** np.random.default_rng(2).uniform(low, high, N // 8)
    return np.r_[sizes, -sizes]


cosine = numba.njit(lambda x: circular.cos_sin(x)[0])
sine = numba.njit(lambda x: circular.cos_sin(x)[1])
AXES = np.arange(-6000, 6000) * (math.pi / 2)
OCTANTS = np.arange(-700, 700) * (math.pi / 256)
# name -> (function, its exact value, in extended precision, ranges of arguments, allowed error)
FUNCTIONS = {
    "exp": (
        exponential.exp,
        mpmath.exp,
        np.exp,
        [
            *spread((-708.3, 709.78), (-40.0, 0.0), (-1.0, 1.0), (-745.0, -708.0)),
            powers(-20, 0),
            neighbours((np.arange(-2000, 2000) + 0.5) * math.log(2.0) / 128.0),
            neighbours([0.0, -708.0, 709.0, 709.78, -745.1, -708.396]),
        ],
        1.0,
    ),
    "expm1": (
        exponential.expm1,
        mpmath.expm1,
        np.expm1,
        [
            *spread((-45.0, 5.0), (-1.0, 1.0), (-0.01, 0.01), (-40.0, 700.0)),
            powers(-20, 0),
            neighbours((np.arange(-300, 300) + 0.5) * math.log(2.0) / 128.0),
            neighbours([2.0**-7, -(2.0**-7), -40.0, 700.0, math.log(2.0), -math.log(2.0)]),
        ],
        1.0,
    ),
    "log": (
        logarithm.log,
        mpmath.log,
        np.log,
        [
            *spread((0.0, 1.0), (0.9, 1.1), (0.5, 3.0)),
            abs(powers(-300, 300)),
            abs(powers(-1074, -1021, 2.0)),
            neighbours(2.0 ** np.arange(-1022, 1024)),
            neighbours(np.arange(88, 177) / 128.0),
            neighbours([2.0**-1022, 5e-324, 1.7976931348623155e308, 1.0]),
        ],
        1.0,
    ),
    "log1p": (
        logarithm.log1p,
        mpmath.log1p,
        np.log1p,
        [
            *spread((-1.0, 1.0), (-0.01, 0.01), (0.0, 100.0)),
            np.maximum(powers(-18, 0), -1.0 + 2.0**-53),
            abs(powers(0, 20)),
            neighbours(np.arange(88, 177) / 128.0 - 1.0),
            neighbours([2.0**53, -0.5, 1.0, 2.0**-53, -(2.0**-53)]),
        ],
        1.0,
    ),
    "cos": (cosine, mpmath.cos, np.cos, [], 1.0),
    "sin": (sine, mpmath.sin, np.sin, [], 1.0),
    "erfc": (
        gaussian.erfc,
        mpmath.erfc,
        None,
        [
            *spread((-6.0, 6.0), (0.0, 26.5), (26.5, 27.2)),
            powers(-20, 0),
            neighbours((np.arange(-40, 200) + 0.5) / 8.0),
        ],
        4.0,
    ),
    "normal_cumulative": (
        gaussian.normal_cumulative,
        lambda x: mpmath.erfc(-x / mpmath.sqrt(2)) / 2,
        None,
        [*spread((-8.0, 8.0), (-37.5, 0.0), (-38.5, -37.5)), powers(-20, 0)],
        4.0,
    ),
}
for name in ("cos", "sin"):
    FUNCTIONS[name][3].extend(
        [
            *spread((-0.2, 0.2), (-7.0, 7.0), (-100.0, 100.0), (-1e4, 1e4)),
            neighbours(AXES),
            neighbours(OCTANTS),
            powers(-20, 0),
        ]
    )


@pytest.mark.parametrize("name", FUNCTIONS)
def test_errors(name):
    function, exact, extended, ranges, allowed = FUNCTIONS[name]
    assert sum(x.size for x in ranges) >= N
    of_array = compiled(function)
    for x in ranges:
        error, where = worst(of_array, exact, extended, x)
        assert error <= allowed, f"{name}({where!r}) errs by {error:.2f} units"


@pytest.mark.parametrize("exponent", [0.3, 0.0, 1.0, 2.5, -1.5, 37.7, 200.0])
def test_errors_of_powers(exponent):
    """(1 - x**2)**exponent is integrated; elsewhere powers are products and roots."""
    of_array = compiled(numba.njit(lambda x: logarithm.power(x, exponent)))
    reach = 700.0 / max(1.0, abs(exponent)) / math.log(10.0)
    ranges = [*spread((0.05, 1.0), (0.9, 1.1)), abs(powers(-min(300.0, reach), min(300.0, reach)))]
    for x in [*ranges, neighbours(np.arange(88, 177) / 128.0)]:
        error, where = worst(
            of_array,
            lambda value: mpmath.power(value, mpmath.mpf(exponent)),
            lambda value: value ** np.longdouble(exponent),
            x,
        )
        assert error <= 1.0, f"{where!r} ** {exponent} errs by {error:.2f} units"


INF, NAN = math.inf, math.nan
SPECIAL = {
    exponential.exp: {0.0: 1.0, INF: INF, -INF: 0.0, NAN: NAN, 710.0: INF, -746.0: 0.0},
    exponential.expm1: {0.0: 0.0, INF: INF, -INF: -1.0, NAN: NAN, -50.0: -1.0},
    logarithm.log: {1.0: 0.0, 0.0: -INF, -1.0: NAN, INF: INF, -INF: NAN, NAN: NAN},
    logarithm.log1p: {0.0: 0.0, -1.0: -INF, -2.0: NAN, INF: INF, NAN: NAN},
    cosine: {0.0: 1.0, INF: NAN, NAN: NAN, 10000.1: NAN, -10000.1: NAN},
    sine: {0.0: 0.0, INF: NAN, NAN: NAN, 10000.1: NAN, -10000.1: NAN},
    gaussian.erfc: {0.0: 1.0, INF: 0.0, -INF: 2.0, NAN: NAN, 40.0: 0.0, -40.0: 2.0, 1e300: 0.0},
    gaussian.normal_cumulative: {0.0: 0.5, INF: 1.0, -INF: 0.0, NAN: NAN, -1e300: 0.0, 9.0: 1.0},
}


@pytest.mark.parametrize("function", SPECIAL, ids=lambda function: function.__name__)
def test_ends(function):
    """Infinities, nan and zeros, where a result is exact."""
    found = compiled(function)(np.array(list(SPECIAL[function])))
    np.testing.assert_array_equal(found, list(SPECIAL[function].values()))


def test_phases_of_the_trap_are_angles_that_are_known():
    assert LARGEST_PHASE <= circular.LARGEST_ANGLE


def test_ends_of_powers():
    wanted = {(0.0, 0.3): 0.0, (0.0, 0.0): 1.0, (0.0, -1.0): INF, (INF, 0.3): INF, (INF, -1.0): 0.0}
    wanted |= {(-1.0, 0.3): NAN, (-1.0, 0.0): 1.0, (NAN, 0.3): NAN, (1.0, 256.0): 1.0}
    found = [logarithm.power(*arguments) for arguments in wanted]
    np.testing.assert_array_equal(found, list(wanted.values()))
    assert logarithm.power(5e-324, 0.5) == 2.0**-537


def test_a_function_two_units_off_is_told():
    """Negative control of the comparison."""

    def off(x):
        return np.nextafter(np.nextafter(np.exp(x), np.inf), np.inf)

    error, _ = worst(off, mpmath.exp, np.exp, np.linspace(-1.0, 1.0, 1000))
    assert 1.5 <= error <= 3.0
