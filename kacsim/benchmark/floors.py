"""Floors of the kernels, measured in the same run, and what is above them.

Below a kernel's time lie, each measured alone: its random words drawn and added up, by a call each
or in blocks; the bytes that it reads and writes, copied; and its variates and elementary functions,
called one after another. What is left is the kernel's own: finding its way, and waiting.
"""

import statistics
from typing import NamedTuple

import numpy as np

from kacsim.benchmark import counts, pieces, stages, standard_works, words
from kacsim.benchmark.timing import draws_for, medians
from kacsim.streams import new_stream

WORD = 8  # bytes


class Floor(NamedTuple):
    """Times in seconds, and numbers, for one unit of a kernel's work.

    Attributes
    ----------
    unit : str
    kernel, calls, blocks, copy, parts : the kernel; its words by calls and in blocks, its bytes
        copied, and its variates and functions
    words, bytes : numbers of words drawn and of bytes moved
    pieces : dict function -> (calls, seconds of all of them)
    """

    unit: str
    kernel: float
    calls: float
    blocks: float
    copy: float
    parts: float
    words: float
    bytes: float
    pieces: dict


def measure(work, count, costs, repeats):
    """Return the Floor of one kernel.

    Parameters
    ----------
    work : `kacsim.benchmark.work.Work`
    count : what `counts.counted` found of it
    costs : function -> seconds of a call
    """
    stream = new_stream(1, "benchmark")
    n = draws_for(lambda n: work.call(n, stream))
    taken, units = [], []

    def run():
        before = stream.copy()
        units.append(work.call(n, stream))
        taken.append(words.used(before, stream))

    run()
    n_words = taken[0]
    moved = int(count["bytes"] * n_words)
    room = max(1, count["room"] // (2 * WORD))
    source, target = np.zeros(room), np.zeros(room)
    calls = {
        "kernel": lambda: units.append(work.call(n, stream)),
        "calls": lambda: words.add_by_calls(n_words, stream),
        "blocks": lambda: words.add_in_blocks(n_words, stream),
        # A word that is copied is read and written.
        "copy": lambda: words.move(source, target, moved // (2 * WORD)),
    }
    for call in calls.values():
        call()
    times = medians(calls, repeats)
    return told(work.unit, times, statistics.mean(units), n_words, count, costs)


def told(unit, times, units, n_words, count, costs):
    """Return a Floor from the times of all units together.

    Raises
    ------
    LookupError
        A function that the kernel calls is not timed.
    """
    missing = sorted(set(count["calls"]) - set(costs))
    if missing:
        raise LookupError(f"{', '.join(missing)}: not timed in {pieces.__name__}")
    per_unit = n_words / units
    parts = {
        name: (calls * per_unit, calls * per_unit * costs[name])
        for name, calls in count["calls"].items()
    }
    return Floor(
        unit,
        *(times[name] / units for name in ("kernel", "calls", "blocks", "copy")),
        sum(seconds for _, seconds in parts.values()),
        per_unit,
        count["bytes"] * per_unit,
        dict(sorted(parts.items(), key=lambda item: -item[1][1])),
    )


HEAD = (
    "kernel",
    "per",
    "ns",
    "words",
    "by calls, ns",
    "ratio",
    "in blocks, ns",
    "ratio",
    "bytes",
    "copied, ns",
    "ratio",
    "variates and functions, ns",
    "ratio",
)


def row(name, floor):
    """Return the cells of one kernel."""
    ratios = []
    for below in (floor.calls, floor.blocks, floor.copy, floor.parts):
        ratios.append((number(1e9 * below), number(floor.kernel / below)))
    calls, blocks, copy, parts = ratios
    first = name, floor.unit, number(1e9 * floor.kernel), number(floor.words)
    return *first, *calls, *blocks, number(floor.bytes), *copy, *parts


def number(value):
    """Return a positive number as text, with three digits or all before the point."""
    return f"{value:.0f}" if value >= 99.5 else f"{value:.1f}" if value >= 9.95 else f"{value:.2f}"


def lines(table):
    """Return the lines of a table, a list of rows, the first one its head."""
    yield "| " + " | ".join(table[0]) + " |"
    yield "| " + " | ".join(["---"] * len(table[0])) + " |"
    for cells in table[1:]:
        yield "| " + " | ".join(cells) + " |"


def pieces_of(name, floor):
    """Return a line with the calls of one kernel's unit, the dearest first."""
    told = ", ".join(
        f"{number(calls)} {function} {number(1e9 * seconds)} ns"
        for function, (calls, seconds) in floor.pieces.items()
    )
    return f"{name}, per {floor.unit}: {told}"


def run(repeats):
    """Print the floors of all kernels, and what their variates and functions cost."""
    found, costs = counts.counted(), pieces.costs(repeats)
    floors = {
        name: measure(work, found[name], costs, repeats) for name, work in standard_works().items()
    }
    print(*lines([HEAD, *(row(name, floor) for name, floor in floors.items())]), sep="\n")
    print()
    for name, floor in floors.items():
        print(pieces_of(name, floor))
    print()
    print(*lines(stages.table(floors, repeats)), sep="\n")
    apart = ", ".join(f"{name} {number(1e9 * seconds)}" for name, seconds in costs.items())
    guess = 1e9 * pieces.wrong_guess(repeats)
    print(f"\nns of one call apart: {apart}; of a branch guessed wrongly: {number(guess)}")
