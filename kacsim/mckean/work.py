"""How large a tree is, for the time that it takes and for the choice of a method."""

import math

from kacsim.mckean.constants import BETA, ELL, KAPPA, LEAST_ETA, VARIANCE

OUTSIDE = "it tells how long a job takes, and no job what to draw"

LARGEST = 30.0  # exponent of the growth, whatever a configuration asks for


def tilt(v, time, law):
    """Return (eta, b) of the tree that serves at v, as `kacsim.mckean.laws.saddle_point`."""
    beta = BETA[law] * math.exp(-KAPPA[law] * time)
    low, high = 0.0, v / (2.0 * ELL[law])
    for _ in range(30):
        eta = 0.5 * (low + high)
        b = beta * eta * eta
        slope = eta * (VARIANCE[law] - 2.0 * beta * b / (1.0 + b))
        low, high = (eta, high) if slope < v else (low, eta)
    return eta, BETA[law] * eta * eta


def mean_leaves(v, time, law):
    """Return about the mean number of leaves of a tree that is tilted for v.

    mu = 1 + (e**t - 1) (1 + kappa B**2 / (1 + B)), B = b exp(-kappa t).
    """
    _, b = tilt(v, time, law)
    x = b * math.exp(-KAPPA[law] * time)
    return 1.0 + math.expm1(min(LARGEST, time)) * (1.0 + KAPPA[law] * x * x / (1.0 + x))


def mean_ends(v, time, law, cut):
    """Return about the mean number of ends: shares below the cut do not split."""
    leaves = mean_leaves(v, time, law)
    if cut == 0.0:
        return leaves
    eta, _ = tilt(v, time, law)
    return min(leaves, 1.0 + 2.0 * BETA[law] * max(eta, LEAST_ETA) ** 2 / cut)


def of_trees(parameters, axis, law):
    """Return the work of realizations at every probe of a grid.

    Parameters
    ----------
    axis : name of the grid's first axis
    """
    rate = parameters.get("collision_rate", 1.0)
    probes = [(v, rate * time) for v in parameters[axis] for time in parameters["time"]]
    ends = sum(mean_ends(v, time, law, parameters["cut"]) for v, time in probes)
    return {"call": len(probes), "draw": len(probes), "node": ends}
