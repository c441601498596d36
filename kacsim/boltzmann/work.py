"""How much work a realization by trees is: mean numbers of nodes, for the time it takes."""

import math

from kacsim import costs

OUTSIDE = "it tells how long a job takes, and no job what to draw"

LARGEST = 30.0  # exponent of the growth, whatever a configuration asks for


def nodes(time, oversampling=1.0, onset=0.0):
    """Return the mean t' drawings of one estimate: `kacsim.boltzmann.bkw.mean_recursion`."""
    growth = 2.0 * oversampling - 1.0
    early = 2.0 * math.exp(min(LARGEST, onset, time)) - 1.0
    late = math.exp(min(LARGEST, growth * max(0.0, time - onset)))
    return late * early + (late - 1.0) / growth


def of_trees(parameters, axis, counted):
    """Return the work of a realization at every probe of a grid.

    Parameters
    ----------
    axis : name of the first axis of the grid
    counted : callable(first, time, parameters) -> mean nodes of one tree
    """
    probes = [(first, time) for first in parameters[axis] for time in parameters["time"]]
    total = sum(counted(first, time, parameters) for first, time in probes)
    return {"call": len(probes), "draw": len(probes), "node": total}


def of_bkw(parameters, axis):
    """Return the work of trees that grow as exp((2 m - 1) t), m from an onset on."""

    def counted(first, time, p):
        m = first if axis == "oversampling" else p.get("oversampling", 1.0)
        return nodes(time, m, p.get("onset", 0.0))

    return of_trees(parameters, axis, counted)


def of_kac(parameters):
    """Return the work of trees that grow as exp((2 m - 1) rate t)."""
    rate = parameters["collision_rate"]

    def counted(_, time, p):
        return nodes(rate * time, p["oversampling"], rate * p["onset"])

    return of_trees(parameters, "speed", counted)


def of_extinction(parameters):
    """Return the work of binary trees that grow at the raised frequency."""
    return of_trees(parameters, "majorant", lambda nu, time, _: nodes(nu * time))


def of_null_collisions(parameters):
    """Return the work of trees with four branches that grow at three times the raised frequency."""

    def counted(ratio, time, _):
        return (4.0 * math.exp(min(LARGEST, 3.0 * ratio * time)) - 1.0) / 3.0

    return of_trees(parameters, "majorant", counted)


def of_one_tree(parameters):
    """Return the work of one recorded tree."""
    return {"draw": 1.0, "node": nodes(parameters["time"])}


def trap_nodes(radius, time, strength, amplitude, growth, radial):
    """Return about the mean nodes of a tree in the trap, where there is no closed form.

    The cloud is thin where the probe starts and dense where its descendants gather: their number
    grows at one rate, and there are the fewer of them the farther out the tree begins.

    Parameters
    ----------
    strength : the coupling times the factor on the majorant
    amplitude, growth, radial : fitted to the nodes that samples count
    """
    grown = math.expm1(min(LARGEST, growth * strength * time))
    return 1.0 + amplitude * grown / (1.0 + radial * radius)


def of_trap(parameters, name):
    """Return the work of trees in the trap; the time is that in which null collisions happen."""
    strength = parameters["coupling"] * parameters.get("majorant_factor", 1.0)
    shape = costs.table()["trees"][name]
    work = of_trees(
        parameters, "radius", lambda radius, time, _: trap_nodes(radius, time, strength, **shape)
    )
    return work | {"span": len(parameters["radius"]) * sum(parameters["time"]) * strength}
