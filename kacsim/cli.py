"""The command line: parse and call. No science here."""

import argparse
import importlib
import signal
import sys
import threading

from kacsim import commands, plan
from kacsim.checks import BudgetError
from kacsim.files import StoreError

USAGE_ERROR = 2
JOIN = "--and"  # between the cases of one `sample` command
COMPLETION = "--print-completion"
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
    if threading.current_thread() is threading.main_thread():
        # A job that is told to end cleans up after itself.
        signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(128 + number))
    parts = _split(argv)
    requests = [_parser(words).parse_args(words) for words in parts]
    command = _load(parts[0][0])
    try:
        _insist_on_clone(parts[0][0], command)
        if len(requests) > 1:
            return command.run_all(requests) or 0
        return command.run(requests[0]) or 0
    except (plan.PlanError, StoreError, BudgetError) as error:
        print(error, file=sys.stderr)
        return USAGE_ERROR


def _load(name):
    return importlib.import_module(f"kacsim.commands.{name}")


def _insist_on_clone(name, command):
    if getattr(command, "OF_A_CLONE", False) and not plan.SCHEMA.is_file():
        advice = "there, install by pip install --no-deps --editable ."
        raise plan.PlanError(f"kacsim {name}: needs a clone of the project; {advice}")


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
    """Return the parser; options are added to the command that is called, or to complete all."""
    import shtab

    form = argparse.RawDescriptionHelpFormatter
    parser = Parser(
        prog="kacsim",
        description="Reproducible Monte Carlo experiments on gases.",
        epilog=EPILOG,
        formatter_class=form,
    )
    shtab.add_argument_to(parser, COMPLETION, help="print what completes words in this shell")
    found = parser.add_subparsers(required=True, metavar="command")
    called = words[0] if words else ""
    for name in commands.NAMES:
        if called in commands.NAMES and name != called:
            continue
        command = _load(name)
        text = command.__doc__.splitlines()[0]
        one = found.add_parser(
            name,
            help=text[0].lower() + text[1:-1],
            description=text,
            epilog=f"example:\n  kacsim {command.EXAMPLE}",
            formatter_class=form,
        )
        if called in (name, COMPLETION):
            command.add(one)
    return parser
