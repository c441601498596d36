"""Draw one case."""

import argparse
import contextlib
import sys
import time

from kacsim.commands import _shared

EXAMPLE = (
    "sample kac --algorithm bird --n-particles 50 --time 2 --n-draws 1000000 --seed 1 "
    "--output bird.nc"
)


def add(parser):
    """Add the samplers and their options."""
    for one in _shared.add_samplers(parser):
        one.add_argument("--shard", type=shard, default=(1, 1), help="k/K: these replicates only")
        add_output(one)


def add_output(parser):
    """Add the option that names the file of samples."""
    parser.add_argument("--output", type=_file, required=True, help="file ending in .nc or .csv")


def _file(text):
    if not text.endswith((".nc", ".csv")):
        raise argparse.ArgumentTypeError(f"{text!r}: must end in .nc or .csv")
    return text


def shard(text):
    """Return k/K as two integers; whether they are a shard of the case is checked later."""
    try:
        number, total = map(int, text.split("/"))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: must be k/K, two integers") from None
    return number, total


def run(arguments):
    """Draw one case."""
    run_all([arguments])


def run_all(requests):
    """Draw cases one after the other; all are checked before the first is drawn."""
    chosen = [_shared.case_of(arguments) for arguments in requests]
    from kacsim import files
    from kacsim.jobs import sampling, times

    for arguments in requests:
        files.check_writable(arguments.output)
    for arguments, case in zip(requests, chosen, strict=True):
        sampling.load(case)
        start = time.process_time()
        with progress(case) as advance:
            variables = sampling.run(case, advance)
        print(times.drawn_sentence(case, time.process_time() - start), flush=True)
        _shared.write_sample(variables, arguments.output, case)


@contextlib.contextmanager
def progress(case):
    """Yield a callable(draws done) that shows a line on a terminal, and nothing in a log."""
    if not sys.stderr.isatty():
        yield None
        return
    import tqdm

    total = case.n_draws * len(case.replicates)
    keywords = {"unit": "draws", "unit_scale": True, "leave": False, "dynamic_ncols": True}
    with tqdm.tqdm(total=total, desc=case.id, **keywords) as line:
        yield lambda done: line.update(done - line.n)
