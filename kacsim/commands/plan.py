"""Check a configuration and list its cases."""

from kacsim.commands import _shared

EXAMPLE = "plan --item kac_fig3"
OF_A_CLONE = True


def add(parser):
    """Add the options."""
    _shared.add_config(parser)
    _shared.add_item(parser)
    parser.add_argument("--ids", action="store_true", help="print the ids of the cases alone")


def run(arguments):
    """Print the cases of a configuration, as a table or their ids."""
    checked, chosen = _shared.planned(arguments)
    print("\n".join(case.id for case in chosen) if arguments.ids else checked.table(chosen))
