"""Measure the kernels, as ratios in one run."""

EXAMPLE = "benchmark"


def add(parser):
    """Add the options."""
    parser.add_argument("--repeats", type=int, default=5, help="runs; medians count")


def run(arguments):
    """Print the measurements of the kernels."""
    from kacsim.jobs import benchmark

    benchmark.run(arguments.repeats)
