"""The inventory: everything that the texts print, with the row that was made of it or why none.

``reports/inventory/{text}.yaml`` is a list in the order of the text; its digits were transcribed
from the texts a second time, before the rows were read. An entry:

    id       unique, begins with the name of the text
    where    section, paragraph, figure or equation
    what     what stands there, in our words; quotations in double quotes
    sort     figure, number, algorithm, formula or claim
    printed  of a number only: its digits as printed, as text, or a list of several

and one of three, what became of it:

    rows     ids of reports/published/
    item     the item that shows it or, of a number, has it among its settings
    none     why there is neither
"""

import copy
import functools
import itertools
import math
import re

import pytest

from kacsim import files, items
from kacsim.kernels.provenance import ROOT

SORTS = ("figure", "number", "algorithm", "formula", "claim")
ENDS = ("rows", "item", "none")
FIGURE = re.compile(r"_fig\d+$")


@functools.cache
def texts(folder):
    """Return text -> content of its file in a folder of reports/."""
    paths = sorted((ROOT / "reports" / folder).glob("*.yaml"))
    return {path.stem: files.read_yaml(path) for path in paths}


def printed(entry):
    """Return the printed digits of an entry, as a list."""
    values = entry.get("printed", [])
    return values if isinstance(values, list) else [values]


def problems(inventory, rows, names):
    """Return a sentence for all that is wrong.

    Parameters
    ----------
    inventory, rows : text -> list of entries, text -> dict of published rows
    names : items
    """
    found = []
    for text, entries in inventory.items():
        for entry in entries:
            found += [f"{entry.get('id')}: {why}" for why in _shape(entry, text)]
            found += [f"{entry.get('id')}: {why}" for why in _ends(entry, rows[text], names)]
    every = [entry for entries in inventory.values() for entry in entries]
    ids = [entry["id"] for entry in every]
    found += [f"{one}: twice" for one in set(ids) if ids.count(one) > 1]
    for name in names:
        shown = [e["id"] for e in every if e["sort"] == "figure" and e.get("item") == name]
        if FIGURE.search(name) and len(shown) != 1:
            found.append(f"{name}: {len(shown)} figures of the texts")
    for text, of_text in rows.items():
        for claim, row in of_text.items():
            naming = [entry for entry in inventory[text] if claim in entry.get("rows", ())]
            found += [f"{claim}: {why}" for why in _transcription(row, naming)]
    return found


def _shape(entry, text):
    """Yield what is wrong with the keys of an entry and their values."""
    end = [key for key in ENDS if key in entry]
    number = ["printed"] if entry.get("sort") == "number" else []
    if sorted(entry) != sorted(["id", "where", "what", "sort", *number, *end]) or len(end) != 1:
        yield f"has {', '.join(entry)}"
    if not re.fullmatch(rf"{text}_[a-z0-9_]+", entry["id"]):
        yield f"is no id of {text}"
    if entry["sort"] not in SORTS:
        yield f"is of sort {entry['sort']}"
    texts = [entry["where"], entry["what"], entry.get("none", "-"), *printed(entry)]
    if not all(isinstance(one, str) and one for one in texts):
        yield "has a value that is no text"
    if number and not printed(entry):
        yield "prints no digits"


def _ends(entry, rows, names):
    """Yield what is wrong with the rows or the item that an entry names."""
    named = entry.get("rows", ["-"])
    if not isinstance(named, list) or not named or len(set(named)) < len(named):
        yield "has no list of different rows"
    elif "rows" in entry:
        yield from (f"no row {claim} in this text" for claim in named if claim not in rows)
    if "item" in entry and entry["item"] not in names:
        yield f"no item {entry['item']}"
    if entry["sort"] == "figure" and not FIGURE.search(entry.get("item", "")):
        yield "a figure without its item"


def _transcription(row, naming):
    """Yield what a row and the entries that name it do not agree on; checks print nothing."""
    if row["kind"] == "check":
        return
    if not naming:
        yield "in no entry of the inventory"
        return
    digits = [value for entry in naming for value in printed(entry)]
    if row["rule"] == "digits" and row["printed"] not in digits:
        yield f"{row['printed']} is not what the inventory has"
    quoted = [part for entry in naming for part in re.findall('"(.+?)"', entry["what"])]
    words = row.get("words", "").partition(" (")[0]  # in brackets: what is measured
    if words and not any(words in part for part in quoted):
        yield f"“{words}” is not quoted in the inventory"


def test_the_inventory_is_whole_and_agrees_with_the_rows():
    assert set(texts("inventory")) == set(texts("published"))
    assert problems(texts("inventory"), texts("published"), items.NAMES) == []


