"""Wrong science must be caught: plausible slips, one at a time, each of which must fail the tests.

python tests/mutants.py
python tests/mutants.py --only bird-twice-the-collisions
python tests/mutants.py --sample 4 --choice 17

Each slip of mutants.yaml is applied to a copy of the project. The tests named there run first;
if they pass, the whole default suite does, but for tests/workflow and tests/browser, which look at
the machinery and not at the science, the test of this table, and those of the bits, which tell that
something is different and not that it is wrong. A test that fails is then run without the slip: it
catches nothing unless it passes there. The exit status is 1 if a slip survives or cannot be
applied any more.
"""

import argparse
import os
import queue
import random
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parent.parent
TABLE = Path(__file__).with_suffix(".yaml")
LEFT_OUT = (
    "tests/workflow",
    "tests/browser",
    "tests/unit/test_mutants.py",
    "tests/unit/test_bits.py",
    "tests/unit/test_frozen.py",
)
NOT_COPIED = (".git", ".venv", ".snakemake", ".*_cache", "__pycache__", "results", "logs")
SECONDS = 900  # after which a run of tests is given up
CAUGHT, SURVIVED, STALE, BROKEN = "caught", "SURVIVED", "STALE", "BROKEN"


@dataclass(frozen=True)
class Mutant:
    """A slip: text of one source file that is replaced, and the tests to run first."""

    name: str
    slip: str
    file: str
    old: str
    new: str
    tests: tuple

    def path(self, root):
        return root / "kacsim" / self.file

    def stale(self, root):
        """Return why the slip cannot be applied, or nothing."""
        found = self.path(root).read_text(encoding="utf-8").count(self.old)
        return "" if found == 1 else f"old text found {found} times in kacsim/{self.file}"

    def apply(self, root):
        text = self.path(root).read_text(encoding="utf-8")
        self.path(root).write_text(text.replace(self.old, self.new), encoding="utf-8")

    def undo(self, root):
        """Put the source back; the kernels compiled from it are found again by their key."""
        shutil.copy(self.path(ROOT), self.path(root))


@dataclass
class Outcome:
    """What became of one mutant."""

    mutant: Mutant
    kind: str
    test: str = ""
    seconds: float = 0.0


def load():
    """Return all mutants in the order of the table, in which sources stay together."""
    mutants = []
    for group in yaml.safe_load(TABLE.read_text(encoding="utf-8")):
        for name, entry in group["mutants"].items():
            tests = entry.get("tests", group.get("tests"))
            mutants.append(
                Mutant(name, entry["slip"], group["file"], entry["old"], entry["new"], tuple(tests))
            )
    names = [mutant.name for mutant in mutants]
    if len(set(names)) < len(names):
        raise ValueError(f"{TABLE.name}: a name occurs twice")
    return mutants


class Copy:
    """A copy of the project with a kernel cache, in which one run of tests goes on at a time."""

    def __init__(self, folder):
        self.root = folder / "project"
        shutil.copytree(ROOT, self.root, ignore=shutil.ignore_patterns(*NOT_COPIED))
        self.environment = os.environ | {
            "KACSIM_CACHE_DIR": str(folder / "kernels"),
            "PYTHONDONTWRITEBYTECODE": "1",
            "COLUMNS": "400",
        }
        # The seeds and the results that the tests are known to pass with.
        for name in ("KACSIM_TEST_SEED", "KACSIM_TEST_RESULTS"):
            self.environment.pop(name, None)

    def failing(self, *words, first=True):
        """Run pytest; return (exit status, tests that failed, the end of what it said)."""
        options = ["-q", "-o", "addopts=", "-p", "no:cacheprovider", "--tb=line", "-rfE"]
        command = [sys.executable, "-m", "pytest", *options, *(["-x"] if first else []), *words]
        try:
            done = subprocess.run(
                command,
                cwd=self.root,
                env=self.environment,
                capture_output=True,
                text=True,
                timeout=SECONDS,
            )
        except subprocess.TimeoutExpired:
            return -1, [], f"gave up after {SECONDS} s"
        text = done.stdout + done.stderr
        failed = re.findall(r"^(?:FAILED|ERROR) (\S+::.*?)(?: - .*)?$", done.stdout, re.MULTILINE)
        return done.returncode, failed, text[-2000:]

    def judge(self, mutant):
        """Return the outcome of one mutant."""
        if why := mutant.stale(self.root):
            return Outcome(mutant, STALE, why)
        start = time.monotonic()
        rest = ["tests", *(f"--ignore={folder}" for folder in LEFT_OUT)]
        mutant.apply(self.root)
        try:
            for words in (*map(shlex.split, mutant.tests), rest):
                status, failed, text = self.failing(*words)
                if status != 0:
                    break
        finally:
            mutant.undo(self.root)
        seconds = time.monotonic() - start
        if status == 0:
            return Outcome(mutant, SURVIVED, "", seconds)
        if status != 1 or not failed:
            return Outcome(mutant, BROKEN, text, seconds)
        return Outcome(mutant, CAUGHT, failed[0], seconds)


