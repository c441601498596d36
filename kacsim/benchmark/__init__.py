"""Measure the kernels, as ratios in one run: speeds with their goals, floors, and peers."""

import importlib


def standard_works():
    """Return name -> `kacsim.benchmark.work.Work` with the constants of the papers."""
    from kacsim.benchmark.work import works
    from kacsim.boltzmann.constants import BREATHING
    from kacsim.kac.constants import MEAN_ENERGY, RATE

    return works(RATE, MEAN_ENERGY, BREATHING)


def run(parts, repeats):
    """Print what was measured.

    Parameters
    ----------
    parts : some of "goals", "floors", "peers"
    repeats : int, of which medians are taken
    """
    from kacsim.benchmark.timing import processor
    from kacsim.kernels.provenance import versions

    print(f"machine: {processor()}; {versions()}; medians of {repeats}")
    for part in parts:
        importlib.import_module(f"{__name__}.{part}").run(repeats)
