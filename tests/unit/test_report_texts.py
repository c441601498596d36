"""The texts of the report, and the colours of its style."""

import re

import numpy as np
import pytest
import yaml

from kacsim import items
from kacsim.report import page as report

CAPTIONS, ERRATA, TEMPLATE, RUNTIME = (
    (report.TEXTS / name).read_text(encoding="utf-8")
    for name in ("captions.yaml", "errata.yaml", "report.html.j2", "runtime.html.j2")
)


REFERENCE = r"(?:[Ss]ections?|eqs?\.|Figs?\.) \(?[\d.]+\)?(?: and \(\d+\))?"
CONSTANTS = {"16", "256"}  # of eq. (8), and of the name xoshiro256++


def typed_numbers(text):
    """Return the numbers in a text that no expression put there and that name no place or claim.

    Single digits are free: formulas hold them.
    """
    text = re.sub(r"^\s*#.*$", "", text, flags=re.M)
    text = re.sub(r"\{\{.*?\}\}|\{%.*?%\}|\{#.*?#\}", " ", text, flags=re.S)
    text = re.sub(r"<[^>]*>|\b[a-z]+_\w+", " ", text)
    text = re.sub(REFERENCE, " ", " ".join(text.split()))
    found = re.findall(r"\d+(?:[.,\u202f]\d+)*", text)
    return [number for number in found if len(number) > 1 and number not in CONSTANTS]


@pytest.mark.parametrize(
    "text", [CAPTIONS, ERRATA, TEMPLATE, RUNTIME], ids=["captions", "errata", "page", "times"]
)
def test_no_number_of_a_run_is_typed(text):
    assert typed_numbers(text) == []


def test_typed_numbers_would_be_found():
    text = "At 0.01 (section 4.3, eqs. (13) and (14)): {{ 2.5 }} of 3204 <td width='77'> steps, 1/2"
    assert typed_numbers(text) == ["0.01", "3204"]


def test_every_item_has_all_its_texts():
    captions = yaml.safe_load(CAPTIONS)
    assert set(captions) == set(items.NAMES)
    needed = {"label", "title", "caption", "see", "alt"}
    free = {"engine", "draws", "finding"}
    assert all(needed <= set(texts) <= needed | free for texts in captions.values())


def test_every_text_is_a_template():
    env = report.environment()
    captions, errata = (yaml.safe_load(text) for text in (CAPTIONS, ERRATA))
    errors = [error for text in errata.values() for error in text["errors"]]
    for texts in (*captions.values(), *errors):
        for text in texts.values():
            if isinstance(text, str):
                env.from_string(text)


def test_every_error_has_its_parts_and_its_claims_are_published():
    for text in yaml.safe_load(ERRATA).values():
        assert set(text) == {"name", "about", "errors"}
        for error in text["errors"]:
            assert {"title", "where", "printed", "right", "claims"} <= set(error), error
            assert error["claims"] or error.get("note"), error
            assert set(error["claims"]) <= set(items.published())


def test_every_text_of_an_item_is_known():
    families = {name.partition("_")[0] for name in items.NAMES}
    assert families <= set(yaml.safe_load(ERRATA))


# Colours


def colours(scheme):
    """Return the custom properties of the style sheet in a colour scheme."""
    style = (report.TEXTS / "style.css").read_text(encoding="utf-8")
    blocks = re.findall(r":root \{(.*?)\}", style, re.S)
    pairs = [dict(re.findall(r"--([\w-]+): (#\w+);", block)) for block in blocks]
    return pairs[0] if scheme == "light" else pairs[0] | pairs[1]


def luminance(colour):
    """Return the relative luminance of #rgb or #rrggbb, as WCAG defines it."""
    digits = colour[1:] if len(colour) == 7 else "".join(2 * c for c in colour[1:])
    parts = np.array([int(digits[k : k + 2], 16) for k in (0, 2, 4)]) / 255
    linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
    return linear @ [0.2126, 0.7152, 0.0722]


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize(
    ("name", "least"),
    [("ink", 7), ("soft", 4.5), ("link", 4.5), ("reproduced", 3), ("contradicted", 3)],
)
def test_contrast(scheme, name, least):
    known = colours(scheme)
    for ground in ("paper", "shade"):
        dark, light = sorted(luminance(known[k]) for k in (name, ground))
        assert (light + 0.05) / (dark + 0.05) >= least
