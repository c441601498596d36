"""Texts, tables and a figure for a report of two made-up items, and a reader of its page."""

from html.parser import HTMLParser

import numpy as np

from kacsim import store

SVG = """<?xml version="1.0" encoding="utf-8" standalone="no"?>
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">
<svg xmlns:xlink="http://www.w3.org/1999/xlink" width="360pt" height="216pt"
 viewBox="0 0 360 216" xmlns="http://www.w3.org/2000/svg" version="1.1">
 <metadata><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"/></metadata>
 <defs><style type="text/css">*{stroke-linejoin: round}</style><path id="m1" d="M 0 0
L 1 1"/></defs>
 <!-- a comment -->
 <g id="figure_1" clip-path="url(#p1)"><use xlink:href="#m1"/><text>N = 5</text></g>
 <defs><clipPath id="p1"><rect width="3"/></clipPath></defs>
</svg>"""


class Page(HTMLParser):
    """What the tests ask of a page: its start tags with attributes, and its text."""

    def __init__(self, html):
        super().__init__()
        self.tags, self.text, self.within = [], "", ""
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        self.within = tag

    def handle_data(self, data):
        if self.within != "script":
            self.text += " " + data

    def handle_endtag(self, tag):
        self.within = ""

    def all(self, *names):
        return [attrs for tag, attrs in self.tags if tag in names]


# claim, kind, rule, verdict, evidence; of it: label, law, verdict, measured, error, low, high, set,
# right set, departure seen
ROWS = [
    ("small", "printed", "digits", "reproduced", "Seen -2.5 <b>so</b>, 1.9e-10."),
    ("faster", "stated", "direction", "contradicted", ""),
    ("rate", "implied", "implied", "corrected", "E v₁⁴."),
    ("never", "stated", "never", "contradicted", "236 steps."),
    ("gone", "stated", "untestable", "not testable", ""),
    ("own", "check", "words", "undecided", ""),
]
NONE, ENDLESS = np.nan, np.inf
PARTS = [
    ("small", "", "normal", 0.0205, 0.00013, 0.02, 0.021, 0.0145, 0.0229, NONE, NONE, 7e-4, NONE),
    (
        "faster",
        "N = 2",
        "normal",
        1e-5,
        2e-6,
        0.5e-5,
        1.5e-5,
        1e-4,
        ENDLESS,
        NONE,
        NONE,
        8e-6,
        NONE,
    ),
    (
        "faster",
        "N = 3",
        "normal",
        3e-4,
        2e-6,
        2.9e-4,
        3.1e-4,
        1e-4,
        ENDLESS,
        NONE,
        NONE,
        8e-6,
        NONE,
    ),
    ("rate", "", "exact", 4.5949, 0, 4.5949, 4.5949, 4.5434, 4.564, 4.5848, 4.6054, 0.0, NONE),
    ("never", "", "exact", 22.0, 0.0, 22.0, 22.0, 0.0, 0.001, NONE, NONE, 0.0, NONE),
    ("own", "", "t with 9 degrees", 0.5, 0.1, 0.1, 0.9, 0.4, 0.6, NONE, NONE, 0.6, NONE),
]
PART_WORDS = ["reproduced", "contradicted", "reproduced", "corrected", "contradicted", "undecided"]
PUBLISHED = {
    "small": {"printed": "0.0187", "text": "TVN at the small step", "reason": "One TVN"},
    "faster": {"margin": 1e-4, "text": "Poisson is faster", "reason": "A tenth"},
    "rate": {"text": "The rate is right", "reason": "Two rates"},
    "never": {"text": "It never grows", "reason": "A step would do"},
    "gone": {"text": "It is elegant", "reason": "A matter of taste"},
    "own": {"words": "half", "low": 0.4, "high": 0.6, "text": "Our sum", "reason": "A check"},
}
TEXTS = {
    "label": "Fig. 4",
    "title": "Histograms",
    "caption": "{{ number(s.n_draws) }} draws, <i>N</i> = {{ s.n_particles }}.",
    "see": "TVN {{ measured('tvn', algorithm='bird') }} {{ published }}.",
    "alt": 'TVN {{ measured("tvn", algorithm="bird") }} <i>or</i> "so"',
}
STATE = {"state": "slip", "affected": "Nobody.", "follows": "Nothing."}
KNOWN = {
    "name": "Kac paper",
    "about": "A paper.",
    "errors": [
        STATE
        | {"title": "A rate", "where": "a", "printed": "b", "right": "c"}
        | {"claims": ["rate", "left"]},
        STATE
        | {"title": "A sign", "where": "a", "printed": "b", "right": "c", "claims": []}
        | {"note": "{{ number(datasets.kac_fig4.floor[0]) }}"},
    ],
}


INVENTORY = [
    {"id": "kac_a", "where": "section 4", "what": "a TVN", "sort": "number"}
    | {"printed": "0.0187", "rows": ["small", "elsewhere"]},
    {
        "id": "kac_b",
        "where": "Fig. 4",
        "what": "two pictures",
        "sort": "figure",
        "item": "kac_fig4",
    },
    {
        "id": "kac_c",
        "where": "section 5",
        "what": "a name",
        "sort": "claim",
        "none": "a definition",
    },
]


def figure_dataset():
    widths, names = [0.1, 0.05], ["bird", "poisson"]
    described = store.described
    return {
        "algorithm": described(np.array(names, dtype=object), ("algorithm",), "algorithm"),
        "bin_width": described(widths, ("bin_width",), "bin width"),
        "tvn": described([[0.02, 0.03], [0.04, 0.05]], ("algorithm", "bin_width"), "TVN"),
        "tvn_error": described(np.full((2, 2), 0.001), ("algorithm", "bin_width"), "error"),
        "floor": described([0.0093, 0.0131], ("bin_width",), "noise floor"),
    }


def numbers_dataset():
    names = ["claim", "kind", "rule", "verdict", "evidence"]
    row = dict(zip(names, zip(*ROWS, strict=True), strict=True))
    row["text"] = [PUBLISHED[claim]["text"] for claim in row["claim"]]
    names = "of label law measured standard_error low high allowed_low allowed_high right_low"
    names = [*names.split(), "right_high", "seen", "pull"]
    part = dict(zip(names, zip(*PARTS, strict=True), strict=True)) | {"part_verdict": PART_WORDS}
    return {"n_intervals": store.described(4, (), "intervals")} | {
        name: store.described(array(column), (dim,), name)
        for dim, columns in (("row", row), ("part", part))
        for name, column in columns.items()
    }


def array(column):
    return np.array(column, object if isinstance(column[0], str) else float)
