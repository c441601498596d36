"""The report on paper: Chromium, where one is installed, prints the page to PDF."""

import os
import signal
import subprocess
import tempfile
from pathlib import Path

from kacsim.files import StoreError, replace_file
from kacsim.recipes import carriers, lines
from kacsim.report import browser
from kacsim.report.page import without_files, without_scripts
from kacsim.report.texts import read_text

# Nothing is asked of the network, and a page printed as root runs without Chromium's own sandbox.
QUIET = (
    "--headless",
    "--disable-gpu",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-pdf-header-footer",
    "--generate-pdf-document-outline",
)
SECONDS = 300


def write(report, output, chromium=None):
    """Print a report to PDF; the same page and browser give the same bytes.

    Parameters
    ----------
    report : HTML file
    output : PDF file to create or replace
    chromium : path of the browser, found if not given

    Raises
    ------
    StoreError
        If there is no Chromium, or it fails, with the last of what it said, or the page is no
        report.
    """
    chromium = chromium or browser.find()
    if chromium is None:
        raise StoreError(f"{output}: not printed: {browser.NONE}")
    output = Path(output).absolute()
    html = without_scripts(without_files(read_text(Path(report))))
    recipe = lines.of_report(*carriers.of_page(html, report))
    replace_file(output, lambda name: _print(html, name, chromium, recipe))


def _print(html, output, chromium, recipe):
    # Beside the output: a Chromium that is packed as a snap may not see the folder of temporaries.
    with tempfile.TemporaryDirectory(dir=Path(output).parent, ignore_cleanup_errors=True) as folder:
        page, pdf = Path(folder) / "page.html", Path(folder) / "page.pdf"
        page.write_text(html, encoding="utf-8")
        root = ("--no-sandbox",) if os.geteuid() == 0 else ()
        own = (f"--user-data-dir={folder}/profile", f"--print-to-pdf={pdf}", page.as_uri())
        said = _run([chromium, *QUIET, *root, *own])
        if not pdf.exists() or pdf.stat().st_size == 0:
            raise StoreError(f"{chromium}: printed nothing: {said.strip()[-300:]}")
        settle(pdf, output, recipe)


def settle(pdf, output, recipe):
    """Write a PDF file again without times and random ids, with a recipe among its metadata.

    Raises
    ------
    StoreError
        If it is not a PDF file.
    """
    import pikepdf

    try:
        with pikepdf.open(pdf) as file:
            for key in ("/CreationDate", "/ModDate"):
                if key in file.docinfo:
                    del file.docinfo[key]
            file.docinfo[f"/{carriers.FIELD['pdf']}"] = recipe
            # Without streams of objects, as the browser wrote it: pages can be read as text.
            plain = pikepdf.ObjectStreamMode.disable
            file.save(output, deterministic_id=True, object_stream_mode=plain)
    except pikepdf.PdfError as error:
        raise StoreError(f"{pdf}: is not a PDF file: {error}") from error


def _run(command):
    """Run the browser and return what it said; it and its children end after `SECONDS`."""
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    with subprocess.Popen(command, text=True, start_new_session=True, **streams) as process:
        try:
            return process.communicate(timeout=SECONDS)[0]
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            return f"no answer within {SECONDS} s"
