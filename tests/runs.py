"""A copy of the project in which Snakemake runs, is killed, goes on, and is compared."""

import hashlib
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SMOKE = ("--configfile", "config/smoke.yaml")


def copy_project(folder):
    """Copy all files that git knows or would add."""
    listed = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]
    found = subprocess.run(listed, cwd=ROOT, capture_output=True, text=True, check=True)
    for name in found.stdout.splitlines():
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)


class FaultError(AssertionError):
    """A scenario that did not end as it must."""


class Run:
    """A copy of the project in which Snakemake runs, with a kernel cache of its own folder.

    Parameters
    ----------
    folder : where to copy to; a copy that is there already is used as it is
    targets : names of items; none means everything
    cache : folder of the compiled kernels, ``folder/kernels`` if not given
    finished : Run of the same targets that is copied, results and all; none if not given
    """

    def __init__(self, folder, targets=(), cache=None, finished=None):
        self.folder, self.targets = Path(folder), targets
        self.cache = Path(cache or self.folder / "kernels")
        if finished is not None:
            shutil.copytree(finished.folder, self.folder, dirs_exist_ok=True)
            shutil.copytree(finished.cache, self.cache, dirs_exist_ok=True)
        elif not (self.folder / "Snakefile").exists():
            copy_project(self.folder)

    def start(self, *words, cores=2, **environment):
        """Start Snakemake in a process group of its own; output goes to ``folder/out.txt``."""
        command = [sys.executable, "-m", "snakemake", "-c", str(cores), *self.targets]
        # Not printed: the PDF holds its date, and takes ten seconds.
        known = {"KACSIM_CACHE_DIR": str(self.cache), "KACSIM_CHROMIUM": ""} | environment
        with open(self.folder / "out.txt", "w", encoding="utf-8") as out:
            return subprocess.Popen(
                [*command, *SMOKE, *words],
                cwd=self.folder,
                env=os.environ | known,
                stdout=out,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def run(self, *words, **choices):
        """Run Snakemake to its end; return (exit status, output)."""
        status = self.start(*words, **choices).wait()
        return status, (self.folder / "out.txt").read_text(encoding="utf-8")

    def complete(self, *words, **choices):
        """Run Snakemake and insist on success; return the checksums."""
        status, output = self.run(*words, **choices)
        if status:
            raise FaultError(f"exit {status}: {output[-2000:]}")
        return self.checksums()

    def resume(self, **choices):
        """Go on after a kill, as the README says; return the checksums."""
        self.run("--unlock")
        return self.complete(**choices)

    def checksums(self):
        """Return file -> SHA-256 of everything that must not depend on the run."""
        files = [*self.folder.glob("results/**/*")]
        kept = [f for f in files if f.suffix in (".nc", ".png", ".svg", ".pdf", ".csv", ".html")]
        kept = [f for f in kept if f.name not in ("report.pdf", "runtime.html")]
        return {
            str(f.relative_to(self.folder)): hashlib.sha256(f.read_bytes()).hexdigest()
            for f in sorted(kept)
        }

    def leftovers(self):
        """Return locks and temporary files that a run has left behind."""
        locks = [*(self.folder / ".snakemake/locks").glob("*")]
        return [str(f) for f in (*locks, *self.folder.glob("results/**/.*")) if f.is_file()]

    def processes(self):
        """Return the ids of processes that work in the folder."""
        found = []
        for process in Path("/proc").glob("[0-9]*"):
            try:
                if Path(os.readlink(process / "cwd")) == self.folder.resolve():
                    found.append(int(process.name))
            except OSError:
                continue
        return found

    def jobs(self):
        """Return the ids of processes that do a job or wait for it: not Snakemake, no shell."""
        return [pid for pid in self.processes() if _is_job(_words(pid)) and not _is_server(pid)]

    def servers(self):
        """Return the ids of processes from which the jobs of a run are forked."""
        return [pid for pid in self.processes() if _is_server(pid)]

    def progress(self):
        """Return the share of its jobs that the run has said to have started."""
        said = (self.folder / "out.txt").read_text(encoding="utf-8")
        started = re.findall(r"^\[(\d+)/(\d+)\] ", said, re.M)
        return int(started[-1][0]) / int(started[-1][1]) if started else 0.0

    def ends(self, seconds=60.0, of=None):
        """Return the processes that still work in the folder after some time, none if all end.

        Parameters
        ----------
        of : callable that returns the processes meant, all of the run if not given
        """
        end = time.monotonic() + seconds
        while (found := (of or self.processes)()) and time.monotonic() < end:
            time.sleep(0.02)
        return found


def _words(process):
    """Return the words of a process's command, none if it has gone."""
    try:
        return Path(f"/proc/{process}/cmdline").read_bytes().split(b"\0")
    except OSError:
        return []


def _is_job(words):
    ours = any(b"kacsim" in word for word in words[1:])
    return ours and b"snakemake" not in words and b"-c" not in words


def _is_server(process):
    """Tell a server from the jobs that are forked from it: it leads a session of its own."""
    try:
        return b"kacsim.jobs.server" in _words(process) and os.getsid(process) == process
    except OSError:
        return False


def same(found, expected, what):
    """Raise FaultError unless two sets of checksums are equal."""
    if found != expected:
        wrong = sorted(k for k in found.keys() | expected if found.get(k) != expected.get(k))
        raise FaultError(f"{what}: {len(wrong)} files differ: {', '.join(wrong[:5])}")
