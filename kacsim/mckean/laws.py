"""The exact transform of the two laws, and the place from where it is best inverted."""

import numpy as np

from kacsim.elementary.exponential import exp
from kacsim.kernels.jit import inlined
from kacsim.mckean import constants
from kacsim.mckean.constants import HALVINGS

BETA, ELL, KAPPA = map(np.array, (constants.BETA, constants.ELL, constants.KAPPA))
VARIANCE = np.array(constants.VARIANCE)


@inlined
def product_mean(b, time, law):
    """Return (x, y) of E prod(1 + b rho_i) = exp(x) y: x = b (1 - eps), y = 1 + b eps.

    eps = exp(-kappa t). Both sides Q solve dQ/dt = -Q + E[Q(U b) Q((1 - U) b)], Q(b, 0) = 1 + b.
    """
    left = exp(-KAPPA[law] * time)
    return b * (1.0 - left), 1.0 + b * left


@inlined
def saddle_point(v, time, law):
    """Return eta >= 0 where the derivative of log E exp(eta v_1(t)) is v >= 0."""
    beta = BETA[law] * exp(-KAPPA[law] * time)
    low, high = 0.0, v / (2.0 * ELL[law])
    for _ in range(HALVINGS):
        eta = 0.5 * (low + high)
        b = beta * eta * eta
        if eta * (VARIANCE[law] - 2.0 * beta * b / (1.0 + b)) < v:
            low = eta
        else:
            high = eta
    return 0.5 * (low + high)
