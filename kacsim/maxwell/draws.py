"""The public draws of Maxwell molecules."""

from __future__ import annotations

import numpy as np

from kacsim import checks
from kacsim.cases import make_case
from kacsim.kernels.lookup import named
from kacsim.maxwell.constants import RATE
from kacsim.streams import new_stream
from kacsim.typed import Floats

NOT_OF_THE_ENSEMBLE = ("algorithm", "engine", "keep_above")


def kernel_of(parameters):
    """Return (kernel, arguments) of one algorithm on one engine, from a case's parameters."""
    own = {key: value for key, value in parameters.items() if key not in NOT_OF_THE_ENSEMBLE}
    arguments, kernel = (
        named("kacsim.maxwell", parameters["algorithm"], part)
        for part in ("arguments", parameters["engine"])
    )
    return kernel, arguments(**own, collision_rate=RATE)


def draw(
    algorithm: str,
    *,
    n_particles: int | float,
    time: float,
    n_draws: int,
    seed: int,
    time_step: float | None = None,
    engine: str = "ancestral",
) -> Floats:
    """Draw independent velocities of particle 1 of a gas of Maxwell molecules.

    The gas starts from the BKW mode, density proportional to c**2 exp(-c**2 / 1.2), collides once
    per particle and unit of time and scatters isotropically. Velocities are in units of the RMS
    velocity per axis. Each draw is from an ensemble of its own, by an algorithm of the Kac paper.

    Parameters
    ----------
    algorithm : one of `kacsim.maxwell.ALGORITHMS`
    n_particles : int >= 2, or math.inf (ancestral poisson only: the Boltzmann equation itself, so
        that the draws have the law of the BKW mode at that time)
    time : float > 0, in mean collision times
    n_draws : int >= 1
    seed : int >= 0; the same arguments give the same bits
    time_step : float that divides time, at most 1; of the Nanbu family, which needs it
    engine : "ancestral" (particle 1's ancestors only) or "forward" (whole ensembles); same law

    Returns
    -------
    float64[n_draws, 3]

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    given = {} if time_step is None else {"time_step": time_step}
    case = make_case(
        "maxwell",
        algorithm=algorithm,
        engine=engine,
        n_particles=n_particles,
        time=time,
        n_draws=n_draws,
        n_replicates=1,
        seed=seed,
        **given,
    )
    checks.raise_problems(case.problems())
    kernel, arguments = kernel_of(case.parameters)
    velocities, own = np.empty((n_draws, 3)), np.empty(n_draws, np.int64)
    kernel(velocities, own, *arguments, new_stream(seed, f"maxwell.draw {algorithm} {engine}"))
    return velocities
