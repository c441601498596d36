"""The rows of reports/published/: each has the keys of its rule, and words mean one range.

No z tests: these are texts.
"""

import collections
import math
import re

import pytest

from kacsim import files, items
from kacsim.kernels.provenance import ROOT
from kacsim.statistics import verdict

COMMON = {"item", "kind", "rule", "source", "text", "reason"}
OWN = {
    "digits": {"printed", "spread"},
    "words": {"words", "low", "high"},
    "implied": set(),
    "direction": {"margin"},
    "never": set(),
    "always": set(),
    "untestable": set(),
}
FILES = {path.stem: files.read_yaml(path) for path in items.PUBLISHED}
ROWS = {key: entry for rows in FILES.values() for key, entry in rows.items()}
TO_DO = "to be written"


def number(value):
    return isinstance(value, int | float) and not isinstance(value, bool)


def of_rule(*rules):
    return [key for key, entry in ROWS.items() if entry["rule"] in rules]


def test_files_are_those_of_the_texts():
    assert set(FILES) == {"kac", "boltzmann", "techniques"}
    assert set(OWN) == set(verdict.RULES)


@pytest.mark.parametrize("name", FILES)
def test_ids_begin_with_the_name_of_their_file(name):
    assert [key for key in FILES[name] if not key.startswith(f"{name}_")] == []


@pytest.mark.parametrize("name", FILES)
def test_no_id_stands_twice(name):
    """YAML keeps the last of two, without a word."""
    text = (ROOT / "reports" / "published" / f"{name}.yaml").read_text(encoding="utf-8")
    ids = collections.Counter(re.findall(r"^([\w-]+):", text, re.M))
    assert [key for key, many in ids.items() if many > 1] == []
    assert set(ids) == set(FILES[name])


@pytest.mark.parametrize("key", ROWS)
def test_a_row_has_the_keys_of_its_rule(key):
    entry = ROWS[key]
    assert entry["rule"] in verdict.RULES
    assert set(entry) - {"also"} == COMMON | OWN[entry["rule"]]
    assert entry["kind"] in verdict.KINDS


@pytest.mark.parametrize("key", ROWS)
def test_a_row_belongs_to_items_of_its_text(key):
    entry = ROWS[key]
    family = key.partition("_")[0]
    for name in (entry["item"], *entry.get("also", ())):
        assert name in items.NAMES
        assert name.startswith(f"{family}_")


@pytest.mark.parametrize("name", FILES)
def test_the_table_of_a_text_asks_every_item_that_has_a_row(name):
    """An item that it does not ask has its rows left out without a word."""
    gathered = {f"{name}_numbers", *items.load(f"{name}_numbers").USES}
    assert {entry["item"] for entry in FILES[name].values()} <= gathered


@pytest.mark.parametrize("key", ROWS)
def test_a_row_says_where_what_and_why_in_a_line_each(key):
    for name in ("source", "text", "reason"):
        words = ROWS[key][name]
        assert isinstance(words, str)
        assert words == words.strip() != ""
        assert "\n" not in words
    assert TO_DO not in ROWS[key]["reason"]


@pytest.mark.parametrize("key", of_rule("digits"))
def test_printed_digits_are_text(key):
    """Quoted: 0.50 has a digit more than 0.5. No power of ten: half a unit could not be told."""
    entry = ROWS[key]
    assert isinstance(entry["printed"], str)
    assert re.fullmatch(r"-?\d+(\.\d+)?", entry["printed"])
    assert number(entry["spread"])
    assert 0.0 <= entry["spread"] < math.inf


@pytest.mark.parametrize("key", of_rule("words", "direction"))
def test_sets_have_a_width(key):
    entry = ROWS[key]
    if entry["rule"] == "direction":
        assert number(entry["margin"])
        assert 0.0 < entry["margin"] < math.inf
    else:
        assert number(entry["low"])
        assert number(entry["high"])
        assert entry["low"] < entry["high"]


@pytest.mark.parametrize("key", of_rule("untestable"))
def test_what_no_item_tests_belongs_to_the_table(key):
    assert ROWS[key]["item"] == f"{key.partition('_')[0]}_numbers"


def what_words_allow():
    """Return words -> (low, high) of the table in docs/statistics.md."""
    text = (ROOT / "docs" / "statistics.md").read_text(encoding="utf-8")
    section = text.partition("### What words allow")[2].partition("\n## ")[0]
    rows = [line.strip("|").split("|") for line in section.splitlines() if line.startswith("|")]
    found = {}
    for words, low, high, *_ in ([cell.strip() for cell in row] for row in rows[2:]):
        assert words not in found, f"{words!r} stands twice"
        found[words] = tuple(
            float(end.replace("−", "-").replace("∞", "inf")) for end in (low, high)
        )
    return found


def test_words_mean_what_the_documentation_says():
    """No other range in a row, no words in the table that no row uses."""
    used = {}
    for key in of_rule("words"):
        used.setdefault(ROWS[key]["words"], set()).add((ROWS[key]["low"], ROWS[key]["high"]))
    assert used == {words: {ends} for words, ends in what_words_allow().items()}
