"""Faults on purpose: killed runs, broken files, full disks. Each must end with the same bytes.

``python tests/faults.py`` runs every scenario on the smoke configuration and prints a table;
``--only NAME`` runs one. The default tests run the same scenarios on a few items.
"""

import argparse
import contextlib
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from breaking import flip, remove, swap, truncate, zero
from runs import SMOKE, FaultError, Run, same

# Seconds. Snakemake's handler of a signal waits for the lock that its scheduler holds while it
# chooses jobs: a signal at that moment stops both for ever (seen once, snakemake 9.27).
PATIENCE = 180
KINDS = {  # kind of file -> pattern below the working folder
    "sample": "results/samples/*.nc",
    "dataset": "results/datasets/*.nc",
    "kernel mark": "results/kernels/**/*.txt",
    "kernel cache": "kernels/**/*.nbc",
}
FIGURES = {  # of these the report finds out: a run of single items has no stage after them
    "png": "results/figures/*.png",
    "svg": "results/figures/*.svg",
    "pdf": "results/figures/*.pdf",
    "csv": "results/figures/*.csv",
}


def other_circumstances(make, expected, full):
    """Repeat the run with other cores, order, clock, language, hash seed and folders."""
    ways = {
        "one core": {"cores": 1},
        "four cores": {"cores": 4},
        "another order": {"words": ("--scheduler", "greedy", "--config", "batch_seconds=0")},
        "time zone": {"TZ": "Asia/Kathmandu"},
        "locale": {"LC_ALL": "C", "LANG": "tr_TR.UTF-8"},
        "hash seed": {"PYTHONHASHSEED": "77"},
        "no temporary folder": {"TMPDIR": "/nowhere/at/all"},
    }
    if not full:
        merged = {key: value for way in ways.values() for key, value in way.items()}
        ways = {"all at once": merged}
    for name, way in ways.items():
        way = dict(way)
        same(make().complete(*way.pop("words", ()), **way), expected, name)
    return len(ways)


def _signal(process, number):
    """Send a signal to a process, or to its group; return whether it was still there."""
    with contextlib.suppress(ProcessLookupError):
        if isinstance(process, subprocess.Popen):
            os.killpg(process.pid, number)
        else:
            os.kill(process, number)
        return True
    return False


def _wait_for_a_moment(choice, run, process, full):
    """Wait until a share of the jobs has started, left to chance, and a little longer."""
    wanted = choice.uniform(-0.1, 0.2 if full else 0.5)
    while process.poll() is None and run.progress() < wanted:
        time.sleep(0.02)
    time.sleep(choice.uniform(0.0, 0.7))


def kill_everything(make, expected, full, n_kills=None):
    """Kill the process group at random moments; then go on."""
    choice, run, killed = random.Random(11), make(), 0
    for _ in range(n_kills or (20 if full else 3)):
        process = run.start(KACSIM_CHROMIUM=shutil.which("chromium") or "")
        _wait_for_a_moment(choice, run, process, full)
        _signal(process, signal.SIGKILL)
        killed += process.wait() == -signal.SIGKILL
        # What jobs are forked from draws nothing, and may still be busy with its imports.
        if orphans := run.ends(2.0, of=run.jobs) or run.ends():
            raise FaultError(f"orphans after a kill: {orphans}")
        run.run("--unlock")
    same(run.complete(), expected, "after kills")
    return killed


def kill_jobs(make, expected, full):
    """Kill single jobs, or what they are forked from, at random moments; the next run completes."""
    choice, run, killed = random.Random(12), make(), 0
    for k in range(10 if full else 2):
        shutil.rmtree(run.folder / "results/samples", ignore_errors=True)  # there is work to do
        process = run.start()
        _wait_for_a_moment(choice, run, process, full)
        while process.poll() is None and not (found := run.jobs()):
            time.sleep(0.005)
        if process.poll() is None:
            victim = choice.choice((run.servers() if k % 2 else []) or found)
            killed += _signal(victim, signal.SIGKILL)
        process.wait()
    same(run.complete(), expected, "after killed jobs")
    return killed


def interrupt(make, expected, full):
    """End a run by Ctrl-C or by SIGTERM: no process, lock or partial file is left."""
    choice, run, interrupted = random.Random(13), make(), 0
    for number in (signal.SIGINT, signal.SIGTERM) * (5 if full else 1):
        process = run.start()
        _wait_for_a_moment(choice, run, process, full)
        _signal(process, number)
        try:
            interrupted += process.wait(timeout=PATIENCE) != 0
        except subprocess.TimeoutExpired:  # see PATIENCE: a user would end it as a whole
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            run.run("--unlock")
            continue
        if left := run.ends() or run.leftovers():
            raise FaultError(f"{signal.Signals(number).name} left {left}")
    same(run.complete(), expected, "after signals")
    if not interrupted:
        raise FaultError("no signal ended a run")
    return interrupted


def break_files(make, expected, full):
    """Break files of every kind: rebuilt, or named with what to do; never silently used."""
    choice, run, tries = random.Random(14), make(finished=True), 0
    kinds = KINDS if run.targets else KINDS | FIGURES
    passes = [[(kind, way)] for kind in kinds for way in (truncate, zero, flip, swap, remove)]
    if not full:
        both = [("dataset", truncate), ("sample", flip)]
        passes = [both, [("sample", swap)], [("kernel cache", flip)]]
    for one in passes:
        victims = []
        for kind, way in one:
            base = run.cache.parent if kind == "kernel cache" else run.folder
            files = sorted(base.glob(kinds[kind]))
            if way is swap and len(files) < 2:
                continue
            victims.append(choice.choice(files))
            way(victims[-1], files)
            if kind == "kernel cache":
                shutil.rmtree(run.folder / "results/samples")
        if victims:
            what = ", ".join(f"{way.__name__} {kind}" for kind, way in one)
            _recover(run, victims, expected, what)
            tries += len(victims)
    return tries


