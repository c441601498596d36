"""Verdicts: the interval of what was measured against the set of values that a text allows.

The only home of the level, the rules that make the sets, and the words for the outcome. Which rule
serves which row, with its reason, stands in reports/published/.
"""

import math
from dataclasses import dataclass

from scipy import special

from kacsim.statistics import estimate

FAMILY_ERROR = 0.01  # chance that one interval or more of a text misses its quantity
REPRODUCED, CORRECTED, CONTRADICTED = "reproduced", "corrected", "contradicted"
UNDECIDED, NOT_TESTABLE = "undecided", "not testable"
VERDICTS = (REPRODUCED, CORRECTED, CONTRADICTED, UNDECIDED, NOT_TESTABLE)
RULES = ("digits", "words", "implied", "direction", "never", "always", "untestable")
COUNTED = ("never", "always")  # rules of which violations are counted
KINDS = {
    "printed": "printed numbers",
    "stated": "stated results",
    "implied": "consequences of printed formulas",
    "check": "checks of our own code",
}
DEVIATIONS = 3.5  # of the published quantity about its mean that a printed number is allowed
TOLERANCE = 0.01  # of a value that a printed formula implies
QUARTER = 0.25  # of the distance to the formula that it must be told from
RARE = 1e-3  # rate of violations below which "never" stands without a proof
NEAR = 0.1  # of a set's width: a quantity so near its edge may stay undecided
MISSED = 0.05  # share of runs that do not see the departure that is stated as seen


@dataclass(frozen=True)
class Part:
    """One component of a row: "at every N" has one for each N.

    Attributes
    ----------
    measured : Mean, Share (of violations, for never and always) or Exact
    label : what tells it from the row's other components
    printed : value that the printed formula implies here (rule *implied*); nan without one
    rival : value of the formula that the printed one must be told from; nan without one
    corrected : value of the right formula, for a text known to be wrong; else nan
    """

    measured: object
    label: str = ""
    printed: float = math.nan
    rival: float = math.nan
    corrected: float = math.nan


@dataclass(frozen=True)
class Finding:
    """What this run measured on one row of reports/published/.

    Attributes
    ----------
    claim : id of the row
    parts : tuple of Part, at least one unless the row is not testable
    evidence : what else was seen, in sentences; figures come from the run
    """

    claim: str
    parts: tuple
    evidence: str = ""


def finding(claim, measured, evidence="", **part):
    """Return a finding of one component."""
    return Finding(claim, (Part(measured, **part),), evidence)


def half_unit(digits):
    """Return half a unit of the last printed digit of a number, given as text."""
    places = len(digits.partition(".")[2])
    return 0.5 * 10.0**-places


def around(value, *rivals):
    """Return (low, high): a value that a formula implies, and what still counts as that value."""
    gaps = [QUARTER * abs(value - rival) for rival in rivals if not math.isnan(rival)]
    half = min([TOLERANCE * abs(value), *gaps])
    return value - half, value + half


def allowed(entry, part):
    """Return the closed set (low, high) that the text allows, by the rule of its row.

    Parameters
    ----------
    entry : dict of reports/published/, with ``rule`` and what the rule needs: ``printed`` (the
        digits, as text) and ``spread`` (standard deviation of the published quantity at its
        published size); ``low`` and ``high`` (words); ``margin`` (direction)
    part : Part
    """
    rule = entry["rule"]
    if rule == "digits":
        half = half_unit(entry["printed"]) + DEVIATIONS * entry["spread"]
        return float(entry["printed"]) - half, float(entry["printed"]) + half
    if rule == "words":
        return entry["low"], entry["high"]
    if rule == "direction":
        return entry["margin"], math.inf
    if rule == "implied":
        return around(part.printed, part.rival, part.corrected)
    if rule in COUNTED:
        return 0.0, RARE
    raise ValueError(f"rule = {rule!r}: no rule that makes a set")


def correction(part):
    """Return the set (low, high) of the right formula's value; None if the row has none."""
    if math.isnan(part.corrected):
        return None
    return around(part.corrected, part.printed)


