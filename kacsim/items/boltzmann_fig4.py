"""Fig. 4 of the Boltzmann paper: f along an axis at two times, by Algorithm 2."""

import functools
import math

from kacsim.items import _bkw
from kacsim.items._lazy import bkw, estimate, np, second_moment, verdict

cases = functools.partial(_bkw.cases, "bkw")
reduce = functools.partial(_bkw.reduce, "bkw")
draw = functools.partial(_bkw.draw, "bkw", "speed")
FALL = 1e6  # of f along the axis
STARTS = (0.0, 3.0, 301)  # speeds from which f is let fall, in c_q: ends and number
SPEEDS = (0.0, 6.0, 61)
TIMES = (0.05, 2.3, 46)  # of the growth of the variance, to just before it is infinite
LEAVES = 4000  # of the sum over trees: their number is geometric, of mean exp(t)


def claims(dataset):
    """Test recursion, growth and rarefaction of Algorithm 2, mostly by its exact moments."""
    recursions = [_recursion(dataset, j) for j in range(2)]
    return [*recursions, _recursion_exact(dataset), _rarefaction(dataset), _growth()]


def _recursion(dataset, j):
    """Return the mean recursion at a time, over all speeds: the trees do not know them."""
    here = dataset.sel(size="large").isel(time=j)
    n = here.sizes["speed"]
    error = float(np.sqrt((here.recursion_error.values**2).sum())) / n
    degrees = n * (dataset.attrs["settings"]["n_replicates"] - 1)
    mean = estimate.Mean(float(here.recursion.mean()), error, degrees)
    printed = float(bkw.mean_recursion(float(here.time)))
    evidence = f"t = {float(here.time):g}, mean over {n} speeds."
    return verdict.finding(f"boltzmann_recursion_{j + 1}", mean, evidence, printed=printed)


def _recursion_exact(dataset):
    """Return the recursion of the trees themselves: 2 n - 1 drawings of n leaves, n geometric."""
    parts = []
    n = np.arange(1, LEAVES + 1)
    for time in dataset.time.values:
        chance = math.exp(-time) * (-math.expm1(-time)) ** (n - 1)
        value = estimate.Exact(float(((2 * n - 1) * chance).sum()))
        printed = float(bkw.mean_recursion(time))
        parts.append(verdict.Part(value, f"t = {time:g}", printed=printed))
    return verdict.Finding("boltzmann_15_recursion", tuple(parts))


def _rarefaction(dataset):
    """Return the largest factor on the relative error, from any point of the axis outwards."""
    time, starts = float(dataset.time[0]), np.linspace(*STARTS)
    there, factors = second_moment.growth_over_fall(FALL, starts, time)
    k, densest = int(factors.argmax()), int(bkw.density(starts, time).argmax())
    least = int(second_moment.relative_deviation(starts, time).argmin())
    others = ", ".join(
        f"{factors[i]:.2f} from {what}, c = {starts[i]:.2f} c_q"
        for i, what in (
            (least, "the smallest relative error"),
            (densest, "the largest f"),
            (0, "the centre"),
        )
    )
    evidence = (
        f"t = {time:g}: largest factor along the axis, from c = {starts[k]:.2f} c_q to "
        f"{there[k]:.2f} c_q; {others}."
    )
    return verdict.finding("boltzmann_rarefaction", estimate.Exact(float(factors[k])), evidence)


def _growth():
    """Count where the exact variance of Algorithm 2 falls from one time to the next."""
    speeds, times = np.linspace(*SPEEDS), np.linspace(*TIMES)
    falls = np.diff([second_moment.variance(speeds, time) for time in times], axis=0) <= 0.0
    evidence = (
        f"{falls.size} steps of the exact variance, speeds from 0 to {speeds[-1]:g} c_q, times "
        f"from {times[0]:g} to {times[-1]:g}; infinite from t* = {bkw.critical_time():.3f} on."
    )
    wrong = estimate.Exact(float(falls.mean()))
    return verdict.finding("boltzmann_variance_increases", wrong, evidence)
