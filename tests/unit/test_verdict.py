"""Verdicts: every rule's set by hand, every verdict, and what a row of several parts is called.

No z tests: the data are fixed.
"""

import math

import pytest
from scipy import stats

from kacsim.statistics import verdict
from kacsim.statistics.estimate import Exact, Mean, Share
from kacsim.statistics.verdict import Finding, Part, finding

ALPHA = 0.01 / 80
REACH = stats.norm.isf(ALPHA / 2)  # 3.836
DIGITS = {"rule": "digits", "printed": "0.0482", "spread": 0.0014}
WORDS = {"rule": "words", "words": "about 5", "low": 4.5, "high": 5.5}
DIRECTION = {"rule": "direction", "margin": 0.2}
IMPLIED = {"rule": "implied"}
NEVER = {"rule": "never"}
ALWAYS = {"rule": "always"}
UNTESTABLE = {"rule": "untestable"}


def judge(entry, *parts):
    return verdict.judge(Finding("claim", parts), entry, ALPHA)


def word(entry, measured, **others):
    """Return the verdict of a row of one part, which is also that of the part."""
    found, (part,) = judge(entry, Part(measured, **others))
    assert found == part["verdict"]
    return found


def only(entry, measured, **others):
    """Return what is said of the only part."""
    return judge(entry, Part(measured, **others))[1][0]


# Sets


@pytest.mark.parametrize(
    ("digits", "half"),
    [
        ("0.0187", 0.00005),
        ("948.2", 0.05),
        ("422", 0.5),
        ("5", 0.5),
        ("-0.5", 0.05),
        ("0.50", 0.005),
    ],
)
def test_half_a_unit_of_the_last_digit(digits, half):
    assert verdict.half_unit(digits) == pytest.approx(half)


@pytest.mark.parametrize(
    ("entry", "part", "expected"),
    [
        (DIGITS, {}, (0.04325, 0.05315)),  # 0.0482 -+ (0.00005 + 3.5 * 0.0014)
        (DIGITS | {"spread": 0.0}, {}, (0.04815, 0.04825)),
        (DIGITS | {"printed": "-0.5", "spread": 0.02}, {}, (-0.62, -0.38)),
        (WORDS, {}, (4.5, 5.5)),
        (DIRECTION, {}, (0.2, math.inf)),
        (IMPLIED, {"printed": 4.8}, (4.752, 4.848)),  # 1 %
        (IMPLIED, {"printed": -4.8}, (-4.848, -4.752)),
        (IMPLIED, {"printed": 4.8, "rival": 6.0}, (4.752, 4.848)),  # a quarter of 1.2 is more
        (IMPLIED, {"printed": 4.8, "rival": 4.7}, (4.775, 4.825)),  # a quarter of 0.1
        (IMPLIED, {"printed": 4.8, "rival": 4.72, "corrected": 4.82}, (4.795, 4.805)),
        (IMPLIED, {"printed": 4.8, "rival": 4.78, "corrected": 4.9}, (4.795, 4.805)),
        (IMPLIED, {"printed": 0.0}, (0.0, 0.0)),  # which exact values alone can lie in
        (NEVER, {}, (0.0, 0.001)),
        (ALWAYS, {}, (0.0, 0.001)),
    ],
)
def test_sets_by_hand(entry, part, expected):
    assert verdict.allowed(entry, Part(Exact(0.0), **part)) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("part", "expected"),
    [
        ({"printed": 4.8}, None),
        ({"printed": 4.8, "corrected": 6.0}, (5.94, 6.06)),  # 1 %
        ({"printed": 4.8, "corrected": 4.88}, (4.86, 4.90)),  # a quarter of 0.08
        ({"corrected": 6.0}, (5.94, 6.06)),
    ],
)
def test_sets_of_corrections_by_hand(part, expected):
    found = verdict.correction(Part(Exact(0.0), **part))
    assert found == (expected if expected is None else pytest.approx(expected))


