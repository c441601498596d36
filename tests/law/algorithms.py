"""The algorithms of the Kac paper, with values for the parameters that not all of them have."""

from kacsim.kac.samplers import STEP, VARIANTS
from kacsim.samplers import REQUIRED

OWN = {variant.name: variant for variant in VARIANTS}


def own_parameters(algorithm, time, steps):
    """Return an algorithm's own parameters: a step that the time holds so many times, and others.

    Those that no test knows have the value of the declaration's tiny case, or their default.
    """
    found = {}
    for parameter in OWN[algorithm].parameters:
        if parameter is STEP:
            found[parameter.name] = time / steps
        else:
            found[parameter.name] = OWN[algorithm].tiny.get(parameter.name, parameter.default)
        assert found[parameter.name] is not REQUIRED, f"{algorithm}: no {parameter.name} to test"
    return found
