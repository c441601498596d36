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


# Readings of the epsilon-perfect algorithm, beside the one that is printed (see readings.py): how
# a pair is drawn (two of all; two of all or the same one twice; the first and another one) and
# what share of the pair's energy one of them takes.
DISTINCT, REPLACED, WITH_FIRST = range(3)
ARCSINE, HALF, UNIFORM_SHARE, UNIFORM_SINE = range(4)
WALKS = {
    "printed": (DISTINCT, ARCSINE),
    "replacement": (REPLACED, ARCSINE),
    "with_first": (WITH_FIRST, ARCSINE),
    "half": (DISTINCT, HALF),
    "uniform_share": (DISTINCT, UNIFORM_SHARE),
    "uniform_sine": (DISTINCT, UNIFORM_SINE),
}
SINGLE = "single"  # the printed walk in single precision
# What is compared with the tolerance: the largest distance of two corner points, as printed; of
# two with consecutive numbers; of the first two; the root mean square distance; the largest
# difference of one coordinate; of v_1; the largest distance in energies; how far one step back
# moves the mean.
RULES = (
    "largest",
    "consecutive",
    "first_two",
    "mean_square",
    "coordinate",
    "first_coordinate",
    "energies",
    "settled",
)
LIMIT_STEPS = 5000  # in single precision, which need not reach a tolerance
LEVELS = 8192  # bins of v_1 over its whole range, in which perfect draws are counted
LAGS = 4  # of perfect draws that are compared with later ones
