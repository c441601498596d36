"""Jobs under trace, each in a process that is forked where all libraries are imported.

python tests/traced.py < jobs.json

reads a list of [name of a function below, its arguments ...] and prints what each needed.
"""

import dataclasses
import json
import os
import subprocess
import sys
import tempfile
import traceback
from pathlib import Path

import printer
import tracer

DRAWS = 20  # enough for what draws of a tree rarely do
DESCRIBED = ("required", "called", "opened", "published")


def run(jobs):
    """Return what some jobs needed.

    Returns
    -------
    list of dict phase -> {required: set of (module, name); called, opened, published: sets of str}
    """
    command = [sys.executable, "-W", "ignore", __file__]
    own = {"NUMBA_DISABLE_JIT": "1", "OPENBLAS_NUM_THREADS": "1", "PYTHONPATH": str(tracer.ROOT)}
    done = subprocess.run(
        command, input=json.dumps(jobs), capture_output=True, text=True, env=os.environ | own
    )
    assert done.returncode == 0, done.stderr[-3000:]
    found = json.loads(done.stdout.splitlines()[-1])
    for job, phases in zip(jobs, found, strict=True):
        assert phases.pop("changed") == [], f"{job} changes constants"
        for phase in phases.values():
            phase["required"] = {tuple(one) for one in phase["required"]}
            phase |= {key: set(phase[key]) for key in DESCRIBED[1:]}
    return found


def sample(trace, number):
    """Draw a tiny case, as `kacsim sample` does."""
    from kacsim.cases import tiny_cases
    from kacsim.jobs import sampling

    case = dataclasses.replace(list(tiny_cases())[number], n_draws=DRAWS)
    with trace.running("sample"):
        sampling.run(case)


def merge(trace, number):
    """Join two shards of a tiny case."""
    from kacsim import store
    from kacsim.cases import tiny_cases
    from kacsim.jobs import sampling, shards

    case = dataclasses.replace(list(tiny_cases())[number], n_replicates=2)
    with tempfile.TemporaryDirectory() as folder:
        for part in case.split(2):
            path = Path(folder) / Path(part.output()).name
            store.write_sample(sampling.run(part), path, part)
        with trace.running("merge"):
            shards.merged(case.split(2), folder)


def command(trace, *words):
    """Run a command line."""
    from kacsim import cli

    with trace.running("command"):
        cli.main(list(words))


def item(trace, name, results):
    """Reduce and draw an item of a finished run, with its claims."""
    from kacsim import items, store

    results = Path(results)
    known = store.read(results / "datasets" / f"{name}.nc")
    settings, module = known.attrs["settings"], items.load(name)
    ids = {case.id for case in module.cases(settings)}
    samples = {one: store.read(results / "samples" / f"{one}.nc") for one in ids}
    entries = {key: Entry(trace, key, entry) for key, entry in items.published().items()}
    items.published = lambda: entries
    with trace.running("reduce"):
        dataset = items.reduced(name, samples, settings)
    if hasattr(module, "claims"):
        with trace.running("claims"):
            module.claims(dataset)
    with trace.running("draw"):
        module.draw(known)


class Entry(dict):
    """An entry of reports/published/ that notes when more than its item is read."""

    def __init__(self, trace, key, content):
        super().__init__(content)
        self.trace, self.key = trace, key

    def __getitem__(self, name):
        if name not in ("item", "also") and self.trace.phase:
            self.trace.events[self.trace.phase].add(("published", self.key, ""))
        return super().__getitem__(name)


def writers(trace, name, results):
    """Write the figure of an item and the numbers behind it."""
    from kacsim import items, store
    from kacsim.drawing import marks, plotting
    from kacsim.jobs import stages
    from kacsim.recipes import lines
    from kacsim.report import csv_table

    dataset = store.read(Path(results) / "datasets" / f"{name}.nc")
    module = items.load(name)
    figure = module.draw(dataset)
    cases = stages.drawn_from(module.cases(dataset.attrs["settings"]))
    with tempfile.TemporaryDirectory() as folder, trace.running("draw"):
        recipe = lines.of_figure(dataset, "")
        for suffix in ("svg", "png", "pdf"):
            plotting.save(figure, f"{folder}/figure.{suffix}", recipe)
        csv_table.write(dataset, f"{folder}/figure.csv", recipe)
        marks.write(figure, f"{folder}/figure.marks.json", dataset, cases)


def pages(trace, results):
    """Write the report, print it by a browser that only copies, write the page of run times."""
    from kacsim import items
    from kacsim.report import page, printing, runtime

    results = Path(results)
    with tempfile.TemporaryDirectory() as folder:
        browser, html = printer.browser(Path(folder) / "bin"), f"{folder}/report.html"
        shown = items.NAMES
        with trace.running("page"):
            own = results / "page/kernels.wasm", results / "page/draws.json"
            page.write(shown, results / "datasets", results / "figures", html, "", *own)
        with trace.running("printing"):
            printing.write(html, f"{folder}/report.pdf", str(browser))
        with trace.running("runtime"):
            runtime.write(f"{folder}/runtime.html", results.parent)


def _traced(job):
    """Run one job; return what it needed."""
    trace = tracer.Trace()
    globals()[job[0]](trace, *job[1:])
    trace.stop()
    phases = [phase for phase in trace.events if isinstance(phase, str)]
    found = {p: {key: list(getattr(trace, key)(p)) for key in DESCRIBED} for p in phases}
    return found | {"changed": trace.changed()}


def _forked(job):
    """Run one job in a child; return what it needed."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        status = 1
        try:
            with os.fdopen(write, "w", encoding="utf-8") as out:
                json.dump(_traced(job), out)
            status = 0
        except BaseException:
            traceback.print_exc()
        finally:
            os._exit(status)
    os.close(write)
    with os.fdopen(read, encoding="utf-8") as out:
        text = out.read()
    assert os.waitpid(child, 0)[1] == 0, f"{job} has failed"
    return json.loads(text)


def main():
    """Import what takes long and is not traced, then run the jobs."""
    import jinja2  # noqa: F401
    import jsonschema  # noqa: F401
    import lazy_loader  # noqa: F401
    import matplotlib.backends.backend_pdf
    import matplotlib.backends.backend_svg
    import matplotlib.figure  # noqa: F401
    import mpl_toolkits.mplot3d  # noqa: F401
    import netCDF4  # noqa: F401
    import numba  # noqa: F401
    import scipy.stats  # noqa: F401
    import xarray.backends

    xarray.backends.list_engines()
    for module in tracer.modules():
        tracer.statements(module)
    print("\n" + json.dumps([_forked(job) for job in json.load(sys.stdin)]))


if __name__ == "__main__":
    main()
