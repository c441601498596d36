"""Rows whose true values are known: their sets written out, what is measured, what is wrong to say.

A row's true value lies anywhere (at the middle of its set, inside, at an edge, outside), or, in
the least favourable tables, at an edge. A verdict is wrong if the row is reproduced with a value
outside its set, contradicted with all inside, or corrected with one outside the right formula's
set. Verdicts come from `kacsim.statistics.verdict`; what is true here does not.
"""

import collections
import math
from dataclasses import dataclass

import interval_laws as laws
import numpy as np
from scipy import special

from kacsim.statistics import verdict
from kacsim.statistics.estimate import Mean
from kacsim.statistics.tail import clopper_pearson
from kacsim.statistics.verdict import Finding, Part

TYPICAL = 90  # intervals of a text: sizes are chosen for their level
POWER = 1.96  # standard errors beyond the reach: sizes by the rule of a pilot run
EDGE = 1e-9  # how near an edge is, in half widths
CENTRE, INSIDE, AT_EDGE, OUTSIDE = "centre", "inside", "at an edge", "outside"
UNITS = {
    CENTRE: (0.0,),
    INSIDE: (-0.9, 0.9),
    AT_EDGE: (-1.0 - EDGE, -1.0 + EDGE, 1.0 - EDGE, 1.0 + EDGE),
    OUTSIDE: (-4.0, -1.5, 1.5, 4.0),
}  # places of a true value, in half widths of its set
ALL = (-math.inf, math.inf)


@dataclass(frozen=True)
class Scene:
    """A row's entry, its set and that of its correction, written out, and where true values lie.

    Attributes
    ----------
    half : half width that the pilot rule makes estimates for
    places : dict kind of place -> true values
    """

    entry: dict
    part: dict
    allowed: tuple
    right: tuple
    half: float
    places: dict


def _around(*sets):
    """Return places about the middle and the edges of some sets."""
    middles = [((low + high) / 2.0, (high - low) / 2.0) for low, high in sets]
    return {
        name: tuple(middle + half * u for middle, half in middles for u in units)
        for name, units in UNITS.items()
    }


def scene(entry, allowed, part=None, right=ALL):
    """Return the scene of a two-sided set."""
    sets = [allowed] if right == ALL else [allowed, right]
    half = (allowed[1] - allowed[0]) / 2.0
    return Scene(entry, part or {}, allowed, right, half, _around(*sets))


DIGITS = {"rule": "digits", "printed": "0.0482", "spread": 0.0014}
SCENES = {
    "words": scene({"rule": "words", "low": -1.0, "high": 1.0}, (-1.0, 1.0)),
    "digits": scene(DIGITS, (0.04325, 0.05315)),
    "implied": scene({"rule": "implied"}, (0.99, 1.01), {"printed": 1.0}),
    "rival": scene({"rule": "implied"}, (0.995, 1.005), {"printed": 1.0, "rival": 0.98}),
    "corrected": scene(
        {"rule": "implied"}, (0.99, 1.01), {"printed": 1.0, "corrected": 1.1}, (1.089, 1.111)
    ),
    "direction": Scene(
        {"rule": "direction", "margin": 0.5},
        {},
        (0.5, math.inf),
        ALL,
        0.25,
        {
            CENTRE: (1.0,),
            INSIDE: (0.6, 3.0),
            AT_EDGE: (0.5 - EDGE, 0.5 + EDGE),
            OUTSIDE: (-0.5, 0.0, 0.25, 0.4),
        },
    ),
    "never": Scene(
        {"rule": "never"},
        {},
        (0.0, verdict.RARE),
        ALL,
        math.nan,
        {
            CENTRE: (0.0,),
            INSIDE: (1e-6, 1e-4),
            AT_EDGE: (0.0, verdict.RARE * (1.0 - EDGE), verdict.RARE * (1.0 + EDGE)),
            OUTSIDE: (2e-3, 0.02),
        },
    ),
}


def share_scene(law):
    """Return the scene of a share: words, from end to end of the intervals that are likely."""
    p, alpha = law.probability, verdict.FAMILY_ERROR / TYPICAL
    spread = POWER * math.sqrt(p * (1.0 - p) * law.n)
    counts = max(0, math.floor(p * law.n - spread)), math.ceil(p * law.n + spread)
    low, high = (clopper_pearson(k, law.n, 1.0 - alpha)[side] for side, k in enumerate(counts))

    def places(u):
        return p + u * ((high - p) if u > 0.0 else (p - low))

    at = {name: tuple(np.clip([*map(places, units)], 0.0, 1.0)) for name, units in UNITS.items()}
    return Scene({"rule": "words", "low": low, "high": high}, {}, (low, high), ALL, math.nan, at)


def _quantile(degrees):
    return -float(special.stdtrit(degrees, verdict.FAMILY_ERROR / TYPICAL / 2.0))


