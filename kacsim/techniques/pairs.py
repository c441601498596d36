"""Velocities that enter through a face where their law is not separable (section 11.3).

The law is a bivariate normal density of unit variances: the velocity normal to the face, and one
along it that is correlated with it. Three ways to draw an entering pair: straight flight, which
knows no flux; the three steps as printed; the steps with a derivative in the place of P.
"""

import math

from kacsim.kernels.jit import inlined, kernel
from kacsim.variates import exponential, half_normal, random_sign, uniform

REACH = 8.0  # thermal velocities times the step from which particles fly in


@inlined
def normal(stream):
    """Return a standard normal variate."""
    return random_sign(stream) * half_normal(stream)


@inlined
def along(v, correlation, stream):
    """Return a velocity along the face, given the normal one."""
    return correlation * v + math.sqrt(1.0 - correlation * correlation) * normal(stream)


@kernel
def by_flight(pairs, correlation, stream):
    """Draw pairs that cross the face within a step: float64[n, 2], normal velocity first.

    Particles are uniform before the face; who flies farther than his distance enters.
    """
    for k in range(pairs.shape[0]):
        v = normal(stream)
        while v <= REACH * uniform(stream):
            v = normal(stream)
        pairs[k, 0] = v
        pairs[k, 1] = along(v, correlation, stream)


@kernel
def by_steps(pairs, correlation, stream):
    """Draw pairs by the printed steps: v_y from P(v_x, v_y, v_zmax) as a function of v_y.

    P is cumulative in v_x too: its v_y is that of a particle whose normal velocity is below the
    chosen one, of either sign.
    """
    for k in range(pairs.shape[0]):
        v = math.sqrt(2.0 * exponential(stream))
        below = normal(stream)
        while below > v:
            below = normal(stream)
        pairs[k, 0] = v
        pairs[k, 1] = along(below, correlation, stream)


@kernel
def by_derivative(pairs, correlation, stream):
    """Draw pairs by the steps with the derivative of P in v_x: v_y of the chosen v_x itself."""
    for k in range(pairs.shape[0]):
        v = math.sqrt(2.0 * exponential(stream))
        pairs[k, 0] = v
        pairs[k, 1] = along(v, correlation, stream)
