"""How much faster one state of the project is than another, kernel by kernel, in one run.

python tests/compare_speed.py bd30737 .
python tests/compare_speed.py --repeats 11 --only Bird OLD NEW

OLD and NEW are folders with a checkout, or commits of this repository. Each state runs in a process
of its own; kernel by kernel they take turns, so that what else the machine does and how it drifts
meets both. Printed are the medians of processor time, and the median of the ratios of one turn,
with the least and the largest. The work is that of `kacsim/benchmark/work.py` of this checkout.
"""

import argparse
import importlib.util
import json
import os
import statistics
import subprocess
import sys
import tempfile
from contextlib import ExitStack
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BENCHMARK = ROOT / "kacsim" / "benchmark"


class State:
    """A process that runs the kernels of one checkout, when it is told to."""

    def __init__(self, folder, constants):
        command = [sys.executable, __file__, "--serve", *map(str, constants)]
        known = os.environ | {"PYTHONPATH": str(folder)}
        self._process = subprocess.Popen(
            command, cwd=folder, env=known, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )

    def ask(self, *words):
        """Send a request; return the answer."""
        self._process.stdin.write(json.dumps(words) + "\n")
        self._process.stdin.flush()
        if not (line := self._process.stdout.readline()):
            raise RuntimeError("a process has ended: what it said is above")
        return json.loads(line)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.stdin.close()
        self._process.wait()


def serve(constants):
    """Answer requests: the names of all work; the draws of one measurement; what one took."""
    timing, work = loaded("timing"), loaded("work")
    from kacsim.streams import new_stream

    works, stream = work.works(*constants), new_stream(1, "benchmark")

    def draws(name):
        """Return the number, or None if this state cannot do the work."""
        try:
            return timing.draws_for(lambda n: works[name].call(n, stream))
        except MemoryError:
            return None

    def measure(name, n):
        """Return seconds of processor time per unit of work."""
        units = []
        return timing.seconds(lambda: units.append(works[name].call(n, stream))) / units[0]

    answers = {"names": lambda: list(works), "draws": draws, "measure": measure}
    for line in sys.stdin:
        question, *words = json.loads(line)
        print(json.dumps(answers[question](*words)), flush=True)


def loaded(name):
    """Return a module of this checkout's benchmark, beside another checkout's package."""
    spec = importlib.util.spec_from_file_location(name, BENCHMARK / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def checkout(state, stack):
    """Return the folder of a state; a commit is unpacked until the stack is closed."""
    if Path(state).is_dir():
        return Path(state).resolve()
    folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="kacsim-state-")))
    archive = subprocess.run(["git", "archive", state], cwd=ROOT, capture_output=True)
    if archive.returncode:
        raise SystemExit(f"{state}: neither a folder nor a commit of {ROOT}")
    subprocess.run(["tar", "-x", "-C", str(folder)], input=archive.stdout, check=True)
    return folder


def compare(old, new, name, repeats):
    """Return (seconds per unit of the old state, of the new one, ratios of each turn), or None."""
    draws = [state.ask("draws", name) for state in (old, new)]
    if None in draws:
        return None
    turns = []
    for turn in range(repeats):
        order = ((old, draws[0]), (new, draws[1]))[:: 1 if turn % 2 == 0 else -1]
        found = [state.ask("measure", name, n) for state, n in order]
        turns.append(found[:: 1 if turn % 2 == 0 else -1])
    before, after = zip(*turns, strict=True)
    ratios = [a / b for a, b in turns]
    return statistics.median(before), statistics.median(after), ratios


def main():
    """Compare two states, or be one."""
    if sys.argv[1:2] == ["--serve"]:
        serve(map(float, sys.argv[2:]))
        return
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old", help="folder or commit")
    parser.add_argument("new", help="folder or commit")
    parser.add_argument("--repeats", type=int, default=7, help="turns")
    parser.add_argument("--only", default="", help="work with this in its name")
    arguments = parser.parse_args()
    sys.path.insert(0, str(ROOT))
    from kacsim.boltzmann.constants import BREATHING
    from kacsim.kac.constants import MEAN_ENERGY, RATE

    with ExitStack() as stack:
        folders = [checkout(state, stack) for state in (arguments.old, arguments.new)]
        constants = RATE, MEAN_ENERGY, BREATHING
        old, new = (stack.enter_context(State(folder, constants)) for folder in folders)
        print("| kernel | old, ns | new, ns | ratio | least | largest |")
        print("| --- | --- | --- | --- | --- | --- |")
        for name in new.ask("names"):
            if arguments.only not in name:
                continue
            if (found := compare(old, new, name, arguments.repeats)) is None:
                print(f"| {name} | one of the states has no memory for it |")
                continue
            before, after, ratios = found
            costs = f"{1e9 * before:.1f} | {1e9 * after:.1f}"
            told = statistics.median(ratios), min(ratios), max(ratios)
            print(
                f"| {name} | {costs} | " + " | ".join(f"{r:.2f}" for r in told) + " |", flush=True
            )


if __name__ == "__main__":
    main()
