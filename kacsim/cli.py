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
JOIN = "--and"  # between the cases of one `sample` command


def main(argv=None):
    """Run one command; return the exit status: 0, or 2 with one sentence on stderr."""
    from kacsim.store import StoreError

    requests = [_parser().parse_args(words) for words in _split(argv)]
    try:
        if len(requests) > 1:
            _sample_all(requests)
        else:
            requests[0].run(requests[0])
    except (plan.PlanError, StoreError, BudgetError) as error:
        print(error, file=sys.stderr)
        return USAGE_ERROR
    return 0


def _split(argv):
    """Return the command as a list of commands: ``sample A --and B`` is two."""
    words = sys.argv[1:] if argv is None else list(argv)
    if words[:1] != ["sample"]:
        return [words]
    parts = [[]]
    for word in words[1:]:
        if word == JOIN:
            parts.append([])
        else:
            parts[-1].append(word)
    return [["sample", *part] for part in parts]


def _parser():
    parser = argparse.ArgumentParser(prog="kacsim", description="Stages of the kacsim pipeline.")
    commands = parser.add_subparsers(required=True, metavar="command")
    one = commands.add_parser("plan", help="check a configuration and list its cases")
    one.add_argument("--config", nargs="+", default=["config/config.yaml"], metavar="FILE")
    one.add_argument("--item", help="list the cases of one item only")
    one.set_defaults(run=_plan)
    for one in _add_sampling(commands, "sample", "draw one case"):
        one.add_argument("--shard", type=_shard, default=(1, 1), help="k/K: these replicates only")
        one.set_defaults(run=_sample)
    for one in _add_sampling(commands, "merge", "join the shards of one case"):
        one.add_argument("--shards", type=_shards, required=True, dest="shard", help="how many")
        one.add_argument("--folder", default="results/shards", help="where they lie")
        one.set_defaults(run=_merge)
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
    one.add_argument(
        "--since", type=_float, default=0.0, help="seconds since 1970: later jobs only"
    )
    one.set_defaults(run=_times)
    one = commands.add_parser("benchmark", help="measure the kernels, as ratios in one run")
    one.add_argument("--repeats", type=int, default=5, help="runs whose median counts")
    one.set_defaults(run=_benchmark)
    return parser


def _add_sampling(commands, name, text):
    """Add a command on one case; yield the parser of each sampler."""
    parent = commands.add_parser(name, help=text)
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
        yield one


def _value(name):
    if name in ("algorithm", "engine", "initial"):
        return str
    if name == "max_nodes":
        return _integer
    return _count if name == "n_particles" else _float


def _integer(text):
    """Return an integer; other text stays as it is, for the checks to refuse by name."""
    try:
        return int(text)
    except ValueError:
        return text


def _shard(text):
    """Return k/K as two integers; whether they are a shard of the case is checked later."""
    try:
        number, total = map(int, text.split("/"))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: must be k/K, two integers") from None
    return number, total


def _shards(text):
    return _shard(f"1/{text}")


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
    _sample_all([arguments])


def _sample_all(requests):
    """Draw cases one after the other; all are checked before the first is drawn."""
    chosen = [_case_of(arguments) for arguments in requests]
    from kacsim import sampling, store, times

    for arguments in requests:
        store.check_writable(arguments.output)
    for arguments, case in zip(requests, chosen, strict=True):
        sampling.load(case)
        start = time.perf_counter()
        variables = sampling.run(case)
        print(times.drawn_sentence(case, time.perf_counter() - start), flush=True)
        store.write(variables, arguments.output, title=case.title(), settings=case.settings())


def _merge(arguments):
    parts = _case_of(arguments).split(arguments.shard[1])
    from kacsim import shards, store

    store.check_writable(arguments.output)
    case, variables = parts[0].whole(), shards.merged(parts, arguments.folder)
    store.write(variables, arguments.output, title=case.title(), settings=case.settings())


def _case_of(arguments):
    """Return the case that the flags of `sample` or `merge` describe."""
    names = cases.SAMPLERS[arguments.sampler]
    given = {name: getattr(arguments, name) for name in names}
    given = {name: value for name, value in given.items() if value is not None}
    size = {name: getattr(arguments, name) for name in ("n_draws", "n_replicates", "seed")}
    case = cases.make_case(arguments.sampler, **given, **size, shard=arguments.shard)
    problems = [Problem(cases.flag(p.name), p.value, p.allowed) for p in case.problems()]
    if problems:
        raise plan.PlanError("\n".join(map(str, problems)))
    return case


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

    print(times.table(arguments.folder, arguments.since))


def _benchmark(arguments):
    from kacsim import benchmark

    benchmark.run(arguments.repeats)
