"""Processor time, as medians of several repeats, one thread. Needs nothing of the package."""

import functools
import platform
import statistics
import time

SPAN = 0.05  # seconds of one measurement: long beside the clock's step, short beside drifts


def seconds(call):
    """Return the processor time of one call."""
    start = time.process_time()
    call()
    return time.process_time() - start


def seconds_per_draw(call, n_draws, repeats):
    """Return the median processor time of call(n_draws) per draw, after a call that compiles."""
    call(2)
    return statistics.median(seconds(lambda: call(n_draws)) for _ in range(repeats)) / n_draws


def medians(calls, repeats):
    """Return the median processor time of each call, measured in turns so that drifts cancel.

    Parameters
    ----------
    calls : dict name -> function without arguments, already compiled

    Returns
    -------
    dict name -> seconds
    """
    times = {name: [] for name in calls}
    for _ in range(repeats):
        for name, call in calls.items():
            times[name].append(seconds(call))
    return {name: statistics.median(found) for name, found in times.items()}


def draws_for(call, span=SPAN):
    """Return for how many draws call(n) takes about `span` seconds; compiles it first."""
    call(2)
    n = 2
    while (taken := seconds(functools.partial(call, n))) < span / 8:
        n *= 4
    return max(2, int(n * span / taken))


def processor():
    """Return the name of this machine's processor."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            return next(line.split(":")[1].strip() for line in lines if "model name" in line)
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()