def _recover(run, victims, expected, what):
    """Run; what fails must be named, and comes back once it is removed."""
    status, output = run.run()
    if status:
        right = {run.folder / name for name, value in run.checksums().items() & expected.items()}
        for victim in set(victims) - right:
            if victim.exists() and victim.name not in output:
                raise FaultError(f"{what}: {victim} is not named in {output[-1500:]}")
            victim.unlink(missing_ok=True)
        run.complete()
    same(run.checksums(), expected, f"{what}, {', '.join(map(str, victims))}")


def can_mount():
    """Tell whether this user may mount a small disk here."""
    with tempfile.TemporaryDirectory() as folder:
        mounted = subprocess.run(
            ["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", folder],
            check=False,
            capture_output=True,
        )
        if mounted.returncode == 0:
            subprocess.run(["umount", folder], check=True)
        return mounted.returncode == 0


def full_disk(make, expected, full):
    """Fill the disk in the middle of a run, and then a read-only one; needs to mount."""
    run, tries = make(), 0
    results = run.folder / "results"
    results.mkdir()
    sizes = ("200k", "1m", "3m", "8m") if full else ("400k",)
    try:
        for options in (*(f"size={size}" for size in sizes), "size=500m,ro"):
            mounted = ["-o", "remount," + options] if tries else ["-t", "tmpfs", "-o", options]
            subprocess.run(["mount", *mounted, "tmpfs", str(results)], check=True)
            status, output = run.run()
            sentence = "Read-only file system" if "ro" in options else "cannot be written"
            if not status or sentence not in output:
                raise FaultError(f"{options}: exit {status}, no clear sentence in {output[-1500:]}")
            if [f for f in run.leftovers() if "results" in f]:
                raise FaultError(f"{options} left {run.leftovers()}")
            tries += 1
        subprocess.run(["mount", "-o", "remount,size=500m,rw", str(results)], check=True)
        same(run.resume(), expected, "after a full disk")
    finally:
        subprocess.run(["umount", str(results)], check=False, capture_output=True)
    return tries


def two_at_once(make, expected, full):
    """Two runs in one folder: the second is refused. In two folders: a cold cache is shared."""
    pair = [make(), make()]
    for run in pair:
        run.cache = pair[0].folder / "kernels"
        run.targets = run.targets if full else run.targets[:1]
    processes = [run.start(cores=1) for run in pair]
    while not pair[0].leftovers() and processes[0].poll() is None:
        time.sleep(0.05)
    processes[0].send_signal(signal.SIGSTOP)  # or it may be done before the second has started
    command = [sys.executable, "-m", "snakemake", "-c1", *pair[0].targets, *SMOKE]
    second = subprocess.run(command, cwd=pair[0].folder, capture_output=True, text=True)
    processes[0].send_signal(signal.SIGCONT)
    if not second.returncode or "cannot be locked" not in second.stdout + second.stderr:
        raise FaultError(f"the second run was not refused: {second.stderr[-1000:]}")
    statuses = [process.wait() for process in processes]
    if any(statuses):
        raise FaultError("runs disturb each other, in one folder or by a cold cache they share")
    for run in pair:
        found = run.checksums()
        same(found, expected if full else {name: expected[name] for name in found}, "two at once")
    return 2


SCENARIOS = (
    other_circumstances,
    kill_everything,
    kill_jobs,
    interrupt,
    break_files,
    full_disk,
    two_at_once,
)


class Maker:
    """Makes runs in new folders of a scratch folder; they share the kernels of a first one."""

    def __init__(self, scratch, targets, undisturbed=None):
        self.scratch, self.targets = scratch, targets
        self.undisturbed = undisturbed or self._new(cache=Path(scratch) / "kernels")

    def _new(self, **choices):
        return Run(tempfile.mkdtemp(dir=self.scratch), self.targets, **choices)

    def __call__(self, finished=False):
        """Return a new run; a finished one is a copy, its kernels too, to be broken at will."""
        if finished:
            return self._new(finished=self.undisturbed)
        return self._new(cache=self.undisturbed.cache)


def main():
    """Run the scenarios on everything and print one line each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", nargs="+", choices=[one.__name__ for one in SCENARIOS])
    parser.add_argument("--items", nargs="+", default=[], help="items; everything without")
    wanted = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        make = Maker(scratch, wanted.items)
        expected = make.undisturbed.complete()
        bad = 0
        print(f"{'scenario':22}{'tries':>6}{'seconds':>9}  result", flush=True)
        for scenario in SCENARIOS:
            if wanted.only and scenario.__name__ not in wanted.only:
                continue
            start, tries, result = time.monotonic(), 0, "the same bytes"
            try:
                tries = scenario(make, expected, True)
            except FaultError as fault:
                result, bad = f"FAILED: {fault}", bad + 1
            seconds = time.monotonic() - start
            print(f"{scenario.__name__:22}{tries:6}{seconds:9.0f}  {result}", flush=True)
    return bad


if __name__ == "__main__":
    sys.exit(main())
