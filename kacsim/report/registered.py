"""The sets of all verdicts, written down before the run that they judge.

``reports/registered.yaml`` holds, as of a commit, the set of every component of every row and the
number of intervals that share a text's chance of an error. `kacsim register` writes it from the
datasets of any run of the full configuration (sets depend on texts, formulas and settings, not on
what was drawn); a report compares its own sets with it and lists those that have changed.
"""

import math
from pathlib import Path

import yaml

from kacsim import files
from kacsim.kernels.provenance import ROOT

PATH = ROOT / "reports" / "registered.yaml"
KEYS = ("allowed_low", "allowed_high", "right_low", "right_high")
DIGITS = 9  # significant, of an end of a set


def sets(datasets):
    """Return what is registered: number of intervals by text, and sets by row and component.

    Parameters
    ----------
    datasets : dict item -> dataset; those with a table of claims count
    """
    intervals, found = {}, {}
    for name, dataset in datasets.items():
        if "claim" not in dataset:
            continue
        intervals[name.partition("_")[0]] = int(dataset["n_intervals"])
        rules = dict(zip(dataset.claim.values.tolist(), dataset.rule.values.tolist(), strict=True))
        found |= {claim: {"rule": rule, "sets": {}} for claim, rule in rules.items()}
        ends = [dataset[key].values.tolist() for key in KEYS]
        labels = dataset.label.values.tolist()
        for claim, label, *four in zip(dataset.of.values.tolist(), labels, *ends, strict=True):
            found[claim]["sets"][label] = [_end(value) for value in four if not math.isnan(value)]
    return {"intervals": intervals, "rows": found}


def _end(value):
    return value if math.isinf(value) else float(f"{value:.{DIGITS}g}")


def write(datasets, commit, path):
    """Write the sets of some datasets as those of a commit, to a file."""
    content = {"commit": commit} | sets(datasets)
    text = yaml.safe_dump(content, sort_keys=False, default_flow_style=None, width=110)
    files.replace_file(path, lambda name: Path(name).write_text(HEAD + text, encoding="utf-8"))


HEAD = """\
# Written by `kacsim register`, not by hand: the sets of all verdicts (ends of what the text allows,
# then of the right formula's set), and how many intervals share a text's chance of an error.
"""


def read(path):
    """Return what a file holds, None if there is none."""
    return files.read_yaml(path) if Path(path).exists() else None


def changes(datasets, known):
    """Return a sentence for each set that is not as registered, in the order of the rows.

    Parameters
    ----------
    datasets : dict item -> dataset
    known : what `read` returns
    """
    now, before = sets(datasets), known["rows"]
    found = [
        f"{text}: {many} intervals, registered {known['intervals'].get(text, 'none')}"
        for text, many in now["intervals"].items()
        if known["intervals"].get(text) != many
    ]
    for claim, row in now["rows"].items():
        if claim not in before:
            found.append(f"{claim}: new")
        elif row != before[claim]:
            found += _differences(claim, row, before[claim])
    return found + [f"{claim}: left out" for claim in before if claim not in now["rows"]]


def _differences(claim, row, old):
    if row["rule"] != old["rule"]:
        yield f"{claim}: rule {row['rule']}, registered {old['rule']}"
    for label in {**old["sets"], **row["sets"]}:
        one, other = (_shown(x["sets"].get(label)) for x in (row, old))
        if one != other:
            yield f"{claim}{f' ({label})' if label else ''}: {one}, registered {other}"


def _shown(ends):
    return "none" if ends is None else " to ".join(f"{value:.4g}" for value in ends[:2])
