"""f0 of the Kac paper by the Gamma identity; the kernels of that paper draw it by strips."""

import math

from kacsim.kernels.jit import kernel
from kacsim.variates import exponential, half_normal, random_sign


@kernel
def draw(values, stream):
    """Draw v = +-sqrt(E + Z**2 / 2): v**2 is Gamma(3/2, 1), E exponential, Z normal."""
    for k in range(values.size):
        z = half_normal(stream)
        values[k] = math.sqrt(exponential(stream) + 0.5 * z * z) * random_sign(stream)
