"""The report: its page, made from small datasets."""

import re
import shutil
from html.parser import HTMLParser

import numpy as np
import pytest
import yaml

from kacsim import files, store
from kacsim.report import page as report
from kacsim.report import svg

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


# Figures


def test_an_inline_figure_brings_nothing_from_outside():
    markup, box = svg.inline(SVG, "a.svg", "kac_fig1", 'TVN < 0.1 & "more"')
    assert box == "0 0 360 216"
    assert not re.search(r"http|xmlns|xlink|metadata|<style|<!|comment|\n", markup)
    assert set(re.findall(r' id="(.*?)"', markup)) == {
        "kac_fig1-m1",
        "kac_fig1-figure_1",
        "kac_fig1-p1",
    }
    assert 'href="#kac_fig1-m1"' in markup
    assert 'clip-path="url(#kac_fig1-p1)"' in markup
    assert 'd="M 0 0 L 1 1"' in markup
    assert "<text>N = 5</text>" in markup
    assert 'aria-label="TVN &lt; 0.1 &amp; &quot;more&quot;"' in markup


# The page


class Page(HTMLParser):
    """What the tests ask of a page: its start tags with attributes, and its text."""

    def __init__(self, html):
        super().__init__()
        self.tags, self.text = [], ""
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data):
        self.text += " " + data

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


@pytest.fixture
def write(tmp_path, monkeypatch):
    """Return a function that writes the report of two made-up items and gives its path."""
    xr = pytest.importorskip("xarray")
    texts, data, figures = (tmp_path / name for name in ("texts", "datasets", "figures"))
    for folder in (texts, data, figures):
        folder.mkdir()
    for name in ("report.html.j2", "style.css"):
        shutil.copy(report.TEXTS / name, texts)
    numbers_texts = TEXTS | {"label": "All claims", "see": "", "alt": "", "caption": ""}
    captions = {"kac_fig4": TEXTS, "kac_numbers": numbers_texts | {"engine": "all", "draws": "all"}}
    (texts / "captions.yaml").write_text(yaml.safe_dump(captions), encoding="utf-8")
    (texts / "inventory").mkdir()
    (texts / "inventory/kac.yaml").write_text(yaml.safe_dump(INVENTORY), encoding="utf-8")
    errata = {"kac": KNOWN, "boltzmann": KNOWN | {"name": "Boltzmann paper"}}
    (texts / "errata.yaml").write_text(yaml.safe_dump(errata, sort_keys=False), encoding="utf-8")
    rules = {row[0]: row[2] for row in ROWS}
    place = {"item": "kac_fig4", "source": "Kac paper, eq. (8)"}
    entries = {key: entry | place | {"rule": rules[key]} for key, entry in PUBLISHED.items()}
    monkeypatch.setattr(report, "TEXTS", texts)
    monkeypatch.setattr(report, "published", lambda: entries)
    own = {"seed": 77, "engine": "forward", "n_draws": 2000, "n_replicates": 3, "n_particles": 5}
    contents = {
        "kac_fig4": (figure_dataset(), own, {"published": {"small": 0.0187}}),
        "kac_numbers": (
            numbers_dataset(),
            {"seed": 77, "items": {"kac_fig4": own}},
            {"published": {}, "family_error": 0.01},
        ),
    }
    for name, (variables, settings, attributes) in contents.items():
        (figures / f"{name}.svg").write_text(SVG, encoding="utf-8")
        content = xr.Dataset(variables, attrs=attributes)
        store.write(content, data / f"{name}.nc", title="t", settings=settings)

    def run(names=("kac_fig4", "kac_numbers"), options="--configfile a.yaml"):
        output = tmp_path / "report" / "report.html"
        report.write(names, data, figures, output, options)
        return output

    run.folder = tmp_path
    return run


@pytest.fixture
def html(write):
    return write().read_text(encoding="utf-8")


def test_the_same_inputs_give_the_same_bytes(write):
    assert write().read_bytes() == write().read_bytes()


def test_the_page_is_self_contained(html):
    assert not re.search(r"https?:|src=|@import|<script|<link", html)
    assert len(html.encode()) < 5e6


def test_headings_are_in_order(html):
    levels = [int(level) for level in re.findall(r"<h([1-6])", html)]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert max(np.diff(levels)) == 1


def test_ids_are_unique_and_every_anchor_resolves(html):
    page = Page(html)
    ids = [attrs["id"] for _, attrs in page.tags if "id" in attrs]
    assert len(ids) == len(set(ids))
    targets = [attrs["href"] for attrs in page.all("a", "use") if attrs["href"].startswith("#")]
    assert targets
    assert {target[1:] for target in targets} <= set(ids)
    labels = [attrs["aria-labelledby"] for _, attrs in page.tags if "aria-labelledby" in attrs]
    assert set(labels) <= set(ids)


def test_files_are_linked_relative_to_the_report(html):
    links = {attrs["href"] for attrs in Page(html).all("a")}
    wanted = {f"../figures/kac_fig4.{suffix}" for suffix in ("svg", "png", "pdf")}
    assert wanted | {"../datasets/kac_fig4.nc", "../figures/kac_fig4.csv", "runtime.html"} <= links


