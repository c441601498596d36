"""Run one case, whichever its sampler; memory does not grow with the number of draws."""

import importlib

from kacsim.cases import make_case
from kacsim.checks import ALGORITHMS, ENGINES, STEPPED
from kacsim.samplers import LISTS, SAMPLERS


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


GAS = {"density": 1.0, "temperature": 1.0, "drift": [0.1, 0.0, 0.0], "half_width": [1.0] * 3}
# Samplers of the chapter -> the smallest parameters of each, several where kernels differ.
TINY = {
    "inverse_transform": [{"law": "ramp", "n_table": [2]}],
    "inversion": [{"law": "ramp", "rate": 1.0}],
    "rejection": [{"law": "ramp", "envelope": "constant"}],
    "identity": [{}],
    "injection": [GAS | {"step": 0.1}],
    "outer_gas": [GAS | {"step": 0.1}],
    "weighted_particles": [{"n_representatives": 50, "temperature": 1.0, "drift": [0.0] * 3}],
    "sphere_lattice": [{"dimension": [2], "edge": [2]}],
    "sphere_points": [
        {"generator": name, "dimension": [2], "n_points": [2]}
        for name in ("good", "exhausted", "congruential")
    ],
    "area": [{"exponent": 0.3, "n_points": [2]}],
}


def _tiny_techniques(size):
    """Yield the smallest cases of the chapter's samplers."""
    for sampler, choices in TINY.items():
        for parameters in choices:
            yield make_case(sampler, **parameters, **size)


def _words(case):
    """Return the parameters that choose between kernels."""
    return {name: value for name, value in case.parameters.items() if isinstance(value, str)}


def load(case):
    """Import the sampler of a case and load its compiled kernels, which `run` then need not."""
    words = _words(case)
    same = [tiny for tiny in _tiny_cases() if tiny.sampler == case.sampler]
    run(max(same, key=lambda tiny: len(words.items() & _words(tiny).items())))


def _tiny_cases():
    """Yield a case of every sampler, algorithm and engine, as small as can be."""
    size = {"n_draws": 2, "n_replicates": 1, "seed": 0}
    for algorithm in ALGORITHMS:
        step = 0.5 if algorithm in STEPPED else None
        for engine in ENGINES:
            common = {"n_particles": 4, "time": 1.0, "time_step": step, "engine": engine}
            yield make_case("kac", algorithm=algorithm, **common, **size)
    yield from _tiny_techniques(size)
    for sampler in SAMPLERS:
        if sampler != "kac" and sampler not in TINY:
            probes = {"n_particles": 3, "tolerance": 0.1, "initial": "bkw"}
            lists = LISTS.get(sampler, ())
            for name in ("speed", "time", "threshold", "majorant", "radius", "oversampling"):
                probes[name] = [1.0] if name in lists else 1.0
            yield make_case(sampler, **probes, **size)


def compile_module(module):
    """Compile every kernel of a module that the samplers call, into the kernel cache.

    Parameters
    ----------
    module : one of kacsim.samplers.KERNEL_MODULES
    """
    for case in _tiny_cases():
        if case.kernel_module == module:
            run(case)
