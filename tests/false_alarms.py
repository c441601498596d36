"""Count false alarms: the law tests over many seeds, against the rates that they state.

python tests/false_alarms.py
python tests/false_alarms.py --seeds 20 --tests tests/law/test_infinite.py

Every z that a test takes as null is collected. With the limit lowered to 2 (``--limit``) alarms and
second looks are common enough to be counted. Compared with the normal law are how many z exceed 1,
2, 3 and 4 in absolute value at the first look, and how many at a second one; with the product of
both, how many exceed a level at both looks, on the same side: what fails a test, at 4. The error of
a count is its spread between seeds (the z of one seed are not independent), and not less than that
of independent z. With ``--record FILE`` a seed is a line of FILE as soon as it is done, and is not
run again.
``KACSIM_TEST_DRAWS=0.2`` makes a fifth of the draws: a sharper test of the rates, whose nulls are
normal only in the limit, in less time.
The exit status is 1 if a count is not as stated (|z| > 4), or a test fails for another reason.
"""

import argparse
import contextlib
import io
import json
import math
import os
import sys
from collections import defaultdict
from concurrent.futures import ProcessPoolExecutor, as_completed
from itertools import chain
from pathlib import Path

import numpy as np
import pytest
from law import compare, looks
from scipy import special, stats

ROOT = Path(__file__).resolve().parent.parent
SPACING = 10**6  # some tests also use seeds a little above their own
LIMIT = compare.LIMIT
LEVELS = (1.0, 2.0, 2.5, 3.0, LIMIT)
NULLS = "not caught"  # what is a negative control and nothing else is named so
FEW = 20.0  # expected counts below are taken as Poisson, not as normal


class Recorder:
    """A pytest plugin that keeps the null z of each module, and the tests that failed otherwise."""

    def __init__(self):
        self.z, self.failed = defaultdict(list), []

    def pytest_runtest_logreport(self, report):
        found = looks.found_in(report) if report.when == "call" else []
        self.z[report.nodeid.split("::")[0]] += found
        pairs = [(z, again) for z, again, _ in found if again is not None]
        stays = any(compare.stays(*pair) for pair in pairs)
        kept = pairs and all(z == again for z, again in pairs)  # not drawn again
        if kept or (report.failed and not stays):
            self.failed.append(report.nodeid)


def run(number, tests, limit):
    """Run the tests with one seed in this process; return what is to be counted."""
    seed = 1 + number * SPACING
    os.environ["KACSIM_TEST_SEED"], compare.LIMIT = str(seed), limit
    recorder, said = Recorder(), io.StringIO()
    options = ["-q", "-o", "addopts=", "-p", "no:cacheprovider", "--tb=line", "-k", NULLS]
    with contextlib.redirect_stdout(said):
        status = pytest.main([*options, *tests], plugins=[recorder])
    if status not in (pytest.ExitCode.OK, pytest.ExitCode.TESTS_FAILED):
        raise RuntimeError(f"pytest ended with {status!r}\n{said.getvalue()}")
    return {"seed": seed, "limit": limit, "failed": recorder.failed, "z": recorder.z}


def sweep(options):
    """Return the outcomes of all seeds, those of the record included."""
    known, record = [], options.record
    if record and record.exists():
        known = [json.loads(line) for line in record.read_text(encoding="utf-8").splitlines()]
    if any(one["limit"] != options.limit for one in known):
        raise SystemExit(f"{record} is of another limit")
    done = {one["seed"] for one in known}
    numbers = [k for k in range(options.seeds) if 1 + k * SPACING not in done]
    with ProcessPoolExecutor(options.jobs) as pool:
        jobs = [pool.submit(run, k, options.tests, options.limit) for k in numbers]
        for future in as_completed(jobs):
            known.append(future.result())
            if record:
                with open(record, "a", encoding="utf-8") as out:
                    out.write(json.dumps(known[-1]) + "\n")
            print(f"{len(known)} of {options.seeds} seeds", file=sys.stderr, flush=True)
    return known


def compared(name, found, wanted):
    """Print counts of each seed as a sum, with what is expected; return whether they agree."""
    found, wanted = np.array(found), np.array(wanted)
    total, mean = int(found.sum()), wanted.sum()
    if mean < FEW:
        tail = min(stats.poisson.cdf(total, mean), stats.poisson.sf(total - 1, mean))
        z = math.copysign(compare.of_p(min(1.0, 2.0 * tail)), total - mean)
    else:
        between = np.var(found - wanted, ddof=1) * found.size
        z = (total - mean) / math.sqrt(max(between, mean))
    print(f"{name:<30} {total:7d}, expected {mean:11.4g}, z = {z:5.2f}")
    return abs(z) <= LIMIT


def judge(outcomes, limit):
    """Print the counts; return whether all are as stated."""
    tables = [np.array([*chain(*one["z"].values())], dtype=float) for one in outcomes]
    for name, found in outcomes[0]["z"].items():
        print(f"{name:<45} {len(found):4d} null z")
    print(f"{len(outcomes)} seeds, {np.mean([len(table) for table in tables]):.1f} null z each")
    agree = True
    for level in LEVELS:
        share = 2.0 * special.ndtr(-level)
        for name, column in (("first", 0), ("second", 1)):
            zs = [table[~np.isnan(table[:, column]), column] for table in tables]
            found = [(np.abs(z) > level).sum() for z in zs]
            agree &= compared(f"{name} look: |z| > {level}", found, [z.size * share for z in zs])
        if level >= limit:
            found = [beyond(table, level).sum() for table in tables]
            wanted = [compare.chance(table[:, 2] > 0, level).sum() for table in tables]
            agree &= compared(f"both looks: |z| > {level}", found, wanted)
    for name, failing, rate in (
        ("first look", lambda table: np.abs(table[:, 0]) > LIMIT, once),
        ("both looks", lambda table: beyond(table, LIMIT), twice),
    ):
        seeds = [failing(table).any() for table in tables]
        agree &= compared(f"seeds beyond {LIMIT} at {name}", seeds, [rate(t) for t in tables])
    others = [(one["seed"], name) for one in outcomes for name in one["failed"]]
    for seed, name in others:
        print(f"failed otherwise: {name} with KACSIM_TEST_SEED={seed}")
    return agree and not others


def beyond(table, level):
    """Return which z exceed a level at both looks, on the same side."""
    first, second = table[:, 0], table[:, 1]
    return (np.abs(first) > level) & (np.abs(second) > level) & ((first > 0) == (second > 0))


def once(table):
    """Return the probability of a seed with an alarm at the first look, of independent z."""
    return -math.expm1(len(table) * math.log1p(-2.0 * special.ndtr(-LIMIT)))


def twice(table):
    """Return the probability of a seed with an alarm that stays."""
    return -math.expm1(np.log1p(-compare.chance(table[:, 2] > 0, LIMIT)).sum())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=200, help="how many (default 200)")
    parser.add_argument("--jobs", type=int, default=2, help="processes at a time (default 2)")
    parser.add_argument("--limit", type=float, default=2.0, help="of an alarm (default 2)")
    parser.add_argument("--tests", nargs="+", default=["tests/law"], help="default tests/law")
    parser.add_argument("--record", type=Path, help="file of outcomes, to go on from")
    options = parser.parse_args()
    os.chdir(ROOT)
    return int(not judge(sweep(options), options.limit))


if __name__ == "__main__":
    sys.exit(main())
