"""How much work a draw of the chapter is: values, particles, points and lattice cells."""

import math

from kacsim.techniques.constants import REACH, flux_at_rest

OUTSIDE = "it tells how long a job takes, and no job what to draw"


def of_tables(parameters):
    """Return the work of one value through each table."""
    n = len(parameters["n_table"])
    return {"call": n, "draw": n}


def of_injection(parameters):
    """Return the work of one step: the particles that enter a cuboid from a gas at rest."""
    a, b, c = parameters["half_width"]
    flux = flux_at_rest(parameters["density"], parameters["temperature"])
    area = 8.0 * (a * b + b * c + c * a)
    return {"draw": 1.0, "particle": area * flux * parameters["step"]}


def of_outer_gas(parameters):
    """Return the work of one step: the particles that could enter."""
    thermal, step = math.sqrt(parameters["temperature"]), parameters["step"]
    sides = (
        2.0 * (width + step * (abs(drift) + REACH * thermal))
        for width, drift in zip(parameters["half_width"], parameters["drift"], strict=True)
    )
    return {"draw": 1.0, "particle": parameters["density"] * math.prod(sides)}


def of_points(parameters):
    """Return the work of one replicate: the coordinates of the points of every dimension."""
    dimensions = parameters.get("dimension", [1])
    return {"call": len(dimensions), "draw": max(parameters["n_points"]) * sum(dimensions)}


def of_lattices(parameters):
    """Return the work of all lattices, which a convolution along each axis counts."""
    cubes = sum(edge**3 for edge in parameters["edge"])
    return {"call": 1.0, "draw": max(parameters["dimension"]) * cubes}


def of_circles(parameters):
    """Return the work of all circles: the steps along their edges, spread in the logarithm."""
    smallest, largest = parameters["smallest"], parameters["largest"]
    mean = (largest - smallest) / math.log(largest / smallest)
    return {"call": 1.0, "draw": parameters["n_edges"] * mean}
