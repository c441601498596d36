"""Measure the kernels, as ratios in one run."""

EXAMPLE = "benchmark"


def add(parser):
    """Add the options."""
    parser.add_argument("--repeats", type=int, default=5, help="runs; medians count")
    parser.add_argument(
        "--floors",
        action="store_true",
        help="beside each kernel its random numbers, its memory and its functions alone",
    )
    parser.add_argument(
        "--peers", action="store_true", help="Bird's algorithm in C, plain numba and numpy"
    )


def run(arguments):
    """Print the measurements of the kernels."""
    from kacsim import benchmark

    parts = [part for part in ("floors", "peers") if getattr(arguments, part)]
    benchmark.run(parts or ["goals"], arguments.repeats)
