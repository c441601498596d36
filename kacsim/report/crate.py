"""A finished run as an RO-Crate, ready for an archive: its files, and how they were made.

Workflow Run RO-Crate 0.5: https://w3id.org/ro/wfrun/workflow/0.5
"""

import datetime
import hashlib
import json
import tempfile
from pathlib import Path

from kacsim import files
from kacsim.kernels import provenance
from kacsim.kernels.provenance import ROOT
from kacsim.recipes import carriers
from kacsim.report.texts import read_text

VERSION = "1.1"  # of RO-Crate, which these profiles are made for
PROFILES = ("process/0.5", "workflow/0.5")
FORM = "https://w3id.org/ro/wfrun/"
WORKFLOW_CRATE = "https://w3id.org/workflowhub/workflow-ro-crate/1.0"
MISSING = "kacsim crate: needs rocrate; install the library of that name, or the group archive"
KINDS = {
    ".nc": "application/x-netcdf",
    ".csv": "text/csv",
    ".html": "text/html",
    ".json": "application/json",
    ".pdf": "application/pdf",
    ".png": "image/png",
    ".svg": "image/svg+xml",
}
SHA256 = "https://w3id.org/ro/terms/workflow-run#sha256"
INPUTS = ("environment.txt", "workflow/schemas/config.schema.yaml")


def write(results, output, with_samples=False):
    """Write the crate of a run as a zip file; return the number of result files in it.

    Parameters
    ----------
    results : folder of a finished run
    output : zip file to create or replace
    with_samples : bool, also the samples

    Raises
    ------
    StoreError
        If rocrate is not installed, or the run has no report.
    """
    try:
        from rocrate.rocrate import ROCrate
    except ImportError as error:
        raise files.StoreError(MISSING) from error
    results = Path(results)
    report = results / "report" / "report.html"
    settings, source, _ = carriers.of_page(read_text(report), report)
    crate = ROCrate(version=VERSION)
    crate.metadata.extra_terms["sha256"] = SHA256
    crate.name = "Monte Carlo for kinetic equations: published results, regenerated"
    crate.description = f"A run of the kacsim workflow: {source}"
    crate.license = "https://spdx.org/licenses/MIT"
    ended = datetime.datetime.fromtimestamp(report.stat().st_mtime, datetime.UTC)
    crate.datePublished = ended
    workflow = crate.add_workflow(
        ROOT / "Snakefile", "Snakefile", main=True, lang="snakemake",
        lang_version=provenance.version("snakemake"),
        properties={"name": "kacsim", "version": source.split(",")[0].removeprefix("kacsim ")},
    )  # fmt: skip
    given = [crate.add_file(ROOT / name, name) for name in INPUTS]
    with tempfile.TemporaryDirectory(prefix="kacsim-") as folder:
        config = Path(folder) / "configuration.json"
        config.write_text(json.dumps(settings, indent=1, sort_keys=True), encoding="utf-8")
        given.append(crate.add_file(config, "configuration.json", properties=_about(config)))
        made = [_added(crate, path, results) for path in _results(results, with_samples)]
        action = {
            "name": f"Run of {source}",
            "description": "The published results, made again from nothing",
            "endTime": ended.isoformat(timespec="seconds"),
            "actionStatus": "http://schema.org/CompletedActionStatus",
        }
        done = crate.add_action(workflow, "#run", object=given, result=made, properties=action)
        crate.root_dataset["mentions"] = done
        _conform(crate)
        files.replace_file(output, crate.write_zip)
    return len(made)


def _results(results, with_samples):
    """Return the files of a run, in order."""
    folders = ("report", "figures", "datasets", *(("samples",) if with_samples else ()))
    found = (path for folder in folders for path in sorted((results / folder).glob("*")))
    return [path for path in found if path.is_file() and not path.name.startswith(".")]


def _added(crate, path, results):
    place = Path("results") / path.relative_to(results)
    return crate.add_file(path, place.as_posix(), properties=_about(path))


def _about(path):
    content = path.read_bytes()
    about = {"name": path.name, "contentSize": str(len(content))}
    if kind := KINDS.get(path.suffix):
        about["encodingFormat"] = kind
    return about | {"sha256": hashlib.sha256(content).hexdigest()}


def _conform(crate):
    """Say which profiles the crate conforms to."""
    from rocrate.model.contextentity import ContextEntity

    names = [*(f"{FORM}{one}" for one in PROFILES), WORKFLOW_CRATE]
    found = []
    for name in names:
        about = {"@type": "CreativeWork", "name": name.rsplit("/", 2)[1], "version": name[-3:]}
        found.append(crate.add(ContextEntity(crate, name, properties=about)))
    crate.root_dataset["conformsTo"] = found
