"""Show where the report is and how many verdicts stand."""

from pathlib import Path

from kacsim.commands import times

EXAMPLE = "summary"


def add(parser):
    """Add the options."""
    parser.add_argument("--report", default="results/report/report.html", metavar="FILE")
    parser.add_argument("--datasets", default="results/datasets", metavar="FOLDER")
    times.add_since(parser)


def run(arguments):
    """Print where the report is and how many verdicts stand, if it is newer than a time."""
    report = Path(arguments.report)
    if not report.exists() or report.stat().st_mtime < arguments.since:
        return
    from kacsim import store
    from kacsim.statistics.verdict import VERDICTS

    words, checks = [], 0
    for path in sorted(Path(arguments.datasets).glob("*_numbers.nc")):
        table = store.read(path)
        published = table.kind.values != "check"
        words += list(table.verdict.values[published])
        checks += int((~published).sum())
    counts = {word: words.count(word) for word in VERDICTS if word in words}
    shown = ", ".join(f"{number} {word}" for word, number in counts.items())
    print(f"{report}: of {len(words)} published results {shown}; {checks} checks of our own apart")
