"""Tables of claims: what they refuse, what they share, and that the figure draws what they hold.

No z tests: findings are made up.
"""

import numpy as np
import pytest
from matplotlib.colors import to_rgba
from scipy import stats

from kacsim import items
from kacsim.items import _claims
from kacsim.statistics import verdict
from kacsim.statistics.estimate import Exact, Mean, Share
from kacsim.statistics.verdict import Finding, Part, finding

NAMES = ("kac_numbers", "kac_fig3")


def entry(rule, item="kac_fig3", **keys):
    text = f"a claim, {rule}"
    return {"item": item, "kind": "stated", "rule": rule, "text": text, "reason": "why"} | keys


PUBLISHED = {
    "kac_words": entry("words", low=4.0, high=6.0),
    "kac_effect": entry("direction", margin=0.5, kind="printed"),
    "kac_formula": entry("implied"),
    "kac_never": entry("never"),
    "kac_proof": entry("implied"),
    "kac_sure_effect": entry("direction", margin=0.5),
    "kac_cost": entry("untestable", item="kac_numbers"),
    "kac_other": entry("words", item="kac_fig9", low=0.0, high=1.0),
}
FOUND = [
    finding("kac_words", Mean(4.75, 0.1), "Seen at N = 5."),
    finding("kac_effect", Mean(2.0, 0.1, 19)),
    Finding(
        "kac_formula",
        (
            Part(Mean(2.0021, 0.001), "N = 2", printed=2.0),
            Part(Mean(2.1, 0.001), "N = 3", printed=2.0, corrected=2.1),
            Part(Mean(2.5, 0.3), "N = 4", printed=2.0),
        ),
    ),
    finding("kac_never", Share(0, 20_000)),
    finding("kac_proof", Exact(1.75), printed=1.75),
    finding("kac_sure_effect", Exact(3.0)),
]
N_INTERVALS = 6
ALPHA = 0.01 / N_INTERVALS


@pytest.fixture(autouse=True)
def published(monkeypatch):
    monkeypatch.setattr(items, "published", lambda: PUBLISHED)


@pytest.fixture
def table():
    return _claims.table(NAMES, FOUND)


def without(claim):
    return [one for one in FOUND if one.claim != claim]


# What a table refuses


@pytest.mark.parametrize("claim", ["kac_other", "kac_unheard_of"])
def test_a_table_refuses_findings_of_items_that_it_does_not_name(claim):
    """The published entries are dependencies of the items named; another's would go unseen."""
    with pytest.raises(ValueError, match=r"\A[^\n]+\Z") as error:
        _claims.table(NAMES, [*FOUND, finding(claim, Mean(1.0, 0.1))])
    assert str(error.value) == (
        f"claim = {claim!r}: reports/published has no such entry of kac_numbers or kac_fig3"
    )


def test_a_table_refuses_to_leave_a_row_out():
    with pytest.raises(ValueError, match=r"\Aclaim = 'kac_never': kac_fig3 finds nothing on it\Z"):
        _claims.table(NAMES, without("kac_never"))


@pytest.mark.parametrize("claim", ["kac_words", "kac_cost"])
def test_a_table_refuses_two_findings_on_a_row(claim):
    """The table itself has one on what cannot be tested."""
    with pytest.raises(ValueError, match=rf"\Aclaim = '{claim}': 2 findings are on it\Z"):
        _claims.table(NAMES, [*FOUND, finding(claim, Mean(5.0, 0.1))])


def test_a_row_that_also_belongs_to_an_item_may_be_found_elsewhere(monkeypatch):
    """`also` lets another item compare itself with a row; it need not find anything on it."""
    shared = PUBLISHED | {"kac_other": PUBLISHED["kac_other"] | {"also": ["kac_fig3"]}}
    monkeypatch.setattr(items, "published", lambda: shared)
    assert "kac_other" not in _claims.table(NAMES, FOUND).claim.values


# What it holds


def test_rows_hold_their_entry_and_verdict(table):
    words = dict(zip(table.claim.values, table.verdict.values, strict=True))
    assert words == {
        "kac_words": "reproduced",
        "kac_effect": "reproduced",
        "kac_formula": "contradicted",
        "kac_never": "reproduced",
        "kac_proof": "reproduced",
        "kac_sure_effect": "reproduced",
        "kac_cost": "not testable",
    }
    for key in ("text", "kind", "rule"):
        assert list(table[key].values) == [PUBLISHED[claim][key] for claim in table.claim.values]
    assert table.evidence.values[0] == "Seen at N = 5."


def test_what_cannot_be_tested_has_a_row_and_no_part(table):
    assert "kac_cost" in table.claim.values
    assert "kac_cost" not in table.of.values


