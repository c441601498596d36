"""The report in a real browser: Debian's Chromium, driven by Playwright, asked by axe-core.

What the page does when one uses it is in the other files of this folder.
"""

import re

import pytest
from page_checks import PAPER_WIDTH, Visit

from kacsim.report import page as report
from kacsim.report import printing

VIEWS = {
    "wide": {"width": 1200},
    "narrow": {"width": 380},
    "dark": {"width": 1200, "scheme": "dark"},
    "narrow-dark": {"width": 380, "scheme": "dark"},
    "paper": {"width": PAPER_WIDTH, "media": "print"},
}
PAGES = ("report", "runtime")
BAD = """<!DOCTYPE html><html lang="en"><head><title>Bad</title></head><body><main>
<h1>Bad</h1><img src="http://127.0.0.1:9/outside.png"><a href="#nowhere">lost</a>
<a href="missing.pdf">gone</a><a href="http://127.0.0.1:9/">away</a>
<div style="width: 2000px">wide</div>
<figure style="background: #111; height: 2000px"><svg role="img" aria-label="dark"></svg></figure>
<script>console.error("broken")</script></main></body></html>"""


@pytest.fixture(
    scope="module", params=[(page, view) for page in PAGES for view in VIEWS], ids="-".join
)
def visit(request, chromium, results):
    page, view = request.param
    one = Visit(chromium, (results / f"report/{page}.html").as_uri(), **VIEWS[view])
    yield one
    one.context.close()


@pytest.fixture
def bad(chromium, tmp_path):
    """Return a function that visits a page with one fault for every check."""
    visits = []

    def open_bad(**view):
        (tmp_path / "bad.html").write_text(BAD, encoding="utf-8")
        visits.append(Visit(chromium, (tmp_path / "bad.html").as_uri(), **view))
        return visits[-1]

    yield open_bad
    for one in visits:
        one.context.close()


def test_the_page_is_right(visit):
    assert visit.complaints() == []
    assert visit.requests() == []
    assert visit.broken_links() == []
    assert visit.too_wide() == []
    assert visit.dark_grounds() == []


def test_accessibility(visit, axe):
    assert visit.violations(axe) == []


def test_no_figure_is_split_on_paper(chromium, results):
    one = Visit(chromium, (results / "report/report.html").as_uri(), **VIEWS["paper"])
    assert one.split_figures() == []
    one.context.close()


def test_a_kept_report_stands_alone(chromium, results, tmp_path):
    whole = (results / "report/report.html").read_text(encoding="utf-8")
    (tmp_path / "report.html").write_text(report.without_files(whole), encoding="utf-8")
    one = Visit(chromium, (tmp_path / "report.html").as_uri())
    assert one.broken_links() == []
    one.context.close()


def test_the_report_is_printed_on_a4(results, tmp_path):
    printing.write(results / "report/report.html", tmp_path / "report.pdf")
    content = (tmp_path / "report.pdf").read_bytes()
    sizes = set(re.findall(rb"/MediaBox \[ ?0 0 (\d+)[.\d]* (\d+)[.\d]* ?\]", content))
    assert content.startswith(b"%PDF")
    assert sizes == {(b"594", b"841")}
    assert b"file:///" not in content  # links to files would name folders of this machine
    assert [path.name for path in tmp_path.iterdir()] == ["report.pdf"]


# Each check finds its fault


def test_a_page_that_complains_is_seen(bad):
    assert any("broken" in line for line in bad().complaints())


def test_a_request_is_seen(bad):
    assert bad().requests() == ["http://127.0.0.1:9/outside.png"]


def test_broken_links_are_seen(bad):
    assert bad().broken_links() == [
        "#nowhere names no place",
        "http://127.0.0.1:9/ leaves the page",
        "http://127.0.0.1:9/outside.png leaves the page",
        "missing.pdf names no file",
    ]


def test_a_wide_element_is_seen(bad):
    assert any(line.startswith("DIV reaches") for line in bad(width=380).too_wide())


def test_a_dark_figure_is_seen(bad):
    assert bad(scheme="dark").dark_grounds() == ["rgb(17, 17, 17)"]


def test_a_split_figure_is_seen(bad):
    assert bad(**VIEWS["paper"]).split_figures() == ["may break inside", "2000 of 986 px high"]


def test_an_image_without_text_is_seen(bad, axe):
    assert any(line.startswith("image-alt: ") for line in bad().violations(axe))