def test_a_copy_that_stands_alone_has_no_link_to_a_file(html):
    alone = report.without_files(html)
    links = [attrs["href"] for attrs in Page(alone).all("a")]
    assert links
    assert all(link.startswith("#") for link in links)
    assert "".join(Page(alone).text.split()) == "".join(Page(html).text.split())


def test_tables_and_figures_are_labelled(html):
    page = Page(html)
    assert len(page.all("table")) == len(page.all("caption")) > 0
    assert all(attrs.get("scope") in ("col", "row") for attrs in page.all("th"))
    assert all(attrs.get("role") == "img" or "aria-hidden" in attrs for attrs in page.all("svg"))
    assert 'Fig. 4. TVN 0.0200 ± 0.0010 or "so"' in [a.get("aria-label") for a in page.all("svg")]
    regions = [attrs for _, attrs in page.tags if "scroll" in (attrs.get("class") or "").split()]
    assert regions
    assert all({"role", "tabindex", "aria-label"} <= set(attrs) for attrs in regions)
    assert page.all("html") == [{"lang": "en"}]


def test_every_verdict_is_counted_by_kind_and_has_a_word_and_a_sign(html):
    text = " ".join(Page(html).text.split())
    assert "1 printed numbers: 1 reproduced." in text
    assert "3 stated results: 2 contradicted, 1 not testable." in text
    assert "1 consequences of printed formulas: 1 corrected." in text
    assert "1 checks of our own code, 1 undecided" in text
    for sign in ("✓ reproduced", "↻ corrected", "✗ contradicted", "? undecided", "– not testable"):
        assert sign in text


def test_claims_show_set_interval_and_departure(html):
    text = " ".join(Page(html).text.replace("\u00a0", " ").split())
    assert "0.0187: 0.0145 to 0.0229 0.02000 to 0.02100 0.02050 ± 0.00013 0.0007 Fig. 4" in text
    assert "2 components: 1 reproduced, 1 contradicted; shown N = 2" in text
    assert "at least 0.0001 (0.50 to 1.50)·10⁻⁵ (1.00 ± 0.20)·10⁻⁵ 8·10⁻⁶" in text
    assert "4.543 to 4.564 right: 4.585 to 4.605 4.5949 exact any" in text
    assert "no violation, or at most 1 in 1000 22 exact" in text
    assert "“half”: 0.4 to 0.6 0.10 to 0.90" in text
    assert "Set (untestable): A matter of taste." in text
    assert "Seen −2.5 <b>so</b>, 1.9·10⁻¹⁰." in text  # escaped: text, not markup


def test_registered_sets_and_their_changes_are_shown(write, monkeypatch):
    known = {"commit": "0123abc", "intervals": {"kac": 5}, "rows": {"old": {}}}
    monkeypatch.setattr(report.registered, "read", lambda path: known)
    text = " ".join(Page(write(options="").read_text(encoding="utf-8")).text.split())
    assert "of commit 0123abc , made before anything was drawn with this seed. Changed" in text
    assert "kac: 4 intervals, registered 5" in text
    assert "old: left out" in text
    assert "no registered sets" in Page(write().read_text(encoding="utf-8")).text


def test_an_item_shows_what_its_run_used(html):
    text = " ".join(Page(html).text.replace("\u00a0", " ").split())
    assert "Fig. 4. 2000 draws, N = 5." in text
    assert "3 replicates of 2000 draws Engine forward" in text
    assert "snakemake -c2 kac_fig4 --configfile a.yaml" in text
    assert "algorithm width 0.05 width 0.1 bird 0.0300 ± 0.0010 0.0200 ± 0.0010" in text
    assert "noise floor 0.0131 0.0093" in text
    assert "4 of the Kac paper share a chance of 0.01 that one misses" in text


def test_errors_of_a_text_come_with_their_evidence(html):
    text = " ".join(Page(html).text.replace("\u00a0", " ").split())
    assert "the text allows 4.543 to 4.564, right is 4.585 to 4.605, measured 4.5949" in text
    assert "Evidence 0.0093" in text
    assert "Boltzmann paper" not in text  # none of its items is on the page


def test_what_is_printed_is_listed_with_its_rows(html):
    text = " ".join(Page(html).text.replace("\u00a0", " ").split())
    assert "Kac paper: 3 entries" in text
    row = "✓ reproduced TVN at the small step"
    assert f"section 4 a TVN: 0.0187 (number) {row} Fig. 4 two pictures (figure) figure" in text
    assert "a name (claim) a definition" in text


def test_a_report_without_claims_says_so(write):
    text = " ".join(Page(write(["kac_fig4"]).read_text(encoding="utf-8")).text.split())
    assert "This run holds no table of claims." in text


def test_a_missing_figure_is_named(write):
    (write.folder / "figures/kac_fig4.svg").unlink()
    with pytest.raises(files.StoreError, match=r"kac_fig4\.svg: cannot be read"):
        write()


def test_a_broken_figure_is_named(write):
    (write.folder / "figures/kac_fig4.svg").write_text("<svg", encoding="utf-8")
    with pytest.raises(files.StoreError, match=r"kac_fig4\.svg: is not SVG"):
        write()


def test_an_item_without_texts_is_named(write):
    (write.folder / "texts/captions.yaml").write_text("kac_fig1: {}", encoding="utf-8")
    with pytest.raises(files.StoreError, match=r"captions\.yaml: has no entry kac_fig4"):
        write()
    assert not (write.folder / "report").exists()
