"""The report: its page, made from small datasets."""

import re
import shutil

import numpy as np
import pytest
import yaml
from made_report import (
    INVENTORY,
    KNOWN,
    PUBLISHED,
    ROWS,
    SVG,
    TEXTS,
    Page,
    figure_dataset,
    numbers_dataset,
)

from kacsim import files, store
from kacsim.report import page as report
from kacsim.report import svg

# Figures


def test_an_inline_figure_brings_nothing_from_outside():
    markup, box = svg.inline(SVG, "a.svg", "kac_fig1", 'TVN < 0.1 & "more"', svg.Shared())
    assert box == "0 0 360 216"
    assert not re.search(r"http|xmlns|xlink|metadata|<style|<!|comment|\n", markup)
    (used,) = re.findall(r'<use href="#(.*?)"', markup)
    assert f'<path d="M0 0L1 1" id="{used}"/>' in markup
    (clipped,) = re.findall(r'clip-path="url\(#(.*?)\)"', markup)
    assert f'<clipPath id="{clipped}">' in markup
    assert ' id="kac_fig1-figure_1"' in markup
    assert "<text>N = 5</text>" in markup
    assert 'aria-label="TVN &lt; 0.1 &amp; &quot;more&quot;"' in markup


@pytest.fixture
def write(tmp_path, monkeypatch):
    """Return a function that writes the report of two made-up items and gives its path."""
    xr = pytest.importorskip("xarray")
    texts, data, figures = (tmp_path / name for name in ("texts", "datasets", "figures"))
    for folder in (texts, data, figures):
        folder.mkdir()
    for name in ("*.html.j2", "style.css", "findings.yaml", "glossary.yaml"):
        for path in report.TEXTS.glob(name):
            shutil.copy(path, texts)
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
    html = html.replace("http://www.w3.org/2000/svg", "")  # a name, not an address
    assert not re.search(r"https?:|src=|@import|<link|import ", html)


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


def test_a_copy_for_paper_has_no_script_and_all_words(html):
    paper = report.without_scripts(html)
    assert "<script" not in paper
    assert "worker" not in paper
    # Nobody there has scripts, which a browser that prints would think it has.
    assert paper.count("<noscript><svg") == 0 < html.count("<noscript><svg")
    assert paper.count("-figure_1") == html.count("-figure_1")
    assert Page(paper).text.split() == Page(html).text.split()


def test_tables_and_figures_are_labelled(html):
    page = Page(html)
    assert len(page.all("table")) == len(page.all("caption")) > 0
    assert all(attrs.get("scope") in ("col", "row", "rowgroup") for attrs in page.all("th"))
    assert all(
        attrs.get("role") in ("img", "group") or "aria-hidden" in attrs for attrs in page.all("svg")
    )
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
    assert "Boltzmann paper, 1." not in text  # none of its items is on the page


def test_what_goes_past_the_papers_has_a_chapter(write):
    assert "Past the papers" not in write().read_text(encoding="utf-8")
    captions = write.folder / "texts/captions.yaml"
    texts = yaml.safe_load(captions.read_text(encoding="utf-8"))
    texts["kac_fig4"]["finding"] = "Half: {{ measured('tvn', algorithm='bird') }}."
    captions.write_text(yaml.safe_dump(texts), encoding="utf-8")
    page = Page(write().read_text(encoding="utf-8"))
    text = " ".join(page.text.replace("\u00a0", " ").split())
    assert "Histograms Half: 0.0200 ± 0.0010." in text
    assert text.count("Past the papers") == 2  # in the contents, and above the chapter


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
