"""What the items on Maxwell molecules share: the gas, and cases against N and the time step."""

from kacsim.items import _kac
from kacsim.items._lazy import maxwell
from kacsim.kac.samplers import STEPPED
from kacsim.maxwell.samplers import ALGORITHMS

MAXWELL = _kac.Gas(
    "maxwell",
    lambda speed, time: maxwell.cumulative(speed, time),
    lambda time, **process: maxwell.fourth_moment(time, **process),
    3.0,
)
DASHES = (("-", "solid"), ("--", "dashed"), ("-.", "dash-dotted"))  # of lines at some N


def case(settings, algorithm, n_particles, time_step=None, **others):
    """Return the case of one algorithm with the item's time, engine and size."""
    return _kac.velocity_case(settings, algorithm, n_particles, time_step, gas=MAXWELL, **others)


def particle_grid(settings):
    """Return place -> case: every algorithm at every N, those with a step at one."""
    return {
        (a, n): case(settings, algorithm, n_particles, settings["fixed_time_step"])
        for a, algorithm in enumerate(ALGORITHMS)
        for n, n_particles in enumerate(settings["n_particles"])
    }


def step_grid(settings):
    """Return place -> case: the algorithms with a step at each of them, at some N."""
    return {
        (a, n, s): case(settings, algorithm, n_particles, step)
        for a, algorithm in enumerate(STEPPED)
        for n, n_particles in enumerate(settings["step_n_particles"])
        for s, step in enumerate(settings["time_step"])
    }


def cases(settings):
    """Return the cases of both grids."""
    return [*particle_grid(settings).values(), *step_grid(settings).values()]


def dashed(numbers):
    """Return a title that says how the lines of some N are dashed."""
    named = (f"{n} ({word})" for n, (_, word) in zip(numbers, DASHES, strict=False))
    return "$N$ = " + ", ".join(named)


def problems(settings):
    """Return numbers of particles that there are no dashes for."""
    many, most = settings["step_n_particles"], len(DASHES)
    return [("step_n_particles", f"must be at most {most}")] if len(many) > most else []
