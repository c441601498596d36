"""Expected processor time: amounts of work times the nanoseconds that the benchmark fitted.

`kacsim benchmark --fit` writes the file that is read here (`kacsim.benchmark.fitting`). Nothing
heavy is imported: the plan reads it at every start of Snakemake.
"""

import functools
import json
import statistics

from kacsim.kernels.provenance import PACKAGE

OUTSIDE = "it tells how long a job takes, and no job what to draw"

FILE = PACKAGE / "costs.json"
DRAW = "draw"  # the term that every sampler has


@functools.cache
def table():
    """Return the fitted coefficients.

    Returns
    -------
    dict with ``machine``, ``versions`` (str), ``nanoseconds`` (kind -> term -> float), ``trees``
    (what `kacsim.boltzmann.work.trap_nodes` takes), ``stages`` (stage -> seconds each)
    """
    return json.loads(FILE.read_text(encoding="utf-8"))


def kind_of(sampler, parameters):
    """Return the name that a case's coefficients have: its sampler and its words."""
    words = (value for value in parameters.values() if isinstance(value, str))
    return "-".join([sampler, *words])


def nanoseconds(kind):
    """Return term -> nanoseconds of one unit of work.

    A kind that was not measured takes each unit as long as the slowest of its sampler's; one of a
    sampler that was not measured has no units of its own.
    """
    known = table()["nanoseconds"]
    if kind in known:
        return known[kind]
    sampler = kind.partition("-")[0]
    found = {}
    for other, terms in known.items():
        if other.partition("-")[0] == sampler:
            for term, each in terms.items():
                found[term] = max(each, found.get(term, 0.0))
    return found


def seconds(kind, amounts):
    """Return the expected processor time of a case's kernels.

    Parameters
    ----------
    kind : str, of `kind_of`
    amounts : dict term -> float, of `kacsim.cases.Case.amounts`
    """
    each = nanoseconds(kind)
    return 1e-9 * sum(n * each.get(term, 0.0 if each else _usual()) for term, n in amounts.items())


@functools.cache
def _usual():
    """Return the median over all kinds of the nanoseconds of a draw: for a sampler not measured."""
    return statistics.median(terms.get(DRAW, 0.0) for terms in table()["nanoseconds"].values())


def stage_seconds(**number):
    """Return the seconds beside the kernels of so many ``job``, ``case``, ``item`` and ``read``.

    They are spent on starting a job, writing the samples of a case, reducing and drawing an item,
    and reading the samples of one of its cases.
    """
    return sum(table()["stages"][name] * n for name, n in number.items())
