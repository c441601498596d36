"""Run one case, whichever its sampler; memory does not grow with the number of draws."""

import dataclasses
import importlib

from kacsim.cases import LISTS, SAMPLERS, make_case
from kacsim.checks import ALGORITHMS, ENGINES, STEPPED


def run(case, progress=None):
    """Return the samples of one case.

    Parameters
    ----------
    case : kacsim.cases.Case, already checked; of a shard only its replicates are drawn
    progress : callable(draws done), called now and then

    Returns
    -------
    dict name -> variable of kacsim.store.described, see the ``SAMPLERS`` of the case's family
    """
    home = importlib.import_module(f"kacsim.{case.family}.sampling")
    return home.SAMPLERS[case.sampler](case, progress or (lambda done: None))


def load(case):
    """Import the sampler of a case and load its compiled kernels, which `run` then need not."""
    run(dataclasses.replace(case, n_draws=2, n_replicates=1, shard=(1, 1)))


def _tiny_cases():
    """Yield a case of every sampler, algorithm and engine, as small as can be."""
    size = {"n_draws": 2, "n_replicates": 1, "seed": 0}
    for algorithm in ALGORITHMS:
        step = 0.5 if algorithm in STEPPED else None
        for engine in ENGINES:
            common = {"n_particles": 4, "time": 1.0, "time_step": step, "engine": engine}
            yield make_case("kac", algorithm=algorithm, **common, **size)
    for sampler in SAMPLERS:
        if sampler != "kac":
            probes = {"n_particles": 3, "tolerance": 0.1, "initial": "bkw"}
            lists = LISTS.get(sampler, ())
            for name in ("speed", "time", "threshold", "majorant", "radius", "oversampling"):
                probes[name] = [1.0] if name in lists else 1.0
            yield make_case(sampler, **probes, **size)


def compile_module(module):
    """Compile every kernel of a module that the samplers call, into the kernel cache.

    Parameters
    ----------
    module : one of kacsim.cases.KERNEL_MODULES
    """
    for case in _tiny_cases():
        if case.kernel_module == module:
            run(case)