def show(outcome):
    name, seconds = outcome.mutant.name, outcome.seconds
    where = outcome.test if outcome.kind == CAUGHT else f"{outcome.kind} {outcome.test}".strip()
    print(f"{name:<38} {seconds:5.1f} s  {where}", flush=True)


def run(mutants, jobs):
    """Judge all mutants, each on a copy of the project that is free; return the outcomes."""
    with tempfile.TemporaryDirectory(prefix="kacsim-mutants-") as scratch:
        free = queue.SimpleQueue()
        for k in range(jobs):
            free.put(Copy(Path(scratch) / str(k)))

        def one(mutant):
            copy = free.get()
            try:
                outcome = copy.judge(mutant)
            finally:
                free.put(copy)
            show(outcome)
            return outcome

        with ThreadPoolExecutor(jobs) as pool:
            outcomes = list(pool.map(one, mutants))
        check(free.get(), outcomes)
    return outcomes


def check(copy, outcomes):
    """Run the tests that caught mutants without any: one that fails has caught nothing."""
    tests = sorted({outcome.test for outcome in outcomes if outcome.kind == CAUGHT})
    if not tests:
        return
    status, failed, text = copy.failing(*tests, first=False)
    for outcome in outcomes:
        if outcome.kind == CAUGHT and (outcome.test in failed or status not in (0, 1)):
            outcome.kind = BROKEN
            outcome.test = f"{outcome.test} fails without the slip: {text}"
            show(outcome)


def chosen(arguments, mutants):
    """Return the mutants that the command line asks for."""
    if arguments.only:
        known = {mutant.name: mutant for mutant in mutants}
        if unknown := set(arguments.only) - set(known):
            raise SystemExit(f"no such mutant: {', '.join(sorted(unknown))}")
        return [mutant for mutant in mutants if mutant.name in arguments.only]
    if arguments.sample:
        some = random.Random(arguments.choice).sample(mutants, min(arguments.sample, len(mutants)))
        return [mutant for mutant in mutants if mutant in some]
    return mutants


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--only", nargs="+", metavar="NAME", help="these mutants")
    parser.add_argument("--sample", type=int, metavar="N", help="a random handful")
    parser.add_argument("--choice", default="0", metavar="SEED", help="which handful; any text")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="mutants at a time")
    parser.add_argument("--list", action="store_true", help="show the slips, run nothing")
    arguments = parser.parse_args()
    mutants = chosen(arguments, load())
    if arguments.list:
        for mutant in mutants:
            print(f"{mutant.name:<38} kacsim/{mutant.file}: {mutant.slip}")
        return 0
    start = time.monotonic()
    outcomes = run(mutants, max(1, arguments.jobs))
    numbers = {kind: sum(o.kind == kind for o in outcomes) for kind in (CAUGHT, SURVIVED, STALE)}
    numbers[BROKEN] = len(outcomes) - sum(numbers.values())
    told = ", ".join(f"{number} {kind.lower()}" for kind, number in numbers.items())
    print(f"{len(outcomes)} mutants: {told}; {time.monotonic() - start:.0f} s")
    return int(numbers[CAUGHT] < len(outcomes))


if __name__ == "__main__":
    sys.exit(main())
