"""The command line: parse and call. No science here."""

import argparse
import math
import signal
import sys
import threading

import shtab

from kacsim import cases, commands, meanings, plan, samplers
from kacsim.checks import BudgetError

USAGE_ERROR = 2
JOIN = "--and"  # between the cases of one `sample` command
COMPLETION = "--print-completion"
# What reads the schema, the texts or the published numbers, which are not part of the package.
OF_A_CLONE = ("plan", "verify", "reduce", "draw", "report", "keep", "kept")
# command -> (what it does, an example)
COMMANDS = {
    "plan": ("check a configuration and list its cases", "plan --item kac_fig3"),
    "sample": (
        "draw one case",
        "sample kac --algorithm bird --n-particles 50 --time 2 --n-draws 1000000 --seed 1 "
        "--output bird.nc",
    ),
    "merge": (
        "join the shards of one case",
        "merge kac --algorithm bird --n-particles 50 --time 2 --n-draws 100 --n-replicates 4 "
        "--seed 1 --shards 2 --output bird.nc",
    ),
    "estimate": (
        "probe a density or a fraction by trees",
        "estimate bkw --velocity 4 --time 1 --n-realizations 100000",
    ),
    "verify": ("draw cases again and compare bits", "verify --cases 10"),
    "reduce": (
        "make the dataset of one item from its samples",
        "reduce kac_fig4 --settings '{...}' --output results/datasets/kac_fig4.nc",
    ),
    "draw": (
        "draw the figure of one item from its dataset",
        "draw kac_fig4 --dataset results/datasets/kac_fig4.nc --output fig4.png",
    ),
    "report": (
        "write the report from datasets and figures",
        "report --items kac_fig4 kac_fig5 --output report.html",
    ),
    "print": ("print the report to PDF, by Chromium", "print"),
    "keep": ("keep the report of a full run in reports/latest", "keep"),
    "kept": ("say which kernels have changed since the kept report", "kept"),
    "compile": (
        "compile a module's kernels into the kernel cache",
        "compile kac/bird.py --output bird.txt",
    ),
    "times": ("show where the time of the last run went", "times"),
    "summary": ("show where the report is and how many verdicts stand", "summary"),
    "benchmark": ("measure the kernels, as ratios in one run", "benchmark"),
}
EPILOG = """examples:
  kacsim plan                          what the full run would do
  kacsim sample kac --help             the options of one sampler
  kacsim verify                        compare bits with an earlier run
The pipeline itself is run by `snakemake -c2 all`."""


class Parser(argparse.ArgumentParser):
    """Parser whose complaint is one line."""

    def error(self, message):
        """Print what is wrong and end with the status of a usage error."""
        self.exit(USAGE_ERROR, f"{self.prog}: {message}; see {self.prog} --help\n")


def main(argv=None):
    """Run one command; return the exit status: 0, or 2 with one sentence on stderr.

    A comparison of `verify` that finds a difference gives 1.
    """
    from kacsim.store import StoreError

    if threading.current_thread() is threading.main_thread():
        # A job that is told to end cleans up after itself.
        signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(128 + number))
    parts = _split(argv)
    requests = [_parser(words).parse_args(words) for words in parts]
    try:
        _insist_on_clone(command=parts[0][0])
        if len(requests) > 1:
            return commands.run_sample_all(requests)
        return requests[0].run(requests[0]) or 0
    except (plan.PlanError, StoreError, BudgetError) as error:
        print(error, file=sys.stderr)
        return USAGE_ERROR


def _insist_on_clone(command):
    if command in OF_A_CLONE and not plan.SCHEMA.is_file():
        advice = "there, install by pip install --no-deps --editable ."
        raise plan.PlanError(f"kacsim {command}: needs a clone of the project; {advice}")


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


