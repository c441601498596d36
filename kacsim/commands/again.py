"""Make a file again from the recipe that it carries, and compare."""

import os
import tempfile
from pathlib import Path

from kacsim import plan
from kacsim.commands import sample
from kacsim.samplers import whole

EXAMPLE = "again kac_fig3.png --check"
OF_A_CLONE = True
DIFFERENT = 1  # exit status where bits differ


def add(parser):
    """Add the options."""
    parser.add_argument(
        "file", help="samples or a dataset (nc), a figure (svg, png, pdf), a table (csv) or a "
        "report (html)"
    )  # fmt: skip
    parser.add_argument("--check", action="store_true", help="compare only, leave no new file")
    parser.add_argument(
        "--output", metavar="FOLDER", default="again", help="of the new file (default again)"
    )
    parser.add_argument("--cores", type=whole, default=2, help="jobs at a time (default 2)")


def run(arguments):
    """Make the file again and compare; return 1 if bits differ and only a check was wanted."""
    if not (isinstance(arguments.cores, int) and arguments.cores >= 1):
        raise plan.PlanError(f"--cores = {arguments.cores!r}: must be an integer, at least 1")
    from kacsim import files
    from kacsim.again import comparing, making, reading

    order = reading.read(arguments.file)
    with tempfile.TemporaryDirectory(prefix="kacsim-") as scratch:
        folder = Path(scratch, "again") if arguments.check else Path(arguments.output)
        output = folder / order.path.name
        if output.exists() and os.path.samefile(output, order.path):
            raise plan.PlanError(f"--output = {arguments.output!r}: is where the file itself lies")
        files.check_writable(output)
        print(f"{order.path}: {order.recipe.source}", flush=True)
        print(f"about {order.seconds():.3g} s in kernels", flush=True)
        for line in reading.differences(order):
            print(line, flush=True)
        if order.case:
            with sample.progress(order.case) as advance:
                making.make(order, output, scratch, arguments.cores, advance)
        else:
            making.make(order, output, scratch, arguments.cores)
        found = comparing.differences(order.path, output)
    for line in found or ["bits: the same, apart from what says how the file was made"]:
        print(line)
    if not arguments.check:
        print(f"{output}: written")
    return DIFFERENT if found and arguments.check else 0
