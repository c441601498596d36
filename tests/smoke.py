"""The finished smoke run that tests share: made once, beside the tests that do not need it.

python tests/smoke.py FOLDER

makes it in a copy of the project in FOLDER; KACSIM_TEST_RESULTS=FOLDER/results has tests use it.
"""

import contextlib
import fcntl
import os
import signal
import subprocess
import sys
from pathlib import Path

from runs import SMOKE, copy_project

SAID = "said.txt"  # what the run printed; there once it has succeeded
FAILED = "failed.txt"  # the same of a run that has not


def given():
    """Return the folder of the run that KACSIM_TEST_RESULTS names, None if it names none."""
    folder = Path(os.environ.get("KACSIM_TEST_RESULTS", "")).resolve().parent
    return folder if (folder / SAID).exists() else None


def _lock(folder):
    return folder.with_suffix(".lock")


def start(folder, session):
    """Have the run made in the background, unless some process has done so before.

    Parameters
    ----------
    folder : Path, not there yet
    session : id of the process with which the run shall end
    """
    with open(_lock(folder), "w", encoding="utf-8") as lock, contextlib.suppress(BlockingIOError):
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if folder.exists():
            return
        # The lock goes with the open file: it is free when this process ends, however it ends.
        subprocess.Popen(
            [sys.executable, __file__, str(folder), str(session)],
            pass_fds=[lock.fileno()],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )


def wait(folder):
    """Wait until the run has ended; insist on success."""
    with open(_lock(folder), encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_SH)
    if not (folder / SAID).exists():
        failed = folder / FAILED
        raise AssertionError(failed.read_text(encoding="utf-8") if failed.exists() else "killed")


def make(folder, session=None):
    """Copy the project, run it, keep what the run says; return its exit status."""
    folder.mkdir(parents=True, exist_ok=True)
    copy_project(folder)
    command = [sys.executable, "-m", "snakemake", "--cores", "2", *SMOKE]
    with open(folder / FAILED, "w", encoding="utf-8") as out:
        # Not printed: that would take ten seconds, and a browser.
        run = subprocess.Popen(
            command,
            cwd=folder,
            env=os.environ | {"KACSIM_CHROMIUM": ""},
            stdout=out,
            stderr=subprocess.STDOUT,
        )
        while _goes_on(run):
            if session is not None and not _lives(session):
                run.send_signal(signal.SIGTERM)
                return run.wait()
    if run.returncode == 0:
        os.replace(folder / FAILED, folder / SAID)
    return run.returncode


def _goes_on(run):
    try:
        run.wait(timeout=1.0)
    except subprocess.TimeoutExpired:
        return True
    return False


def _lives(process):
    try:
        os.kill(process, 0)
    except OSError:
        return False
    return True


def main(folder, session=None):
    """Make the run; say what it said if it failed."""
    status = make(Path(folder).resolve(), session and int(session))
    if status and session is None:
        print((Path(folder) / FAILED).read_text(encoding="utf-8"), file=sys.stderr)
    return status


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