def n_intervals(findings):
    """Return over how many intervals the chance of an error is shared: exact values have none."""
    return sum(not _exact(part) for found in findings for part in found.parts)


def judge(found, entry, alpha):
    """Return (verdict of the row, list of dicts of its parts).

    Parameters
    ----------
    found : Finding
    entry : its row of reports/published/
    alpha : level of one interval

    Returns
    -------
    verdict : *reproduced* if every part is, *contradicted* if one is, *corrected* if also every
        part for which the right formula has a set lies in it, and every other part in what the
        text allows (else its parts are contradicted too); *undecided* without a part
    parts : dicts with low, high (the interval), allowed, correction (sets; None without one),
        verdict, seen (how far beyond the set's edge a quantity must lie to be contradicted in 95
        of 100 runs; for *never* and *always* the rate of violations of which as many runs meet
        one; 0 for exact values), pull (deviation from the value that is known to be right, in
        standard errors; nan without one), near (within a tenth of the set's width of its edge)
    """
    if entry["rule"] == "untestable":
        return NOT_TESTABLE, []
    parts = [_part(part, entry, alpha) for part in found.parts]
    if not all(map(_rightly, parts)):
        parts = [_uncorrected(part) for part in parts]
    words = {part["verdict"] for part in parts}
    for word in (CONTRADICTED, CORRECTED, UNDECIDED):
        if word in words:
            return word, parts
    return REPRODUCED if parts else UNDECIDED, parts


def _rightly(part):
    """Tell whether a part is as the right formula has it, or as printed if that says nothing."""
    return part["verdict"] == (CORRECTED if part["correction"] else REPRODUCED)


def _uncorrected(part):
    """Return a part without the verdict that the right formula stands, which fails elsewhere."""
    word = part["verdict"]
    return part | {"verdict": CONTRADICTED if word == CORRECTED else word}


def _part(part, entry, alpha):
    measured = part.measured
    interval, wanted, right = measured.interval(alpha), allowed(entry, part), correction(part)
    word = _verdict(interval, wanted, right)
    if entry["rule"] in COUNTED and measured.value > 0.0:
        word = CONTRADICTED
    width = wanted[1] - wanted[0]
    distance = min(abs(measured.value - edge) for edge in wanted)
    return {
        "low": interval[0],
        "high": interval[1],
        "allowed": wanted,
        "correction": right,
        "verdict": word,
        "seen": _seen(measured, entry, alpha),
        "pull": _pull(part, entry, word),
        "near": distance <= NEAR * (width if math.isfinite(width) else wanted[0]),
    }


def _seen(measured, entry, alpha):
    """Return the smallest departure that all but `MISSED` of the runs see."""
    if entry["rule"] in COUNTED and isinstance(measured, estimate.Share):
        # (1 - rate)**n = MISSED
        return -math.expm1(math.log(MISSED) / measured.n) if measured.n else 1.0
    return measured.reach(alpha) - float(special.ndtri(MISSED)) * measured.standard_error


def _verdict(interval, wanted, right):
    if any(math.isnan(end) for end in interval):
        return UNDECIDED
    if _inside(interval, wanted):
        return REPRODUCED
    if interval[1] >= wanted[0] and interval[0] <= wanted[1]:
        return UNDECIDED
    return CORRECTED if right and _inside(interval, right) else CONTRADICTED


def _inside(interval, wanted):
    return wanted[0] <= interval[0] and interval[1] <= wanted[1]


def _exact(part):
    return isinstance(part.measured, estimate.Exact)


def _pull(part, entry, word):
    """Return the deviation from the right value, in errors: standard normal if all is well.

    Whether a part has a pull must not hang on how far it deviates: undecided ones have one. Where
    the text is contradicted and no right value is known there is none.
    """
    known = part.printed if math.isnan(part.corrected) else part.corrected
    unknown = word == CONTRADICTED and math.isnan(part.corrected)
    error = part.measured.standard_error
    if unknown or entry["rule"] != "implied" or not error > 0.0:
        return math.nan
    return (part.measured.value - known) / error
