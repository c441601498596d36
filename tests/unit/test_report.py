"""The report: its page, made from small datasets."""

import re
import shutil
from html.parser import HTMLParser

import numpy as np
import pytest
import yaml

from kacsim import files, store
from kacsim.report import page as report

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


def test_an_inline_figure_brings_nothing_from_outside(tmp_path):
    (tmp_path / "a.svg").write_text(SVG, encoding="utf-8")
    markup, box = report.inline_svg(tmp_path / "a.svg", "kac_fig1", 'TVN < 0.1 & "more"')
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


ROWS = [
    (
        "small",
        "number",
        "reproduced",
        0.0205,
        0.00013,
        0.0013,
        np.nan,
        1.4,
        "Seen -2.5 <b>so</b>, 1.9e-10.",
    ),
    ("faster", "effect", "not reproduced", 1e-5, 2e-5, 0.0, np.nan, 0.5, ""),
    ("rate", "correction", "corrected", 4.5949, 0.003, 0.0, 4.5951, 13.8, "E v₁⁴."),
    ("never", "number", "not reproduced", 22.0, 0.0, 0.0, np.nan, np.inf, "236 steps."),
]
PUBLISHED = {
    "small": {"value": 0.0187, "text": "TVN at the small step"},
    "faster": {"value": 0, "text": "Poisson is faster"},
    "rate": {"value": None, "text": "The rate is right"},
    "never": {"value": 0, "text": "It never grows"},
}
TEXTS = {
    "label": "Fig. 4",
    "title": "Histograms",
    "caption": "{{ number(s.n_draws) }} draws, <i>N</i> = {{ s.n_particles }}.",
    "see": "TVN {{ measured('tvn', algorithm='bird') }} {{ published }}.",
    "alt": 'TVN {{ measured("tvn", algorithm="bird") }} <i>or</i> "so"',
}
KNOWN = {
    "name": "Kac paper",
    "about": "A paper.",
    "errors": [
        {"title": "A rate", "where": "a", "printed": "b", "right": "c", "claims": ["rate", "gone"]},
        {
            "title": "A sign",
            "where": "a",
            "printed": "b",
            "right": "c",
            "claims": [],
            "note": "{{ number(datasets.kac_fig4.floor[0]) }}",
        },
    ],
}


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
    names = "claim kind verdict measured standard_error published_error corrected z evidence"
    columns = dict(zip(names.split(), map(list, zip(*ROWS, strict=True)), strict=True))
    columns |= {"reference": [0.0187, 0.0, 4.5537, 0.0], "adjusted_p_value": [0.9, 1, 2e-42, 0.0]}
    return {
        name: store.described(np.array(column, dtype=object), ("row",), name)
        if isinstance(column[0], str)
        else store.described(np.array(column, dtype=float), ("row",), name)
        for name, column in columns.items()
    }


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
    errata = {"kac": KNOWN, "boltzmann": KNOWN | {"name": "Boltzmann paper"}}
    (texts / "errata.yaml").write_text(yaml.safe_dump(errata, sort_keys=False), encoding="utf-8")
    entries = {
        k: e | {"item": "kac_fig4", "source": "Kac paper, eq. (8)"} for k, e in PUBLISHED.items()
    }
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

    def run(names=("kac_fig4", "kac_numbers")):
        output = tmp_path / "report" / "report.html"
        report.write(names, data, figures, output, "--configfile a.yaml")
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


def test_every_verdict_is_counted_and_has_a_word_and_a_sign(html):
    text = " ".join(Page(html).text.split())
    assert "1 of 4 published results reproduced, 1 corrected, 2 not reproduced." in text
    for sign in ("✓ reproduced", "↻ corrected", "✗ not reproduced"):
        assert sign in text


def test_claims_show_published_measured_and_statistic(html):
    text = " ".join(Page(html).text.replace("\u00a0", " ").split())
    assert "0.0187 ± 0.0013 0.02050 ± 0.00013 +1.4 p = 0.9 Fig. 4 Kac paper, eq. (8)" in text
    assert "> 0 (1.0 ± 2.0)·10⁻⁵ +0.5 p = 1" in text
    assert "4.5537 implied by the text corrected: 4.5951 4.5949 ± 0.0030 +13.8" in text
    assert "0 22 exact count" in text
    assert "Seen −2.5 <b>so</b>, 1.9·10⁻¹⁰." in text  # escaped: text, not markup


def test_an_item_shows_what_its_run_used(html):
    text = " ".join(Page(html).text.replace("\u00a0", " ").split())
    assert "Fig. 4. 2000 draws, N = 5." in text
    assert "3 replicates of 2000 draws Engine forward" in text
    assert "snakemake -c2 kac_fig4 --configfile a.yaml" in text
    assert "algorithm width 0.05 width 0.1 bird 0.0300 ± 0.0010 0.0200 ± 0.0010" in text
    assert "noise floor 0.0131 0.0093" in text
    assert "at most 0.01" in text


def test_errors_of_a_text_come_with_their_evidence(html):
    text = " ".join(Page(html).text.replace("\u00a0", " ").split())
    assert "printed text 4.5537, correction 4.5951, measured 4.5949 ± 0.0030 (z = +13.8" in text
    assert "Evidence 0.0093" in text
    assert "Boltzmann paper" not in text  # none of its items is on the page


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
