"""Run one case, whichever its sampler; memory does not grow with the number of draws."""

from kacsim.cases import tiny_cases
from kacsim.kernels.lookup import named


def run(case, progress=None):
    """Return the samples of one case.

    Parameters
    ----------
    case : kacsim.cases.Case, already checked; of a shard only its replicates are drawn
    progress : callable(draws done), called now and then

    Returns
    -------
    dict name -> variable of kacsim.store.described, see ``sample_*`` in the family's ``sampling``
    """
    (module, function), *_ = case.roots
    package, module = module.rsplit(".", 1)
    return named(package, module, function)(case, progress or (lambda done: None))


def tiny(unit):
    """Return the smallest case that runs the kernels of a unit (`kacsim.cases.Case.unit`)."""
    return next(case for case in tiny_cases() if case.unit == unit)


def load(case):
    """Import the sampler of a case and load its compiled kernels, which `run` then need not."""
    run(tiny(case.unit))


def compile_unit(unit):
    """Compile the kernels of a unit into the kernel cache.

    Parameters
    ----------
    unit : of `kacsim.cases.Case.unit`
    """
    run(tiny(unit))
