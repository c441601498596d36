"""Compile kernels into the kernel cache."""

from pathlib import Path

from kacsim.cases import tiny_cases

EXAMPLE = "compile kac/bird.kac.arguments.forward --output bird.txt"


def add(parser):
    """Add the options."""
    units = list(dict.fromkeys(case.unit for case in tiny_cases()))
    parser.add_argument("unit", choices=units, metavar="UNIT", help="module and what it is for")
    parser.add_argument("--output", required=True, help="file that gets the sources' hash")


def run(arguments):
    """Compile the kernels of a unit, and leave a file that says so."""
    from kacsim import files
    from kacsim.jobs import sampling
    from kacsim.kernels import sources

    sampling.compile_unit(arguments.unit)
    text = sources.code(sampling.tiny(arguments.unit).roots) + "\n"
    files.replace_file(arguments.output, lambda name: Path(name).write_text(text))
