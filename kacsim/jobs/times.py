"""Where the time of a run went: jobs and kernels, stage by stage, from logs and benchmarks."""

import csv
import re
from pathlib import Path

STAGES = ("compile", "sample", "reduce", "draw", "report", "print")
DRAWN = re.compile(r"^drew .* in ([0-9.]+) s$", re.MULTILINE)


def drawn_sentence(case, seconds):
    """Return the line that a sampler leaves in its log."""
    return f"drew {case.n_draws * len(case.replicates)} values of {case.id} in {seconds:.3f} s"


def _job_seconds(file):
    with open(file, newline="", encoding="utf-8") as lines:
        return float(next(csv.DictReader(lines, delimiter="\t"))["s"])


def _kernel_seconds(file):
    found = DRAWN.findall(file.read_text(encoding="utf-8")) if file.exists() else []
    return sum(map(float, found))


def collect(folder=".", since=0.0):
    """Return stage -> list of (job, seconds, seconds in kernels), longest first.

    Parameters
    ----------
    folder : where ``benchmarks`` and ``logs`` lie
    since : jobs that ended before this time are left out, seconds since 1970
    """
    root = Path(folder)
    found = {stage: [] for stage in STAGES}
    for file in (root / "benchmarks").rglob("*.tsv"):
        if file.stat().st_mtime < since:
            continue
        job = Path(str(file.relative_to(root / "benchmarks")).removesuffix(".tsv"))
        kernels = _kernel_seconds(root / "logs" / f"{job}.log")
        found[job.parts[0]].append((str(job), _job_seconds(file), kernels))
    return {stage: sorted(jobs, key=lambda job: -job[1]) for stage, jobs in found.items() if jobs}


def cases_of(folder="."):
    """Return job -> number of cases that it drew, from the logs of a run."""
    root = Path(folder) / "logs"
    return {
        str(file.relative_to(root).with_suffix("")): len(
            DRAWN.findall(file.read_text(encoding="utf-8"))
        )
        for file in root.rglob("*.log")
    }


def table(folder=".", since=0.0):
    """Return the summary as text: seconds per stage, share outside kernels, longest jobs."""
    stages = collect(folder, since)
    lines = [f"{'stage':10}{'jobs':>6}{'seconds':>10}{'in kernels':>12}"]
    everything = [job for jobs in stages.values() for job in jobs]
    for stage, jobs in [*stages.items(), ("all", everything)]:
        seconds, kernels = total(jobs, 1), total(jobs, 2)
        lines.append(f"{stage:10}{len(jobs):6}{seconds:10.1f}{kernels:12.1f}")
    for job, seconds, _ in sorted(everything, key=lambda job: -job[1])[:5]:
        lines.append(f"  {seconds:8.1f} s  {job}")
    return "\n".join(lines)


def total(jobs, column):
    """Return the sum over jobs of one of their columns."""
    return sum(job[column] for job in jobs)
