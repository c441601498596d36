"""The command line: parse, call, write. No science here."""

import argparse
import json
import math
import sys
import time
from pathlib import Path

from kacsim import cases, plan
from kacsim.checks import BudgetError, Problem

USAGE_ERROR = 2


def main(argv=None):
    """Run one command; return the exit status: 0, or 2 with one sentence on stderr."""
    from kacsim.store import StoreError

    arguments = _parser().parse_args(argv)
    try:
        arguments.run(arguments)
    except (plan.PlanError, StoreError, BudgetError) as error:
        print(error, file=sys.stderr)
        return USAGE_ERROR
    return 0


def _parser():
    parser = argparse.ArgumentParser(prog="kacsim", description="Stages of the kacsim pipeline.")
    commands = parser.add_subparsers(required=True, metavar="command")
    one = commands.add_parser("plan", help="check a configuration and list its cases")
    one.add_argument("--config", nargs="+", default=["config/config.yaml"], metavar="FILE")
    one.add_argument("--item", help="list the cases of one item only")
    one.set_defaults(run=_plan)
    _add_sample(commands)
    one = commands.add_parser("reduce", help="make the dataset of one item from its samples")
    one.add_argument("item")
    one.add_argument("--settings", required=True, help="the item's settings, as JSON")
    one.add_argument("--samples", default="results/samples", metavar="FOLDER")
    one.add_argument("--output", required=True)
    one.set_defaults(run=_reduce)
    one = commands.add_parser("draw", help="draw the figure of one item from its dataset")
    one.add_argument("item")
    one.add_argument("--dataset", required=True)
    one.add_argument("--output", required=True, nargs="+", help="files ending in png, svg, pdf")
    one.set_defaults(run=_draw)
    one = commands.add_parser("report", help="write the report from datasets and figures")
    one.add_argument("--datasets", default="results/datasets", metavar="FOLDER")
    one.add_argument("--figures", default="results/figures", metavar="FOLDER")
    one.add_argument("--items", nargs="+", required=True)
    one.add_argument("--output", required=True)
    one.set_defaults(run=_report)
    one = commands.add_parser("compile", help="compile a module's kernels into the kernel cache")
    one.add_argument("module", choices=cases.KERNEL_MODULES)
    one.add_argument("--output", required=True, help="file that gets the hash of the sources")
    one.set_defaults(run=_compile)
    one = commands.add_parser("times", help="show where the time of the last run went")
    one.add_argument("--folder", default=".", help="where benchmarks and logs lie")
    one.set_defaults(run=_times)
    one = commands.add_parser("benchmark", help="measure the kernels, as ratios in one run")
    one.add_argument("--repeats", type=int, default=5, help="runs whose median counts")
    one.set_defaults(run=_benchmark)
    return parser


def _add_sample(commands):
    parent = commands.add_parser("sample", help="draw one case")
    samplers = parent.add_subparsers(required=True, metavar="sampler", dest="sampler")
    for sampler, names in cases.SAMPLERS.items():
        one = samplers.add_parser(sampler)
        for name in names:
            required = name not in cases.DEFAULTS
            many = {"nargs": "+"} if name in cases.LISTS.get(sampler, ()) else {}
            one.add_argument(cases.flag(name), type=_value(name), required=required, **many)
        one.add_argument("--n-draws", type=_integer, required=True, help="draws of a replicate")
        one.add_argument("--n-replicates", type=_integer, default=1)
        one.add_argument("--seed", type=_integer, required=True)
        one.add_argument("--output", required=True)
        one.set_defaults(run=_sample)


def _value(name):
    if name in ("algorithm", "engine", "initial", "law", "envelope", "generator"):
        return str
    if name in ("max_nodes", "n_table", "dimension", "edge", "n_points", "n_representatives"):
        return _integer
    return _count if name == "n_particles" else _float


def _integer(text):
    """Return an integer; other text stays as it is, for the checks to refuse by name."""
    try:
        return int(text)
    except ValueError:
        return text


def _count(text):
    return math.inf if text == "inf" else _integer(text)


def _float(text):
    try:
        return float(text)
    except ValueError:
        return text


def _plan(arguments):
    checked = plan.Plan(plan.read_config(*arguments.config), arguments.config)
    if arguments.item is not None and arguments.item not in checked.cases_of:
        known = ", ".join(checked.cases_of)
        raise plan.PlanError(f"--item = {arguments.item!r}: must be one of {known}")
    chosen = checked.cases_of.get(arguments.item, checked.cases.values())
    for case in chosen:
        print(case.id)


def _sample(arguments):
    names = cases.SAMPLERS[arguments.sampler]
    given = {name: getattr(arguments, name) for name in names}
    given = {name: value for name, value in given.items() if value is not None}
    size = {name: getattr(arguments, name) for name in ("n_draws", "n_replicates", "seed")}
    case = cases.make_case(arguments.sampler, **given, **size)
    problems = [Problem(cases.flag(p.name), p.value, p.allowed) for p in case.problems()]
    if problems:
        raise plan.PlanError("\n".join(map(str, problems)))
    from kacsim import sampling, store, times

    title = f"{case.n_replicates} x {case.n_draws} draws of {case.id}"
    store.check_writable(arguments.output)
    start = time.perf_counter()
    variables = sampling.run(case)
    print(times.drawn_sentence(case.n_draws * case.n_replicates, time.perf_counter() - start))
    store.write(variables, arguments.output, title=title, settings=case.settings())


def _known_item(name):
    from kacsim import items

    if name not in items.NAMES:
        raise plan.PlanError(f"item = {name!r}: must be one of {', '.join(items.NAMES)}")


def _reduce(arguments):
    _known_item(arguments.item)
    try:
        settings = json.loads(arguments.settings)
    except json.JSONDecodeError as error:
        raise plan.PlanError(
            f"--settings = {arguments.settings!r}: is not JSON: {error}"
        ) from error
    from kacsim import items, store

    module = items.load(arguments.item)
    wanted = module.cases(settings)
    folder = Path(arguments.samples)
    samples = {case.id: store.read_sample(folder / f"{case.id}.nc", case) for case in wanted}
    dataset = items.reduced(arguments.item, samples, settings)
    title = module.__doc__.splitlines()[0]
    store.write(dataset, arguments.output, title=title, settings=settings)


def _draw(arguments):
    _known_item(arguments.item)
    from kacsim import items, plotting, store

    figure = items.load(arguments.item).draw(store.read(arguments.dataset))
    for path in arguments.output:
        plotting.save(figure, path)


def _report(arguments):
    from kacsim import report

    for name in arguments.items:
        _known_item(name)
    report.write(arguments.items, arguments.datasets, arguments.figures, arguments.output)


def _compile(arguments):
    from kacsim import jit, provenance, sampling, store

    sampling.compile_module(arguments.module)
    text = provenance.source_hash(*jit.kernel_sources(arguments.module)) + "\n"
    store.replace_file(arguments.output, lambda name: Path(name).write_text(text))


def _times(arguments):
    from kacsim import times

    print(times.table(arguments.folder))


def _benchmark(arguments):
    from kacsim import benchmark

    benchmark.run(arguments.repeats)
