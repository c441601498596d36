"""The samplers of the Boltzmann paper, declared: probes by trees, and the trap."""

import dataclasses
import functools

from kacsim.boltzmann.constants import BREATHING, COUPLING, LARGEST_PHASE, MAX_NODES
from kacsim.boltzmann.work import of_bkw, of_extinction, of_null_collisions, of_one_tree, of_trap
from kacsim.checks import (
    Problem,
    at_least,
    count,
    is_number,
    not_negative,
    one_of,
    positive,
)
from kacsim.mckean.constants import BKW
from kacsim.mckean.parameters import MCKEAN, far, mckean, tiny_of
from kacsim.mckean.work import of_trees
from kacsim.samplers import Parameter, Sampler, real, whole

OUTSIDE = "a case carries every value that its declaration sets"

LONGEST_LITERAL = 10.0  # mean collision times; plain recursion has no budget
STARTS = ("bkw", "breathing")


def grid(name, short, meaning, check=not_negative):
    """Return an axis of a grid of probes."""
    return Parameter(name, short, meaning, check, kind=real, many=True)


def quantity(name, short, meaning, check, default):
    """Return a real parameter with a default."""
    return Parameter(name, short, meaning, check, default, kind=real)


def amplitude(name, value):
    """Yield a problem unless the value is an amplitude of eq. (31), in [0, 1)."""
    if not is_number(value) or not 0 <= value < 1:
        yield Problem(name, value, "must be at least 0 and less than 1")


def slant(name, value):
    """Yield a problem unless the value keeps the density of u' positive."""
    if not is_number(value) or not -1 < value < 1:
        yield Problem(name, value, "must be greater than -1 and less than 1")


def angle(name, value):
    """Yield a problem unless the value is a phase whose sine is known."""
    if not is_number(value) or abs(value) > LARGEST_PHASE:
        yield Problem(name, value, f"must be a number of at most {LARGEST_PHASE:g} either way")


def phase(name, value):
    """Yield a problem unless the value is a phase omega t, not before the start."""
    yield from not_negative(name, value)
    if is_number(value) and value > LARGEST_PHASE:
        yield Problem(name, value, f"must be at most {LARGEST_PHASE:g} radians")


def literal_time(name, value):
    """Yield a problem unless plain recursion ends before long."""
    yield from not_negative(name, value)
    if is_number(value) and value > LONGEST_LITERAL:
        yield Problem(name, value, f"the literal algorithm takes at most {LONGEST_LITERAL:g}")


at_least_one = functools.partial(at_least, least=1.0)
ONSET = quantity(
    "onset", "from", "collisions later than this time are oversampled", not_negative, 0.0
)
BUDGET = Parameter(
    "max_nodes", "budget", "budget of nodes of one tree", count, MAX_NODES, kind=whole
)
TREE = (
    quantity(
        "oversampling", "m", "mean number of sub-estimates that replace each one",
        at_least_one, 1.0,
    ),
    ONSET,
    BUDGET,
)  # fmt: skip
TIMES = grid("time", "t", "times t, in mean collision times")
SPEEDS = grid("speed", "c", "speeds of the probes, in RMS velocities per axis")
THRESHOLDS = grid("threshold", "c", "thresholds, in RMS velocities per axis")
RADII = grid("radius", "r", "radii of the probes, in c_eq / omega")
TRAP_TIMES = grid("time", "t", "times t, in 1 / omega", phase)
LITERAL_TIMES = grid("time", "t", "times t, at most 10", literal_time)


def initial_state(*allowed, **more):
    """Return the parameter that names the state at time 0."""
    check = functools.partial(one_of, allowed=allowed)
    return Parameter("initial", "", f"state at time 0: {' or '.join(allowed)}", check, **more)


EPS = quantity("breathing", "eps", "amplitude eps of the breathing state", amplitude, BREATHING)
STRENGTH = quantity("coupling", "coupling", "n kappa omega^2 / c_eq^3", positive, COUPLING)
# The weight of c* grows without bound for a narrower law than the Maxwellian.
SAMPLING_LAWS = (
    quantity(
        "majorant_factor", "majorant", "factor on the raised collision frequency", positive, 1.0
    ),
    quantity(
        "spread", "spread", "width of the law of c* over that of the breathing state",
        at_least_one, 1.0,
    ),
    quantity(
        "anisotropy", "anisotropy", "departure of the law of u' from the isotropic one",
        slant, 0.0,
    ),
)  # fmt: skip
PHASE = quantity("start_phase", "phi", "phase phi0 of the breathing state", angle, 0.0)
INITIAL = initial_state(*STARTS, default="bkw")
TRAP = (RADII, TRAP_TIMES, INITIAL, EPS, PHASE, STRENGTH, *SAMPLING_LAWS, BUDGET)


