"""Tables of real samples: many seeds through `sample`, `reduce` and `claims`, against what is true.

The true value of a component is the exact one where the row knows it (the corrected value, or the
printed one if all tables together agree with it), else the mean over all tables, whose own error
is small beside that of one. Rows whose true value lies too near an edge to be told are counted
apart. What a table says must not depend on what was drawn: its sets, its number of parts, its
exact values.
"""

import collections
import math
from dataclasses import dataclass, field

import numpy as np
import xarray as xr
from verdict_rows import ALL, is_wrong

from kacsim import items, plan
from kacsim.items import _claims
from kacsim.jobs import sampling
from kacsim.kernels.provenance import ROOT
from kacsim.statistics import verdict
from kacsim.statistics.estimate import Exact, Share

CONFIGURATION = (ROOT / "config" / "config.yaml", ROOT / "config" / "smoke.yaml")
AGREES = 4.0  # pooled errors within which a known value is taken for the true one


@dataclass
class Component:
    """One component of a row over all tables.

    Attributes
    ----------
    known : corrected or printed value; nan without one
    sets : (set that the text allows, set of the right formula)
    measured : list of Mean, Share or Exact
    lows, highs : ends of the intervals
    """

    known: float
    sets: tuple
    measured: list = field(default_factory=list)
    lows: list = field(default_factory=list)
    highs: list = field(default_factory=list)

    def truth(self):
        """Return (true value, its error)."""
        if isinstance(self.measured[0], Exact):
            return self.measured[0].value, 0.0
        if isinstance(self.measured[0], Share):
            n = sum(one.n for one in self.measured)
            share = Share(sum(one.successes for one in self.measured), n)
            if not share.successes:  # never, in all tables
                return 0.0, 0.0
            value, error = share.value, share.standard_error
        else:
            values = np.array([one.value for one in self.measured])
            value, error = float(values.mean()), float(values.std()) / math.sqrt(values.size)
        if abs(value - self.known) <= AGREES * error:
            return self.known, 0.0
        return value, error

    def near(self, theta, error):
        """Tell whether a true value may lie on either side of an edge of a set."""
        ends = [end for pair in self.sets for end in pair if math.isfinite(end)]
        return error > 0.0 and any(abs(theta - end) <= AGREES * error for end in ends)

    def misses(self, theta):
        """Return (intervals above the true value, below)."""
        return sum(low > theta for low in self.lows), sum(high < theta for high in self.highs)


@dataclass
class Record:
    """A row over all tables: its rule, what it said, its components."""

    rule: str
    words: list = field(default_factory=list)
    parts: list = field(default_factory=list)


def settings_of(name, times=1, replicates=1):
    """Return the settings of an item at the smoke configuration, with more draws or replicates.

    Parameters
    ----------
    name : item
    times : every number of draws is so many times that of the configuration
    replicates : least number of replicates
    """

    def larger(key, one):
        if isinstance(one, dict):
            return {name: larger(name, inner) for name, inner in one.items()}
        if isinstance(one, list):
            return [larger(key, inner) for inner in one]
        if key.endswith("n_draws"):
            return times * one
        return max(replicates, one) if key.endswith("n_replicates") else one

    return larger("", plan.Plan(plan.read_config(*CONFIGURATION)).settings[name])


def seeded(settings, seed):
    """Return settings, those of the items that an item uses included, with another seed."""
    nested = {key: seeded(one, seed) for key, one in settings.get("items", {}).items()}
    return settings | {"seed": seed} | ({"items": nested} if nested else {})


def _known(finding):
    """Return the known value of each part: the corrected one, else the printed one, or nan."""
    return [p.printed if math.isnan(p.corrected) else p.corrected for p in finding.parts]


def _sets(table):
    """Return (allowed, right) of each part, the whole line where nothing is corrected."""
    keys = ("allowed_low", "allowed_high", "right_low", "right_high")
    ends = np.stack([table[key].values for key in keys], axis=1)
    ends = np.where(np.isnan(ends), [*ALL, *ALL], ends)
    return [((a, b), (c, d)) for a, b, c, d in ends.tolist()]


