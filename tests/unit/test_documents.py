"""Documents beside the code stay true to it."""

import html
import re

import yaml

from kacsim import items
from kacsim.kernels.provenance import ROOT


def text(name):
    return (ROOT / name).read_text(encoding="utf-8")


def plain(words):
    return html.unescape(re.sub(r"<[^>]+>", "", words))


def test_the_manifest_lists_every_figure_and_the_report():
    manifest = yaml.safe_load(text("codecheck.yml"))["manifest"]
    expected = [f"results/figures/{name}.pdf" for name in items.NAMES]
    assert [entry["file"] for entry in manifest] == [*expected, "results/report/report.html"]
    assert all(entry["comment"] for entry in manifest)


def test_the_page_of_errata_lists_every_error_in_order():
    found = re.findall(r"^\d+\. \*\*(.+?)\*\*", text("docs/errata.md"), re.M)
    families = yaml.safe_load(text("reports/errata.yaml")).values()
    assert found == [plain(error["title"]) for family in families for error in family["errors"]]


def test_the_readme_names_every_item_and_every_page():
    readme = text("README.md")
    for name in items.NAMES:
        family, _, number = name.partition("_fig")
        ranges = f"`{family}_fig" in readme and number
        assert f"`{name}`" in readme or ranges, name
    for page in (ROOT / "docs").glob("*.md"):
        assert f"docs/{page.name}" in readme
