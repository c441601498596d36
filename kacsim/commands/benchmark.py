"""Measure the kernels, as ratios in one run."""

from kacsim.commands import _shared

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
    parser.add_argument(
        "--fit",
        action="store_true",
        help="time small cases of every sampler, and keep what `plan` expects by them",
    )
    _shared.add_config(parser)


def run(arguments):
    """Print the measurements of the kernels, or fit the costs of cases."""
    if arguments.fit:
        from kacsim.benchmark import fitting

        checked = _shared.checked_plan(arguments)
        fitting.fit(checked.cases.values(), checked.cases_of)
        return
    from kacsim import benchmark

    parts = [part for part in ("floors", "peers") if getattr(arguments, part)]
    benchmark.run(parts or ["goals"], arguments.repeats)
