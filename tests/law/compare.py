"""How laws are compared: every statistic is a z, standard normal under its null.

Tests without a sign (Kolmogorov-Smirnov, chi-squared) return the z >= 0 of the same two-sided
p-value. A law test looks twice: a z beyond LIMIT, an alarm, is drawn again from another stream and
with AGAIN times the draws, and fails the test if it is an alarm there too, on the same side. Its
negative control, a mutant, must be `caught` at the first look. docs/statistics.md gives the rates.
"""

import contextlib
import functools
import math
import os
import sys

import numpy as np
from scipy import special

LIMIT = 4.0
CAUGHT = 6.0
AGAIN = 4
FRESH = 10**12  # from the seed of the first look to that of the second, past all that tests add
# The tests draw this many times what they state: more to look sharper, fewer to sweep many seeds,
# which a null does not mind but no mutant is caught with.
DRAWS_FACTOR = float(os.environ.get("KACSIM_TEST_DRAWS", "1"))
FEWEST = 100_000  # draws that are never made fewer, lest their z are not normal
SLOPE = 6.5  # near Cov(v**4, v**2) / Var(v**2): 5 under f0, 9 at equilibrium
_looks = []  # those under way, the innermost last


class Unsigned(float):
    """A z >= 0 of a test that knows no sign."""


class Look:
    """One run of a law test: the factor of its draws, and where it took each null z."""

    def __init__(self, factor):
        self.factor, self.is_scaled, self.places, self.zs = factor, False, [], []


@contextlib.contextmanager
def look(factor):
    """Have the draws multiplied and the z collected; give the look."""
    _looks.append(Look(factor))
    try:
        yield _looks[-1]
    finally:
        _looks.pop()


def look_at(test, seed):
    """Run a test, a function of its seed; return its looks, the second one only after an alarm."""
    with look(1) as first:
        test(seed)
    if first.zs and not first.is_scaled:
        raise RuntimeError("a law test makes as many draws as `scaled` says")
    if not any(abs(z) > LIMIT for z in first.zs):
        return [first]
    with look(AGAIN) as second:
        test(seed + FRESH)
    if second.places != first.places:
        raise RuntimeError("the second look took other z: their number depends on the draws")
    return [first, second]


def stays(z, again):
    """Return whether a z is an alarm at both looks, on the same side."""
    return min(abs(z), abs(again)) > LIMIT and (z > 0.0) == (again > 0.0)


def judge(looks):
    """Fail if an alarm of the first look is one at the second."""
    found = [
        f"{place}: z = {z:.2f}, then {again:.2f} with {AGAIN} times the draws"
        for place, z, again in zip(looks[0].places, looks[0].zs, looks[-1].zs, strict=True)
        if len(looks) > 1 and stays(z, again)
    ]
    if found:
        raise AssertionError("; ".join(found))


def chance(unsigned, limit=LIMIT):
    """Return the probability that a z, without a sign or with one, is an alarm which stays."""
    return (2.0 * special.ndtr(-limit)) ** 2 * np.where(unsigned, 1.0, 0.5)


def factor():
    """Return the factor of the look under way."""
    return _looks[-1].factor if _looks else 1


def scaled(n_draws):
    """Return how many draws to make where a test states so many."""
    if _looks:
        _looks[-1].is_scaled = True
    return round(max(n_draws * DRAWS_FACTOR, min(n_draws, FEWEST)) * factor())


def kept(draw):
    """Return a function of the seed that makes scaled draws once for all tests that share them."""
    found = functools.cache(draw)

    def drawn(seed):
        if _looks:
            _looks[-1].is_scaled = True
        return found(seed)

    return drawn


def ok(*zs):
    """Take each z as null; an alarm waits for the second look, and only no number is not ok."""
    if not _looks:
        raise RuntimeError("a law test takes its seed as an argument, to be looked at twice")
    caller = sys._getframe(1)
    place = f"{os.path.basename(caller.f_code.co_filename)}:{caller.f_lineno}"
    _looks[-1].places += [place] * len(zs)
    _looks[-1].zs += zs
    return not any(math.isnan(z) for z in zs)


