"""How long a run has still to take: expected seconds of its jobs, mended by those that are done."""

import time

from kacsim import costs

# Seconds of jobs that the plan does not know: of one unit's kernels, of the page's, of the report.
OTHERS = {
    "compile": 1.5,
    "page_kernels": 17.0,
    "report": 6.0,
    "print_report": 17.0,
    "run_times": 0.4,
}
TRUSTED = 30.0  # seconds of finished jobs from which on the machine's own speed is taken


def weights(plan):
    """Return rule -> expected seconds of one of its jobs, of all rules of the workflow."""
    found = {}
    for batch in plan.batches:
        beside = costs.stage_seconds(job=1, case=len(batch.cases))
        found[f"sample_{batch.id}"] = batch.seconds() + beside
    parts = [part.seconds() for parts in plan.shards.values() for part in parts]
    if parts:
        found["shard"] = sum(parts) / len(parts) + costs.stage_seconds(job=1, case=1)
        found["merge"] = costs.stage_seconds(job=1, case=1)
    read = sum(map(len, plan.cases_of.values())) / max(1, len(plan.cases_of))
    found["reduce"] = costs.stage_seconds(item=0.5, read=read)
    found["draw"] = costs.stage_seconds(item=0.5)
    return found | OTHERS


class Remaining:
    """The time that a run still takes.

    Parameters
    ----------
    expected : rule -> seconds of one job, as of `weights`
    cores : int, jobs at a time
    clock : callable() -> seconds
    """

    def __init__(self, expected, cores, clock=time.monotonic):
        self.expected, self.cores, self.clock = expected, max(1, cores or 1), clock
        self.left = self.done = 0.0
        self.running, self.begun = {}, clock()

    def plan(self, counts):
        """Take the numbers of jobs to do, rule -> number."""
        self.left = sum(self.expected.get(rule, 0.0) * int(n) for rule, n in counts.items())
        self.done, self.begun = 0.0, self.clock()

    def start(self, job, rule):
        """Note that a job runs."""
        self.running[job] = self.expected.get(rule, 0.0)

    def finish(self, job):
        """Note that a job is done."""
        seconds = self.running.pop(job, 0.0)
        self.done += seconds
        self.left = max(0.0, self.left - seconds)

    def seconds(self):
        """Return the seconds that the rest should take."""
        pace = 1.0 / self.cores
        if self.done > TRUSTED:
            pace = (self.clock() - self.begun) / self.done
        return self.left * pace

    def text(self):
        """Return it as words, few digits."""
        seconds = self.seconds()
        if seconds < 10.0:
            return "a few s left"
        if seconds < 90.0:
            return f"about {10 * round(seconds / 10)} s left"
        return f"about {round(seconds / 60)} min left"
