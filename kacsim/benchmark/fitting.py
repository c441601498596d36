"""Fit what a unit of work costs: every sampler timed on small cases of the configured kinds.

A case's amounts (`kacsim.cases.Case.amounts`) are counted in closed form; their nanoseconds are the
non-negative ones that make the relative errors of the measured times smallest. Trees are fitted to
the nodes that they had. The file that is written is `kacsim.costs.FILE`.
"""

import dataclasses
import json
import multiprocessing
import time
from collections import defaultdict

import numpy as np
from scipy import optimize

from kacsim import costs, files
from kacsim.benchmark.timing import processor
from kacsim.boltzmann import work
from kacsim.cases import tiny_cases
from kacsim.jobs import sampling, times
from kacsim.kernels.provenance import versions

ENOUGH = 0.1  # seconds: what a case is cut to
MOST = 6  # cases of a kind that are timed
FEWER = 8  # by which draws are cut once more, so that starting and drawing come apart
REPEATS = 3
DIGITS = 4
TRAPS = ("trap", "trap_fraction", "trap_energy")  # samplers whose trees have a fitted size
DOUBT = {"case": 0.01, "call": 0.005}  # weights of a guess of zero beside one measured time


@dataclasses.dataclass(frozen=True)
class Timed:
    """A small case, its processor time in seconds, and the mean nodes of each probe if it has any.

    Attributes
    ----------
    case : Case
    seconds : float
    nodes : float64[first, time] or None
    """

    case: object
    seconds: float
    nodes: object = None

    def amounts(self):
        """Return the case's amounts, with the nodes that its trees had."""
        amounts = self.case.amounts()
        if self.nodes is not None:
            amounts["node"] = float(self.nodes.sum()) * self.case.n_draws * self.case.n_replicates
        return amounts


def fit(cases, items_of, show=print, folder="."):
    """Time small versions of cases and write the coefficients.

    Parameters
    ----------
    cases : of Case, configured; every other kind is timed with the smallest parameters it has
    items_of : dict item -> list of Case, for the stages after sampling
    show : callable(str), called for each kind
    folder : of a run, whose records tell the time of the stages; without one they stay
    """
    found = defaultdict(list)
    for one in on_engines(list(cases)):
        found[one.kind].append(one)
    for case in tiny_cases():
        if case.kind not in found:
            small = dataclasses.replace(case, n_draws=100_000, n_replicates=100)
            found[case.kind] += with_laws_of(case, found) or [small]
    # A process of its own for each kind, as jobs have.
    with multiprocessing.get_context().Pool(1, maxtasksperchild=1) as one:
        rows = {}
        for kind in sorted(found):
            rows[kind] = one.apply(measured, [found[kind]])
            show(f"{kind}: {told(coefficients(rows[kind]))}")
    trees = {name: tree_shape(rows, name) for name in TRAPS}
    content = {
        "machine": processor(),
        "versions": versions(),
        "nanoseconds": {kind: coefficients(timings) for kind, timings in rows.items()},
        "trees": trees,
        "stages": stages(items_of, folder) or costs.table()["stages"],
    }
    text = json.dumps(content, indent=1) + "\n"
    files.replace_file(costs.FILE, lambda path: _write(path, text))
    costs.table.cache_clear()


def _write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def with_laws_of(tiny, found):
    """Return the cases of the kind that a tiny one has but for its laws, with its laws."""
    laws = {one.name: tiny.parameters[one.name] for one in tiny.sampler.parameters if one.settle}
    plain = dataclasses.replace(tiny, parameters=tiny.parameters | dict.fromkeys(laws))
    same = found.get(plain.kind, ()) if plain.kind != tiny.kind else ()
    return [dataclasses.replace(one, parameters=one.parameters | laws) for one in same]


def on_engines(cases):
    """Yield all cases, also on the engines that few are configured for, none larger than those."""
    largest = defaultdict(float)
    for case in cases:
        engine = case.parameters.get("engine")
        largest[case.name, engine] = max(largest[case.name, engine], size_of(case))
    for case in cases:
        yield case
        for engine in {*case.sampler.engines} - {case.parameters.get("engine")}:
            other = dataclasses.replace(case, parameters=case.parameters | {"engine": engine})
            if not other.problems() and size_of(other) <= largest[case.name, engine]:
                yield other


def size_of(case):
    """Return the work of one draw, all its terms together."""
    return sum(case.sampler.work(case.parameters).values())


def spread(cases):
    """Return at most `MOST` cases of a kind, with every term as small and as large as in any.

    After the smallest it is always the one that is farthest from those before, in logarithms.
    """
    works = [case.sampler.work(case.parameters) for case in cases]
    places = np.log1p([list(work.values()) for work in works])
    chosen = [int(np.argmin([size_of(case) for case in cases]))]
    while len(chosen) < MOST:
        apart = np.abs(places[:, None] - places[chosen]).max(axis=-1).min(axis=-1)
        if not apart.max() > 0.0:
            break
        chosen.append(int(apart.argmax()))
    return [cases[k] for k in chosen]


def told(terms):
    """Return nanoseconds by term as words, those of nothing left out."""
    return ", ".join(f"{term} {each:.3g} ns" for term, each in terms.items() if each > 0.0)


