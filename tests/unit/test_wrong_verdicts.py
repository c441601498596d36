"""Wrong verdicts are as rare as the level allows, in small; larger: tests/wrong_verdicts.py.

Two rates, with their mutants: of 300 tables with all true values at an edge, at a chance of an
error of 0.5 instead of 0.01. Stated: a wrong verdict in at most a quarter of them, since an
interval that leaves its set misses on one side; and as many intervals that miss as the level says.
False alarm 5e-4 each; a rate of 0.39, or half as many misses again, is seen in 95 of 100 runs.
"""

import math

import interval_laws as laws
import numpy as np
import pytest
import real_tables
import wrong_verdicts
from scipy import stats
from verdict_rows import SCENES, Row, Tally, is_wrong, share_scene, sweep

from kacsim import items
from kacsim.items import _claims
from kacsim.statistics import estimate, verdict
from kacsim.statistics.estimate import Exact, Mean, Share
from kacsim.statistics.verdict import Finding, Part, finding

CHANCE, N_TABLES = 0.5, 300
STATED = CHANCE / 2.0
ALARM = 5e-4
TWO_SIDED = ("words", "digits", "implied", "rival", "corrected")


def rows():
    """Return rows of laws whose intervals are exact, or wider."""
    shares = [laws.Counts(p, n) for p, n in ((0.3, 500), (0.02, 2000), (3e-3, 1000), (0.97, 300))]
    welch = laws.Difference(laws.Normal(9), laws.Normal(39, error=2.0))
    known, four = laws.Normal(math.inf), laws.Normal(4)
    return [
        *(Row("known", known, SCENES[name]) for name in (*TWO_SIDED, "direction")),
        *(Row("t with 4", four, SCENES[name]) for name in 2 * TWO_SIDED),
        Row("t with 4", four, SCENES["words"], 6),
        Row("known", known, SCENES["implied"], 6),
        *(Row("Welch", welch, SCENES[name]) for name in ("words", "direction")),
        *(Row("share", law, share_scene(law)) for law in 2 * shares),
        *(Row("never", laws.Counts(0.0, n), SCENES["never"]) for n in (500, 20_000)),
    ]


def too_many(seed, monkeypatch):
    """Tell whether more tables have a wrong verdict, or more intervals miss, than stated."""
    monkeypatch.setattr(verdict, "FAMILY_ERROR", CHANCE)
    made, rng = rows(), np.random.default_rng([seed, 41])
    tallies = {row.type: Tally() for row in made}
    wrong = sweep(made, N_TABLES, rng, True, tallies)
    misses = sum(one.too_high + one.too_low for one in tallies.values())
    n_intervals = sum(one.n_intervals for one in tallies.values())
    level = CHANCE / sum(row.n_parts for row in made)
    rates = (wrong, N_TABLES, STATED), (misses, n_intervals, level)
    return any(stats.binomtest(*rate, alternative="greater").pvalue < ALARM for rate in rates)


def not_shared(monkeypatch):
    monkeypatch.setattr(verdict, "n_intervals", lambda found: 1)


def normal(monkeypatch):
    reach = Mean.reach
    monkeypatch.setattr(
        Mean, "reach", lambda self, a: reach(Mean(self.value, self.standard_error), a)
    )


def one_sided(monkeypatch):
    reach = Mean.reach
    monkeypatch.setattr(Mean, "reach", lambda self, alpha: reach(self, 2.0 * alpha))


def wald(monkeypatch):
    def interval(self, alpha):
        error = math.sqrt(self.value * (1.0 - self.value) / self.n)
        return Mean(self.value, error or 1e-9).interval(alpha)

    monkeypatch.setattr(Share, "interval", interval)


def overlapping(monkeypatch):
    monkeypatch.setattr(verdict, "_inside", lambda i, a: a[0] <= i[1] and i[0] <= a[1])


def by_the_estimate(monkeypatch):
    word = verdict._verdict
    middle = lambda i: (sum(i) / 2.0,) * 2  # noqa: E731
    monkeypatch.setattr(verdict, "_verdict", lambda i, a, b: word(middle(i), a, b))


def test_wrong_verdicts_are_as_rare_as_stated(seed, monkeypatch):
    assert not too_many(seed, monkeypatch)


@pytest.mark.parametrize(
    "mutation", [not_shared, normal, one_sided, wald, overlapping, by_the_estimate]
)
def test_wrong_verdicts_of_a_mutant_are_seen(mutation, seed, monkeypatch):
    mutation(monkeypatch)
    assert too_many(seed, monkeypatch)


@pytest.mark.parametrize("name", wrong_verdicts.TEXTS)
def test_tables_of_every_text_are_judged(name, seed):
    """At the level of a run, with small banks: hardly ever a wrong one in 40 (stated 0.2)."""
    rng = np.random.default_rng([seed, 42])
    made = wrong_verdicts.TEXTS[name](rng, 400)
    assert 60 <= sum(row.n_parts for row in made) <= 100
    tallies = {row.type: Tally() for row in made}
    wrong = sum(wrong_verdicts.count(made, 20, rng, hard, tallies) for hard in (False, True))
    assert wrong <= 5
    assert sum(one.n_rows for one in tallies.values()) == 40 * len(made)


# What is wrong

A, B, ALL = (1.0, 2.0), (3.0, 4.0), (-math.inf, math.inf)


@pytest.mark.parametrize(
    ("word", "thetas", "wrong"),
    [
        ("reproduced", (1.0, 2.0), False),
        ("reproduced", (1.5, 2.1), True),
        ("reproduced", (0.9, 0.9), True),
        ("contradicted", (1.0, 2.0), True),
        ("contradicted", (1.5, 2.1), False),
        ("undecided", (9.0, 9.0), False),
        ("undecided", (1.5, 1.5), False),
        ("corrected", (3.5, 3.5), False),
        ("corrected", (3.5, 4.1), True),
        ("corrected", (3.5, 1.5), True),
        ("corrected", (1.5, 1.5), True),
    ],
)
def test_what_is_wrong_by_hand(word, thetas, wrong):
    assert is_wrong(word, "implied", thetas, [(A, B), (A, B)]) is wrong


