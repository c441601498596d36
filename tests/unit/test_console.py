"""The terminal of a run: one line per job, and of a failed job what is needed to go on."""

import logging

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

from kacsim.jobs import console


@pytest.fixture
def shown():
    """Return (logger, list of the lines that its terminal shows)."""
    lines = []

    class Terminal(logging.Handler):
        def emit(self, record):
            lines.append(self.format(record))

    logger = logging.Logger("snakemake-of-a-test")
    handler = Terminal()
    handler.name = "DefaultStreamHandler"
    handler.setFormatter(logging.Formatter("%(message)s"))
    logger.addHandler(handler)
    console.quieten(logger, ["more.yaml"], ["all", "kac_fig4"])
    return logger, lines


def test_one_line_per_job(shown):
    logger, lines = shown
    stats = {"draw": 2, "sample_a": 1, "all": 1, "kac_fig4": 1, "total": 5}
    logger.info("table", extra={"event": LogEvent.RUN_INFO, "stats": stats})
    for sentence in ("Drawing a", None, "Drawing b"):
        logger.info("Select jobs to execute...")
        logger.info("job", extra={"event": LogEvent.JOB_INFO, "rule_msg": sentence})
        logger.info("done", extra={"event": LogEvent.PROGRESS, "done": 1, "total": 5})
    assert lines == ["3 jobs to do", "[1/3] Drawing a", "[2/3] Drawing b"]


def test_a_failed_job_shows_the_end_of_its_log_and_how_to_repeat_it(shown, tmp_path):
    logger, lines = shown
    log = tmp_path / "job.log"
    log.write_text("\n".join(f"line {k}" for k in range(40)), encoding="utf-8")
    failed = {"rule_msg": "Reducing a", "rule_name": "reduce", "log": [str(log)]}
    logger.error("Error", extra={"event": LogEvent.JOB_ERROR, "output": ["results/a.nc"], **failed})
    (text,) = lines
    assert text.splitlines()[0] == "FAILED: Reducing a"
    assert "line 39" in text
    assert "line 29" not in text
    assert text.endswith("to repeat it: snakemake -c1 results/a.nc --configfile more.yaml")


def test_other_errors_are_shown_as_they_are(shown):
    logger, lines = shown
    logger.error("Error: Directory cannot be locked.", extra={"event": LogEvent.ERROR})
    logger.warning("a warning")
    assert lines == ["Error: Directory cannot be locked.", "a warning"]
