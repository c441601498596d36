"""The sampler of Maxwell molecules, declared: the algorithms of the Kac paper by another law."""

import dataclasses
import functools
from pathlib import Path

from kacsim.checks import finite, one_of, positive
from kacsim.kac import samplers as kac
from kacsim.kac import work
from kacsim.maxwell.constants import RATE
from kacsim.samplers import Parameter, Sampler, real, whole_or_infinite

OUTSIDE = "a case carries every value that its declaration sets"

# Those of Kac's model that have a module of their name here.
ALGORITHMS = tuple(
    name for name in kac.ALGORITHMS if Path(__file__).with_name(f"{name}.py").exists()
)


def at_rate(check):
    """Return a check of Kac's model for the gas, whose collision rate is no parameter."""
    return functools.partial(check, collision_rate=RATE) if check else None


# Each is the module of its name.
VARIANTS = tuple(
    dataclasses.replace(variant, check=at_rate(variant.check))
    for variant in kac.VARIANTS
    if variant.name in ALGORITHMS
)
TITLES = {name: kac.TITLES[name] for name in ALGORITHMS}


def of_velocities(parameters):
    """Return the work of one draw, that of `kacsim.kac.work`."""
    return work.of_velocities({**parameters, "collision_rate": RATE})


MAXWELL = Sampler(
    "maxwell",
    "speeds of Maxwell molecules at a time, by one algorithm of the Kac paper",
    (
        Parameter(
            "algorithm", "", ", ".join(ALGORITHMS),
            functools.partial(one_of, allowed=ALGORITHMS), shown=True,
        ),
        Parameter(
            "engine", "", "ancestral (default) or forward",
            functools.partial(one_of, allowed=kac.ENGINES), "ancestral", shown=True,
        ),
        Parameter(
            "n_particles", "n", "number of particles; inf for the ancestral poisson",
            kac.number_of_particles, kind=whole_or_infinite,
        ),
        Parameter("time", "t", "time t in mean collision times", positive, kind=real),
        Parameter(
            "keep_above", "above", "keep the first speeds above this", finite, None, kind=real
        ),
    ),
    variants=VARIANTS,
    variant_place=4,
    engines=kac.ENGINES,
    entries=lambda parameters: ("arguments", parameters["engine"]),
    check=at_rate(kac.kac),
    work=of_velocities,
    tiny=({"n_particles": 4, "time": 1.0},),
)  # fmt: skip
SAMPLERS = (MAXWELL,)