def measured(cases):
    """Return a list of Timed: cases of one kind, each cut to a short time, and with fewer draws."""
    sampling.load(cases[0])
    rows = []
    for case in spread(cases):
        long = cut(case)
        rows.append(long)
        for size in ("n_draws", "n_replicates"):
            fewer = max(1, getattr(long.case, size) // FEWER)
            if fewer < getattr(long.case, size):
                rows.append(timed(dataclasses.replace(long.case, **{size: fewer})))
    return rows


def cut(case):
    """Return the case with so few draws and replicates that it takes about `ENOUGH` seconds."""
    n_draws, n_replicates = min(case.n_draws, 16), 1
    while True:
        small = dataclasses.replace(case, n_draws=n_draws, n_replicates=n_replicates)
        seconds = timed(small, repeats=1).seconds
        whole = n_draws == case.n_draws and n_replicates == case.n_replicates
        if whole or seconds > ENOUGH / 2.0:
            return timed(small)
        factor = min(8.0, 0.8 * ENOUGH / max(seconds, 1e-6))
        more = max(factor, 1.3)
        if n_draws < case.n_draws:
            n_draws = min(case.n_draws, int(more * n_draws) + 1)
        else:
            n_replicates = min(case.n_replicates, int(more * n_replicates) + 1)


def timed(case, repeats=REPEATS):
    """Return the Timed of a case: the least processor time of several repeats."""
    seconds = []
    for _ in range(repeats):
        start = time.process_time()
        variables = sampling.run(case)
        seconds.append(time.process_time() - start)
        if seconds[-1] > 10.0 * ENOUGH:
            break
    dims, nodes, _ = variables.get("nodes", ((), None, {}))
    if "replicate" not in dims:
        nodes = None
    return Timed(case, min(seconds), None if nodes is None else nodes.mean(axis=-1))


def coefficients(rows):
    """Return term -> nanoseconds of one unit, from a list of Timed of one kind."""
    amounts = [row.amounts() for row in rows]
    terms = list(dict.fromkeys(term for one in amounts for term in one))
    seconds = np.array([row.seconds for row in rows])
    table = np.array([[one.get(term, 0.0) for term in terms] for one in amounts])
    scaled = table / seconds[:, None]
    largest = np.maximum(scaled.max(axis=0), 1e-300)
    # Where sizes do not tell the terms apart it is the draws that take the time.
    doubt = np.diag([DOUBT.get(term, 0.0) for term in terms])
    wanted = np.append(np.ones(len(rows)), np.zeros(len(terms)))
    found, _ = optimize.nnls(np.vstack([scaled / largest, doubt]), wanted)
    nanoseconds = 1e9 * found / largest
    return {term: rounded(n) for term, n in zip(terms, nanoseconds, strict=True)}


def rounded(value):
    """Return a number with the digits that a measurement has."""
    return float(f"{value:.{DIGITS}g}")


def tree_shape(timed, name):
    """Return the fitted keywords of `kacsim.boltzmann.work.trap_nodes` for one sampler."""
    rows = []
    for row in [one for kind, rows in timed.items() if kind.startswith(f"{name}-") for one in rows]:
        p, draws = row.case.parameters, row.case.n_draws * row.case.n_replicates
        strength = p["coupling"] * p.get("majorant_factor", 1.0)
        for i, radius in enumerate(p["radius"]):
            for j, when in enumerate(p["time"]):
                rows.append((radius, when, strength, row.nodes[i, j], draws))
    *places, nodes, draws = np.array(rows).T

    def misses(logarithms):
        shape = np.exp(logarithms)
        expected = [work.trap_nodes(*place, *shape) for place in zip(*places, strict=True)]
        return np.log(expected / nodes) * np.minimum(1.0, np.sqrt(draws / 100.0))

    best = optimize.least_squares(misses, np.log([0.7, 0.1, 1.0])).x
    return dict(zip(("amplitude", "growth", "radial"), map(rounded, np.exp(best)), strict=True))


def stages(items_of, folder):
    """Return what a run takes beside its kernels, in seconds; None if there are no records of one.

    Returns
    -------
    dict: ``job`` and ``case``, to start a job and to write the samples of a case; ``item`` and
    ``read``, to reduce and draw an item and to read the samples of one of its cases
    """
    jobs = times.collect(folder)
    if not {"sample", "reduce", "draw"} <= jobs.keys():
        return None
    number = times.cases_of(folder)
    drawn = [(number[job], seconds - kernels) for job, seconds, kernels in jobs["sample"]]
    reduced = [
        (len(items_of[name]), seconds) for name, seconds in _by_item(jobs["reduce"], items_of)
    ]
    job, case = _line(drawn)
    item, read = _line(reduced)
    item += np.mean([seconds for _, seconds in _by_item(jobs["draw"], items_of)])
    found = {"job": job, "case": case, "item": item, "read": read}
    return {name: rounded(seconds) for name, seconds in found.items()}


def _by_item(jobs, items_of):
    names = [(job.rpartition("/")[2], seconds) for job, seconds, _ in jobs]
    return [(name, seconds) for name, seconds in names if name in items_of]


def _line(pairs):
    """Return (a, b), neither negative, of the line a + b x nearest to pairs of x and y."""
    x, y = np.array(pairs, dtype=float).T
    return optimize.nnls(np.stack([np.ones(x.size), x], axis=1), y)[0]
