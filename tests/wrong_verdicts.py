"""Count wrong verdicts: tables of rows whose true values are known, judged as a run judges them.

PYTHONPATH=. python tests/wrong_verdicts.py
PYTHONPATH=. python tests/wrong_verdicts.py --tables 500 --texts kac
PYTHONPATH=. python tests/wrong_verdicts.py --real 500 --times 5 --replicates 20

A table has as many intervals as a text, each drawn from a law of `interval_laws` for a set of
`verdict_rows`: once with true values anywhere, once with all of them at an edge, which is the least
favourable. The exit status is 1 unless the share of tables with a wrong verdict is shown to be at
most 1 %, that of the level. ``--real`` takes tables of real samples instead (`real_tables`), too
few to show that: there the status is 1 if more than 1 % is shown, or if sets, numbers of intervals
or exact values depend on what was drawn.
"""

import argparse
import collections
import sys
import time

import interval_laws as laws
import numpy as np
from verdict_rows import SCENES, UNITS, Row, Tally, share_scene, sweep

from kacsim.statistics.tail import clopper_pearson

MOST = 0.01  # share of tables with a wrong verdict
CONFIDENCE = 0.99
SEED = 20261125
CHUNK = 500  # tables held at a time
PLACES = {"true values anywhere": False, "all at an edge": True}


