"""Means and their standard errors."""

import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Mean:
    """An estimate with its standard error."""

    value: float
    standard_error: float

    def z(self, exact=0.0):
        """Return (value - exact) / standard_error; 0 when both differences vanish."""
        gap = self.value - exact
        return 0.0 if gap == 0.0 else gap / self.standard_error

    def minus(self, other):
        """Return the difference to an independent estimate."""
        error = math.hypot(self.standard_error, other.standard_error)
        return Mean(self.value - other.value, error)


def of_replicates(values):
    """Return the mean over replicates and its standard error (nan for a single one)."""
    values = np.asarray(values, dtype=float)
    if values.size < 2:
        return Mean(float(values.mean()), math.nan)
    return Mean(float(values.mean()), float(values.std(ddof=1) / math.sqrt(values.size)))


def of_power(moments, order, n_draws):
    """Return the mean of v**order from summed moments.

    Parameters
    ----------
    moments : mapping or Series, order -> mean of v**order over the draws; holds 2 * order too
    order : even int
    n_draws : int, draws behind the moments
    """
    mean = float(moments[order])
    variance = max(0.0, float(moments[2 * order]) - mean**2)
    return Mean(mean, math.sqrt(variance / n_draws))


def of_share(successes, n_draws):
    """Return a binomial share with its standard error, never zero (Agresti-Coull centre)."""
    centre = (successes + 2.0) / (n_draws + 4.0)
    return Mean(successes / n_draws, math.sqrt(centre * (1.0 - centre) / n_draws))
