"""The report of the last full run, kept in the repository, and what has changed since.

``kept.json`` beside the report holds the commits and the configuration that it was made from, and
the hash of the sources of every module's kernels.
"""

import json
from pathlib import Path

from kacsim import store
from kacsim.provenance import source_hash
from kacsim.report import read_text, without_files
from kacsim.samplers import KERNEL_MODULES

LARGEST = 5_000_000  # bytes
REPORT, FACTS = "report.html", "kept.json"


def keep(results, settings, folder):
    """Copy the report of a run into a folder; return a sentence.

    Parameters
    ----------
    results : folder of a finished run
    settings : item -> its settings in a full run
    folder : where the report is kept

    Raises
    ------
    StoreError
        If a file is missing, the run was not a full one, or the report is too large.
    """
    results, folder = Path(results), Path(folder)
    sources = set()
    for name, wanted in settings.items():
        path = results / "datasets" / f"{name}.nc"
        attributes = store.read(path).attrs
        if attributes["settings"] != json.loads(json.dumps(wanted)):
            raise store.StoreError(f"{path}: not made with these settings; only a full run is kept")
        sources.add(attributes["source"])
    html = without_files(read_text(results / "report" / REPORT))
    if (size := len(html.encode())) > LARGEST:
        raise store.StoreError(f"{REPORT}: {size} bytes; a kept report has at most {LARGEST}")
    # What the samples were drawn by, which may be older than the sources of today.
    drawn = {name: read_text(_compiled(results, name)).strip() for name in KERNEL_MODULES}
    facts = {"sources": sorted(sources), "kernels": drawn, "configuration": settings}
    text = json.dumps(facts, indent=1, sort_keys=True) + "\n"
    for name, content in ((REPORT, html), (FACTS, text)):
        store.replace_file(folder / name, lambda path, c=content: _write(path, c))
    return f"{folder / REPORT}: kept, {size} bytes"


def _compiled(results, module):
    return results / "kernels" / Path(module).with_suffix(".txt")


def _write(path, content):
    Path(path).write_text(content, encoding="utf-8")


def sentence(folder):
    """Return one line that says whether the kernels have changed since the kept report."""
    from kacsim.jit import kernel_sources

    path = Path(folder) / FACTS
    if not path.exists():
        return f"{folder}: no report is kept yet; after a full run, `kacsim keep` keeps its report"
    facts = json.loads(read_text(path))
    now = {name: source_hash(*kernel_sources(name)) for name in KERNEL_MODULES}
    changed = sorted(name for name in now if facts["kernels"].get(name) != now[name])
    if changed:
        return f"{folder}: kernels have changed since the kept report: {', '.join(changed)}"
    return f"{folder}: no kernel has changed since the kept report"
