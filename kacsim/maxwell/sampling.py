"""Streams the algorithms for Maxwell molecules: speeds into counts and moments, as Kac's model."""

import math

import numpy as np

from kacsim.kac.replicates import KEPT, algorithm_sums
from kacsim.kernels.jit import kernel
from kacsim.maxwell import draws
from kacsim.store import described

__all__ = ["KEPT", "sample_maxwell"]


@kernel
def set_speeds(speeds, velocities):
    """Set float64[n] to the lengths of velocities, float64[n, 3]; return the sum of v_x**2."""
    total = 0.0
    for k in range(speeds.size):
        x, y, z = velocities[k, 0], velocities[k, 1], velocities[k, 2]
        speeds[k] = math.sqrt(x * x + y * y + z * z)
        total += x * x
    return total


def sample_maxwell(case, progress):
    """Draw the velocity of particle 1 at a time by one algorithm on one engine.

    Returns
    -------
    dict as of `kacsim.kac.replicates.algorithm_sums` for the speed |v_1|, its raw values being
    kept_speed[kept], with square_x[replicate], the mean of v_x**2
    """
    draw_kernel, arguments = draws.kernel_of(case.parameters)
    squares = np.zeros(len(case.replicates))

    def fill(speeds, own, row, stream):
        velocities = np.empty((speeds.size, 3))
        collisions = draw_kernel(velocities, own, *arguments, stream)
        squares[row] += set_speeds(speeds, velocities)
        return collisions

    variables = algorithm_sums(case, fill, progress, value="|v_1|", kept_name="kept_speed")
    mean = squares / case.n_draws
    return variables | {"square_x": described(mean, ("replicate",), "mean of v_x squared")}
