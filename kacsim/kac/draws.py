"""The public draws of Kac's model, and the table of its algorithms."""

import numpy as np

from kacsim import checks
from kacsim.checks import MEAN_ENERGY, RATE
from kacsim.kac import bird, nanbu, nanbu_babovsky, perfect, poisson
from kacsim.streams import new_stream

# algorithm -> (parameters of its kernels, forward kernel, ancestral kernel)
KERNELS = {
    "nanbu_sequential": (nanbu.arguments, nanbu.forward_sequential, nanbu.ancestral_sequential),
    "nanbu_synchronous": (nanbu.arguments, nanbu.forward_synchronous, nanbu.ancestral_synchronous),
    "nanbu_babovsky": (nanbu_babovsky.arguments, nanbu_babovsky.forward, nanbu_babovsky.ancestral),
    "bird": (bird.arguments, bird.forward, bird.ancestral),
    "poisson": (poisson.arguments, poisson.forward, poisson.ancestral),
    "poisson_printed": (poisson.arguments, poisson.forward, poisson.ancestral),
}


def kernel_of(parameters):
    """Return (kernel, arguments) of one algorithm on one engine, from checked parameters."""
    arguments, forward, ancestral = KERNELS[parameters["algorithm"]]
    kernel = forward if parameters["engine"] == "forward" else ancestral
    return kernel, arguments(**parameters)


def draw(
    algorithm,
    *,
    n_particles,
    time,
    n_draws,
    seed,
    time_step=None,
    collision_rate=RATE,
    engine="ancestral",
):
    """Draw independent values of v_1(t), each from an ensemble of its own (Kac paper, section 4).

    Parameters
    ----------
    algorithm : one of `kacsim.kac.ALGORITHMS`
    n_particles : int >= 2, or math.inf (ancestral poisson only: the Kac equation itself)
    time : float > 0
    n_draws : int >= 1
    seed : int >= 0; the same arguments give the same bits
    time_step : float that divides time, Nanbu family only; collision_rate * time_step <= 1
    collision_rate : float > 0, sqrt(pi) / 2 in the paper
    engine : "ancestral" (particle 1's ancestors only) or "forward" (as published); same law

    Returns
    -------
    float64[n_draws]

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    parameters = {
        "algorithm": algorithm,
        "engine": engine,
        "n_particles": n_particles,
        "time": time,
        "time_step": time_step,
        "collision_rate": collision_rate,
    }
    checks.raise_problems(checks.kac(**parameters))
    checks.raise_problems(checks.amount(n_draws=n_draws, n_replicates=1, seed=seed))
    kernel, arguments = kernel_of(parameters)
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
    problems = checks.kac_equilibrium(n_particles=n_particles, tolerance=tolerance, energy=energy)
    checks.raise_problems(problems)
    checks.raise_problems(checks.amount(n_draws=n_draws, n_replicates=1, seed=seed))
    velocities, times = np.empty(n_draws), np.empty(n_draws, np.int64)
    total = MEAN_ENERGY * n_particles if energy is None else energy
    stream = new_stream(seed, "kac.draw_equilibrium")
    perfect.couple(velocities, times, n_particles, float(total), float(tolerance), stream)
    return velocities, times
