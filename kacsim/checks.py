"""What each sampler accepts: one light table of parameters and one sentence per violation.

Nothing heavy is imported here: the plan, the command line and the Python interface all check
with these functions, so that a wrong value is refused before any work starts.
"""

import math
import numbers
from dataclasses import dataclass

RATE = math.sqrt(math.pi) / 2
MEAN_ENERGY = 1.5  # E[v**2] under f0, per particle
STEPPED = ("nanbu_sequential", "nanbu_synchronous", "nanbu_babovsky")
CONTINUOUS = ("bird", "poisson", "poisson_printed")
ALGORITHMS = STEPPED + CONTINUOUS
NAMES = {
    "nanbu_sequential": "Nanbu (sequential)",
    "nanbu_synchronous": "Nanbu (synchronous)",
    "nanbu_babovsky": "Nanbu–Babovsky",
    "bird": "Bird",
    "poisson": "Poisson (exact)",
    "poisson_printed": "Poisson (printed rate)",
    "endless": "Poisson, N = ∞",
}
ENGINES = ("ancestral", "forward")
RELATIVE_TOLERANCE = 1e-13  # below this times sqrt(energy) rounding decides when corners meet

LARGEST_COUNT = 2**63 - 1  # of draws, points and the like; seeds may be larger
LARGEST = 1e50  # of any parameter: its products stay within double precision
LARGEST_ANCESTRY = 1e6  # mean number of ancestors; memory grows with the largest of them
MAX_NODES = 10_000_000  # budget of one tree of the Boltzmann paper
BREATHING = 9.0 / 41.0  # eps of section V


class BudgetError(RuntimeError):
    """A realization whose tree has grown past the budget of nodes."""


@dataclass(frozen=True)
class Problem:
    """A wrong value: ``name = value: sentence``."""

    name: str
    value: object
    allowed: str

    def __str__(self):
        return f"{self.name} = {self.value!r}: {self.allowed}"


def raise_problems(problems):
    """Raise ValueError with the first problem, if there is one."""
    for problem in problems:
        raise ValueError(str(problem))


def _is_number(value):
    """Tell a real number that arithmetic in double precision can stand; nan and inf are none."""
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        return False
    try:
        return abs(float(value)) < LARGEST
    except OverflowError:
        return False


def _is_integer(value):
    return isinstance(value, numbers.Integral) and not isinstance(value, bool)


def positive(name, value):
    """Yield a problem unless the value is a positive finite number."""
    if not _is_number(value) or value < 1.0 / LARGEST:
        yield Problem(name, value, "must be a positive finite number")


def finite(name, value):
    """Yield a problem unless the value is a finite number."""
    if not _is_number(value):
        yield Problem(name, value, "must be a finite number")


def at_least(name, value, least):
    """Yield a problem unless the value is a finite number of at least `least`."""
    if not _is_number(value) or value < least:
        yield Problem(name, value, f"must be a finite number of at least {least:g}")


def not_negative(name, value):
    """Yield a problem unless the value is a finite number, zero or positive."""
    yield from at_least(name, value, 0)


def count(name, value, least=1):
    """Yield a problem unless the value is an integer of at least `least`."""
    if not _is_integer(value) or value < least:
        yield Problem(name, value, f"must be an integer of at least {least}")
    elif value > LARGEST_COUNT and name != "seed":
        yield Problem(name, value, f"must be at most {LARGEST_COUNT}")


def one_of(name, value, allowed):
    """Yield a problem unless the value is one of the allowed words."""
    if value not in allowed:
        yield Problem(name, value, f"must be one of {', '.join(allowed)}")


def n_steps(time, time_step):
    """Return time / time_step as an integer, None if the step does not divide the time."""
    ratio = time / time_step
    steps = round(ratio) if ratio < 2**53 else 0
    return steps if steps >= 1 and math.isclose(ratio, steps, rel_tol=1e-9) else None


