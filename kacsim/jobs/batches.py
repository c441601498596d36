"""Short cases share a job: the start of Python and of the kernels takes longer than they do."""

import math
from collections import defaultdict
from dataclasses import dataclass

from kacsim.cases import time_limit

SHORT = 60.0  # seconds: what a job in a queue is not worth


@dataclass(frozen=True)
class Batch:
    """Cases that one job draws, one after the other.

    Attributes
    ----------
    id : str, from the first item that needs the cases and their kernels
    cases : tuple of Case, all of the same compiled kernels, needed by the same items
    """

    id: str
    cases: tuple

    def arguments(self):
        """Return the command-line words that sample all cases."""
        return " --and ".join(f"{case.arguments()} --output {case.output()}" for case in self.cases)

    def recipes(self):
        """Return what the draws are made from: the recipe of each case."""
        return [case.recipe() for case in self.cases]

    def seconds(self):
        """Return the expected time in the kernels, seconds."""
        return sum(case.seconds() for case in self.cases)

    def priority(self):
        """Return a rank below 1000 that starts the longest batches first."""
        return round(10.0 * math.log2(max(1.0, 1e6 * self.seconds())))

    def group(self):
        """Return the group that lets a scheduler join short batches of any kind, or None."""
        return "samples" if self.seconds() < SHORT else None

    def description(self):
        """Return what the job does, for one line of a log."""
        number = len(self.cases)
        return f"{self.id} ({number} case{'s' if number > 1 else ''})"

    def minutes(self):
        """Return the time limit for a scheduler."""
        return time_limit(self.seconds())

    def megabytes(self):
        """Return the memory to ask a scheduler for: that of the largest case."""
        return max(case.megabytes() for case in self.cases)


def make_batches(cases_of, batch_seconds):
    """Return the cases of all items in batches.

    Cases join if the same items need them, so that a single item draws nothing else, and if they
    need the same kernels; a batch ends before it expects to pass `batch_seconds`.

    Parameters
    ----------
    cases_of : dict item -> list of Case
    batch_seconds : float, 0 gives each case a job of its own

    Returns
    -------
    list of Batch, each case in one of them
    """
    needed_by, cases = defaultdict(list), {}
    for item, wanted in cases_of.items():
        for case in wanted:
            needed_by[case.id].append(item)
            cases[case.id] = case
    groups = defaultdict(list)
    for case_id, case in cases.items():
        groups[tuple(needed_by[case_id]), case.unit].append(case)
    batches, numbers = [], defaultdict(int)
    for (names, _), group in groups.items():
        for part in _parts(group, batch_seconds):
            stem = f"{names[0]}-{group[0].kernel_module.rpartition('.')[2]}"
            numbers[stem] += 1
            batches.append(Batch(f"{stem}-{numbers[stem]}", tuple(part)))
    return batches


def _parts(group, batch_seconds):
    """Yield consecutive cases that together stay below the time."""
    part, seconds = [], 0.0
    for case in group:
        if part and seconds + case.seconds() > batch_seconds:
            yield part
            part, seconds = [], 0.0
        part.append(case)
        seconds += case.seconds()
    yield part
