"""The samplers of the Kac paper, declared: algorithms, parameters, checks and costs."""

import dataclasses
import functools
import math

from kacsim.boltzmann.samplers import BUDGET, TREE, grid
from kacsim.boltzmann.work import of_kac
from kacsim.checks import Problem, count, finite, not_negative, one_of, positive
from kacsim.kac import equilibrium_samplers, own_tables, work
from kacsim.kac.constants import RATE, n_steps
from kacsim.kernels import names
from kacsim.mckean import work as trees
from kacsim.mckean.constants import KAC as KAC_LAW
from kacsim.mckean.parameters import MCKEAN, far, mckean, tiny_of
from kacsim.samplers import (
    Parameter,
    Sampler,
    Variant,
    real,
    whole_or_infinite,
)

OUTSIDE = "a case carries every value that its declaration sets"

ENGINES = ("ancestral", "forward")
LARGEST_ANCESTRY = 1e6  # mean number of ancestors; memory grows with the largest of them
LARGEST_ENSEMBLE = {"forward": 10**8, "ancestral": 10**15}  # a forward one lies in memory


def step_problems(algorithm, time, time_step, collision_rate):
    """Yield the problems of a time step, which must divide the time."""
    if n_steps(time, time_step) is None:
        yield Problem("time_step", time_step, f"must divide time = {time!r} evenly")
    if collision_rate * time_step > 1:
        product = f"({collision_rate:.4g} * {time_step!r} = {collision_rate * time_step:.4g})"
        sentence = f"{algorithm} needs collision_rate * time_step <= 1 {product}"
        yield Problem("time_step", time_step, sentence)


def nanbu(*, time, time_step, collision_rate, **_):
    """Yield the problems of Nanbu's algorithm."""
    yield from step_problems("Nanbu", time, time_step, collision_rate)


def nanbu_babovsky(*, n_particles, time, time_step, collision_rate, **_):
    """Yield the problems of Nanbu and Babovsky's algorithm: enough particles for its pairs."""
    found = list(step_problems("Nanbu-Babovsky", time, time_step, collision_rate))
    yield from found
    pairs = math.ceil(collision_rate * n_particles * time_step / 2)
    if not found and 2 * pairs > n_particles:
        sentence = f"{pairs} disjoint pairs may be needed of {n_particles} particles"
        yield Problem("time_step", time_step, f"{sentence}; at most n_particles / 2 exist")


STEP = Parameter(
    "time_step", "dt", "time step of the algorithms of Nanbu and of Nanbu and Babovsky", positive,
    kind=real,
)  # fmt: skip
# The algorithms: each is the module of its name. Its parameters stand after the time in ids.
VARIANTS = (
    Variant("nanbu_sequential", "Nanbu (sequential)", (STEP,), nanbu, {"time_step": 0.5}),
    Variant("nanbu_synchronous", "Nanbu (synchronous)", (STEP,), nanbu, {"time_step": 0.5}),
    Variant("nanbu_babovsky", "Nanbu–Babovsky", (STEP,), nanbu_babovsky, {"time_step": 0.5}),
    Variant("bird", "Bird"),
    Variant("poisson", "Poisson (exact)"),
    Variant("poisson_printed", "Poisson (printed rate)"),
)
ALGORITHMS = tuple(algorithm.name for algorithm in VARIANTS)
TITLES = {algorithm.name: algorithm.title for algorithm in VARIANTS}
STEPPED = tuple(algorithm.name for algorithm in VARIANTS if STEP in algorithm.parameters)
# The page of the report draws by those whose own parameters are at most a step.
ON_PAGE = tuple(algorithm.name for algorithm in VARIANTS if set(algorithm.parameters) <= {STEP})
LAWS = ("initial", "scattering")
TABLES = "own_drawn", "tables"  # what makes tables of them
HOW_TO_DRAW = ("engine", "keep_above", *LAWS)  # no parameters of an exact moment


def number_of_particles(name, value):
    """Yield a problem unless the value is an integer from 2 on, or infinite."""
    if value != math.inf:
        yield from count(name, value, least=2)


def is_own(parameters):
    """Tell whether a case has an initial law or a law of the angle that is not the paper's."""
    return any(parameters.get(name) is not None for name in LAWS)


def entry(parameters):
    """Return the name of the kernel that draws a case."""
    return f"own_{parameters['engine']}" if is_own(parameters) else parameters["engine"]


def takes_own_laws(algorithm):
    """Tell whether the module of an algorithm has kernels for `kacsim.kac.own_law`."""
    return all(names.binds(f"kacsim.kac.{algorithm}", f"own_{engine}") for engine in ENGINES)


def own_law_problems(algorithm, initial, scattering):
    """Yield a problem if an algorithm draws by the paper's laws only."""
    for name, value in zip(LAWS, (initial, scattering), strict=True):
        if value is not None and not takes_own_laws(algorithm):
            able = ", ".join(filter(takes_own_laws, ALGORITHMS))
            yield Problem(name, value, f"needs one of {able}")


def kac(*, algorithm, engine, n_particles, time, collision_rate, **laws):
    """Yield the problems of a draw of v_1 at time t (Kac paper, section 4)."""
    yield from own_law_problems(algorithm, *map(laws.get, LAWS))
    if n_particles == math.inf:
        if algorithm != "poisson" or engine != "ancestral":
            yield Problem("n_particles", n_particles, "infinity needs ancestral poisson")
            return
    elif n_particles > (most := LARGEST_ENSEMBLE[engine]):
        sentence = f"must be at most {most} for {engine} {algorithm}"
        yield Problem("n_particles", n_particles, sentence)
    followed = min(n_particles, math.exp(min(700.0, collision_rate * time)))
    if engine == "ancestral" and followed > LARGEST_ANCESTRY:
        yield Problem(
            "time",
            time,
            f"must be earlier: about {followed:.0e} ancestors, more than {LARGEST_ANCESTRY:.0e}",
        )