def kac(
    *,
    algorithm,
    engine,
    n_particles,
    time,
    time_step=None,
    collision_rate=RATE,
    keep_above=None,
):
    """Yield the problems of a draw of v_1 at time t (Kac paper, section 4)."""
    before = [
        *([] if keep_above is None else finite("keep_above", keep_above)),
        *one_of("algorithm", algorithm, ALGORITHMS),
        *one_of("engine", engine, ENGINES),
        *positive("time", time),
        *positive("collision_rate", collision_rate),
    ]
    yield from before
    if before:
        return
    if n_particles == math.inf:
        if algorithm != "poisson" or engine != "ancestral":
            yield Problem("n_particles", n_particles, "infinity needs ancestral poisson")
            return
    else:
        wrong = list(particles(n_particles, algorithm, engine))
        yield from wrong
        if wrong:
            return
    followed = min(n_particles, math.exp(min(700.0, collision_rate * time)))
    if engine == "ancestral" and followed > LARGEST_ANCESTRY:
        yield Problem(
            "time",
            time,
            f"must be earlier: about {followed:.0e} ancestors, more than {LARGEST_ANCESTRY:.0e}",
        )
        return
    if algorithm in STEPPED:
        yield from _stepped(algorithm, n_particles, time, time_step, collision_rate)
    elif time_step is not None:
        yield Problem("time_step", time_step, f"{algorithm} has no time step")


def particles(n_particles, algorithm, engine):
    """Yield the problems of a finite number of particles."""
    yield from count("n_particles", n_particles, least=2)
    labelled = algorithm in STEPPED or engine == "forward"
    most = 10**8 if labelled else 10**15
    if _is_integer(n_particles) and n_particles > most:
        yield Problem(
            "n_particles", n_particles, f"must be at most {most} for {engine} {algorithm}"
        )


def moment(algorithm, time, n_particles, time_step, collision_rate):
    """Yield the problems of an exact fourth moment."""
    yield from one_of("algorithm", algorithm, ALGORITHMS)
    yield from positive("collision_rate", collision_rate)
    if time == math.inf:
        if algorithm != "poisson":
            yield Problem("time", time, "infinity needs poisson")
    else:
        yield from not_negative("time", time)
    if n_particles != math.inf:
        wrong = list(count("n_particles", n_particles, least=2))
        yield from wrong
        if not wrong and algorithm in STEPPED and _is_number(time) and time > 0:
            yield from _stepped(algorithm, n_particles, time, time_step, collision_rate)


def _stepped(algorithm, n_particles, time, time_step, rate):
    wrong = list(positive("time_step", time_step))
    yield from wrong
    if wrong:
        return
    if n_steps(time, time_step) is None:
        yield Problem("time_step", time_step, f"must divide time = {time!r} evenly")
    product = f"({rate:.4g} * {time_step!r} = {rate * time_step:.4g})"
    if rate * time_step > 1:
        family = "Nanbu-Babovsky" if algorithm == "nanbu_babovsky" else "Nanbu"
        yield Problem(
            "time_step", time_step, f"{family} needs collision_rate * time_step <= 1 {product}"
        )
    elif algorithm == "nanbu_babovsky":
        pairs = math.ceil(rate * n_particles * time_step / 2)
        if 2 * pairs > n_particles:
            sentence = f"{pairs} disjoint pairs may be needed of {n_particles} particles"
            yield Problem("time_step", time_step, f"{sentence}; at most n_particles / 2 exist")


def kac_equilibrium(*, n_particles, tolerance, energy=None, **_):
    """Yield the problems of an epsilon-perfect draw (Kac paper, section 5)."""
    wrong = [*count("n_particles", n_particles, least=2), *positive("tolerance", tolerance)]
    if energy is not None:
        wrong += positive("energy", energy)
    yield from wrong
    if wrong:
        return
    radius = math.sqrt(MEAN_ENERGY * n_particles if energy is None else energy)
    least = RELATIVE_TOLERANCE * radius
    if tolerance < least:
        sentence = f"double precision resolves distances of at least {least:.1e} on this sphere"
        yield Problem("tolerance", tolerance, sentence)


def kac_corners(*, n_particles, tolerance, **_):
    """Yield the problems of a recorded run of the corner points."""
    yield from kac_equilibrium(n_particles=n_particles, tolerance=tolerance)


def amount(*, n_draws, n_replicates, seed, **_):
    """Yield the problems of the size and the seed of a case."""
    yield from count("n_draws", n_draws)
    yield from count("n_replicates", n_replicates)
    yield from count("seed", seed, least=0)
