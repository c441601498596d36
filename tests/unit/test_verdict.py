"""Verdicts: Holm's adjustment by hand, and what each kind of claim is called."""

import math

import pytest
from scipy import stats

from kacsim.items import _claims
from kacsim.statistics import verdict
from kacsim.statistics.verdict import CORRECTED, NOT_REPRODUCED, REPRODUCED, UNDECIDED, Finding


def verdicts(kind, value, *findings):
    published = {f"claim {k}": {"kind": kind, "value": value} for k in range(len(findings))}
    named = [Finding(f"claim {k}", *one[0], **one[1]) for k, one in enumerate(findings)]
    return verdict.judge(named, published)


def one(*measured, **others):
    return measured, others


def test_holm_by_hand():
    """Sorted 0.01, 0.02, 0.03, 0.04 times 4, 3, 2, 1, made monotone."""
    assert verdict.holm([0.02, 0.01, 0.04, 0.03]) == pytest.approx([0.06, 0.04, 0.06, 0.06])
    assert verdict.holm([0.9, 0.5]) == [1.0, 1.0]
    assert verdict.holm([1e-5]) == [1e-5]
    assert verdict.holm([]) == []


@pytest.mark.parametrize("z", [-3.0, 0.4, 2.5])
def test_p_values(z):
    assert verdict.p_value(z, "number") == pytest.approx(2 * stats.norm.sf(abs(z)))
    assert verdict.p_value(z, "correction") == pytest.approx(2 * stats.norm.sf(abs(z)))
    assert verdict.p_value(z, "effect") == pytest.approx(stats.norm.sf(z))


def test_statistic():
    assert verdict.statistic(1.5, 1.0, 0.25) == 2.0
    assert verdict.statistic(1.0, 1.0, 0.0) == 0.0
    assert verdict.statistic(3, 2, 0.0) == math.inf
    assert verdict.statistic(1, 2, 0.0) == -math.inf


@pytest.mark.parametrize(
    ("measured", "error", "published_error", "expected"),
    [
        (0.048, 0.001, 0.0, REPRODUCED),
        (0.060, 0.001, 0.0, NOT_REPRODUCED),
        (0.036, 0.001, 0.0, NOT_REPRODUCED),
        (0.060, 0.001, 0.01, REPRODUCED),
        (0.048, 0.0, 0.0, REPRODUCED),
        (0.049, 0.0, 0.0, NOT_REPRODUCED),
    ],
)
def test_numbers(measured, error, published_error, expected):
    """A number is reproduced unless contradicted; a published error widens the error once."""
    (row,) = verdicts("number", 0.048, one(measured, error, published_error=published_error))
    assert row["verdict"] == expected
    assert abs(row["z"]) in (0.0, math.inf) or row["z"] == pytest.approx(
        (measured - 0.048) / math.hypot(error, published_error)
    )


@pytest.mark.parametrize(
    ("measured", "expected"), [(5.0, REPRODUCED), (1.0, NOT_REPRODUCED), (-5.0, NOT_REPRODUCED)]
)
def test_effects(measured, expected):
    """An effect is reproduced only if it is significant, in the stated direction."""
    (row,) = verdicts("effect", 0.0, one(measured, 1.0))
    assert row["verdict"] == expected


@pytest.mark.parametrize(
    ("measured", "printed", "corrected", "expected"),
    [
        (5.0, 5.2, 9.0, REPRODUCED),
        (9.1, 5.2, 9.0, CORRECTED),
        (7.0, 2.0, 9.0, UNDECIDED),
        (7.0, 1.0, 12.0, NOT_REPRODUCED),
    ],
)
def test_corrections(measured, printed, corrected, expected):
    """Corrected: the printed value is rejected and the corrected one stands."""
    error = 1.0 if printed != 2.0 else 2.0
    (row,) = verdicts(
        "correction", None, one(measured, error, printed=printed, corrected=corrected)
    )
    assert row["verdict"] == expected


def test_reading_error_of_a_figure_widens_the_error():
    """Measured 0.06 with an error of 0.003, read off as 0.048 with one of 0.004: z = 2.4."""
    entry = {"kind": "number", "value": 0.048, "reading_error": 0.004}
    found = Finding("claim", 0.06, 0.003)
    (row,) = verdict.judge([found], {"claim": entry})
    assert row["z"] == pytest.approx(0.012 / 0.005)
    (exact,) = verdict.judge([found], {"claim": entry | {"reading_error": 0.0}})
    assert exact["z"] == pytest.approx(4.0)


def test_the_corrected_value_is_judged_in_the_family():
    """3 sigma from the corrected value, p = 0.0027: among ten claims 0.027, which stands."""
    values = {"printed": 1.0, "corrected": 9.0}
    doubtful = one(12.0, 1.0, **values)
    (alone,) = verdicts("correction", None, doubtful)
    assert alone["verdict"] == NOT_REPRODUCED
    family = verdicts("correction", None, doubtful, *[one(1.0, 1.0, **values)] * 9)
    assert family[0]["verdict"] == CORRECTED


def test_printed_value_of_a_finding_replaces_the_entrys():
    (row,) = verdicts("number", 99.0, one(5.0, 1.0, printed=5.0))
    assert (row["z"], row["verdict"]) == (0.0, REPRODUCED)


def test_family_error_is_shared_by_holm():
    """p = 0.004 alone is below 0.01; among ten claims it is not (adjusted 0.04)."""
    z = stats.norm.isf(0.002)
    (alone,) = verdicts("number", 0.0, one(z, 1.0))
    assert alone["verdict"] == NOT_REPRODUCED
    family = verdicts("number", 0.0, one(z, 1.0), *[one(0.1, 1.0)] * 9)
    assert family[0]["verdict"] == REPRODUCED
    assert family[0]["adjusted_p_value"] == pytest.approx(0.04, rel=1e-6)
    assert verdict.FAMILY_ERROR == 0.01


def test_a_table_refuses_findings_of_items_that_it_does_not_name():
    """The published entries are dependencies of the items named; another's would go unseen."""
    finding = Finding("kac_9_limit", 1.0, 0.0)
    with pytest.raises(ValueError, match=r"\A[^\n]+\Z") as error:
        _claims.table(("kac_fig9", "kac_fig4"), [finding])
    assert str(error.value) == (
        "claim = 'kac_9_limit': reports/published.yaml has no such entry of kac_fig9 or kac_fig4"
    )