@pytest.mark.parametrize("ratio", [0.3, 0.97, 0.999, 1.002, 1.03, 4.0])
def test_a_corrections_set_and_the_printed_one_have_no_value_in_common(ratio):
    part = Part(Exact(0.0), printed=2.0, corrected=2.0 * ratio)
    (a, b), (c, d) = verdict.allowed(IMPLIED, part), verdict.correction(part)
    assert b < c or d < a


def test_a_rule_that_makes_no_set_is_named():
    with pytest.raises(ValueError, match=r"\Arule = 'untestable': no rule that makes a set\Z"):
        verdict.allowed(UNTESTABLE, Part(Exact(0.0)))
    with pytest.raises(ValueError, match="rule = 'nevr'"):
        word({"rule": "nevr"}, Share(0, 10**6))


# Levels


def test_the_chance_of_an_error_is_shared_by_all_intervals():
    """Three of the parts have an interval; the exact one and the row without a part have none."""
    rows = [
        finding("a", Mean(1.0, 0.1)),
        Finding("b", (Part(Share(1, 9)), Part(Exact(2.0)), Part(Mean(3.0, 0.1, 9)))),
        Finding("c", ()),
    ]
    assert verdict.n_intervals(rows) == 3
    assert verdict.FAMILY_ERROR == 0.01


def test_intervals_are_two_sided_at_the_given_level():
    part = only(WORDS, Mean(5.0, 0.1))
    assert (part["low"], part["high"]) == pytest.approx((5 - 0.1 * REACH, 5 + 0.1 * REACH))
    wide = verdict.judge(finding("claim", Mean(5.0, 0.1)), WORDS, 0.05)[1][0]
    assert (wide["low"], wide["high"]) == pytest.approx((5 - 0.195996, 5 + 0.195996), abs=1e-6)


# Verdicts of one part


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (5.0, "reproduced"),
        (4.5 + 1.01 * 0.1 * REACH, "reproduced"),
        (5.5 - 1.01 * 0.1 * REACH, "reproduced"),
        (4.5 + 0.99 * 0.1 * REACH, "undecided"),
        (5.5 - 0.99 * 0.1 * REACH, "undecided"),
        (4.5 - 0.99 * 0.1 * REACH, "undecided"),
        (5.5 + 0.99 * 0.1 * REACH, "undecided"),
        (4.5 - 1.01 * 0.1 * REACH, "contradicted"),
        (5.5 + 1.01 * 0.1 * REACH, "contradicted"),
        (math.nan, "undecided"),
    ],
)
def test_an_interval_against_a_set(value, expected):
    assert word(WORDS, Mean(value, 0.1)) == expected


def test_a_wide_interval_reproduces_nothing():
    assert word(WORDS, Mean(5.0, 10.0)) == "undecided"
    assert word(DIRECTION, Mean(5.0, 10.0)) == "undecided"
    assert word(NEVER, Share(0, 100)) == "undecided"


@pytest.mark.parametrize("error", [math.nan, 0.0])
def test_an_error_that_is_not_known_decides_nothing(error):
    """Of a single replicate, or of equal ones; far away too."""
    for value in (5.0, 50.0):
        part = only(WORDS, Mean(value, error, 9))
        assert part["verdict"] == "undecided"
        assert math.isnan(part["low"])
        assert math.isnan(part["high"])
        assert math.isnan(part["seen"])
    assert word(IMPLIED, Mean(5.0, error), printed=5.0) == "undecided"


def test_few_replicates_widen_the_interval():
    """Half the set's width is five errors: enough for 99 degrees (3.99), not for 9 (6.4)."""
    assert word(WORDS, Mean(5.0, 0.1, 99)) == "reproduced"
    assert word(WORDS, Mean(5.0, 0.1, 9)) == "undecided"


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (0.2 + 1.01 * 0.1 * REACH, "reproduced"),
        (1e9, "reproduced"),
        (0.2 + 0.99 * 0.1 * REACH, "undecided"),
        (0.2 - 0.99 * 0.1 * REACH, "undecided"),
        (0.2 - 1.01 * 0.1 * REACH, "contradicted"),
        (-1e9, "contradicted"),
    ],
)
def test_directions(value, expected):
    """Of a real effect that is less than what matters too: the set starts at the margin."""
    assert word(DIRECTION, Mean(value, 0.1)) == expected


