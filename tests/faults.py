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

from runs import SMOKE, FaultError, Run, same

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
    """Repeat the run with other cores, order, clock, language, hash seed and folder."""
    ways = {
        "one core": {"cores": 1},
        "four cores": {"cores": 4},
        "another order": {"words": ("--scheduler", "greedy", "--config", "batch_seconds=0")},
        "time zone": {"TZ": "Asia/Kathmandu"},
        "locale": {"LC_ALL": "C", "LANG": "tr_TR.UTF-8"},
        "hash seed": {"PYTHONHASHSEED": "77"},
    }
    if not full:
        merged = {key: value for way in ways.values() for key, value in way.items()}
        ways = {"all at once": merged}
    for name, way in ways.items():
        way = dict(way)
        same(make().complete(*way.pop("words", ()), **way), expected, name)
    return len(ways)


def _signal(process, number):
    """Send a signal to a process group, unless it has already ended."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, number)


def kill_everything(make, expected, full, n_kills=None):
    """Kill the process group at random moments; then go on."""
    choice, run, killed = random.Random(11), make(), 0
    for _ in range(n_kills or (20 if full else 3)):
        process = run.start(KACSIM_CHROMIUM=shutil.which("chromium") or "")
        time.sleep(choice.uniform(1.5, 9.0 if full else 5.0))
        _signal(process, signal.SIGKILL)
        killed += process.wait() == -signal.SIGKILL
        time.sleep(0.2)
        if run.processes():
            raise FaultError(f"orphans after a kill: {run.processes()}")
        run.run("--unlock")
    same(run.resume(), expected, "after kills")
    return killed


def kill_jobs(make, expected, full):
    """Kill single jobs at random moments; the run fails, and the next one completes."""
    choice, run, killed = random.Random(12), make(), 0
    for _ in range(10 if full else 2):
        process, end = run.start(), time.monotonic() + choice.uniform(2.0, 8.0)
        while time.monotonic() < end and process.poll() is None:
            time.sleep(0.1)
        jobs = [pid for pid in run.processes() if b"kacsim" in _command(pid)]
        for pid in jobs[:1]:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
                killed += 1
        process.wait()
    same(run.complete(), expected, "after killed jobs")
    return killed


def _command(pid):
    try:
        words = Path(f"/proc/{pid}/cmdline").read_bytes().split(b"\0")
    except OSError:
        return b""
    return b" ".join(words) if b"-m" in words and b"snakemake" not in words else b""


def interrupt(make, expected, full):
    """End a run by Ctrl-C or by SIGTERM: no lock and no partial file is left."""
    choice, tries = random.Random(13), 0
    for number in (signal.SIGINT, signal.SIGTERM):
        run = make()
        for _ in range(5 if full else 1):
            process = run.start()
            time.sleep(choice.uniform(3.0, 9.0))
            _signal(process, number)
            process.wait()
            time.sleep(0.5)
            if run.leftovers():
                raise FaultError(f"{signal.Signals(number).name} left {run.leftovers()}")
            tries += 1
        same(run.complete(), expected, signal.Signals(number).name)
    return tries


def break_files(make, expected, full):
    """Break files of every kind: rebuilt, or named with what to do; never silently used."""
    choice, run, tries = random.Random(14), make(), 0
    run.complete()
    kinds = KINDS if run.targets else KINDS | FIGURES
    cases = [(kind, way) for kind in kinds for way in (truncate, zero, flip, swap, remove)]
    if not full:
        cases = [("sample", flip), ("sample", swap), ("dataset", truncate), ("kernel cache", flip)]
    for kind, way in cases:
        base = run.cache.parent if kind == "kernel cache" else run.folder
        files = sorted(base.glob(kinds[kind]))
        if way is swap and len(files) < 2:
            continue
        victim = choice.choice(files)
        way(victim, files)
        if kind == "kernel cache":
            shutil.rmtree(run.folder / "results/samples")
        _recover(run, victim, expected, f"{way.__name__} {kind}")
        tries += 1
    return tries


def _recover(run, victim, expected, what):
    status, output = run.run()
    if status:
        if victim.name not in output:
            raise FaultError(f"{what}: {victim} is not named in {output[-1500:]}")
        victim.unlink(missing_ok=True)
        run.complete()
    same(run.checksums(), expected, f"{what}, {victim}")


def truncate(victim, _):
    """Cut a file to a third."""
    victim.write_bytes(victim.read_bytes()[: victim.stat().st_size // 3])


def zero(victim, _):
    """Overwrite a file with zeros."""
    victim.write_bytes(bytes(victim.stat().st_size))


def flip(victim, _):
    """Flip a bit in the middle."""
    content = bytearray(victim.read_bytes())
    content[len(content) // 2] ^= 0x10
    victim.write_bytes(content)


def swap(victim, files):
    """Exchange the content of two files of a kind."""
    other = next(f for f in files if f != victim and f.read_bytes() != victim.read_bytes())
    victim.write_bytes(other.read_bytes())


def remove(victim, _):
    """Remove a file."""
    victim.unlink()


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


def no_temporary_folder(make, expected, full):
    """Run without the folder that TMPDIR names."""
    same(make().complete(TMPDIR="/nowhere/at/all"), expected, "no TMPDIR")
    return 1


def two_at_once(make, expected, full):
    """Two runs in one folder: the second is refused. In two folders: a cold cache is shared."""
    run = make()
    first = run.start()
    while not run.leftovers() and first.poll() is None:
        time.sleep(0.05)
    command = [sys.executable, "-m", "snakemake", "-c1", *run.targets, *SMOKE]
    second = subprocess.run(command, cwd=run.folder, capture_output=True, text=True)
    if not second.returncode or "cannot be locked" not in second.stdout + second.stderr:
        raise FaultError(f"the second run was not refused: {second.stderr[-1000:]}")
    if first.wait():
        raise FaultError("the first run was disturbed")
    same(run.checksums(), expected, "two in one folder")
    pair = [make(), make()]
    pair[1].cache = pair[0].cache
    shutil.rmtree(pair[0].cache, ignore_errors=True)
    processes = [one.start(cores=1) for one in pair]
    if [status for status in [process.wait() for process in processes] if status]:
        raise FaultError("two cold runs that share a kernel cache disturb each other")
    for one in pair:
        same(one.checksums(), expected, "two that share a cache")
    return 2


SCENARIOS = (
    other_circumstances,
    kill_everything,
    kill_jobs,
    interrupt,
    break_files,
    full_disk,
    no_temporary_folder,
    two_at_once,
)


def main():
    """Run the scenarios on everything and print one line each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", nargs="+", choices=[one.__name__ for one in SCENARIOS])
    parser.add_argument("--items", nargs="+", default=[], help="items; everything without")
    wanted = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        cache = Path(scratch) / "kernels"

        def make():
            return Run(tempfile.mkdtemp(dir=scratch), wanted.items, cache)

        expected = make().complete()
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
