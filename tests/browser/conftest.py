"""A browser, and the results of a run whose pages it opens.

KACSIM_TEST_RESULTS names the results of a finished run; without it, they are the smoke run's.
KACSIM_AXE names axe.min.js; without it, ``npm ci`` in this folder is where it is looked for.
"""

import os
from pathlib import Path

import pytest

from kacsim.report import browser

HERE = Path(__file__).resolve().parent
GIVEN = os.environ.get("KACSIM_TEST_RESULTS")


@pytest.fixture(scope="session")
def chromium():
    sync_api = pytest.importorskip("playwright.sync_api")
    path = browser.find()
    if path is None:
        pytest.skip(browser.NONE)
    with sync_api.sync_playwright() as driver:
        running = driver.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield running
        running.close()


@pytest.fixture(scope="session")
def axe():
    path = Path(os.environ.get("KACSIM_AXE") or HERE / "node_modules/axe-core/axe.min.js")
    if not path.is_file():
        pytest.skip(f"no axe-core at {path}: run `npm ci` in tests/browser, or set KACSIM_AXE")
    return path


if GIVEN:

    @pytest.fixture(scope="session")
    def results(chromium):
        """Return the results of the run that is named."""
        return Path(GIVEN).resolve()

else:

    @pytest.fixture(scope="session")
    def results(chromium, smoke_run):
        """Return the results of the smoke run."""
        return smoke_run / "results"


@pytest.fixture(scope="module")
def report(results):
    """Return the address of the report."""
    return (results / "report/report.html").as_uri()


@pytest.fixture
def opened(chromium, report):
    """Return a function that opens the report in a window of its own; errors fail the test."""
    pages, wrong = [], []

    def open_page(address="", **view):
        page = chromium.new_page(**{"viewport": {"width": 1280, "height": 900}} | view)
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.goto(report + address)
        pages.append(page)
        return page

    yield open_page
    for page in pages:
        page.close()
    assert wrong == []
