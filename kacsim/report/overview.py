"""All rows of all texts in one picture, which stands above their tables."""

import io

import matplotlib

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
    return svg.inline(text.getvalue(), "overview", "overview", LABEL, shared)[0]
