"""Laws of what is measured, by type of interval: what `wrong_verdicts` draws its tables from.

A law knows the true value of its quantity and draws estimates with their errors as the items make
them: weights with tails, counts, extremes, TVN, slopes, each at sizes of the project. Replicates
are taken, with replacement, from a bank that is drawn once; the true value is then the bank's mean,
so that the tables are consistent whatever the bank.
"""

import math
from dataclasses import dataclass

import numba
import numpy as np
from scipy import special

from kacsim.kac import exact
from kacsim.statistics import histogram, slope
from kacsim.statistics.estimate import Mean, Share

BANK = 400_000  # replicates of a law
CHUNK = 5_000  # histograms held at a time
EXTREMES = 50_000  # of all draws of a table


@dataclass(frozen=True)
class Replicates:
    """The mean over replicates, its error from their spread (Student's t).

    Attributes
    ----------
    bank : float64[replicates], values of single replicates
    n : int, replicates of an estimate
    """

    bank: object
    n: int

    @property
    def theta(self):
        return float(self.bank.mean())

    @property
    def error(self):
        return float(self.bank.std()) / math.sqrt(self.n)

    @property
    def degrees(self):
        return self.n - 1

    def draw(self, rng, n_tables):
        """Return (values, errors, degrees), each of n_tables."""
        drawn = self.bank[rng.integers(0, self.bank.size, (n_tables, self.n))]
        error = drawn.std(axis=1, ddof=1) / math.sqrt(self.n)
        return drawn.mean(axis=1), error, np.full(n_tables, self.n - 1.0)


@dataclass(frozen=True)
class Pooled:
    """The mean over all draws, its error from their pooled second moment, taken as known.

    Attributes
    ----------
    bank, squares : float64[replicates], means of the draws of a replicate and of their squares
    n : int, replicates of an estimate
    n_draws : int, draws of a replicate
    """

    bank: object
    squares: object
    n: int
    n_draws: int
    degrees: float = math.inf

    @property
    def theta(self):
        return float(self.bank.mean())

    @property
    def error(self):
        return float(self.bank.std()) / math.sqrt(self.n)

    def draw(self, rng, n_tables):
        """Return (values, errors, degrees), each of n_tables."""
        places = rng.integers(0, self.bank.size, (n_tables, self.n))
        mean = self.bank[places].mean(axis=1)
        variance = self.squares[places].mean(axis=1) - mean**2
        error = np.sqrt(variance / (self.n * self.n_draws))
        return mean, error, np.full(n_tables, math.inf)


@dataclass(frozen=True)
class Normal:
    """Plain normal replicates, or for infinite degrees an error that is known."""

    degrees: float
    error: float = 1.0
    theta: float = 0.0

    def draw(self, rng, n_tables):
        """Return (values, errors, degrees), each of n_tables."""
        degrees = np.full(n_tables, float(self.degrees))
        known = math.isinf(self.degrees)
        factor = np.ones(n_tables) if known else np.sqrt(rng.chisquare(degrees) / degrees)
        return self.error * rng.standard_normal(n_tables), self.error * factor, degrees


@dataclass(frozen=True)
class Difference:
    """The difference of two independent estimates, by `estimate.Mean.minus`."""

    one: object
    other: object

    @property
    def theta(self):
        return self.one.theta - self.other.theta

    @property
    def error(self):
        return math.hypot(self.one.error, self.other.error)

    @property
    def degrees(self):
        return self._minus(*((law.theta, law.error, law.degrees) for law in self._both)).degrees

    @property
    def _both(self):
        return self.one, self.other

    @staticmethod
    def _minus(one, other):
        return Mean(*map(float, one)).minus(Mean(*map(float, other)))

    def draw(self, rng, n_tables):
        """Return (values, errors, degrees), each of n_tables."""
        drawn = [np.stack(law.draw(rng, n_tables), axis=1) for law in self._both]
        found = [self._minus(*pair) for pair in zip(*drawn, strict=True)]
        columns = ([getattr(one, key) for one in found] for key in ("value", "standard_error"))
        return *map(np.array, columns), np.array([one.degrees for one in found])


@dataclass(frozen=True)
class Drawn:
    """Estimates with errors that were drawn beforehand, as they are."""

    values: object
    errors: object
    degrees: float
    theta: float

    @property
    def error(self):
        return float(np.median(self.errors))

    def draw(self, rng, n_tables):
        """Return (values, errors, degrees), each of n_tables."""
        places = rng.integers(0, self.values.size, n_tables)
        degrees = np.full(n_tables, float(self.degrees))
        return self.values[places], self.errors[places], degrees


@dataclass(frozen=True)
class Counts:
    """A share of n independent draws; its probability is a table's own."""

    probability: float
    n: int

    def draw(self, rng, probabilities):
        """Return the Share of each table."""
        return [Share(int(k), self.n) for k in rng.binomial(self.n, probabilities)]


# Banks


