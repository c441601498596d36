"""What each command does: check, call, write. No science here."""

import json
import time
from pathlib import Path

from kacsim import cases, plan, samplers
from kacsim.checks import Problem

DIFFERENCE = 1  # exit status of `verify` where bits differ


def _planned(arguments):
    """Return (plan, cases of the wanted item or of all items)."""
    checked = plan.Plan(plan.read_config(*arguments.config), arguments.config)
    if arguments.item is None:
        return checked, list(checked.cases.values())
    if arguments.item not in checked.cases_of:
        known = ", ".join(checked.cases_of)
        raise plan.PlanError(f"--item = {arguments.item!r}: must be one of {known}")
    return checked, checked.cases_of[arguments.item]


def run_plan(arguments):
    """Print the cases of a configuration, as a table or their ids."""
    checked, chosen = _planned(arguments)
    if arguments.ids:
        print("\n".join(case.id for case in chosen))
    else:
        print(checked.table(chosen))


def run_verify(arguments):
    """Draw cases again; return 1 if bits differ from those kept, else 0."""
    from kacsim import progress, verify

    if not (isinstance(arguments.cases, int) and arguments.cases >= 1):
        raise plan.PlanError(f"--cases = {arguments.cases!r}: must be an integer, at least 1")
    wrong = 0
    for case in verify.choose(_planned(arguments)[1], arguments.cases, arguments.choice):
        line = progress.Progress(case.n_draws * case.n_replicates, case.id)
        state, sentence = verify.verify(case, arguments.samples, line)
        line.end()
        print(sentence)
        wrong += state != verify.EQUAL
    return DIFFERENCE if wrong else 0


def run_estimate(arguments):
    """Print the estimate of one probe."""
    from kacsim import estimating

    estimating.run(arguments)


def run_sample(arguments):
    """Draw one case."""
    return run_sample_all([arguments])


def run_sample_all(requests):
    """Draw cases one after the other; all are checked before the first is drawn."""
    chosen = [_case_of(arguments) for arguments in requests]
    from kacsim import progress, sampling, store, times

    for arguments in requests:
        store.check_writable(arguments.output)
    for arguments, case in zip(requests, chosen, strict=True):
        sampling.load(case)
        line = progress.Progress(case.n_draws * case.n_replicates, case.id)
        start = time.perf_counter()
        variables = sampling.run(case, line)
        line.end()
        print(times.drawn_sentence(case, time.perf_counter() - start), flush=True)
        store.write_sample(variables, arguments.output, case)
    return 0


def run_merge(arguments):
    """Join the shards of one case."""
    parts = _case_of(arguments).split(arguments.shard[1])
    from kacsim import shards, store

    store.check_writable(arguments.output)
    case, variables = parts[0].whole(), shards.merged(parts, arguments.folder)
    store.write_sample(variables, arguments.output, case)


def _case_of(arguments):
    """Return the case that the flags of `sample` or `merge` describe."""
    names = samplers.SAMPLERS[arguments.sampler]
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


def run_reduce(arguments):
    """Make the dataset of an item."""
    _known_item(arguments.item)
    try:
        settings = json.loads(arguments.settings)
    except json.JSONDecodeError as error:
        raise plan.PlanError(
            f"--settings = {arguments.settings!r}: is not JSON: {error}"
        ) from error
    from kacsim import items, provenance, store

    module = items.load(arguments.item)
    wanted = module.cases(settings)
    folder = Path(arguments.samples)
    samples = {case.id: store.read_sample(folder / f"{case.id}.nc", case) for case in wanted}
    dataset = items.reduced(arguments.item, samples, settings)
    about = {
        "title": module.__doc__.splitlines()[0],
        "settings": settings,
        "code": provenance.source_hash(*plan.reduce_sources(arguments.item)),
    }
    store.write(dataset.assign_attrs(item=arguments.item), arguments.output, **about)


def run_draw(arguments):
    """Draw the figure of an item, and write the numbers behind it."""
    _known_item(arguments.item)
    from kacsim import csv_table, items, plotting, store

    dataset = store.read_dataset(arguments.dataset, arguments.item)
    figure = items.load(arguments.item).draw(dataset)
    sums = [path for path in arguments.output if path.endswith(".sha256")]
    drawn = [path for path in arguments.output if path not in sums]
    for path in drawn:
        if path.endswith(".csv"):
            csv_table.write(dataset, path)
        else:
            plotting.save(figure, path)
    for path in sums:
        store.write_sums(drawn, path)


def run_report(arguments):
    """Write the report."""
    from kacsim import report

    for name in arguments.items:
        _known_item(name)
    folders = arguments.datasets, arguments.figures
    report.write(arguments.items, *folders, arguments.output, arguments.options)


def run_print(arguments):
    """Print the report."""
    from kacsim import printing

    printing.write(arguments.report, arguments.output)


def run_keep(arguments):
    """Keep the report of a full run."""
    from kacsim import kept

    checked = plan.Plan(plan.read_config(*arguments.config), arguments.config)
    print(kept.keep(arguments.results, checked.settings, arguments.folder))


def run_kept(arguments):
    """Say which kernels have changed since."""
    from kacsim import kept

    print(kept.sentence(arguments.folder))


def run_compile(arguments):
    """Compile a module, and leave a file that says so."""
    from kacsim import jit, provenance, sampling, store

    sampling.compile_module(arguments.module)
    text = provenance.source_hash(*jit.kernel_sources(arguments.module)) + "\n"
    store.replace_file(arguments.output, lambda name: Path(name).write_text(text))


def run_times(arguments):
    """Print where the time of a run went, or write the page of it."""
    from kacsim import times

    if arguments.output:
        times.write(arguments.output, arguments.folder)
    else:
        print(times.table(arguments.folder, arguments.since))


def run_summary(arguments):
    """Print where the report is and how many verdicts stand, if it is newer than a time."""
    report = Path(arguments.report)
    if not report.exists() or report.stat().st_mtime < arguments.since:
        return
    from kacsim import store

    words = []
    for path in sorted(Path(arguments.datasets).glob("*_numbers.nc")):
        words += list(store.read(path)["verdict"].values)
    counts = {word: words.count(word) for word in dict.fromkeys(words)}
    shown = ", ".join(f"{number} {word}" for word, number in sorted(counts.items()))
    print(f"{report}: of {len(words)} published results {shown}")


def run_benchmark(arguments):
    """Print the measurements of the kernels."""
    from kacsim import benchmark

    benchmark.run(arguments.repeats)