def without_controls():
    """Return whether mutants are not looked at: at a second look, and where draws are too few."""
    return DRAWS_FACTOR < 1.0 or factor() > 1


def controls(*mutations):
    """Return the mutations to try."""
    return () if without_controls() else mutations


def caught(*zs):
    """Return whether every z rejects its null, as a mutant's must."""
    return without_controls() or all(abs(z) > CAUGHT for z in zs)


def of_p(p):
    """Return the z >= 0 whose two-sided p-value is p."""
    return Unsigned(-special.ndtri(max(p, 1e-300) / 2.0))


def of_mean(values, exact):
    """Return z of a sample mean, its standard error estimated from the sample."""
    return float((values.mean() - exact) / (values.std(ddof=1) / math.sqrt(values.size)))


def of_means(a, b):
    """Return z of the difference of two independent sample means."""
    error = math.hypot(a.std(ddof=1) / math.sqrt(a.size), b.std(ddof=1) / math.sqrt(b.size))
    return float((a.mean() - b.mean()) / error)


def of_energy(velocities):
    """Return z of E v**2 = 3/2, which every algorithm keeps."""
    return of_mean(velocities**2, 1.5)


def of_fourth(velocities, exact):
    """Return z of E v**4, with v**2 as control variate (E v**2 = 3/2): half the noise."""
    square = velocities**2
    return of_mean(square**2 - SLOPE * (square - 1.5), exact)


def of_share(successes, n, probability):
    """Return z of a binomial count."""
    return (successes - n * probability) / math.sqrt(n * probability * (1.0 - probability))


def of_distribution(values, cumulative):
    """Return z of the Kolmogorov-Smirnov test against a continuous law (many values)."""
    f = cumulative(np.sort(values))
    rank = np.arange(values.size + 1) / values.size
    distance = max((rank[1:] - f).max(), (f - rank[:-1]).max())
    return of_p(special.kolmogorov(math.sqrt(values.size) * distance))


def of_distributions(a, b):
    """Return z of the two-sample Kolmogorov-Smirnov test (many values, no ties)."""
    a, b = np.sort(a), np.sort(b)
    above = np.arange(1, a.size + 1) / a.size
    share = np.searchsorted(b, a) / b.size
    # The suprema are at the points of `a`, just after and just before each.
    distance = max(np.abs(above - share).max(), np.abs(above - 1.0 / a.size - share).max())
    return of_p(special.kolmogorov(distance * math.sqrt(a.size * b.size / (a.size + b.size))))


def of_counts(counts, probabilities, least=20.0):
    """Return z of Pearson's test; bins that expect fewer than `least` are taken as one."""
    counts, wanted = np.asarray(counts, float), np.asarray(probabilities) * np.sum(counts)
    rare = wanted < least
    pooled = [counts[rare].sum()], [wanted[rare].sum()]
    if pooled[1][0] < least:  # the rest joins the largest bin
        place = int(np.argmax(np.where(rare, 0.0, wanted)))
        counts[place] += pooled[0][0]
        wanted[place] += pooled[1][0]
        pooled = [], []
    counts, wanted = np.r_[counts[~rare], pooled[0]], np.r_[wanted[~rare], pooled[1]]
    statistic = ((counts - wanted) ** 2 / wanted).sum()
    return of_p(special.chdtrc(counts.size - 1, statistic))


def of_histograms(a, b, n_bins=64):
    """Return z of the two-sample chi-squared test on bins with equal shares of `a` and `b`."""
    a, b = np.sort(a), np.sort(b)
    both = np.sort(np.concatenate([a, b]))
    edges = both[np.arange(1, n_bins) * both.size // n_bins]
    of_a, of_b = (np.diff(np.searchsorted(x, edges), prepend=0, append=x.size) for x in (a, b))
    ratio = math.sqrt(b.size / a.size)
    statistic = ((of_a * ratio - of_b / ratio) ** 2 / (of_a + of_b)).sum()
    return of_p(special.chdtrc(n_bins - 1, statistic))


def of_squares(zs):
    """Return z of a family of independent z, by the chi-squared law of the sum of squares."""
    return of_p(special.chdtrc(len(zs), float(np.square(zs).sum())))
