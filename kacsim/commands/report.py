"""Write the report from datasets and figures."""

from kacsim.commands import _shared

EXAMPLE = "report --items kac_fig4 kac_fig5 --output report.html"
OF_A_CLONE = True


def add(parser):
    """Add the options."""
    parser.add_argument("--datasets", default="results/datasets", metavar="FOLDER")
    parser.add_argument("--figures", default="results/figures", metavar="FOLDER")
    parser.add_argument("--items", nargs="+", required=True)
    parser.add_argument("--output", required=True)
    parser.add_argument("--kernels", metavar="FILE", help="of `kacsim wasm`: the page draws itself")
    parser.add_argument("--draws", metavar="FILE", help="of `kacsim wasm`, with the kernels")
    parser.add_argument("--options", default="", help="of the command on the page")


def run(arguments):
    """Write the report."""
    from kacsim.report import page

    for name in arguments.items:
        _shared.known_item(name)
    folders = arguments.datasets, arguments.figures
    own = arguments.kernels, arguments.draws
    page.write(arguments.items, *folders, arguments.output, arguments.options, *own)
