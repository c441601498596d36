"""The terminal of a run: one line per job, and of a failed job what is needed to go on."""

import logging
import re

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

from kacsim import plan
from kacsim.jobs import console, remaining
from kacsim.kernels.provenance import ROOT


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
    left = remaining.Remaining({"draw": 40.0, "sample_a": 120.0}, 2, lambda: 0.0)
    console.quieten(logger, ["more.yaml"], ["all", "kac_fig4"], left)
    return logger, lines


def test_one_line_per_job(shown):
    logger, lines = shown
    stats = {"draw": 2, "sample_a": 1, "all": 1, "kac_fig4": 1, "total": 5}
    logger.info("table", extra={"event": LogEvent.RUN_INFO, "stats": stats})
    for k, sentence in enumerate(("Drawing a", None, "Drawing b")):
        about = {"rule_msg": sentence, "jobid": k, "rule_name": "draw"}
        logger.info("Select jobs to execute...")
        logger.info("job", extra={"event": LogEvent.JOB_INFO} | about)
        logger.info("done", extra={"event": LogEvent.PROGRESS, "done": 1, "total": 5})
    assert lines == [
        "3 jobs to do",
        "[1/3] about 2 min left: Drawing a",
        "[2/3] about 2 min left: Drawing b",
    ]


def test_the_time_left_follows_the_machine():
    """100 s of jobs on two cores are 50 s; where 40 s of them took 60 s, the rest takes 90 s."""
    now = [0.0]
    left = remaining.Remaining({"a": 40.0, "b": 30.0, "c": 0.5}, 2, lambda: now[0])
    left.plan({"a": 1, "b": 2})
    assert left.seconds() == pytest.approx(50.0)
    assert left.text() == "about 50 s left"
    for job, rule in enumerate(("a", "b")):
        left.start(job, rule)
    assert left.seconds() == pytest.approx(50.0)
    now[0] = 60.0
    left.finish(0)
    assert left.seconds() == pytest.approx(90.0)
    assert left.text() == "about 2 min left"
    left.finish(0)  # told twice
    left.finish(9)  # of no job that was told
    assert left.seconds() == pytest.approx(90.0)
    now[0] = 75.0
    left.finish(1)
    left.start(2, "unknown")
    assert left.seconds() == pytest.approx(30.0 * 75.0 / 70.0)
    left.start(3, "b")
    left.finish(3)
    assert left.text() == "a few s left"


def test_every_rule_has_an_expected_time():
    """Of the smoke run's plan: its batches, and what the workflow has beside them."""
    checked = plan.Plan(plan.read_config(ROOT / "config/config.yaml", ROOT / "config/smoke.yaml"))
    known = remaining.weights(checked)
    assert {f"sample_{batch.id}" for batch in checked.batches} <= known.keys()
    rules = re.findall(
        r"^rule (\w+):",
        "".join(path.read_text() for path in (ROOT / "workflow/rules").glob("*.smk")),
        re.MULTILINE,
    )
    assert set(rules) - {"shard", "merge"} <= known.keys()
    assert all(seconds > 0.0 for seconds in known.values())


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
