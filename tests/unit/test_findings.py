"""What comes first on the page: sentences from rows, ranked by a rule, gone when not so."""

import math
import re

import pytest
import yaml

from kacsim.items import published
from kacsim.report import findings, glossary, page
from kacsim.report.texts import TEXTS

FILE = yaml.safe_load((TEXTS / "findings.yaml").read_text(encoding="utf-8"))


def part(verdict="contradicted", low=2.0, high=3.0, allowed=(0.0, 1.0), **more):
    middle = 0.5 * (low + high)
    return {
        "part_verdict": verdict, "low": low, "high": high, "measured": middle,
        "standard_error": 0.1, "law": "normal", "allowed_low": allowed[0],
        "allowed_high": allowed[1], "right_low": math.nan,
    } | more  # fmt: skip


def entry(claim, weight="conclusion", verdict="contradicted"):
    return {
        "claim": claim,
        "weight": weight,
        "verdict": verdict,
        "sentence": "{{ value }} " + claim,
    }


def row(verdict="contradicted"):
    shown = {"label": "N = 2", "interval": "2 to 3", "allowed": "x: 0 to 1", "right": ""}
    return {"verdict": verdict, "item": "kac_fig4", "shown": shown}


def shown(entries, rows, parts):
    env = page.environment()
    return findings.shown(
        yaml.safe_dump(entries),
        rows,
        parts,
        {"kac_fig4": {"n_particles": 7}},
        {name: {} for name in rows},
        lambda text, **words: page._rendered(env, text, **words),
    )


def test_order():
    """Conclusions before numbers before formulas; the larger departure first."""
    entries = [entry("f", "formula"), entry("n", "number"), entry("small"), entry("large")]
    parts = {
        "f": [part()],
        "n": [part()],
        "small": [part(low=1.5)],
        "large": [part(low=9.0, high=9.5)],
    }
    found = shown(entries, {name: row() for name in parts}, parts)
    assert [one["claim"] for one in found] == ["large", "small", "n", "f"]
    assert found[0]["sentence"] == "9.25\u00a0±\u00a00.10 large"


def test_changed_data_change_or_remove_a_sentence():
    entries = [entry("a"), entry("b")]
    parts = {"a": [part()], "b": [part(low=4.0, high=5.0)]}
    assert [one["claim"] for one in shown(entries, {"a": row(), "b": row()}, parts)] == ["b", "a"]
    assert [one["claim"] for one in shown(entries, {"a": row(), "b": row("undecided")}, parts)] == [
        "a"
    ]
    parts["a"] = [part(low=7.0, high=8.0)]
    found = shown(entries, {"a": row(), "b": row()}, parts)
    assert [one["claim"] for one in found] == ["a", "b"]
    assert "7.50" in found[0]["sentence"]
    assert shown(entries, {}, {}) == []


def test_no_more_than_ten():
    names = [f"c{k}" for k in range(14)]
    parts = {name: [part(low=2.0 + k, high=2.5 + k)] for k, name in enumerate(names)}
    found = shown([entry(name) for name in names], {name: row() for name in names}, parts)
    assert [one["claim"] for one in found] == names[:3:-1]


def test_the_component_that_decides_is_told():
    parts = {"a": [part("reproduced", low=0.1, high=0.2), part(low=6.0, high=6.2)]}
    assert "6.10" in shown([entry("a")], {"a": row()}, parts)[0]["sentence"]


@pytest.mark.parametrize(
    ("given", "wanted"),
    [
        (part(), 1.0),
        (part(low=-3.0, high=-2.0, allowed=(-1.0, 1.0)), 1.0),
        (part(allowed=(5.0, math.inf)), 0.4),
        (part(low=0.5), 0.0),
        (part(allowed=(-1.0, 0.0)), math.inf),
    ],
)
def test_departure(given, wanted):
    assert findings.departure(given) == pytest.approx(wanted)


def test_a_picture_has_its_set_and_interval_in_order():
    markup = findings.picture(part())
    left = float(re.search(r'rect class="set" x="([\d.]+)"', markup)[1])
    wide = float(re.search(r'width="([\d.]+)" height="18"', markup)[1])
    start, end = map(float, re.search(r'd="M([\d.]+) [\d.]+H([\d.]+)"', markup).groups())
    value = float(re.search(r'cx="([\d.]+)"', markup)[1])
    assert findings.PAD <= left < left + wide < start < value < end <= findings.WIDTH - findings.PAD
    assert value == pytest.approx(0.5 * (start + end), abs=0.1)
    # The set is as long as the interval, and so far from it as it is long.
    assert wide == pytest.approx(end - start, abs=0.2)
    assert start - left - wide == pytest.approx(wide, abs=0.3)
    endless = findings.picture(part(allowed=(5.0, math.inf)))
    assert 'the text allows 5"' in endless


@pytest.mark.parametrize("one", FILE, ids=[one["claim"] for one in FILE])
def test_sentences_type_no_number(one):
    """Digits stand in references to a text only, and in exponents and indices."""
    assert set(one) == {"claim", "verdict", "weight", "sentence"}
    assert one["claim"] in published()
    assert one["weight"] in findings.WEIGHTS
    text = re.sub(r"\{\{.*?\}\}|<su[bp]>.*?</su[bp]>", "", one["sentence"])
    text = re.sub(r"(Fig\.|eq\.|section) \(?\d+\)?", "", text)
    assert not re.search(r"\d", text), text


def test_the_rule_is_stated():
    assert all(
        word in findings.RANKED for word in ("concludes", "numbers", "formulas", "departure")
    )


def test_symbols_lead_to_their_meaning_once():
    terms = [
        {"key": "N", "html": "<i>N</i>", "meaning": "a number"},
        {"key": "TVN", "html": "TVN", "meaning": 'a "norm"'},
    ]
    text = "<b>TVN</b> of TVNs and TVN at <i>N</i> = 5, <i>N</i> = 7, <a href='#x'>TVN</a>"
    linked = str(glossary.linked(text, terms))
    assert linked.count('href="#term-N"') == 1
    assert linked.count('href="#term-TVN"') == 1
    assert '<a class="term" href="#term-N" data-meaning="a number"><i>N</i></a> = 5' in linked
    assert "<a href='#x'>TVN</a>" in linked
    assert "<b>TVN</b> of TVNs and <a " in linked  # neither in a tag of its own nor in a word
    assert "a &#34;norm&#34;" in linked


def test_the_row_that_the_page_narrows():
    """Two-sided, at the level that one interval of its text has."""
    own = {"kac_forward": {"n_particles": 3, "tolerance": 1e-6}}
    raw = {"kac_51_perfect": [part(allowed=(4.0, 4.1))]}
    (found,) = findings.narrowed(raw, own, {"kac": (100, 0.01)})
    assert found["deviations"] == pytest.approx(3.8906, abs=1e-4)  # of a chance of 1e-4
    assert (found["low"], found["high"]) == (4.0, 4.1)
    assert found["given"] == {"n_particles": 3, "tolerance": 1e-6}
    assert findings.narrowed({}, own, {"kac": (100, 0.01)}) == []
