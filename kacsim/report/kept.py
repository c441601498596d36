"""The report of the last full run, kept in the repository, and what has changed since.

``kept.json`` beside the report holds the commits and the configuration that it was made from, and
the hash of what the kernels of every sampler were compiled from.
"""

import json
from pathlib import Path

from kacsim import files, store
from kacsim.cases import tiny_cases
from kacsim.kernels import sources
from kacsim.report.page import without_files
from kacsim.report.texts import read_text

LARGEST_REPORT = 6_000_000  # bytes
REPORT, FACTS = "report.html", "kept.json"


def keep(results, plan, folder):
    """Copy the report of a run into a folder; return a sentence.

    Parameters
    ----------
    results : folder of a finished run
    plan : kacsim.plan.Plan of a full run
    folder : where the report is kept

    Raises
    ------
    StoreError
        If a file is missing, the run was not a full one, or the report is too large.
    """
    results, folder = Path(results), Path(folder)
    made_by = set()
    for name, wanted in plan.settings.items():
        path = results / "datasets" / f"{name}.nc"
        attributes = store.read(path).attrs
        if attributes["settings"] != json.loads(json.dumps(wanted)):
            raise files.StoreError(f"{path}: not made with these settings; only a full run is kept")
        made_by.add(attributes["source"])
    html = without_files(read_text(results / "report" / REPORT))
    if (size := len(html.encode())) > LARGEST_REPORT:
        raise files.StoreError(
            f"{REPORT}: {size} bytes; a kept report has at most {LARGEST_REPORT}"
        )
    # What the samples were drawn by, which may be older than the sources of today.
    marks = {case.unit: results.parent / case.compiled() for case in plan.cases.values()}
    drawn = {unit: read_text(mark).strip() for unit, mark in marks.items()}
    facts = {"sources": sorted(made_by), "kernels": drawn, "configuration": plan.settings}
    text = json.dumps(facts, indent=1, sort_keys=True) + "\n"
    for name, content in ((REPORT, html), (FACTS, text)):
        files.replace_file(folder / name, lambda path, c=content: _write(path, c))
    return f"{folder / REPORT}: kept, {size} bytes"


def _write(path, content):
    Path(path).write_text(content, encoding="utf-8")


def sentence(folder):
    """Return one line that says whether the kernels have changed since the kept report."""
    path = Path(folder) / FACTS
    if not path.exists():
        return f"{folder}: no report is kept yet; after a full run, `kacsim keep` keeps its report"
    facts = json.loads(read_text(path))
    now = {case.unit: sources.code(case.roots) for case in tiny_cases()}
    changed = sorted(name for name, code in facts["kernels"].items() if now.get(name) != code)
    if changed:
        return f"{folder}: kernels have changed since the kept report: {', '.join(changed)}"
    return f"{folder}: no kernel has changed since the kept report"