@pytest.mark.parametrize(
    ("word", "rate", "wrong"),
    [
        ("reproduced", 0.0, False),
        ("reproduced", 0.001, False),
        ("reproduced", 0.0011, True),
        ("contradicted", 0.0, True),
        ("contradicted", 1e-9, False),
        ("contradicted", 0.5, False),
    ],
)
def test_what_is_wrong_of_never(word, rate, wrong):
    assert is_wrong(word, "never", (rate,), [((0.0, 0.001), ALL)]) is wrong


# Real tables


def test_a_real_item_is_drawn_reduced_and_judged():
    """Three seeds at the smoke configuration: other draws, the same sets."""
    tables = real_tables.Tables("kac_fig1")
    for one in range(3):
        tables.add(one)
    assert len(set(tables.intervals)) == 1
    assert min(tables.intervals) > 0
    assert tables.depends == set()
    (part,) = tables.records["kac_fig1_large_step"].parts
    assert part.sets == (pytest.approx((0.04325, 0.05315)), ALL)
    assert len({one.value for one in part.measured}) == 3
    theta, error = part.truth()
    assert theta == pytest.approx(np.mean([one.value for one in part.measured]))
    assert error > 0.0


PUBLISHED = {
    "kac_a": {"item": "kac_fig1", "kind": "stated", "rule": "words", "low": 0.0, "high": 0.9},
    "kac_b": {"item": "kac_fig1", "kind": "stated", "rule": "implied"},
    "kac_c": {"item": "kac_fig1", "kind": "stated", "rule": "never"},
}


@pytest.fixture
def tables(monkeypatch):
    """Return a function that judges made-up findings, a list for each seed."""
    texts = {key: entry | {"text": key, "reason": "why"} for key, entry in PUBLISHED.items()}
    monkeypatch.setattr(items, "published", lambda: texts)

    def made(*findings):
        def judged(name, settings):
            found = findings[settings["seed"]]
            return found, _claims.table((name,), found)

        monkeypatch.setattr(real_tables, "judged", judged)
        found = real_tables.Tables("kac_fig1")
        for one in range(len(findings)):
            found.add(one)
        return found

    return made


def row(value, error=0.01, printed=2.0, corrected=math.nan, violations=0):
    return [
        finding("kac_a", Mean(value, error)),
        finding("kac_b", Mean(2.0001, 1e-4), printed=printed, corrected=corrected),
        finding("kac_c", Share(violations, 50_000)),
    ]


def test_a_verdict_is_wrong_by_the_mean_of_all_tables(tables):
    """The quantity is about 1, outside 0 to 0.9; one table says 0.5 with a small error."""
    many = [*[row(1.0 + 0.02 * (-1) ** k) for k in range(99)], row(0.5)]
    found = tables(*many).verdicts()
    wrong, told = found["kac_a"]
    assert told
    assert list(np.flatnonzero(wrong)) == [99]
    assert not any(found["kac_b"][0])
    assert tables(*many).show() == 1


def test_a_true_value_at_an_edge_is_not_told(tables):
    found = tables(*[row(0.9 + 0.1 * (-1) ** k) for k in range(20)])
    assert found.verdicts()["kac_a"][1] is False
    assert found.show() == 0


def test_a_known_value_is_the_true_one_if_the_tables_agree(tables):
    """2.0001 with an error of nought over the tables is not 2; with what they vary by it is."""
    values = [2.0001, 1.9998, 2.0002]
    varied = [
        [*row(1.0)[:1], finding("kac_b", Mean(v, 1e-4), printed=2.0), row(1.0)[2]] for v in values
    ]
    (part,) = tables(*varied).records["kac_b"].parts
    assert part.truth() == (2.0, 0.0)
    (part,) = tables(*3 * [row(1.0)]).records["kac_b"].parts
    assert part.truth()[0] == pytest.approx(2.0001)


def test_rates_are_pooled(tables):
    (part,) = tables(row(1.0), row(1.0, violations=3)).records["kac_c"].parts
    assert part.truth()[0] == pytest.approx(3 / 100_000)


def test_what_depends_on_the_draws_is_told(tables):
    """A set, a number of components and an exact value that another seed changes."""
    other = row(1.0, printed=2.5)
    assert tables(row(1.0), other).depends == {"kac_b: set"}
    more = [*row(1.0)[:2], Finding("kac_c", 2 * (Part(Share(0, 50_000)),))]
    assert tables(row(1.0), more).depends == {
        "kac_c: number of components",
        "kac_fig1: number of intervals",
    }
    exact = [[finding("kac_a", Exact(value)), *row(1.0)[1:]] for value in (0.5, 0.6)]
    assert tables(*exact).depends == {"kac_a: exact value"}


def test_estimates_of_a_bank_are_those_of_the_project(seed):
    """Replicates as `of_replicates` takes them: value, error, degrees."""
    rng = np.random.default_rng([seed, 43])
    law = laws.Replicates(rng.exponential(size=50), 20)
    again = np.random.default_rng(7)
    value, error, degrees = law.draw(np.random.default_rng(7), 3)
    drawn = law.bank[again.integers(0, 50, (3, 20))]
    for k in range(3):
        mean = estimate.of_replicates(drawn[k])
        assert (value[k], error[k], degrees[k]) == (
            pytest.approx(mean.value),
            pytest.approx(mean.standard_error),
            mean.degrees,
        )