def _parser(words=()):
    """Return the parser; that of the estimators, which need the compiler, only if it is called."""
    form = argparse.RawDescriptionHelpFormatter
    parser = Parser(
        prog="kacsim",
        description="Reproducible Monte Carlo experiments on gases.",
        epilog=EPILOG,
        formatter_class=form,
    )
    shtab.add_argument_to(parser, COMPLETION, help="print what completes words in this shell")
    found = parser.add_subparsers(required=True, metavar="command")
    parts = {}
    for name, (text, example) in COMMANDS.items():
        about = {"help": text, "description": f"{text[0].upper()}{text[1:]}."}
        parts[name] = found.add_parser(
            name, epilog=f"example:\n  kacsim {example}", formatter_class=form, **about
        )
        parts[name].set_defaults(run=getattr(commands, f"run_{name}"))
    _add_configured(parts["plan"], parts["verify"])
    for one in _add_sampling(parts["sample"]):
        one.add_argument("--shard", type=_shard, default=(1, 1), help="k/K: these replicates only")
    for one in _add_sampling(parts["merge"]):
        one.add_argument("--shards", type=_shards, required=True, dest="shard", help="how many")
        one.add_argument("--folder", default="results/shards", help="where they lie")
    if words and words[0] in ("estimate", COMPLETION):
        from kacsim import estimating

        estimating.add_parsers(parts["estimate"])
    _add_stages(parts["reduce"], parts["draw"], parts["report"], parts["compile"])
    _add_pages(parts["print"], parts["keep"], parts["kept"])
    parts["times"].add_argument("--folder", default=".", help="where benchmarks and logs lie")
    parts["times"].add_argument("--output", metavar="FILE", help="write a page of all jobs instead")
    parts["summary"].add_argument("--report", default="results/report/report.html", metavar="FILE")
    parts["summary"].add_argument("--datasets", default="results/datasets", metavar="FOLDER")
    for one in (parts["times"], parts["summary"]):
        one.add_argument("--since", type=_float, default=0.0, help="seconds since 1970")
    parts["benchmark"].add_argument("--repeats", type=int, default=5, help="runs; medians count")
    return parser


def _add_config(*parsers):
    text = "configuration of the run; later files override (default config/config.yaml)"
    default = ["config/config.yaml"]
    for one in parsers:
        one.add_argument("--config", nargs="+", default=default, metavar="FILE", help=text)


def _sample_file(text):
    if not text.endswith((".nc", ".csv")):
        raise argparse.ArgumentTypeError(f"{text!r}: must end in .nc or .csv")
    return text


def _add_configured(planning, verifying):
    _add_config(planning, verifying)
    for one in (planning, verifying):
        one.add_argument("--item", help="the cases of one item only")
    planning.add_argument("--ids", action="store_true", help="print the ids of the cases alone")
    one = verifying
    one.add_argument("--cases", type=_integer, default=5, help="how many, at random (default 5)")
    one.add_argument("--choice", type=_integer, default=0, help="seed of the choice (default 0)")
    one.add_argument("--samples", default="results/samples", metavar="FOLDER")


def _add_stages(reducing, drawing, reporting, compiling):
    reducing.add_argument("item")
    reducing.add_argument("--settings", required=True, help="the item's settings, as JSON")
    reducing.add_argument("--samples", default="results/samples", metavar="FOLDER")
    reducing.add_argument("--output", required=True)
    drawing.add_argument("item")
    drawing.add_argument("--dataset", required=True)
    drawing.add_argument("--output", required=True, nargs="+", help="svg, png, pdf, csv; sha256")
    reporting.add_argument("--datasets", default="results/datasets", metavar="FOLDER")
    reporting.add_argument("--figures", default="results/figures", metavar="FOLDER")
    reporting.add_argument("--items", nargs="+", required=True)
    reporting.add_argument("--output", required=True)
    reporting.add_argument("--options", default="", help="of the command on the page")
    compiling.add_argument("module", choices=samplers.KERNEL_MODULES)
    compiling.add_argument("--output", required=True, help="file that gets the sources' hash")


def _add_pages(printing, keeping, asking):
    printing.add_argument("--report", default="results/report/report.html", metavar="FILE")
    printing.add_argument("--output", default="results/report/report.pdf", metavar="FILE")
    keeping.add_argument("--results", default="results", metavar="FOLDER")
    _add_config(keeping)
    for one in (keeping, asking):
        one.add_argument("--folder", default="reports/latest", help="where the report is kept")


def _add_sampling(parent):
    """Add the samplers to a command on one case; yield the parser of each."""
    found = parent.add_subparsers(required=True, metavar="sampler", dest="sampler")
    for sampler, names in samplers.SAMPLERS.items():
        text = meanings.DRAWS[sampler]
        one = found.add_parser(sampler, help=text, description=f"Draw {text}.")
        for name in names:
            engine = name == "engine"  # of all others the case fills in the default
            many = {"nargs": "+"} if name in samplers.LISTS.get(sampler, ()) else {}
            one.add_argument(
                cases.flag(name),
                type=_value(name),
                required=name not in samplers.DEFAULTS and not engine,
                default="ancestral" if engine else None,
                help=meanings.MEANINGS[name],
                **many,
            )
        one.add_argument("--n-draws", type=_integer, required=True, help="draws of a replicate")
        one.add_argument("--n-replicates", type=_integer, default=1, help="default 1")
        one.add_argument("--seed", type=_integer, required=True)
        one.add_argument(
            "--output", type=_sample_file, required=True, help="file ending in .nc or .csv"
        )
        yield one


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