def kac(rng, size):
    """Return rows like those of the Kac paper: TVN, shares, moments, extremes."""
    tvn = laws.Replicates(laws.total_variations(rng, 100_000, size // 4), 100)
    gap = laws.Difference(tvn, tvn)
    first, last = (
        laws.Replicates(draw(rng, 30.0, 100_000, size), 20)
        for draw in (laws.smallest, laws.largest)
    )
    low, high = (
        laws.extreme_of_all(rng, draw, best, 30.0, 10_000, 20)
        for draw, best in ((laws.smallest, np.min), (laws.largest, np.max))
    )
    known = laws.Normal(np.inf)
    return [
        *_rows("TVN, t with 99", tvn, "words", "words", "digits", "digits", "implied", "corrected"),
        Row("TVN, t with 99", tvn, SCENES["words"], 8),
        Row("TVN, difference", gap, SCENES["direction"], 10),
        Row("TVN, difference", gap, SCENES["words"], 8),
        *_rows("mean extremes, t with 19", first, "words", "digits"),
        *_rows("mean extremes, t with 19", last, "words", "digits"),
        *_rows("extremes of all draws", low, "words", "digits"),
        *_rows("extremes of all draws", high, "words", "digits"),
        *_rows("normal, known error", known, "implied", "rival", "corrected", "words", "direction"),
        Row("normal, known error", known, SCENES["implied"], 12),
        Row("normal, known error", known, SCENES["corrected"], 6),
        *_rows("normal, t with 19", laws.Normal(19), "words", "implied", "corrected", "direction"),
        *_shares("share", (0.3, 70_000_000), (3e-3, 70_000_000), (0.02, 100_000), (0.5, 2_000)),
        *_shares("share, rare", (2e-5, 100_000), (1e-5, 1_000_000), (5e-6, 10_000_000)),
        *_never(20_000, 100_000, 1_000_000),
        Row("never", laws.Counts(0.0, 20_000), SCENES["never"], 6),
    ]


def boltzmann(rng, size):
    """Return rows like those of the Boltzmann paper: means and variances of skewed weights."""
    rows, banks = [], {}
    for index in (6.6, 4.2, 3.0, 2.5):
        banks[index] = laws.weights(rng, index, 0.8, 2_500, size)
        name = f"weights of index {index:g}, t with 39"
        law = laws.Replicates(banks[index][0], 40)
        rows += _rows(name, law, "words", "implied", "corrected", "direction")
        rows.append(Row(name, law, SCENES["words"], 4))
    pooled = laws.Pooled(*banks[4.2], 40, 2_500)
    few = laws.Replicates(laws.weights(rng, 4.2, 1.2, 250, size)[0], 20)
    rare = laws.Replicates(laws.weights(rng, 4.2, 0.8, 2_500, size, chance=0.02)[0], 40)
    squares = laws.Replicates(laws.weights(rng, 9.2, 0.5, 10_000, size // 4)[1], 200)
    ratio = laws.deviation_ratios(rng, banks[6.6], banks[4.2], 40, size)
    trees = laws.Replicates(laws.nodes(rng, 1.0, 2_500, size), 40)
    return [
        *rows,
        *_rows("weights of index 4.2, pooled error", pooled, "words", "implied", "corrected"),
        *_rows("weights of index 4.2, 20 x 250", few, "words", "implied", "corrected"),
        *_rows("weights, 98 % zero, t with 39", rare, "words", "implied", "corrected"),
        *_rows("squared weights, t with 199", squares, "words", "implied", "corrected"),
        *_rows("ratio of deviations, jackknife", ratio, "words", "implied", "direction"),
        *_rows("nodes of trees, t with 39", trees, "words", "implied", "direction", "corrected"),
        Row("nodes of trees, t with 39", trees, SCENES["implied"], 8),
        Row("normal, t with 39", laws.Normal(39), SCENES["implied"], 12),
        *_rows("normal, t with 39", laws.Normal(39), "words", "direction", "digits"),
        *_shares("share, rare", (1e-3, 10_000), (1e-4, 100_000)),
        *_never(20_000, 100_000),
    ]


def techniques(rng, size):
    """Return rows like those of the chapter: powers of N, shares, few replicates."""
    size = max(100, size // 20)  # fits take time
    edges = np.arange(10.0, 101.0, 3.0) ** 4  # a third of those that are there: as good, faster
    few = laws.slopes(rng, 16, edges, size)
    many = laws.slopes(rng, 50, 2.0 ** np.arange(6, 18), size)
    lattice = laws.slopes(rng, 1, np.arange(10.0, 101.0) ** 4, size, block=5)
    four, nine = laws.Normal(4), laws.Normal(9)
    welch = laws.Difference(nine, laws.Normal(19, error=3.0))
    return [
        *_rows("slope, 16 seeds", few, "words", "digits", "direction"),
        *_rows("slope, 50 seeds", many, "words", "implied", "corrected", "direction"),
        Row("slope, 50 seeds", many, SCENES["words"], 4),
        *_rows("slope, blocks of a lattice", lattice, "words", "implied", "corrected", "direction"),
        Row("slope, blocks of a lattice", lattice, SCENES["words"], 4),
        *_rows("normal, t with 4", four, "words", "implied", "corrected", "direction"),
        *_rows("normal, t with 9", nine, "words", "implied", "corrected", "direction"),
        Row("normal, t with 9", nine, SCENES["implied"], 8),
        Row("difference, Welch", welch, SCENES["direction"], 4),
        *_rows("difference, Welch", welch, "words", "words"),
        *_rows("normal, t with 19", laws.Normal(19), "words", "implied", "corrected", "direction"),
        Row("normal, known error", laws.Normal(np.inf), SCENES["implied"], 16),
        *_shares("share", *[(p, n) for p in (0.5, 0.1, 0.02) for n in (2_000, 100_000)]),
        *_shares("share, rare", (2e-4, 20_000), (5e-4, 10_000)),
        *_never(20_000, 100_000, 10_000),
    ]


TEXTS = {"kac": kac, "boltzmann": boltzmann, "techniques": techniques}


def _rows(name, law, *scenes):
    return [Row(name, law, SCENES[scene]) for scene in scenes]


def _shares(name, *sizes):
    made = [laws.Counts(*size) for size in sizes]
    return [Row(name, law, share_scene(law)) for law in made]


def _never(*sizes):
    return [Row("never", laws.Counts(0.0, n), SCENES["never"]) for n in sizes]


def count(rows, n_tables, rng, hard, tallies):
    """Return how many of some tables have a wrong verdict; what became of rows goes to tallies."""
    sizes = [min(CHUNK, n_tables - start) for start in range(0, n_tables, CHUNK)]
    return sum(sweep(rows, size, rng, hard, tallies) for size in sizes)


def show_types(tallies):
    """Print a line per type: misses of intervals over those stated, wrong and undecided rows."""
    print(f"{'':37}intervals  too high, low  wrong rows  undecided at {', '.join(UNITS)}")
    for name, one in sorted(tallies.items()):
        misses = (f"{miss / one.stated:6.2f}" for miss in (one.too_high, one.too_low))
        shares = (
            f"{one.undecided[kind] / one.placed[kind]:7.1%}" if one.placed[kind] else "      -"
            for kind in UNITS
        )
        rate = f"{one.wrong / one.n_rows:10.1e}"
        print(f"{name:37}{one.n_intervals:9d} {' '.join(misses)} {rate}    {' '.join(shares)}")


def synthetic(texts, n_tables, bank, seed):
    """Count wrong verdicts in synthetic tables, print them; return whether they are few enough."""
    few = True
    for name in texts:
        rng, start = np.random.default_rng([seed, list(TEXTS).index(name)]), time.monotonic()
        rows = TEXTS[name](rng, bank)
        tallies = collections.defaultdict(Tally)
        n_intervals = sum(row.n_parts for row in rows)
        print(f"\n{name}: {len(rows)} rows, {n_intervals} intervals")
        for words, hard in PLACES.items():
            wrong = count(rows, n_tables, rng, hard, tallies)
            low, high = clopper_pearson(wrong, n_tables, CONFIDENCE)
            few &= high <= MOST
            print(
                f"  {words}: a wrong verdict in {wrong} of {n_tables} tables, "
                f"{wrong / n_tables:.2%} ({low:.2%} to {high:.2%})"
            )
        show_types(tallies)
        print(f"  {time.monotonic() - start:.0f} s", flush=True)
    return few


def real(names, n_tables, **size):
    """Count wrong verdicts in tables of real samples; return whether they are few enough."""
    import real_tables  # which compiles the samplers

    few = True
    for name in names:
        start, tables = time.monotonic(), real_tables.Tables(name, **size)
        for seed in range(n_tables):
            tables.add(seed)
        wrong = tables.show()
        low, high = clopper_pearson(wrong, n_tables, CONFIDENCE)
        print(
            f"  a wrong verdict in {wrong} of {n_tables} tables, {wrong / n_tables:.2%} "
            f"({low:.2%} to {high:.2%}); {time.monotonic() - start:.0f} s",
            flush=True,
        )
        few &= low <= MOST and not tables.depends
    return few


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tables", type=int, default=20_000, help="of each text (default 20000)")
    parser.add_argument("--bank", type=int, default=laws.BANK, help="replicates of each law")
    parser.add_argument("--texts", nargs="+", default=list(TEXTS), choices=TEXTS)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--real", type=int, metavar="N", help="N tables of real samples instead")
    parser.add_argument("--times", type=int, default=1, help="as many draws as a smoke run's")
    parser.add_argument("--replicates", type=int, default=1, help="at least so many of everything")
    parser.add_argument("--items", nargs="+", help="whose tables (default those of the texts)")
    options = parser.parse_args()
    if options.real:
        names = options.items or [f"{name}_numbers" for name in options.texts]
        size = {"times": options.times, "replicates": options.replicates}
        return int(not real(names, options.real, **size))
    return int(not synthetic(options.texts, options.tables, options.bank, options.seed))


if __name__ == "__main__":
    sys.exit(main())
