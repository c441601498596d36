"""Check a configuration, list its cases, and tell how long they should take."""

from kacsim.checks import count
from kacsim.commands import _shared
from kacsim.jobs import expected
from kacsim.plan import PlanError
from kacsim.samplers import whole

EXAMPLE = "plan --item kac_fig3"
OF_A_CLONE = True


def add(parser):
    """Add the options."""
    _shared.add_config(parser)
    _shared.add_item(parser)
    parser.add_argument("--ids", action="store_true", help="print the ids of the cases alone")
    parser.add_argument("--cores", type=whole, default=2, help="cores that share it (default 2)")


def run(arguments):
    """Print the cases and the items of a configuration with their times, or the cases' ids."""
    checked, chosen = _shared.planned(arguments)
    if arguments.ids:
        print("\n".join(case.id for case in chosen))
        return
    problems = list(count("--cores", arguments.cores))
    if problems:
        raise PlanError("\n".join(map(str, problems)))
    names = [arguments.item] if arguments.item else list(checked.cases_of)
    print(expected.cases_table(checked, chosen), end="\n\n")
    print(expected.items_table(checked, names), end="\n\n")
    print(expected.whole(checked, chosen, names, arguments.cores))
