"""Rows of a table of claims as the page shows them, from a small table made by hand."""

import math

import pytest
import xarray as xr

from kacsim.report import verdicts

ENTRY = {
    "item": "kac_fig4",
    "source": "section 4, Fig. 4",
    "text": "Never below.",
    "reason": "As said.",
    "rule": "words",
    "words": "small",
}


def table(words):
    """Return a table of one row, contradicted, with a part for each verdict: 0.1, 0.2, ..."""
    n = len(words)
    columns = {
        "of": ["claim"] * n,
        "label": [f"N = {k + 2}" for k in range(n)],
        "law": ["normal"] * n,
        "part_verdict": list(words),
        "measured": [0.1 * (k + 1) for k in range(n)],
        "standard_error": [0.01] * n,
        "low": [0.1 * (k + 1) - 0.03 for k in range(n)],
        "high": [0.1 * (k + 1) + 0.03 for k in range(n)],
        "allowed_low": [0.0] * n,
        "allowed_high": [0.15] * n,
        "right_low": [math.nan] * n,
        "right_high": [math.nan] * n,
        "seen": [0.05] * n,
    }
    row = {"claim": "claim", "text": "", "kind": "stated", "rule": "words", "evidence": ""}
    row |= {"verdict": "contradicted"}
    rows = {key: ("row", [value]) for key, value in row.items()}
    return xr.Dataset(rows | {key: ("part", values) for key, values in columns.items()})


@pytest.mark.parametrize(
    ("words", "label"),
    [
        (("reproduced", "contradicted", "contradicted"), "N = 3"),
        (("undecided", "reproduced", "contradicted"), "N = 4"),
        (("contradicted", "undecided", "reproduced"), "N = 2"),
    ],
)
def test_a_row_shows_the_first_component_that_decides_it(words, label):
    found = verdicts.rows([table(words)], {"claim": ENTRY})["claim"]
    assert found["shown"]["label"].replace("\u00a0", " ") == label
    assert found["shown"]["verdict"] == "contradicted"


def test_set_and_interval_of_a_component():
    """0.2 ± 0.03 beside the set from 0 to 0.15."""
    found = verdicts.rows([table(("reproduced", "contradicted"))], {"claim": ENTRY})["claim"]
    second = found["parts"][1]
    assert second["interval"] == "0.170 to 0.230"
    assert second["allowed"] == "“small”: 0 to 0.15"
    assert second["measured"] == "0.200 ± 0.010"
    assert found["summary"] == "2 components: 1 reproduced, 1 contradicted"
