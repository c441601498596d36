"""The samplers of the chapter, declared."""

import functools

from kacsim.checks import (
    Problem,
    bounded,
    count,
    finite,
    is_number,
    not_negative,
    one_of,
    positive,
    rising,
)
from kacsim.checks import three as three_values
from kacsim.samplers import Parameter, Sampler, real, whole
from kacsim.techniques import work
from kacsim.techniques.constants import CLOSED, LAWS

OUTSIDE = "a case carries every value that its declaration sets"

ENVELOPES = ("constant", "closer")
# The generator's name is that of the function that counts its points.
GENERATORS = ("good", "exhausted", "congruential", "sobol")
LARGEST_EDGE = 400  # cells along an edge: the counting table has 4 edge**2 places
LARGEST_DIMENSION = 8
LARGEST_CIRCLE = 10**8  # cells along an edge, whose squares stay whole numbers
WAYS = ("flight", "steps", "derivative")  # to draw a pair: functions by_{way}
TABLE_MEGABYTES = 0.25  # of one replicate's counts by cell


def rejection(*, law, envelope):
    """Yield the problem of an envelope that the law does not have."""
    if envelope == "closer" and law != "kac_initial":
        yield Problem("envelope", envelope, "only kac_initial has a closer envelope")


def correlated(name, value):
    """Yield a problem unless the value is a correlation."""
    if not is_number(value) or not -1.0 < value < 1.0:
        yield Problem(name, value, "must be a number between -1 and 1")


def edges_grow(*, smallest, largest, n_edges):
    """Yield the problem of a range of edges that ends before it begins."""
    if largest <= smallest:
        yield Problem("largest", largest, f"must be greater than smallest = {smallest}")


def law(allowed=LAWS):
    """Return the parameter that names a law."""
    check = functools.partial(one_of, allowed=allowed)
    return Parameter("law", "", f"name of the law: {', '.join(allowed)}", check)


def word(name, allowed):
    """Return a parameter that is one of some words."""
    check = functools.partial(one_of, allowed=allowed)
    return Parameter(name, "", f"{', '.join(allowed[:-1])} or {allowed[-1]}", check)


def vector(name, short, meaning, check=finite):
    """Return a parameter of three numbers."""
    return Parameter(name, short, meaning, check, kind=real, many=True, whole=three_values)


def several(name, short, meaning, check, whole_check=None):
    """Return a parameter of some integers."""
    return Parameter(name, short, meaning, check, kind=whole, many=True, whole=whole_check)


def tables_megabytes(parameters):
    """Return the memory of one replicate's counts by cell, table by table."""
    return TABLE_MEGABYTES * len(parameters.get("n_table", [1]))


DIMENSIONS = several(
    "dimension", "d", "dimensions of the spheres",
    functools.partial(bounded, least=1, most=LARGEST_DIMENSION),
)  # fmt: skip
CELLS = functools.partial(bounded, least=1, most=LARGEST_CIRCLE)
LATTICES = functools.partial(bounded, least=1, most=10**7)
POINTS = several("n_points", "n", "numbers of points, growing", count, rising)
TEMPERATURE = Parameter(
    "temperature", "temp", "T/m, variance of a velocity component", positive, kind=real
)
DRIFT = vector("drift", "drift", "drift velocity, three components")
GAS = (
    Parameter("density", "n", "particles per volume", positive, kind=real),
    TEMPERATURE,
    DRIFT,
    vector("half_width", "box", "half widths of the cuboid, three", positive),
    Parameter("step", "dt", "duration of a step", positive, kind=real),
)
GAS_NAMES = tuple(parameter.name for parameter in GAS)
TINY_GAS = {
    "density": 1.0, "temperature": 1.0, "drift": [0.1, 0.0, 0.0], "half_width": [1.0] * 3,
    "step": 0.1,
}  # fmt: skip
sampler = functools.partial(Sampler, replicate_megabytes=tables_megabytes)
SAMPLERS = (
    sampler(
        "inverse_transform", "values of a law through tables of several sizes",
        (law(), several("n_table", "table", "intervals of the tables", count)),
        ({"law": "ramp", "n_table": [2]},), kernels="inverse_transform", work=work.of_tables,
    ),
    sampler(
        "inversion", "values of a law by its inverted cumulative function",
        (law(CLOSED), Parameter("rate", "rate", "rate of the law", positive, kind=real)),
        ({"law": "ramp", "rate": 1.0},), kernels="inverse_transform",
    ),
    sampler(
        "rejection", "values of a law by rejection under an envelope",
        (law(), word("envelope", ENVELOPES)),
        ({"law": "ramp", "envelope": "constant"},), kernels="rejection", check=rejection,
    ),
    sampler("identity", "values of f0 by the Gamma identity", (), ({},), kernels="identity"),
    sampler(
        "injection", "particles injected through the faces of a cuboid", GAS, (TINY_GAS,),
        kernels="injection", work=work.of_injection,
    ),
    sampler(
        "outer_gas", "particles of an outer gas that fly into a cuboid", GAS, (TINY_GAS,),
        kernels="injection", work=work.of_outer_gas,
    ),
    sampler(
        "weighted_particles", "particles injected from weighted representatives",
        (
            Parameter(
                "n_representatives", "n", "number of representative particles", count, kind=whole
            ),
            TEMPERATURE,
            DRIFT,
        ),
        ({"n_representatives": 50, "temperature": 1.0, "drift": [0.0] * 3},), kernels="particles",
    ),
    sampler(
        "entering_pairs", "pairs of correlated velocities that enter through a face",
        (
            word("way", WAYS),
            Parameter("correlation", "rho", "of both velocities", correlated, kind=real),
        ),
        tuple({"way": name, "correlation": 0.5} for name in WAYS), kernels="pairs",
        entries=lambda parameters: (f"by_{parameters['way']}",),
    ),
    sampler(
        "sphere_lattice", "volumes of spheres on lattices",
        (
            DIMENSIONS,
            several(
                "edge", "m", "points per edge of the lattices",
                functools.partial(bounded, least=1, most=LARGEST_EDGE),
            ),
        ),
        ({"dimension": [2], "edge": [2]},), kernels="integration", work=work.of_lattices,
        by_replicate=False,
    ),
    sampler(
        "circle_lattice", "volumes of circles on lattices of many sizes",
        (
            Parameter("smallest", "m", "points per edge of the smallest", CELLS, kind=whole),
            Parameter("largest", "to", "points per edge of the largest", CELLS, kind=whole),
            Parameter("n_edges", "n", "number of lattices", LATTICES, kind=whole),
        ),
        ({"smallest": 2, "largest": 9, "n_edges": 3},), kernels="circles", check=edges_grow,
        work=work.of_circles, by_replicate=False,
    ),
    sampler(
        "sphere_points", "volumes of spheres with random or quasi-random points",
        (word("generator", GENERATORS), DIMENSIONS, POINTS),
        tuple({"generator": name, "dimension": [2], "n_points": [2]} for name in GENERATORS),
        kernels="integration", work=work.of_points,
        entries=lambda parameters: (f"count_{parameters['generator']}",),
    ),
    sampler(
        "area", "the area under (1 - x^2)^exponent with random points",
        (
            Parameter("exponent", "power", "exponent of 1 - x^2", not_negative, kind=real),
            POINTS,
        ),
        ({"exponent": 0.3, "n_points": [2]},), kernels="integration", work=work.of_points,
    ),
)  # fmt: skip