def test_the_level_is_shared_by_all_intervals_of_the_text(table):
    assert int(table.n_intervals) == N_INTERVALS
    part = table.isel(part=0)
    half = stats.norm.isf(ALPHA / 2.0) * 0.1
    assert float(part.low) == pytest.approx(4.75 - half)
    assert float(part.high) == pytest.approx(4.75 + half)
    effect = table.isel(part=1)
    assert float(effect.low) == pytest.approx(2.0 - stats.t.isf(ALPHA / 2.0, 19) * 0.1)
    never = table.isel(part=list(table.of.values).index("kac_never"))
    assert float(never.high) == pytest.approx(1.0 - (ALPHA / 2.0) ** (1 / 20_000))


def test_more_intervals_are_wider():
    """200 further components of one row: every other interval is wider too."""
    many = Finding("kac_formula", FOUND[2].parts + 200 * (Part(Mean(2.0, 0.001), printed=2.0),))
    wide = _claims.table(NAMES, [many if one is FOUND[2] else one for one in FOUND])
    assert int(wide.n_intervals) == N_INTERVALS + 200
    low = 4.75 - stats.norm.isf(0.005 / (N_INTERVALS + 200)) * 0.1
    assert float(wide.low[0]) == pytest.approx(low)


def test_parts_hold_what_was_judged(table):
    """By hand: sets, the verdict of each component, the pull of those whose value is known."""
    assert list(table.of.values) == [
        "kac_words",
        "kac_effect",
        *3 * ["kac_formula"],
        "kac_never",
        "kac_proof",
        "kac_sure_effect",
    ]
    assert list(table.label.values[2:5]) == ["N = 2", "N = 3", "N = 4"]
    assert list(table.part_verdict.values[2:5]) == ["reproduced", "contradicted", "undecided"]
    assert table.allowed_low.values == pytest.approx([4, 0.5, 1.98, 1.98, 1.98, 0, 1.7325, 0.5])
    inf = np.inf
    assert table.allowed_high.values == pytest.approx(
        [6, inf, 2.02, 2.02, 2.02, 0.001, 1.7675, inf]
    )
    nan = np.nan
    assert table.right_low.values == pytest.approx([nan, nan, nan, 2.079, *4 * [nan]], nan_ok=True)
    assert table.pull.values == pytest.approx([nan, nan, 2.1, 0, 5 / 3, *3 * [nan]], nan_ok=True)
    assert table.measured.values == pytest.approx([4.75, 2, 2.0021, 2.1, 2.5, 0, 1.75, 3])
    assert table.standard_error.values[:5] == pytest.approx([0.1, 0.1, 0.001, 0.001, 0.3])
    assert list(table.law.values[[0, 1, 5, 6]]) == [
        "normal",
        "t with 19 degrees",
        "Clopper-Pearson of 20000",
        "exact",
    ]


def test_findings_are_gathered_from_the_items_that_are_used(monkeypatch):
    """Each from its own dataset, made with its own settings."""

    class Item:
        def __init__(self, name):
            self.name = name

        def claims(self, dataset):
            return [finding(f"{self.name}_{dataset}", Mean(1.0, 0.1))]

    monkeypatch.setattr(items, "load", Item)
    monkeypatch.setattr(items, "reduced", lambda name, samples, own: samples[name] + own)
    found = _claims.findings(("a", "b"), {"a": "x", "b": "y"}, {"items": {"a": "1", "b": "2"}})
    assert [one.claim for one in found] == ["a_x1", "b_y2"]


# Its figure


@pytest.mark.parametrize(
    ("low", "high", "measured", "ends", "expected"),
    [
        (4.0, 6.0, 5.0, (4.5, 5.5), (0.0, -0.5, 0.5)),
        (4.0, 6.0, 6.0, (5.0, 8.0), (1.0, 0.0, 3.0)),
        (-0.62, -0.38, -0.5, (-0.74, -0.26), (0.0, -2.0, 2.0)),
        (0.5, np.inf, 0.75, (0.5, 1.0), (1.5, 1.0, 2.0)),
        (0.5, np.inf, -0.5, (-1.0, 0.0), (-1.0, -2.0, 0.0)),
        (0.0, 0.0, 0.0, (0.0, 0.0), (0.0, 0.0, 0.0)),
    ],
)
def test_units_of_a_set(low, high, measured, ends, expected):
    part = {"allowed_low": low, "allowed_high": high, "measured": measured}
    part |= {"low": ends[0], "high": ends[1]}

    class Record(dict):
        __getattr__ = dict.__getitem__

    assert _claims.in_units(Record(part)) == pytest.approx(expected)