@numba.njit(nogil=True)
def _weights(means, squares, index, spread, chance, n_draws, rng):
    """Fill the means and mean squares of weights: lognormal times Pareto of an index, or 0."""
    for place in range(means.size):
        total = total_square = 0.0
        for _ in range(rng.binomial(n_draws, chance)):
            x = math.exp(spread * rng.standard_normal() + rng.standard_exponential() / index)
            total += x
            total_square += x * x
        means[place], squares[place] = total / n_draws, total_square / n_draws


def weights(rng, index, spread, n_draws, size, chance=1.0):
    """Return (means, mean squares), float64[size] each, of replicates of n_draws weights.

    Parameters
    ----------
    index : of the tail: moments of higher order are infinite
    spread : standard deviation of the lognormal factor's logarithm
    chance : that a realization is not zero
    """
    means, squares = np.empty(size), np.empty(size)
    _weights(means, squares, index, spread, chance, n_draws, rng)
    return means, squares


def total_variations(rng, n_draws, size, bin_width=0.1, time=2.0):
    """Return the TVN of n_draws exact draws from eq. (8), float64[size]."""
    edges = histogram.fine_edges()[:: round(bin_width / histogram.FINE_WIDTH)]
    expected = histogram.probabilities(lambda v: exact.cumulative(v, time), edges)
    expected = np.clip(expected, 0.0, None)
    chunks = [min(CHUNK, size - start) for start in range(0, size, CHUNK)]
    counts = (rng.multinomial(n_draws, expected / expected.sum(), some) for some in chunks)
    return np.concatenate([histogram.total_variation(some, expected) for some in counts])


def largest(rng, shape, n_draws, size):
    """Return the largest of n_draws gamma variates (mean 1), float64[size]."""
    return special.gammaincinv(shape, rng.random(size) ** (1.0 / n_draws)) / shape


def smallest(rng, shape, n_draws, size):
    """Return the smallest of n_draws gamma variates (mean 1), float64[size]."""
    beyond = -np.expm1(np.log(rng.random(size)) / n_draws)
    return special.gammaincinv(shape, beyond) / shape


def extreme_of_all(rng, draw, best, shape, n_draws, n):
    """Return the extreme of all draws as a law, its error the spread of the replicates' extremes.

    Parameters
    ----------
    draw, best : `largest` and np.max, or `smallest` and np.min
    n : replicates, of n_draws each
    """
    values = draw(rng, shape, n_draws, n * EXTREMES).reshape(EXTREMES, n)
    extreme = best(values, axis=1)
    return Drawn(extreme, values.std(axis=1, ddof=1), n - 1, float(extreme.mean()))


def nodes(rng, time, n_draws, size):
    """Return the mean number of nodes, 2 leaves - 1, of n_draws trees of Algorithm 2."""
    leaves = n_draws + rng.negative_binomial(n_draws, math.exp(-time), size)
    return 2.0 * leaves / n_draws - 1.0


def slopes(rng, n_groups, points, size, block=None):
    """Return fitted powers of N as a `Drawn` law: errors fall as 1 / root N.

    Parameters
    ----------
    n_groups : seeds, each a walk whose errors at growing N depend on each other
    points : float64[k], N
    block : instead of seeds, neighbouring N whose errors depend on each other
    """
    found = []
    for _ in range(size):
        if block is None:
            steps = np.sqrt(np.diff(points, prepend=0.0))
            errors = (rng.standard_normal((n_groups, points.size)) * steps).cumsum(axis=1) / points
            groups = np.broadcast_to(np.arange(n_groups)[:, None], errors.shape)
        else:
            groups = np.arange(points.size) // block
            own, common = rng.standard_normal(points.size), rng.standard_normal(groups.max() + 1)
            errors = math.sqrt(0.5) * (own + common[groups]) / np.sqrt(points)
        n = np.broadcast_to(points, errors.shape)
        found.append(slope.of_squares(n.ravel(), errors.ravel() ** 2, groups.ravel())[0])
    columns = ([getattr(one, key) for one in found] for key in ("value", "standard_error"))
    return Drawn(*map(np.array, columns), found[0].degrees, -0.5)


def deviation_ratios(rng, one, other, n, size):
    """Return the ratio of two relative deviations as a `Drawn` law, jackknifed over replicates.

    Parameters
    ----------
    one, other : (means, mean squares) of replicates
    n : replicates of an estimate
    """

    def relative(means, squares):
        return np.sqrt(squares / means**2 - 1.0)

    true, full, left = [], [], []
    for means, squares in (one, other):
        true.append(relative(means.mean(), squares.mean()))
        places = rng.integers(0, means.size, (size, n))
        m, s = means[places], squares[places]
        full.append(relative(m.mean(axis=1), s.mean(axis=1)))
        rest = [(x.sum(axis=1, keepdims=True) - x) / (n - 1) for x in (m, s)]
        left.append(relative(*rest))
    ratios = left[1] / left[0]
    errors = np.sqrt((n - 1) * ratios.var(axis=1))
    return Drawn(full[1] / full[0], errors, n - 1, float(true[1] / true[0]))
