"""Fig. 6 of the Boltzmann paper: fractions beyond a speed at two times, by Algorithm 3."""

import functools
import math

from kacsim.items import _bkw
from kacsim.items._lazy import bkw, estimate, second_moment, verdict

cases = functools.partial(_bkw.cases, "bkw_fraction")
reduce = functools.partial(_bkw.reduce, "bkw_fraction")
draw = functools.partial(_bkw.draw, "bkw_fraction", "threshold")
BILLIONTH = 1e-9
PUBLISHED = 10_000  # realizations of a point
THRESHOLDS = (0.5, 2.0, 6.0)  # of eq. (19): below, at and above the change of its branch


def claims(dataset):
    """Test the sampling law of eq. (19), and what a fraction of a billionth costs."""
    time = float(dataset.time[0])
    threshold = _threshold(BILLIONTH, time)
    relative = second_moment.fraction_deviation(threshold, time)
    error = relative / math.sqrt(PUBLISHED)
    where = f"c0 = {threshold:.3f} c_q, t = {time:g}"
    evidence = (
        f"{where}: one realization departs by {relative:.2f} of the fraction. From t* = "
        f"{bkw.critical_time():.3f} on there is no such number."
    )
    # A direct simulation counts particles: 1 / (fraction error**2) of them for the same error.
    drawings = PUBLISHED * float(bkw.mean_recursion(time))
    particles = 1.0 / (BILLIONTH * error**2)
    normalized = [
        verdict.Part(
            estimate.Exact(second_moment.normalization(one)), f"c0 = {one:g} c_q", printed=1.0
        )
        for one in THRESHOLDS
    ]
    return [
        verdict.finding("boltzmann_billionth", estimate.Exact(error), evidence),
        verdict.finding(
            "boltzmann_burden",
            estimate.Exact(math.log10(particles / drawings)),
            f"{where}: {drawings:.2g} drawings of t' or {particles:.2g} independent particles.",
        ),
        verdict.Finding("boltzmann_19_density", tuple(normalized)),
    ]


def _threshold(fraction, time):
    """Return the threshold beyond which a fraction of the gas is, by bisection."""
    low, high = 0.0, 9.0
    for _ in range(60):
        middle = (low + high) / 2.0
        above = float(bkw.fraction(middle, time)) > fraction
        low, high = (middle, high) if above else (low, middle)
    return low
