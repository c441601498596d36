"""A file made again: samples here, everything else by the workflow in a folder of its own."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

from kacsim import items, store
from kacsim.drawing import plotting
from kacsim.files import StoreError, replace_file
from kacsim.jobs import sampling
from kacsim.kac import own_tables
from kacsim.kernels.provenance import ROOT
from kacsim.report import csv_table, page, printing

CONFIG = "recipe.json"
LAST = 12  # lines of a failed run that are shown


def make(order, output, scratch, cores, advance=None):
    """Make the file of an order again; it carries the recipe of the first one.

    Parameters
    ----------
    order : kacsim.again.reading.Order
    output : Path of the file to write
    scratch : folder for what it is made from
    cores : int, jobs at a time
    advance : callable(draws done), for samples

    Raises
    ------
    StoreError
        Says what failed.
    """
    if order.case:
        sampling.load(order.case)
        variables = sampling.run(order.case, advance)
        _write_samples(variables, order, output)
        return
    if not order.recipe.item:
        _make_report(order, output, _run(order, "results/report/report.html", scratch, cores))
        return
    name = order.recipe.item
    target = _run(order, f"results/datasets/{name}.nc", scratch, cores)
    dataset = store.read_dataset(target, name)
    if output.suffix == ".nc":
        _copy(target, output)
    elif output.suffix == ".csv":
        csv_table.write(dataset, output, order.text)
    else:
        plotting.save(items.load(name).draw(dataset), output, order.text)


def _make_report(order, output, report):
    """Write the page of a run with the command that the first one tells, and print it."""
    results = report.parent.parent
    folders = results / "datasets", results / "figures"
    own = results / "page" / "kernels.wasm", results / "page" / "draws.json"
    page.write(items.NAMES, *folders, report, order.recipe.options, *own)
    if output.suffix == ".html":
        _copy(report, output)
        return
    printed = report.with_suffix(".pdf")
    printing.write(report, printed)
    replace_file(output, lambda name: printing.settle(printed, name, order.text))


def _copy(source, output):
    replace_file(output, lambda name: Path(name).write_bytes(source.read_bytes()))


def _write_samples(variables, order, output):
    if output.suffix == ".csv":
        import xarray as xr

        csv_table.write(xr.Dataset(variables), output, order.text)
    else:
        store.write_sample(variables, output, order.case)


def _run(order, target, scratch, cores):
    """Run the workflow for one file, with the settings of the recipe as its configuration."""
    folder = Path(scratch)
    (folder / CONFIG).write_text(json.dumps(order.plan.config), encoding="utf-8")
    _bring_tables(order.plan.config, folder)
    command = [sys.executable, "-m", "snakemake", "--snakefile", str(ROOT / "Snakefile")]
    command += ["--directory", str(folder), "--configfile", str(folder / CONFIG)]
    command += ["--cores", str(cores), "--quiet", "all", "--", target]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        said = "\n".join((done.stdout + done.stderr).splitlines()[-LAST:])
        raise StoreError(f"{order.path}: cannot be made again:\n{said}")
    return folder / target


def _bring_tables(config, folder):
    """Copy the files of densities that a configuration names to where the workflow runs."""
    for section in config.values():
        for value in section.values() if isinstance(section, dict) else ():
            if own_tables.is_file(value):
                name = own_tables.parts_of(value)[0]
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(name, folder / name)
