"""Pack a finished run as an RO-Crate for an archive."""

EXAMPLE = "crate --output kacsim-run.zip"
OF_A_CLONE = True


def add(parser):
    """Add the options."""
    parser.add_argument("--results", default="results", metavar="FOLDER", help="of a finished run")
    parser.add_argument("--samples", action="store_true", help="with the samples, too")
    parser.add_argument("--output", required=True, metavar="FILE", help="zip file to write")


def run(arguments):
    """Write the crate."""
    from kacsim import files
    from kacsim.report import crate

    files.check_writable(arguments.output)
    number = crate.write(arguments.results, arguments.output, arguments.samples)
    print(f"{arguments.output}: {number} files of {arguments.results}")