def probing(name, draws, kernels, parameters, tiny, work=None, check=None):
    """Return the declaration of a sampler at a grid of probes: its first parameter that is a list.

    Its kernels' module has a function of the sampler's name that binds parameters to a probe.
    """
    axis = next(one.name for one in parameters if one.many and one.name != "time")
    return Sampler(
        name,
        draws,
        parameters,
        tiny if isinstance(tiny, tuple) else (tiny,),
        kernels=kernels,
        entries=lambda _: (name,),
        streaming="sample",
        check=check,
        work=work or functools.partial(of_bkw, axis=axis),
    )


def probing_ancestors(name, draws, axis):
    """Return the declaration of a sampler by McKean's trees, up to `far` speeds."""
    own = dataclasses.replace(axis, check=far)
    return probing(
        name, draws, "mckean_tree", (own, TIMES, *MCKEAN, BUDGET), tiny_of(own.name),
        functools.partial(of_trees, axis=own.name, law=BKW),
        functools.partial(mckean, axis=own.name, law=BKW, at_speed=axis is SPEEDS),
    )  # fmt: skip


def probing_trap(name, draws):
    """Return the declaration of a sampler in the trap, with all its laws."""
    tiny = {"radius": [1.0], "time": [1.0]}
    return probing(name, draws, "trap_tree", TRAP, tiny, functools.partial(of_trap, name=name))


SAMPLERS = (
    probing(
        "bkw", "estimates of f(c; t), Algorithm 2", "bkw_tree", (SPEEDS, TIMES, *TREE),
        {"speed": [1.0], "time": [1.0]},
    ),
    probing(
        "bkw_fraction", "estimates of a high-energy fraction, Algorithm 3", "bkw_tree",
        (THRESHOLDS, TIMES, *TREE), {"threshold": [1.0], "time": [1.0]},
    ),
    Sampler(
        "bkw_tree", "trees of Algorithm 1 with their branches",
        (
            Parameter(
                "speed", "c", "speed of the probe, in RMS velocities per axis", not_negative,
                kind=real,
            ),
            Parameter("time", "t", "time t, in mean collision times", not_negative, kind=real),
        ),
        ({"speed": 1.0, "time": 1.0},), kernels="literal", work=of_one_tree,
        by_replicate=False,
    ),
    probing(
        "bkw_literal", "estimates of f(c; t) by plain recursion in vectors", "literal",
        (initial_state("bkw", "equilibrium", default="bkw"), SPEEDS, LITERAL_TIMES),
        {"initial": "bkw", "speed": [1.0], "time": [1.0]},
    ),
    probing(
        "extinction", "estimates of eq. (20), Algorithm 4", "null_collisions",
        (
            grid("majorant", "nu", "raised collision frequencies over alpha f0", positive),
            grid("time", "t", "times t, in 1 / (alpha f0)"),
            BUDGET,
        ),
        {"majorant": [1.0], "time": [1.0]}, of_extinction,
    ),
    probing_trap("trap", "estimates of f(r; c; t) in the trap, Algorithms 5 and 6"),
    probing_trap("trap_fraction", "estimates of the fraction beyond a radius, Algorithm 7"),
    probing_trap("trap_energy", "estimates of the mechanical energy beyond a radius"),
    probing(
        "trap_literal", "estimates in the trap by plain recursion in vectors", "literal_trap",
        (INITIAL, RADII, LITERAL_TIMES, EPS, STRENGTH),
        {"radius": [1.0], "time": [1.0]}, functools.partial(of_trap, name="trap"),
    ),
    probing(
        "bkw_moment", "estimates of f(c; t)/M at velocities drawn from M", "bkw_tree",
        (
            TIMES,
            grid(
                "oversampling", "m", "mean numbers of sub-estimates that replace each one",
                at_least_one,
            ),
            ONSET,
            BUDGET,
        ),
        {"time": [1.0], "oversampling": [1.0]},
    ),
    probing(
        "uniform_moment",
        "estimates of f/M by Algorithm 6 in a uniform gas, at velocities drawn from M",
        "uniform_tree",
        (
            grid("majorant", "nu", "raised collision frequencies over kappa eta", positive),
            TIMES,
            BUDGET,
        ),
        {"majorant": [1.5], "time": [0.5]}, of_null_collisions,
    ),
    probing_ancestors("bkw_ancestral", "estimates of f(c; t) by McKean's trees", SPEEDS),
    probing_ancestors(
        "bkw_fraction_ancestral", "estimates of a high-energy fraction by McKean's trees",
        THRESHOLDS,
    ),
)  # fmt: skip