@dataclass(frozen=True)
class Row:
    """A row of a table: a law, a scene, and how many components are measured."""

    type: str
    law: object
    scene: Scene
    n_parts: int = 1

    def thetas(self, rng, n_tables, hard):
        """Return (true values, float64[n_tables, parts], kind of place of each table).

        Of several components one lies there and the others at the middle; just inside an edge all
        do, so that any may be contradicted by chance.
        """
        middle = self.scene.places[CENTRE][0]
        found = np.full((n_tables, self.n_parts), middle)
        kinds = [AT_EDGE] * n_tables if hard else rng.choice(list(UNITS), n_tables)
        for k, kind in enumerate(kinds):
            at = rng.choice(self.scene.places[kind])
            inside = self.scene.allowed[0] <= at <= self.scene.allowed[1]
            if kind == AT_EDGE and inside:
                found[k] = at
            else:
                found[k, rng.integers(self.n_parts)] = at
        return found, list(kinds)

    def measure(self, rng, thetas):
        """Return what is measured, a list of the parts of each table."""
        if isinstance(self.law, laws.Counts):
            return list(zip(*(self.law.draw(rng, column) for column in thetas.T), strict=True))
        law, scene_ = self.law, self.scene
        scale = scene_.half / ((_quantile(law.degrees) + POWER) * law.error)
        columns = []
        for theta in thetas.T:
            value, error, degrees = law.draw(rng, theta.size)
            value = theta + scale * (value - law.theta)
            drawn = (value.tolist(), (scale * error).tolist(), degrees.tolist())
            columns.append([Mean(*one) for one in zip(*drawn, strict=True)])
        return list(zip(*columns, strict=True))

    def is_wrong(self, word, thetas):
        """Tell whether a verdict is wrong, from the true values of the parts."""
        sets = [(self.scene.allowed, self.scene.right)] * len(thetas)
        return is_wrong(word, self.scene.entry["rule"], thetas, sets)


def is_wrong(word, rule, thetas, sets):
    """Tell whether the verdict of a row is wrong.

    Parameters
    ----------
    word : verdict
    rule : of the row
    thetas : true values of its parts
    sets : of each part (set that the text allows, set of the right formula)
    """
    inside = [low <= theta <= high for theta, ((low, high), _) in zip(thetas, sets, strict=True)]
    if word == verdict.REPRODUCED:
        return not all(inside)
    if rule in ("never", "always"):  # one counterexample contradicts
        return word == verdict.CONTRADICTED and not any(thetas)
    if word == verdict.CONTRADICTED:
        return all(inside)
    right = [low <= theta <= high for theta, (_, (low, high)) in zip(thetas, sets, strict=True)]
    return word == verdict.CORRECTED and (all(inside) or not all(right))


class Tally:
    """What became of the rows of a type.

    Attributes
    ----------
    too_high, too_low : intervals that miss the true value
    stated : misses on either side that the level allows
    n_intervals, n_rows, wrong : intervals, rows, rows with a wrong verdict
    placed, undecided : Counter by kind of place, of the rows of one component
    """

    def __init__(self):
        self.too_high = self.too_low = self.n_intervals = self.wrong = self.n_rows = 0
        self.stated = 0.0
        self.undecided, self.placed = collections.Counter(), collections.Counter()

    def add(self, word, parts, thetas, kind, *, alpha, wrong):
        """Count a row and its intervals."""
        for part, theta in zip(parts, thetas, strict=True):
            self.too_high += theta < part["low"]
            self.too_low += theta > part["high"]
        self.stated += alpha / 2.0 * len(parts)
        self.n_intervals += len(parts)
        self.n_rows += 1
        self.wrong += wrong
        if len(parts) == 1:
            self.placed[kind] += 1
            self.undecided[kind] += word == verdict.UNDECIDED


def sweep(rows, n_tables, rng, hard, tallies):
    """Judge tables; return how many have a wrong verdict."""
    placed = [row.thetas(rng, n_tables, hard) for row in rows]
    measured = [row.measure(rng, thetas) for row, (thetas, _) in zip(rows, placed, strict=True)]
    n_wrong = 0
    for k in range(n_tables):
        found = [
            Finding(row.type, tuple(Part(one, **row.scene.part) for one in parts[k]))
            for row, parts in zip(rows, measured, strict=True)
        ]
        alpha = verdict.FAMILY_ERROR / verdict.n_intervals(found)
        some = False
        for row, one, (thetas, kinds) in zip(rows, found, placed, strict=True):
            word, parts = verdict.judge(one, row.scene.entry, alpha)
            true = thetas[k].tolist()
            wrong = row.is_wrong(word, true)
            tallies[row.type].add(word, parts, true, kinds[k], alpha=alpha, wrong=wrong)
            some |= wrong
        n_wrong += some
    return n_wrong