@pytest.mark.parametrize("text", sorted(texts("published")))
def test_two_digits_interchanged_in_a_published_number_are_seen(text):
    rows = texts("published")
    tried = 0
    for claim, row in rows[text].items():
        for wrong in interchanged(row.get("printed", "")):
            mutated = copy.deepcopy(rows)
            mutated[text][claim]["printed"] = wrong
            expected = [f"{claim}: {wrong} is not what the inventory has"]
            assert problems(texts("inventory"), mutated, items.NAMES) == expected
            tried += 1
    assert tried or all(len(row.get("printed", "")) < 2 for row in rows[text].values())


def test_words_that_are_not_printed_are_seen():
    rows = copy.deepcopy(texts("published"))
    rows["boltzmann"]["boltzmann_rarefaction"]["words"] = "only by a factor of 6"
    expected = ["boltzmann_rarefaction: “only by a factor of 6” is not quoted in the inventory"]
    assert problems(texts("inventory"), rows, items.NAMES) == expected


def interchanged(digits):
    """Yield a number's digits with two of them interchanged, if that makes another number."""
    places = [k for k, character in enumerate(digits) if character.isdigit()]
    for a, b in itertools.combinations(places, 2):
        if digits[a] != digits[b]:
            swapped = list(digits)
            swapped[a], swapped[b] = digits[b], digits[a]
            yield "".join(swapped)


def test_interchanged_by_hand():
    assert list(interchanged("42.2")) == ["24.2", "22.4"]
    assert list(interchanged("5")) == []


MUTATIONS = {
    "a row that nothing names": lambda one: one["rows"].pop(),
    "a row that does not exist": lambda one: one["rows"].append("kac_other"),
    "a key too many": lambda one: one.update(page="9"),
    "neither rows nor item nor reason": lambda one: one.pop("rows"),
    "two of them": lambda one: one.update(none="why"),
    "no digits": lambda one: one.pop("printed"),
    "digits that YAML reads as a number": lambda one: one.update(printed=0.0187),
    "other digits": lambda one: one.update(printed="0.0178"),
    "another sort": lambda one: one.update(sort="claim"),
    "the id of another entry": lambda one: one.update(id="kac_4_4_tvn_large_step"),
    "the id of another text": lambda one: one.update(id="boltzmann_tvn_small_step"),
}


@pytest.mark.parametrize("change", MUTATIONS.values(), ids=MUTATIONS)
def test_what_is_wrong_is_found(change):
    inventory = copy.deepcopy(texts("inventory"))
    change(next(one for one in inventory["kac"] if one["id"] == "kac_4_4_tvn_small_step"))
    assert problems(inventory, texts("published"), items.NAMES)


def test_a_figure_without_an_entry_is_found():
    kac = [one for one in texts("inventory")["kac"] if one["id"] != "kac_fig6"]
    expected = ["kac_fig6: 0 figures of the texts"]
    assert problems(texts("inventory") | {"kac": kac}, texts("published"), items.NAMES) == expected


# Numbers that are settings


def value(digits):
    """Return the number that some printed digits mean."""
    whole = digits.replace(",", "")
    for sign, operation in {"^": math.pow, "/": lambda a, b: a / b}.items():
        if sign in whole:
            return operation(*map(float, whole.split(sign)))
    return float(whole.removesuffix("π")) * (math.pi if whole.endswith("π") else 1.0)


def settings_of(section):
    """Return the numbers of an item's section, the draws of all replicates, and times of turns."""
    found = [section["n_draws"] * section.get("n_replicates", 1)] if "n_draws" in section else []
    for one in section.values():
        found += [x for x in (one if isinstance(one, list) else [one]) if not isinstance(x, str)]
    return found + [2.0 * math.pi * turn for turn in section.get("turn", ())]


def test_printed_settings_are_those_of_the_full_run():
    config = files.read_yaml(ROOT / "config" / "config.yaml")
    entries = [one for entries in texts("inventory").values() for one in entries]
    seen = [one for one in entries if one["sort"] == "number" and "item" in one]
    for entry in seen:
        known = settings_of(config[entry["item"]])
        for digits in printed(entry):
            assert any(math.isclose(value(digits), x) for x in known), (entry["id"], digits)
    assert len(seen) > 10


@pytest.mark.parametrize(
    ("digits", "number"),
    [("100,000", 1e5), ("10^-6", 1e-6), ("9/41", 9 / 41), ("6π", 6 * math.pi), ("0.0187", 0.0187)],
)
def test_values_of_digits(digits, number):
    assert value(digits) == pytest.approx(number)
