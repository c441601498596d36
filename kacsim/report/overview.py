"""All rows of all texts in one picture, which stands above their tables."""

import io
import re

import matplotlib
from markupsafe import Markup, escape

from kacsim.items import _claims
from kacsim.report import svg

ROW_HEIGHT = 0.055  # inch: rows have no words here
LABEL = (
    "All rows of the tables below, without their words: the interval of each in units of the set "
    "that its text allows, intervals, one-sided sets and exact values apart; below, the histogram "
    "of the deviations of all components whose value is known, with the normal law."
)


def drawn(datasets, shared):
    """Return the picture of all tables of claims as markup, None if there is none.

    Its letters are added to `shared`, as of `kacsim.report.svg.inline`.
    """
    tables = [dataset for dataset in datasets if "claim" in dataset]
    if not tables:
        return None
    figure = _claims.draw(_claims.joined(tables), ROW_HEIGHT, words=False)
    text = io.StringIO()
    with matplotlib.rc_context({"svg.fonttype": figure.svg_fonttype}):
        figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
    markup = svg.inline(text.getvalue(), "overview", "overview", LABEL, shared)[0]
    words = {row["claim"]: f"{row['verdict']}: {row['text']}" for row in _rows(tables)}

    def named(found):
        # The tables have the same links in the order of the keyboard.
        label = escape(words[found[1]])
        title = f"<title>{label}</title>"
        return f'<a href="#claim-{found[1]}" tabindex="-1" aria-label="{label}">{title}'

    linked = re.sub(r'<a href="#claim-(\w+)">', named, markup)
    return Markup(linked.replace('role="img"', 'role="group"', 1))


def _rows(tables):
    """Yield claim, verdict and text of every row."""
    for dataset in tables:
        columns = (dataset[name].values for name in ("claim", "verdict", "text"))
        for claim, verdict, text in zip(*columns, strict=True):
            yield {"claim": claim, "verdict": verdict, "text": text}
