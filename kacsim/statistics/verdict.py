"""Verdicts on published numbers and claims: the only home of the significance level."""

import math
from dataclasses import dataclass

from scipy import special

FAMILY_ERROR = 0.01  # chance of one wrong "not reproduced" or more in the whole table, by Holm
REPRODUCED, NOT_REPRODUCED, CORRECTED = "reproduced", "not reproduced", "corrected"
UNDECIDED = "undecided"  # too few draws to tell the printed formula from the corrected one


@dataclass(frozen=True)
class Finding:
    """What this run measured on one published number or claim.

    Attributes
    ----------
    claim : id in reports/published.yaml
    measured, standard_error : the measured quantity; an error of 0 marks an exact count
    published_error : standard error of the published value itself, where its law is known
    printed : what the printed text implies here, where that is no fixed number; else nan
    corrected : what it should be, for a text known to be wrong; else nan
    evidence : one sentence with what else was seen; figures come from the run
    """

    claim: str
    measured: float
    standard_error: float
    published_error: float = 0.0
    printed: float = math.nan
    corrected: float = math.nan
    evidence: str = ""


def statistic(measured, reference, error):
    """Return z = (measured - reference) / error; infinite if an exact count differs."""
    gap = measured - reference
    if gap == 0.0:
        return 0.0
    return gap / error if error > 0.0 else math.copysign(math.inf, gap)


def reference(finding, entry):
    """Return the value that a finding is tested against."""
    return entry["value"] if math.isnan(finding.printed) else finding.printed


def p_value(z, kind):
    """Return the p-value: two-sided for a number, of "no effect" for a stated direction."""
    if kind in ("number", "correction"):
        return float(2.0 * special.ndtr(-abs(z)))
    return float(special.ndtr(-z))


def holm(p_values):
    """Return Holm's adjusted p-values, in the given order."""
    order = sorted(range(len(p_values)), key=lambda k: p_values[k])
    adjusted, largest = [0.0] * len(p_values), 0.0
    for rank, k in enumerate(order):
        largest = max(largest, min(1.0, (len(p_values) - rank) * p_values[k]))
        adjusted[k] = largest
    return adjusted


def judge(findings, published):
    """Return one row per finding: statistic, adjusted p-value and verdict.

    Parameters
    ----------
    findings : list of Finding
    published : dict, claim id -> entry of reports/published.yaml with ``kind`` and ``value``.
        Kinds: *number* is reproduced unless the measured value contradicts it; *effect* (value:
        the bound) is reproduced only if the measured value is significantly above the bound;
        *correction* is corrected if the printed value is rejected and the corrected one is not,
        undecided if neither is. A value read off a figure has a ``reading_error``.

    Returns
    -------
    list of dict with keys z, p_value, adjusted_p_value, verdict
    """
    rows = []
    for finding in findings:
        entry = published[finding.claim]
        reading = entry.get("reading_error", 0.0)
        error = math.hypot(finding.standard_error, finding.published_error, reading)
        z = statistic(finding.measured, reference(finding, entry), error)
        rows.append({"z": z, "p_value": p_value(z, entry["kind"]), "kind": entry["kind"]})
    adjusted = holm([row["p_value"] for row in rows])
    for finding, row, p in zip(findings, rows, adjusted, strict=True):
        row["adjusted_p_value"] = p
        row["verdict"] = _verdict(finding, row["kind"], p < FAMILY_ERROR, len(rows))
    return rows


def _verdict(finding, kind, rejected, family):
    if kind == "number":
        return NOT_REPRODUCED if rejected else REPRODUCED
    if kind == "effect":
        return REPRODUCED if rejected else NOT_REPRODUCED
    error = math.hypot(finding.standard_error, finding.published_error)
    z = statistic(finding.measured, finding.corrected, error)
    stands = p_value(z, "correction") * family >= FAMILY_ERROR
    if rejected:
        return CORRECTED if stands else NOT_REPRODUCED
    return UNDECIDED if stands else REPRODUCED
