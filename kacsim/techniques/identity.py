"""f0 of the Kac paper by the Gamma identity, as the kernels of that paper draw it."""

from kacsim.kac.model import initial_velocity
from kacsim.kernels.jit import kernel


@kernel
def draw(values, stream):
    """Draw v = +-sqrt(E + Z**2 / 2): v**2 is Gamma(3/2, 1), E exponential, Z normal."""
    for k in range(values.size):
        values[k] = initial_velocity(stream)