def judged(name, settings, table=_claims.table):
    """Return (findings, table) of an item from samples drawn here."""
    module = items.load(name)
    cases = {case.id: case for case in module.cases(settings)}
    samples = {key: xr.Dataset(sampling.run(case)) for key, case in cases.items()}
    if not items.uses(name):
        found = module.claims(items.reduced(name, samples, settings))
        return found, table((name,), found)
    kept = []

    def keeping(names, found):
        kept.extend(found)
        return table(names, found)

    _claims.table = keeping
    try:
        dataset = module.reduce(samples, settings)
    finally:
        _claims.table = table
    return kept, dataset


class Tables:
    """What an item says of its rows, seed after seed.

    Attributes
    ----------
    records : claim id -> Record
    depends : sentences on what should not depend on what was drawn, but does
    """

    def __init__(self, name, **size):
        self.name, self.settings = name, settings_of(name, **size)
        self.records, self.depends, self.intervals = {}, set(), []

    def add(self, seed):
        """Draw, reduce and judge one more table."""
        found, table = judged(self.name, seeded(self.settings, seed))
        words = dict(zip(table.claim.values, table.verdict.values, strict=True))
        rules = dict(zip(table.claim.values, table.rule.values, strict=True))
        self.intervals.append(int(table.n_intervals))
        self._want(len(set(self.intervals)) == 1, self.name, "number of intervals")
        for one in found:
            record = self.records.setdefault(one.claim, Record(rules[one.claim]))
            record.words.append(words[one.claim])
            here = table.isel(part=np.flatnonzero(table.of.values == one.claim))
            made = [Component(*pair) for pair in zip(_known(one), _sets(here), strict=True)]
            record.parts = record.parts or made
            if len(made) == len(record.parts):
                self._join(record.parts, made, one, here)
            else:
                self._want(False, one.claim, "number of components")

    def _join(self, parts, made, one, here):
        ends = zip(here.low.values.tolist(), here.high.values.tolist(), strict=True)
        for kept, new, part, (low, high) in zip(parts, made, one.parts, ends, strict=True):
            name = f"{one.claim} {part.label}".strip()
            self._want(new.sets == kept.sets, name, "set")
            kept.measured.append(part.measured)
            kept.lows.append(low)
            kept.highs.append(high)
            same = not isinstance(part.measured, Exact) or part.measured == kept.measured[0]
            self._want(same, name, "exact value")

    def _want(self, holds, where, what):
        if not holds:
            self.depends.add(f"{where}: {what}")

    def verdicts(self):
        """Return claim id -> (of each table whether it is wrong, whether that can be told)."""
        found = {}
        for claim, record in self.records.items():
            truths = [part.truth() for part in record.parts]
            thetas = [theta for theta, _ in truths]
            sets = [part.sets for part in record.parts]
            near = [part.near(*pair) for part, pair in zip(record.parts, truths, strict=True)]
            wrong = [is_wrong(word, record.rule, thetas, sets) for word in record.words]
            found[claim] = wrong, not any(near)
        return found

    def show(self):
        """Print what was said of each row; return how many tables have a wrong verdict."""
        n_tables = len(self.intervals)
        tables, undecided = np.zeros(n_tables, bool), 0
        print(f"\n{self.name}: {len(self.records)} rows, {self.intervals[0]} intervals")
        for claim, (wrong, told) in self.verdicts().items():
            record = self.records[claim]
            counts = collections.Counter(record.words)
            undecided += counts[verdict.UNDECIDED]
            said = ", ".join(f"{many} {word}" for word, many in counts.most_common())
            missed = [part.misses(part.truth()[0]) for part in record.parts]
            above, below = (sum(side) for side in zip((0, 0), *missed, strict=True))
            note = f"{sum(wrong)} wrong" if told else "at an edge"
            print(f"  {claim:34} {note:10} intervals too high {above}, low {below}; {said}")
            tables |= np.array(wrong) & told
        for sentence in sorted(self.depends):
            print(f"  depends on what was drawn: {sentence}")
        print(f"  {undecided / n_tables:.2f} rows undecided in a table")
        return int(tables.sum())
