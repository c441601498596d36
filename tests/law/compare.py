"""How laws are compared: every statistic is a z, standard normal under its null.

Tests without a sign (Kolmogorov-Smirnov, chi-squared) return the z >= 0 of the same two-sided
p-value. A law test passes if it is `ok`, which happens by chance in all but 6.3e-5 of the runs; its
negative control, a mutant, must be `caught`.
"""

import math
import os

import numpy as np
from scipy import special

LIMIT = 4.0
CAUGHT = 6.0
FALSE_ALARM = 2.0 * special.ndtr(-LIMIT)  # 6.3e-5 for each z
# The expensive tests draw this many times what they state: more to look sharper, fewer to sweep
# many seeds, which a null does not mind but no mutant is caught with.
DRAWS_FACTOR = float(os.environ.get("KACSIM_TEST_DRAWS", "1"))
SLOPE = 6.5  # near Cov(v**4, v**2) / Var(v**2): 5 under f0, 9 at equilibrium
null_zs = []  # of this process: tests/false_alarms.py counts them


def scaled(n_draws):
    """Return a number of draws as KACSIM_TEST_DRAWS wants it."""
    return round(n_draws * DRAWS_FACTOR)


def ok(*zs):
    """Return whether every z agrees with its null."""
    null_zs.extend(zs)
    return all(abs(z) <= LIMIT for z in zs)


def controls(*mutations):
    """Return the mutations to try: none if fewer draws could not tell."""
    return mutations if DRAWS_FACTOR >= 1.0 else ()


def caught(*zs):
    """Return whether every z rejects its null, as a mutant's must; fewer draws cannot tell."""
    return DRAWS_FACTOR < 1.0 or all(abs(z) > CAUGHT for z in zs)


def of_p(p):
    """Return the z >= 0 whose two-sided p-value is p."""
    return float(-special.ndtri(max(p, 1e-300) / 2.0))


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