def drawn(axis):
    """Return marks [(x, y, colour)] and bars [(low, high, y)] of a band, in the order drawn."""
    lines = [line for line in axis.lines if line.get_xdata(orig=True) is not None]
    marks, bars = [], []
    for line in lines:
        x, y = (np.atleast_1d(data) for data in line.get_data())
        if line.get_marker() not in ("", "None", None) and x.size == 1:
            marks.append((float(x[0]), float(y[0]), to_rgba(line.get_color())))
        elif x.size == 2:
            bars.append((float(x[0]), float(x[1]), float(y[0])))
    return marks, bars


def test_the_figure_draws_every_component_at_its_numbers(table):
    """Bands by hand: intervals, one-sided ones, exact values, exact one-sided ones, pulls."""
    figure = _claims.draw(table)
    two_sided, one_sided, exact, exact_one_sided, _ = figure.axes
    half = {k: float(table.high[k] - table.low[k]) / 2.0 for k in range(table.sizes["part"])}

    marks, bars = drawn(two_sided)
    assert [mark[0] for mark in marks] == pytest.approx([-0.25, 0.105, 4.0, 4.0, -1.0])
    assert [mark[1] for mark in marks] == pytest.approx([0.0, 0.7, 1.0, 1.3, 2.0])
    ends = [
        (-0.25 - half[0], -0.25 + half[0]),
        (0.105 - half[2] / 0.02, 0.105 + half[2] / 0.02),
        (4.0, 4.0),  # beyond what is drawn
        (-4.0, 4.0),
        (-1.0, -1.0 + 2.0 * half[5] / 0.0005),
    ]
    assert [bar[:2] for bar in bars] == [pytest.approx(pair) for pair in ends]
    assert [bar[2] for bar in bars] == [mark[1] for mark in marks]

    marks, bars = drawn(one_sided)
    assert [mark[:2] for mark in marks] == [pytest.approx((4.0, 0.0))]
    assert bars == [pytest.approx((4.0 - 2.0 * half[1], 4.0 + 2.0 * half[1], 0.0))]
    assert drawn(exact)[0][0][:2] == pytest.approx((0.0, 0.0))
    assert drawn(exact_one_sided)[0][0][:2] == pytest.approx((6.0, 0.0))


def test_marks_have_the_colour_of_their_verdict(table):
    marks, _ = drawn(_claims.draw(table).axes[0])
    colours = [mark[2] for mark in marks]
    wanted = ["reproduced", "reproduced", "contradicted", "undecided", "reproduced"]
    assert colours == [to_rgba(_claims._style(word)[0]) for word in wanted]
    assert len({_claims._style(word)[0] for word in verdict.VERDICTS}) == len(verdict.VERDICTS)


def test_the_band_of_what_is_allowed_is_shaded(table):
    """From -1 to 1 in units of half a width; from 1 on in multiples of the lower end."""
    spans = [
        axis.patches[0].get_extents().transformed(axis.transData.inverted())
        for axis in _claims.draw(table).axes[:4]
    ]
    assert [span.x0 for span in spans] == pytest.approx([-1.0, 1.0, -1.0, 1.0])
    assert [span.x1 for span in spans] == pytest.approx([1.0, 8.0, 1.0, 8.0])


def test_words_stand_beside_their_rows(table):
    figure = _claims.draw(table)
    words = [label.get_text() for label in figure.axes[0].get_yticklabels()]
    assert words == [
        PUBLISHED[claim]["text"] for claim in ("kac_words", "kac_formula", "kac_never")
    ]
    low, high = figure.axes[0].get_ylim()
    assert low > high  # the first row on top


def test_the_legend_names_the_verdicts_that_are_there(table):
    (legend,) = _claims.draw(table).legends
    assert [text.get_text() for text in legend.get_texts()] == [
        "reproduced",
        "contradicted",
        "undecided",
    ]


def test_all_pulls_are_counted(table):
    """2.1, 0 and 5/3: bins of half a unit from -5; those beyond would be in the outermost."""
    axis = _claims.draw(table).axes[-1]
    heights = np.array([patch.get_height() for patch in axis.patches])
    assert heights.sum() == 3
    assert list(np.flatnonzero(heights)) == [10, 13, 14]
    bell = axis.lines[0].get_ydata().max()
    assert bell == pytest.approx(3 * 0.5 * stats.norm.pdf(0.0), rel=1e-3)


def test_tables_are_joined_for_one_picture(table):
    both = _claims.joined([table, table])
    assert both.sizes["row"] == 2 * table.sizes["row"]
    assert list(both.low.values) == pytest.approx([*table.low.values, *table.low.values])