def moment_problems(algorithm, time, n_particles, collision_rate, **own):
    """Yield the problems of an exact fourth moment; `own` are the algorithm's own parameters."""
    found = [
        *one_of("algorithm", algorithm, ALGORITHMS),
        *positive("collision_rate", collision_rate),
    ]
    found += number_of_particles("n_particles", n_particles)
    if time != math.inf:
        found += not_negative("time", time)
    elif algorithm != "poisson":
        found.append(Problem("time", time, "infinity needs poisson"))
    yield from found
    if found or n_particles == math.inf or time in (0, math.inf):
        return
    variant = next(variant for variant in VARIANTS if variant.name == algorithm)
    wrong = [problem for one in variant.parameters for problem in one.problems(own[one.name])]
    yield from wrong
    if variant.check and not wrong:
        common = {"n_particles": n_particles, "time": time, "collision_rate": collision_rate}
        yield from variant.check(**common, **own)


def own_parameters(algorithm, given):
    """Return the parameters that not every algorithm has, with defaults for those not given.

    Raises
    ------
    ValueError
        Names a parameter that the algorithm does not have.
    """
    common = tuple(one for one in KAC.parameters if one.name not in HOW_TO_DRAW)
    taken = dataclasses.replace(KAC, parameters=common, variant_place=len(common))
    complete = taken.complete({"algorithm": algorithm, **given})
    shared = {one.name for one in common}
    return {name: value for name, value in complete.items() if name not in shared}


TIME = Parameter("time", "t", "time t of the Kac paper", positive, kind=real)
COLLISION_RATE = Parameter(
    "collision_rate", "rate", "collisions of one particle per time, sqrt(pi)/2 in the paper",
    positive, RATE, kind=real,
)  # fmt: skip


def law(name, meaning, names, angles=False):
    """Return a parameter that is a law: one of some names, or the file of a density."""
    words = ", ".join(names[1:])
    settle = functools.partial(own_tables.settled, names=names, angles=angles)
    return Parameter(
        name, f"{name}-", f"{meaning}: {names[0]} (default), {words}, or a file: x,density",
        functools.partial(own_tables.problems, names=names, angles=angles), None,
        settle=settle, token=own_tables.token,
    )  # fmt: skip


KAC = Sampler(
    "kac",
    "v_1 at a time, by one algorithm of the Kac paper",
    (
        Parameter(
            "algorithm", "", ", ".join(ALGORITHMS),
            functools.partial(one_of, allowed=ALGORITHMS), shown=True,
        ),
        Parameter(
            "engine", "", "ancestral (default) or forward",
            functools.partial(one_of, allowed=ENGINES), "ancestral", shown=True,
        ),
        Parameter(
            "n_particles", "n", "number of particles; inf for the ancestral poisson",
            number_of_particles, kind=whole_or_infinite,
        ),
        TIME,
        COLLISION_RATE,
        Parameter(
            "keep_above", "above", "keep the first values of v_1 above this", finite, None,
            kind=real,
        ),
        law("initial", "law of the velocities at time 0", own_tables.INITIALS),
        law("scattering", "law of the scattering angle", own_tables.SCATTERINGS, angles=True),
    ),
    variants=VARIANTS,
    variant_place=4,
    engines=ENGINES,
    entries=lambda parameters: ("arguments", entry(parameters)),
    beside=lambda parameters: (TABLES,) if is_own(parameters) else (),
    check=kac,
    work=work.of_velocities,
    tiny=(
        {"n_particles": 4, "time": 1.0},
        {"n_particles": 4, "time": 1.0, "initial": "two_peaks", "scattering": "forward"},
    ),
)  # fmt: skip
PROBE_TIMES = grid("time", "t", "times t of the Kac paper")
PROBE = Sampler(
    "kac_probe",
    "estimates of f(v, t) of the Kac equation",
    (
        grid("speed", "v", "speeds of the probes |v|, in the unit of the paper"),
        PROBE_TIMES,
        COLLISION_RATE,
        *TREE,
    ),
    kernels="probe_tree",
    entries=lambda parameters: ("kac_probe",),
    work=of_kac,
    tiny=({"speed": [1.0], "time": [1.0]},),
)


def ancestors(name, draws, axis):
    """Return the declaration of a sampler by McKean's trees, up to `far` speeds."""
    return Sampler(
        name,
        draws,
        (axis, PROBE_TIMES, COLLISION_RATE, *MCKEAN, BUDGET),
        tiny_of(axis.name),
        kernels="mckean_tree",
        entries=lambda _: (name,),
        streaming="sample_kac_probe",
        check=functools.partial(mckean, axis=axis.name, law=KAC_LAW),
        work=functools.partial(trees.of_trees, axis=axis.name, law=KAC_LAW),
    )


ANCESTORS = (
    ancestors(
        "kac_ancestral", "estimates of f(v, t) of the Kac equation by McKean's trees",
        grid("speed", "v", "speeds of the probes |v|, in the unit of the paper", far),
    ),
    ancestors(
        "kac_tail_ancestral", "estimates of P(v_1 > v) of the Kac equation by McKean's trees",
        grid("threshold", "v", "thresholds v, in the unit of the paper", far),
    ),
)  # fmt: skip
SAMPLERS = (KAC, *equilibrium_samplers.SAMPLERS, PROBE, *ANCESTORS)
