"""A working copy of the project, and what Snakemake would make in it."""

import os
import re
import subprocess
import sys
from collections import Counter

from runs import copy_project


class Project:
    """A working copy of the project, and Snakemake in it."""

    def __init__(self, folder):
        self.folder = folder
        self.chromium = ""  # none, whatever this machine has

    def snakemake(self, *words, where=("--cores", "2")):
        """Run Snakemake, on two cores if not told; return the finished process, output as text."""
        command = [sys.executable, "-m", "snakemake", *where, *words]
        own = {**os.environ, "KACSIM_CHROMIUM": self.chromium}
        return subprocess.run(command, cwd=self.folder, capture_output=True, text=True, env=own)

    def planned(self, *words):
        """Return rule -> number of jobs that a dry run plans; empty if nothing is to be done."""
        answer = self.snakemake("--dry-run", *words)
        assert answer.returncode == 0, answer.stderr
        table = answer.stdout.split("Job stats:")[1:]
        rows = re.findall(r"^(\S+) +(\d+)$", table[0].split("\n\n")[0], re.M) if table else []
        jobs = Counter()
        for rule, number in rows:
            jobs["sample" if rule.startswith("sample_") else rule] += int(number)
        del jobs["total"]
        return dict(jobs)

    def samples_planned(self, *words):
        """Return the cases that a dry run would sample."""
        answer = self.snakemake("--dry-run", "--printshellcmds", *words)
        return set(re.findall(r"--output results/samples/(\S+)\.nc", answer.stdout + answer.stderr))

    def edit(self, file, old, new):
        """Replace the first occurrence of a text in a file of the copy."""
        path = self.folder / file
        text = path.read_text(encoding="utf-8")
        assert old in text, f"{file} does not hold {old!r}"
        path.write_text(text.replace(old, new, 1), encoding="utf-8")


def new_project(folder):
    """Return a project in a folder of its own."""
    copy_project(folder)
    return Project(folder)
