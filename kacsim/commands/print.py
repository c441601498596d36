"""Print the report to PDF, by Chromium."""

EXAMPLE = "print"


def add(parser):
    """Add the options."""
    parser.add_argument("--report", default="results/report/report.html", metavar="FILE")
    parser.add_argument("--output", default="results/report/report.pdf", metavar="FILE")


def run(arguments):
    """Print the report."""
    from kacsim.report import printing

    printing.write(arguments.report, arguments.output)
