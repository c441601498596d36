"""Numbers of the Kac paper that several modules use."""

import math

RATE = math.sqrt(math.pi) / 2  # lambda: collisions of one particle per time
MEAN_ENERGY = 1.5  # E[v**2] under f0, per particle
THERMAL = math.sqrt(MEAN_ENERGY)  # RMS velocity of eq. (9)


def n_steps(time, time_step):
    """Return time / time_step as an integer, None if the step does not divide the time."""
    ratio = time / time_step
    steps = round(ratio) if ratio < 2**53 else 0
    return steps if steps >= 1 and math.isclose(ratio, steps, rel_tol=1e-9) else None