def test_an_effect_that_is_there_but_does_not_matter_is_contradicted():
    assert word(DIRECTION, Mean(0.1, 0.01)) == "contradicted"


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (4.5, "reproduced"),
        (5.5, "reproduced"),
        (4.499, "contradicted"),
        (5.501, "contradicted"),
    ],
)
def test_exact_values_and_closed_sets(value, expected):
    part = only(WORDS, Exact(value))
    assert part["verdict"] == expected
    assert (part["low"], part["high"], part["seen"]) == (value, value, 0.0)


@pytest.mark.parametrize(
    ("value", "error", "expected"),
    [
        (4.80, 0.005, "reproduced"),
        (4.88, 0.005, "corrected"),
        (4.84, 0.010, "undecided"),  # reaches both sets
        (4.87, 0.014, "undecided"),  # reaches A, and out of B
        (4.87, 0.005, "contradicted"),  # misses A, but reaches out of B
        (4.97, 0.005, "contradicted"),
        (4.71, 0.005, "contradicted"),
    ],
)
def test_corrections(value, error, expected):
    """A is 4.78 to 4.82 and B 4.86 to 4.90."""
    assert word(IMPLIED, Mean(value, error), printed=4.8, corrected=4.88) == expected


def test_contradicted_is_not_yet_corrected():
    """Exact values between A (to 4.82) and B (from 4.86), and in B."""
    values = {"printed": 4.8, "corrected": 4.88}
    assert word(IMPLIED, Exact(4.85), **values) == "contradicted"
    assert word(IMPLIED, Exact(4.86001), **values) == "corrected"


def test_a_printed_number_can_be_corrected_too():
    assert word(DIGITS, Mean(0.061, 0.0001), corrected=0.061) == "corrected"
    assert word(DIGITS, Mean(0.061, 0.0001), corrected=0.062) == "contradicted"


@pytest.mark.parametrize("entry", [NEVER, ALWAYS])
@pytest.mark.parametrize(
    ("measured", "expected"),
    [
        (Share(0, 0), "undecided"),  # nothing to be seen in these draws
        (Share(0, 1_000), "undecided"),
        (Share(0, 9_600), "undecided"),  # upper end 1 - 0.0000625**(1 / 9600) = 0.0010077
        (Share(0, 9_700), "reproduced"),  # 0.0009974
        (Share(1, 10), "contradicted"),
        (Share(1, 1_000_000), "contradicted"),  # one verified counterexample, however rare
        (Exact(0.0), "reproduced"),  # a proof
        (Exact(1e-9), "contradicted"),
    ],
)
def test_never_and_always(entry, measured, expected):
    assert word(entry, measured) == expected


def test_what_cannot_be_tested():
    assert verdict.judge(Finding("claim", ()), UNTESTABLE, ALPHA) == ("not testable", [])


# Verdicts of several parts

GOOD, UNKNOWN, BAD, RIGHT = Exact(4.8), Mean(4.8, 1.0), Exact(9.0), Exact(4.88)
BOTH = {"printed": 4.8, "corrected": 4.88}
PRINTED = {"printed": 4.8}


