"""What a run of the workflow shows: one line per job, and of a failed job what is needed."""

import logging
from pathlib import Path

from snakemake_interface_logger_plugins.common import LogEvent

LAST_LINES = 10  # of a failed job's log
HIDDEN = {LogEvent.WORKFLOW_STARTED, LogEvent.RESOURCES_INFO, LogEvent.PROGRESS}
HIDDEN |= {LogEvent.JOB_FINISHED, LogEvent.JOB_STARTED, LogEvent.SHELLCMD}
CHATTER = ("Select jobs to execute", "Execute ", "Building DAG", "Using shell", "Complete log")
CHATTER += ("Elapsed time", "Assuming unrestricted", "Using workflow specific profile")
CHATTER += ("RuleException",)  # the whole shell command; the failed job's lines say more


def quieten(logger, config_files, targets, remaining):
    """Let the terminal of a real run show one line per job; the log file keeps everything.

    Parameters
    ----------
    logger : logging.Logger of Snakemake
    config_files : list of str, given on the command line; part of the command that repeats a job
    targets : names of the rules that only stand for files
    remaining : kacsim.jobs.remaining.Remaining
    """
    for handler in logger.handlers:
        if handler.name == "DefaultStreamHandler":
            handler.setFormatter(OneLine(handler.formatter, config_files, set(targets), remaining))
            handler.addFilter(lambda record: _is_wanted(record, remaining))


def _is_wanted(record, remaining):
    event = getattr(record, "event", None)
    if event is LogEvent.JOB_FINISHED:
        remaining.finish(record.job_id)
    if event in HIDDEN:
        return False
    if event is LogEvent.JOB_INFO:
        return bool(record.rule_msg)  # a target without a sentence does nothing
    return not record.getMessage().strip().startswith(CHATTER)


class OneLine(logging.Formatter):
    """Formatter of job lines; everything else is left to Snakemake's own.

    Parameters
    ----------
    other : logging.Formatter
    config_files, targets, remaining : as `quieten`
    """

    def __init__(self, other, config_files, targets, remaining):
        super().__init__()
        self.remaining = remaining
        self.other, self.config_files, self.targets = other, config_files, targets
        self.started = self.total = 0

    def format(self, record):
        """Return the lines of a record."""
        event = getattr(record, "event", None)
        if event is LogEvent.RUN_INFO:
            counted = set(record.stats) - {"total"} - self.targets
            self.total = sum(int(record.stats[rule]) for rule in counted)
            self.remaining.plan({rule: record.stats[rule] for rule in counted})
            return f"{self.total} jobs to do"
        if event is LogEvent.JOB_INFO:
            self.started += 1
            self.remaining.start(record.jobid, record.rule_name)
            return f"[{self.started}/{self.total}] {self.remaining.text()}: {record.rule_msg}"
        if event is LogEvent.JOB_ERROR:
            return self._failure(record)
        return self.other.format(record)

    def _failure(self, record):
        lines = [f"FAILED: {record.rule_msg or f'rule {record.rule_name}'}"]
        for log in record.log or ():
            lines.append(f"  the last lines of {log}:")
            path = Path(log)
            text = path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""
            lines += [f"    {line}" for line in text.splitlines()[-LAST_LINES:]]
        if record.output:
            words = ["snakemake", "-c1", str(record.output[0])]
            words += ["--configfile", *self.config_files] if self.config_files else []
            lines.append(f"  to repeat it: {' '.join(words)}")
        return "\n".join(lines)
