"""The public draws of Kac's model."""

import numpy as np

from kacsim import checks
from kacsim.cases import make_case
from kacsim.kac import perfect, perfect_blocks
from kacsim.kac.constants import RATE
from kacsim.kernels.lookup import named
from kacsim.streams import new_stream


def kernel_of(parameters):
    """Return (kernel, arguments) of one algorithm on one engine, from a case's parameters.

    The algorithm is the module of its name, the engine its kernel; the module's ``arguments`` take
    what describes the ensemble, and the algorithm's own parameters.
    """
    own = {key: value for key, value in parameters.items() if key not in NOT_OF_THE_ENSEMBLE}
    # By names that are no literals: a literal would make every case depend on all algorithms'.
    arguments, kernel = (
        named("kacsim.kac", parameters["algorithm"], part)
        for part in ("arguments", parameters["engine"])
    )
    return kernel, arguments(**own)


NOT_OF_THE_ENSEMBLE = ("algorithm", "engine", "keep_above")


def draw(
    algorithm,
    *,
    n_particles,
    time,
    n_draws,
    seed,
    collision_rate=RATE,
    engine="ancestral",
    **parameters,
):
    """Draw independent values of v_1(t), each from an ensemble of its own (Kac paper, section 4).

    Parameters
    ----------
    algorithm : one of `kacsim.kac.ALGORITHMS`
    n_particles : int >= 2, or math.inf (ancestral poisson only: the Kac equation itself)
    time : float > 0
    n_draws : int >= 1
    seed : int >= 0; the same arguments give the same bits
    collision_rate : float > 0, sqrt(pi) / 2 in the paper
    engine : "ancestral" (particle 1's ancestors only) or "forward" (as published); same law
    parameters : those that the algorithm has beside these: time_step of the Nanbu family, a float
        that divides time, with collision_rate * time_step <= 1

    Returns
    -------
    float64[n_draws]

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    case = make_case(
        "kac",
        algorithm=algorithm,
        engine=engine,
        n_particles=n_particles,
        time=time,
        collision_rate=collision_rate,
        n_draws=n_draws,
        n_replicates=1,
        seed=seed,
        **parameters,
    )
    checks.raise_problems(case.problems())
    kernel, arguments = kernel_of(case.parameters)
    velocities, own = np.empty(n_draws), np.empty(n_draws, np.int64)
    kernel(velocities, own, *arguments, new_stream(seed, f"kac.draw {algorithm} {engine}"))
    return velocities


def draw_equilibrium(*, n_particles, tolerance, n_draws, seed, energy=None):
    """Draw epsilon-perfect values of v_1 at equilibrium (Kac paper, section 5).

    Parameters
    ----------
    n_particles : int >= 2
    tolerance : float, epsilon; at least 1e-13 sqrt(energy)
    n_draws : int >= 1
    seed : int >= 0
    energy : float > 0, sum of v**2 of the ensemble, by default 3 N / 2

    Returns
    -------
    (float64[n_draws], int64[n_draws]), velocities and coupling times

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    case = make_case(
        "kac_equilibrium",
        n_particles=n_particles,
        tolerance=tolerance,
        energy=energy,
        n_draws=n_draws,
        n_replicates=1,
        seed=seed,
    )
    checks.raise_problems(case.problems())
    velocities, times = np.empty(n_draws), np.empty(n_draws, np.int64)
    stream = new_stream(seed, "kac.draw_equilibrium")
    perfect.couple(velocities, times, *perfect.arguments(**case.parameters), stream)
    return velocities, times


def draw_perfect(*, n_particles, n_draws, seed, energy=None):
    """Draw v_1 at equilibrium, exactly: the perfect sampler with epsilon = 0 (docs/perfect.md).

    Parameters
    ----------
    n_particles : int from 2 to 1000
    n_draws : int >= 1
    seed : int >= 0; the same arguments give the same bits
    energy : float > 0, sum of v**2 of the ensemble, by default 3 N / 2

    Returns
    -------
    float64[n_draws], independent, of the law v_1**2 / energy ~ Beta(1/2, (N - 1) / 2)

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    case = make_case(
        "kac_perfect",
        n_particles=n_particles,
        energy=energy,
        n_draws=n_draws,
        n_replicates=1,
        seed=seed,
    )
    checks.raise_problems(case.problems())
    velocities = np.empty(n_draws)
    stream = new_stream(seed, "kac.draw_perfect")
    perfect_blocks.draw_beginnings(velocities, *perfect_blocks.arguments(**case.parameters), stream)
    return velocities