@pytest.mark.parametrize(
    ("parts", "expected"),
    [
        ([(GOOD, PRINTED)] * 3, "reproduced"),
        ([(GOOD, PRINTED), (UNKNOWN, PRINTED)], "undecided"),
        ([(GOOD, PRINTED), (UNKNOWN, PRINTED), (BAD, PRINTED)], "contradicted"),
        ([(RIGHT, BOTH)] * 2, "corrected"),
        # Where the right formula has nothing else to say, the text must stand.
        ([(RIGHT, BOTH), (GOOD, PRINTED)], "corrected"),
        ([(RIGHT, BOTH), (UNKNOWN, PRINTED)], "contradicted"),
        # A formula that fails, or is not shown, at one component corrects none.
        ([(RIGHT, BOTH), (GOOD, BOTH)], "contradicted"),
        ([(RIGHT, BOTH), (UNKNOWN, BOTH)], "contradicted"),
        ([(RIGHT, BOTH), (BAD, BOTH)], "contradicted"),
        ([(GOOD, BOTH), (UNKNOWN, BOTH)], "undecided"),
        ([(GOOD, BOTH), (GOOD, PRINTED)], "reproduced"),
        ([], "undecided"),
    ],
)
def test_rows_of_several_parts(parts, expected):
    """In any order; some part has the verdict of the row."""
    made = [Part(measured, **others) for measured, others in parts]
    for order in (made, made[::-1]):
        found, judged = judge(IMPLIED, *order)
        assert found == expected
        assert len(judged) == len(order)
        assert not judged or found in {part["verdict"] for part in judged}


# What is said beside the verdict


def test_the_smallest_departure_that_is_seen():
    """The interval's reach, and the deviate that 95 of 100 values stay above: 1.6449."""
    assert only(WORDS, Mean(5.0, 0.1))["seen"] == pytest.approx(0.1 * (REACH + 1.644854))
    assert only(WORDS, Exact(5.0))["seen"] == 0.0


def test_what_never_sees_is_met_in_95_of_100_runs():
    seen = only(NEVER, Share(0, 20_000))["seen"]
    assert stats.binom.sf(0, 20_000, seen) == pytest.approx(0.95)
    assert only(NEVER, Exact(0.0))["seen"] == 0.0
    assert only(NEVER, Share(0, 0))["seen"] == 1.0


def test_a_departure_is_seen_as_often_as_stated():
    """Contradicted in 95 of 100: the normal law of the value, its error known."""
    seen = only(WORDS, Mean(5.0, 0.1))["seen"]
    edge = 5.5 + 0.1 * REACH  # values above it are contradicted
    assert stats.norm.sf(edge, 5.5 + seen, 0.1) == pytest.approx(0.95, abs=1e-4)


@pytest.mark.parametrize(
    ("entry", "measured", "others", "expected"),
    [
        (IMPLIED, Mean(4.81, 0.002), PRINTED, 5.0),
        (IMPLIED, Mean(4.81, 0.02), PRINTED, 0.5),  # undecided, which a deviation must not choose
        (IMPLIED, Mean(4.79, 0.02), BOTH, -4.5),  # from the right value, which is known
        (IMPLIED, Mean(4.881, 0.002), BOTH, 0.5),
        (IMPLIED, Mean(9.0, 0.02), PRINTED, math.nan),  # contradicted, right value unknown
        (IMPLIED, Exact(4.8), PRINTED, math.nan),
        (IMPLIED, Mean(4.8, math.nan), PRINTED, math.nan),
        (IMPLIED, Mean(4.8, 0.0), PRINTED, math.nan),
        (WORDS, Mean(5.0, 0.1), {}, math.nan),
        (DIGITS, Mean(0.0482, 0.001), {}, math.nan),
    ],
)
def test_pulls(entry, measured, others, expected):
    assert only(entry, measured, **others)["pull"] == pytest.approx(expected, nan_ok=True)


@pytest.mark.parametrize(
    ("entry", "value", "near"),
    [
        (WORDS, 4.59, True),
        (WORDS, 4.41, True),
        (WORDS, 5.41, True),
        (WORDS, 4.61, False),
        (WORDS, 5.0, False),
        (DIRECTION, 0.219, True),  # a tenth of the margin
        (DIRECTION, 0.181, True),
        (DIRECTION, 0.221, False),
    ],
)
def test_near_an_edge(entry, value, near):
    assert only(entry, Mean(value, 0.1))["near"] is near
