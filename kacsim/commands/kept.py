"""Say which kernels have changed since the kept report."""

EXAMPLE = "kept"
OF_A_CLONE = True


def add(parser):
    """Add the options."""
    parser.add_argument("--folder", default="reports/latest", help="where the report is kept")


def run(arguments):
    """Say which kernels have changed since."""
    from kacsim.report import kept

    print(kept.sentence(arguments.folder))
