"""What stands beside the report: its print, the run times, the command that it tells."""

import os

import pikepdf
import printer
import pytest

from kacsim import cli, files, plan
from kacsim.recipes import carriers, lines
from kacsim.report import browser, printing, runtime

PAGE = (
    '<p class="source">kacsim 0.</p>'
    '<code id="configuration" data-options="--config a=&#34;b&#34;">{"a": {}}</code>'
)


@pytest.fixture
def fake(tmp_path, monkeypatch):
    """Return a function that makes a browser of one shell line the one to be found."""

    def make(*lines):
        path = printer.browser(tmp_path / "bin", *lines)
        monkeypatch.setenv(browser.VARIABLE, str(path))
        (tmp_path / "report.html").write_text(PAGE)
        return tmp_path / "report.html", tmp_path / "out" / "report.pdf"

    return make


def test_the_browser_is_the_named_one_or_none(monkeypatch, fake, tmp_path):
    fake()
    assert browser.find() == str(tmp_path / "bin/chromium")
    for nothing in ("", str(tmp_path / "missing")):
        monkeypatch.setenv(browser.VARIABLE, nothing)
        assert browser.find() is None
    monkeypatch.delenv(browser.VARIABLE)
    monkeypatch.setenv("PATH", str(tmp_path / "bin"))
    assert browser.find() == str(tmp_path / "bin/chromium")


def test_a_report_is_printed_whole(fake):
    page, pdf = fake()
    printing.write(page, pdf)
    assert os.listdir(pdf.parent) == ["report.pdf"]
    with pikepdf.open(pdf) as file:
        assert len(file.pages) == 1
        assert "/CreationDate" not in file.docinfo


def test_a_print_has_the_same_bytes_and_carries_the_recipe(fake):
    page, pdf = fake()
    printing.write(page, pdf)
    first = pdf.read_bytes()
    printing.write(page, pdf)
    assert pdf.read_bytes() == first
    recipe = lines.parsed(carriers.read(pdf), pdf)
    assert recipe == lines.Recipe("", {"a": {}}, {}, "kacsim 0", '--config a="b"')


def test_what_is_no_pdf_is_refused(fake):
    page, pdf = fake('echo nothing > "$pdf"')
    with pytest.raises(files.StoreError, match="is not a PDF file"):
        printing.write(page, pdf)
    assert os.listdir(pdf.parent) == []


def test_a_page_that_is_no_report_is_refused(fake):
    page, pdf = fake()
    page.write_text("<p>a page</p>")
    with pytest.raises(files.StoreError, match=r"report\.html: is no report"):
        printing.write(page, pdf)


def test_a_browser_that_fails_is_named_with_what_it_said(fake):
    page, pdf = fake("echo no display; exit 1")
    with pytest.raises(files.StoreError, match="chromium: printed nothing: no display"):
        printing.write(page, pdf)
    assert os.listdir(pdf.parent) == []


def test_a_browser_that_hangs_is_ended(fake, monkeypatch):
    page, pdf = fake("sleep 60")
    monkeypatch.setattr(printing, "SECONDS", 0.2)
    with pytest.raises(files.StoreError, match=r"no answer within 0\.2 s"):
        printing.write(page, pdf)


def test_without_a_browser_one_line_says_so(monkeypatch, capsys):
    monkeypatch.setenv(browser.VARIABLE, "")
    assert cli.main(["print"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("results/report/report.pdf: not printed: no Chromium found")


def test_run_times_have_a_page(tmp_path):
    for job, seconds in (("sample/a", "12.25"), ("sample/b", "3.5"), ("draw/kac_fig1", "1.0")):
        file = tmp_path / "benchmarks" / f"{job}.tsv"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(f"s\tmax_rss\n{seconds}\t100\n")
    (tmp_path / "logs/sample").mkdir(parents=True)
    (tmp_path / "logs/sample/a.log").write_text("drew 10 values of a in 11.000 s\n")
    words = ["times", "--folder", str(tmp_path), "--output", str(tmp_path / "runtime.html")]
    assert cli.main(words) == 0
    text = " ".join((tmp_path / "runtime.html").read_text(encoding="utf-8").split())
    assert text.index("sample/a") < text.index("sample/b")
    row = '<td class="value">{}</td><td class="value">{}</td> <td class="value">{}</td>'
    for cells in ((2, "15.8", "11.0"), (1, "1.0", ""), (3, "16.8", "11.0")):
        assert row.format(*cells).replace("</td><td", "</td> <td") in text.replace(
            "</td><td", "</td> <td"
        )


def test_run_times_without_jobs_say_so(tmp_path):
    runtime.write(tmp_path / "runtime.html", tmp_path)
    assert "No job has left its time." in (tmp_path / "runtime.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("chosen", "values", "command"),
    [
        ([], {}, ""),
        ([plan.ROOT / "config/smoke.yaml"], {}, "--configfile config/smoke.yaml"),
        (["/a b/c.yaml"], {"seed": 7}, "--configfile '/a b/c.yaml' --config seed=7"),
    ],
)
def test_the_page_tells_the_command_of_this_configuration(chosen, values, command):
    assert plan.recipe_options(chosen, values) == command
