"""Show where the time of the last run went."""

from kacsim.samplers import real

EXAMPLE = "times"


def add(parser):
    """Add the options."""
    parser.add_argument("--folder", default=".", help="where benchmarks and logs lie")
    parser.add_argument("--output", metavar="FILE", help="write a page of all jobs instead")
    add_since(parser)


def add_since(parser):
    """Add the option that leaves out what is older."""
    parser.add_argument("--since", type=real, default=0.0, help="seconds since 1970")


def run(arguments):
    """Print where the time of a run went, or write the page of it."""
    from kacsim.jobs import times

    if arguments.output:
        from kacsim.report import runtime

        runtime.write(arguments.output, arguments.folder)
    else:
        print(times.table(arguments.folder, arguments.since))
