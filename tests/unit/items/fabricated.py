"""Samples made by hand, for tests of what items make of them.

A test writes down what every replicate of every case holds, so that the reduced values are known
in closed form; no kernel runs. Nothing here computes what an item should find.
"""

import functools
import math

import numpy as np
import xarray as xr
from scipy import stats

from kacsim import items, plan
from kacsim.kernels.provenance import ROOT
from kacsim.statistics import verdict

FINE_WIDTH, FINE_LIMIT, N_FINE = 0.05, 8.0, 320  # the bins that samplers of velocities count in
ORDERS = (2, 4, 6, 8)


@functools.cache
def _settings():
    return plan.Plan(plan.read_config(ROOT / "config" / "config.yaml")).settings


def settings(name, **changes):
    """Return an item's settings of the full run, some of them replaced."""
    known = _settings()[name]
    unknown = set(changes) - set(known)
    assert not unknown, f"{name} has no setting {', '.join(sorted(unknown))}"
    return known | changes


def reduced(name, chosen, make):
    """Return an item's dataset from samples made by hand.

    Parameters
    ----------
    name : item
    chosen : its settings
    make : callable(case) -> sample
    """
    samples = {case.id: make(case) for case in items.load(name).cases(chosen)}
    return items.reduced(name, samples, chosen)


def found(name, dataset):
    """Return claim id -> Finding of an item."""
    return {one.claim: one for one in items.load(name).claims(dataset)}


def judged(finding, intervals=100):
    """Return (verdict, verdicts of the parts) of a finding, among so many intervals."""
    entry = items.published()[finding.claim]
    word, parts = verdict.judge(finding, entry, 0.01 / intervals)
    return word, [part["verdict"] for part in parts]


def about(mean, error, n):
    """Return n values, n even, with exactly this mean and this standard error of the mean."""
    assert n % 2 == 0
    return mean + error * math.sqrt(n - 1) * np.resize([1.0, -1.0], n)


def variables(**content):
    """Return a sample of variables given as (dims, values)."""
    return xr.Dataset(
        {name: (dims, np.asarray(values)) for name, (dims, values) in content.items()}
    )


def velocities(case, counts=None, **by_replicate):
    """Return a sample of one of Kac's algorithms.

    Parameters
    ----------
    case : its case; the number of replicates must fit the values
    counts : int[replicate, 322], draws per fine bin with the two tails; all draws just above
        v = 0 if not given
    by_replicate : float64[replicate] each: ``v2``, ``v4``, ``v6``, ``v8`` (means of powers, 0 if
        not given), ``collisions``, ``own_collisions``, ``own_variance``; or ``kept_velocity``
    """
    n = case.n_replicates
    if counts is None:
        counts = np.tile(bins({0.0: case.n_draws}), (n, 1))
    assert np.shape(counts) == (n, N_FINE + 2)
    moment = np.zeros((n, len(ORDERS)))
    for k, order in enumerate(ORDERS):
        moment[:, k] = by_replicate.pop(f"v{order}", 0.0)
    kept = by_replicate.pop("kept_velocity", [])
    means = {
        name: ("replicate", np.broadcast_to(by_replicate.pop(name, 0.0), n))
        for name in ("collisions", "own_collisions", "own_variance")
    }
    assert not by_replicate, f"velocities have no {', '.join(by_replicate)}"
    sample = variables(
        counts=(("replicate", "bin"), counts),
        moment=(("replicate", "order"), moment),
        kept_velocity=("kept", kept),
        **means,
    )
    edges = np.linspace(-FINE_LIMIT, FINE_LIMIT, N_FINE + 1)
    return sample.assign_coords(order=("order", list(ORDERS)), edge=("edge", edges))


def bins(draws):
    """Return int[322], draws per fine bin.

    Parameters
    ----------
    draws : mapping, lower end of a fine bin (or -inf, or a limit from 8 on: the tails) -> draws
    """
    counts = np.zeros(N_FINE + 2, np.int64)
    for low, number in draws.items():
        place = round((low + FINE_LIMIT) / FINE_WIDTH) + 1 if np.isfinite(low) else 0
        counts[min(place, N_FINE + 1)] += number
    return counts


def eq_8(time):
    """Return float64[322], the probabilities of eq. (8) of the Kac paper in the fine bins.

    With C = 1 / (3 - 2 exp(-sqrt(pi) t / 16)) it is a mixture: with the weight 3/2 (1 - C) a normal
    law of variance 1 / (2 C), else a root, of random sign, of a Gamma(3/2) variate over C.
    """
    c = 1.0 / (3.0 - 2.0 * math.exp(-math.sqrt(math.pi) * time / 16.0))
    edges = np.linspace(-FINE_LIMIT, FINE_LIMIT, N_FINE + 1)
    root = 0.5 + 0.5 * np.sign(edges) * stats.gamma(1.5, scale=1.0 / c).cdf(edges**2)
    normal = stats.norm(scale=1.0 / math.sqrt(2.0 * c)).cdf(edges)
    below = 1.5 * (1.0 - c) * normal + (1.5 * c - 0.5) * root
    return np.diff(below, prepend=0.0, append=1.0)


def with_tvn(values, n_draws, time):
    """Return int[replicate, 322], counts whose TVN against eq. (8) is that of each replicate.

    A share of the draws is in the lower tail, where eq. (8) has almost none, and the others follow
    it: in bins of any width the TVN is that share, but for rounding, 1e-4 of it with 1e7 draws.
    """
    law = eq_8(time)
    counts = []
    for value in values:
        lost = round(value * n_draws)
        counts.append(rounded(law, n_draws - lost))
        counts[-1][0] += lost
    return np.array(counts)


def rounded(probabilities, n):
    """Return whole numbers that sum to n, each within 1 of n times its probability."""
    cumulative = np.round(np.cumsum(probabilities) / np.sum(probabilities) * n)
    return np.diff(cumulative, prepend=0.0).astype(np.int64)


def probes(case, axes, **by_replicate):
    """Return a sample of a branching tree's estimates.

    Parameters
    ----------
    case : its case
    axes : mapping, name of each grid axis -> values, in the sampler's order
    by_replicate : float64[*axes, replicate] each, or what broadcasts to it: ``mean``,
        ``mean_square``, ``largest``, ``nodes`` (1 if not given)
    """
    shape = (*(len(values) for values in axes.values()), case.n_replicates)
    dims = (*axes, "replicate")
    names = ("mean", "mean_square", "largest", "nodes")
    content = {name: (dims, np.broadcast_to(by_replicate.pop(name, 1.0), shape)) for name in names}
    assert not by_replicate, f"probes have no {', '.join(by_replicate)}"
    return variables(**content).assign_coords({name: list(v) for name, v in axes.items()})
