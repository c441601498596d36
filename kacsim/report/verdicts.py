"""The verdicts as the page shows them: every row with its set, its interval and its reason."""

import math
import re

from kacsim.report.numbers import FIXED_SPACE, bound, number, pm, span, typeset
from kacsim.statistics.verdict import KINDS, VERDICTS

SIGNS = dict(zip(VERDICTS, "✓↻✗?–", strict=True))
# What stands in place of a set whose row is about violations.
NEVER = "no violation, or at most 1 in 1000"


def rows(datasets, entries):
    """Return claim id -> its row, with its numbers as text and its components in `parts`.

    Parameters
    ----------
    datasets : of the items that have a table of claims, and others
    entries : claim id -> entry of reports/published/
    """
    found = {}
    for dataset in datasets:
        if "claim" not in dataset:
            continue
        texts = _columns(dataset, "row")
        parts = _columns(dataset, "part")
        for row in texts:
            entry = entries[row["claim"]]
            own = [_part(part, entry) for part in parts if part["of"] == row["claim"]]
            found[row["claim"]] = row | _worded(row, entry, own)
    return found


def components(datasets):
    """Return claim id -> list of its components, dicts of numbers as the datasets hold them."""
    found = {}
    for dataset in datasets:
        for part in _columns(dataset, "part") if "claim" in dataset else ():
            found.setdefault(part["of"], []).append(part)
    return found


def _columns(dataset, dim):
    """Return the table along a dimension as a list of dicts."""
    names = [name for name in dataset.data_vars if dataset[name].dims == (dim,)]
    columns = [dataset[name].values.tolist() for name in names]
    return [dict(zip(names, cells, strict=True)) for cells in zip(*columns, strict=True)]


def _worded(row, entry, parts):
    """Return the texts of a row."""
    source = re.sub(
        r"\b(sections?|Figs?\.|eqs?\.|exercises?) ", rf"\1{FIXED_SPACE}", entry["source"]
    )
    words = [part["verdict"] for part in parts]
    counts = [f"{words.count(word)} {word}" for word in VERDICTS if word in words]
    return {
        "item": entry["item"],
        "words": bound(entry["text"]),
        "source": source,
        "reason": bound(typeset(entry["reason"])),
        "rule": entry["rule"],
        "printed": entry.get("printed", ""),
        "parts": parts,
        "shown": next((part for part in parts if part["verdict"] == row["verdict"]), None),
        "summary": f"{len(parts)} components: {', '.join(counts)}" if len(parts) > 1 else "",
        "evidence": bound(typeset(row["evidence"])),
    }


def _part(part, entry):
    """Return the texts of a component; the interval of an exact value is the value itself."""
    exact = part["law"] == "exact"
    right = not math.isnan(part["right_low"])
    value = number(part["measured"])
    return {
        "label": bound(part["label"]),
        "verdict": part["part_verdict"],
        "measured": "exact" if exact else pm(part["measured"], part["standard_error"]),
        "interval": value if exact else span(part["low"], part["high"]),
        "law": part["law"],
        "allowed": _allowed(part, entry),
        "right": span(part["right_low"], part["right_high"]) if right else "",
        "seen": "any" if exact else number(part["seen"], 2),
    }


def _allowed(part, entry):
    low, high = part["allowed_low"], part["allowed_high"]
    if entry["rule"] in ("never", "always"):
        return NEVER
    if math.isinf(high):
        return f"at least {number(low, 3)}"
    if entry["rule"] == "digits":
        return f"{entry['printed']}: {span(low, high)}"
    if entry["rule"] == "words":
        return f"“{entry['words']}”: {number(low)} to {number(high)}"
    return span(low, high)


def counted(found):
    """Return kind -> (its name, its rows, word -> number of its rows), kinds without rows left out.

    Parameters
    ----------
    found : claim id -> row
    """
    groups = {}
    for kind, name in KINDS.items():
        own = [row for row in found.values() if row["kind"] == kind]
        words = [row["verdict"] for row in own]
        counts = {word: words.count(word) for word in VERDICTS if word in words}
        if own:
            groups[kind] = {"name": name, "rows": own, "counts": counts}
    return groups
