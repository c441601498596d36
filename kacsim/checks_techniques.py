"""What the samplers of the chapter accept: light, like `kacsim.checks`."""

import itertools

from kacsim.checks import (
    Problem,
    _is_integer,
    count,
    finite,
    not_negative,
    one_of,
    positive,
)

# law -> (lower, upper) end of its table or box; beyond them f0 has 8e-11 and the exponential 6e-6
SUPPORT = {
    "kac_initial": (-5.0, 5.0),
    "exponential": (0.0, 12.0),
    "ramp": (0.0, 1.0),
    "triangle": (0.0, 1.0),
}
LAWS = tuple(SUPPORT)
CLOSED = ("exponential", "ramp", "triangle")  # cumulative functions with an inverse in closed form
ENVELOPES = ("constant", "closer")
GENERATORS = ("good", "exhausted", "congruential", "sobol")
AXES = ("x", "y", "z")
FACES = ("-x", "+x", "-y", "+y", "-z", "+z")  # the normal that points inward is the opposite one
LARGEST_EDGE = 400  # cells along an edge: the counting table has 4 edge**2 places
LARGEST_DIMENSION = 8


def listed(name, values, check):
    """Yield the problems of a list that must not be empty."""
    if not isinstance(values, (list, tuple)) or not values:
        yield Problem(name, values, "must be a list of numbers")
        return
    for value in values:
        yield from check(name, value)


def vector(name, value, check=finite):
    """Yield a problem unless the value is three numbers that pass a check."""
    if not isinstance(value, (list, tuple)) or len(value) != len(AXES):
        yield Problem(name, value, "must be three numbers, along x, y and z")
        return
    for one in value:
        yield from check(name, one)


def bounded(name, value, least, most):
    """Yield a problem unless the value is an integer between two bounds."""
    if not _is_integer(value) or not least <= value <= most:
        yield Problem(name, value, f"must be an integer from {least} to {most}")


def rising(name, values):
    """Yield a problem unless the values are integers that grow."""
    wrong = list(listed(name, values, count))
    yield from wrong
    if not wrong and any(b <= a for a, b in itertools.pairwise(values)):
        yield Problem(name, values, "must grow from each value to the next")


def inverse_transform(*, law, n_table):
    """Yield the problems of draws through tables of several sizes."""
    yield from one_of("law", law, LAWS)
    yield from listed("n_table", n_table, count)


def inversion(*, law, rate):
    """Yield the problems of draws by a cumulative function inverted in closed form."""
    yield from one_of("law", law, CLOSED)
    yield from positive("rate", rate)


def rejection(*, law, envelope):
    """Yield the problems of draws by rejection."""
    yield from one_of("law", law, LAWS)
    yield from one_of("envelope", envelope, ENVELOPES)
    if envelope == "closer" and law != "kac_initial":
        yield Problem("envelope", envelope, "only kac_initial has a closer envelope")


def identity():
    """Yield the problems of draws of f0 by the Gamma identity: it has no parameters."""
    yield from ()


def injection(*, density, temperature, drift, half_width, step):
    """Yield the problems of injection from a drifting Maxwellian gas into a cuboid."""
    yield from positive("density", density)
    yield from positive("temperature", temperature)
    yield from vector("drift", drift)
    yield from vector("half_width", half_width, positive)
    yield from positive("step", step)


outer_gas = injection


def weighted_particles(*, n_representatives, temperature, drift):
    """Yield the problems of injection from weighted particles."""
    yield from count("n_representatives", n_representatives)
    yield from positive("temperature", temperature)
    yield from vector("drift", drift)


def sphere_lattice(*, dimension, edge):
    """Yield the problems of spheres measured on lattices."""
    yield from listed("dimension", dimension, lambda n, v: bounded(n, v, 1, LARGEST_DIMENSION))
    yield from listed("edge", edge, lambda n, v: bounded(n, v, 1, LARGEST_EDGE))


def sphere_points(*, generator, dimension, n_points):
    """Yield the problems of spheres measured with random or quasi-random points."""
    yield from one_of("generator", generator, GENERATORS)
    yield from listed("dimension", dimension, lambda n, v: bounded(n, v, 1, LARGEST_DIMENSION))
    yield from rising("n_points", n_points)


def area(*, exponent, n_points):
    """Yield the problems of the area under (1 - x**2)**exponent."""
    yield from not_negative("exponent", exponent)
    yield from rising("n_points", n_points)
