"""Keep the report of a full run in reports/latest."""

from kacsim import plan
from kacsim.commands import _shared, kept

EXAMPLE = "keep"
OF_A_CLONE = True


def add(parser):
    """Add the options."""
    parser.add_argument("--results", default="results", metavar="FOLDER")
    _shared.add_config(parser)
    kept.add(parser)


def run(arguments):
    """Keep the report of a full run."""
    from kacsim.report import kept

    checked = plan.Plan(plan.read_config(*arguments.config), arguments.config)
    print(kept.keep(arguments.results, checked, arguments.folder))
