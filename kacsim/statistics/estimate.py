"""What was measured: a mean, a share or an exact value, each with its interval."""

import math
from dataclasses import dataclass

import numpy as np
from scipy import special

from kacsim.statistics.tail import clopper_pearson


@dataclass(frozen=True)
class Mean:
    """An estimate with its standard error.

    Attributes
    ----------
    value, standard_error : float
    degrees : degrees of freedom behind the standard error; inf where draws are so many that the
        error counts as known
    """

    value: float
    standard_error: float
    degrees: float = math.inf

    def z(self, exact=0.0):
        """Return (value - exact) / standard_error; 0 when both differences vanish."""
        gap = self.value - exact
        return 0.0 if gap == 0.0 else gap / self.standard_error

    def minus(self, other):
        """Return the difference to an independent estimate (degrees by Welch and Satterthwaite)."""
        error = math.hypot(self.standard_error, other.standard_error)
        parts = [(one.standard_error**2, one.degrees) for one in (self, other)]
        spread = sum(square**2 / degrees for square, degrees in parts)
        degrees = error**4 / spread if spread > 0.0 else math.inf
        return Mean(self.value - other.value, error, degrees)

    def over(self, unit):
        """Return the estimate in units of a known positive value."""
        return Mean(self.value / unit, self.standard_error / unit, self.degrees)

    def interval(self, alpha):
        """Return (low, high) that misses the mean with probability `alpha` (Student's t)."""
        reach = self.reach(alpha)
        return self.value - reach, self.value + reach

    def reach(self, alpha):
        """Return half the width of the interval; nan if equal values left no spread to judge by."""
        if not self.standard_error > 0.0:
            return math.nan
        return -float(special.stdtrit(self.degrees, alpha / 2.0)) * self.standard_error

    @property
    def law(self):
        """Name the law of the interval."""
        return "normal" if math.isinf(self.degrees) else f"t with {self.degrees:.0f} degrees"


@dataclass(frozen=True)
class Share:
    """A share of independent trials."""

    successes: int
    n: int

    @property
    def value(self):
        """Return the share; nan of no trial at all, which rare draws may leave."""
        return self.successes / self.n if self.n else math.nan

    @property
    def standard_error(self):
        """Return the binomial standard error, never zero (Agresti-Coull centre)."""
        centre = (self.successes + 2.0) / (self.n + 4.0)
        return math.sqrt(centre * (1.0 - centre) / max(1, self.n))

    def interval(self, alpha):
        """Return the exact binomial interval (low, high)."""
        return clopper_pearson(self.successes, self.n, 1.0 - alpha)

    def reach(self, alpha):
        """Return half the width of the interval."""
        low, high = self.interval(alpha)
        return (high - low) / 2.0

    @property
    def law(self):
        """Name the law of the interval."""
        return f"Clopper-Pearson of {self.n}"


@dataclass(frozen=True)
class Exact:
    """A value without sampling error: a closed form, a proof, a count of all there are."""

    value: float
    standard_error: float = 0.0

    def interval(self, alpha):
        """Return the value twice."""
        return self.value, self.value

    def reach(self, alpha):
        """Return 0."""
        return 0.0

    @property
    def law(self):
        """Name the law of the interval."""
        return "exact"


def of_replicates(values):
    """Return the mean over replicates and its standard error (nan for a single one)."""
    values = np.asarray(values, dtype=float)
    if values.size < 2:
        return Mean(float(values.mean()), math.nan)
    error = float(values.std(ddof=1) / math.sqrt(values.size))
    return Mean(float(values.mean()), error, values.size - 1)


def of_power(moments, order, n_draws, square=None):
    """Return the mean of v**order from summed moments.

    Parameters
    ----------
    moments : mapping or Series, order -> mean of v**order over the draws; holds 2 * order too, and
        with a control variate 2, 4 and order + 2
    order : even int, above 2 with a control variate
    n_draws : int, draws behind the moments
    square : float, the known mean of v**2, which is then a control variate: what the draws' own
        mean has too much, times the slope of v**order on v**2, is taken off
    """
    mean = float(moments[order])
    variance = max(0.0, float(moments[2 * order]) - mean**2)
    if square is not None:
        own = float(moments[2])
        spread = float(moments[4]) - own**2
        slope = (float(moments[order + 2]) - mean * own) / spread if spread > 0.0 else 0.0
        mean -= slope * (own - square)
        variance = max(0.0, variance - slope**2 * spread)
    return Mean(mean, math.sqrt(variance / n_draws))


def of_share(successes, n_draws):
    """Return a binomial share with its standard error, never zero, as a mean."""
    share = Share(int(successes), int(n_draws))
    return Mean(share.value, share.standard_error)


def within(worst, rounding):
    """Return a largest departure as words: rounding errors differ from machine to machine."""
    return f"within {rounding:.0e}" if worst <= rounding else f"{worst:.1e}"
