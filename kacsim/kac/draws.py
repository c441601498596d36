"""The public draws of Kac's model."""

from __future__ import annotations

import functools
from pathlib import Path

import numpy as np

from kacsim import checks
from kacsim.cases import make_case
from kacsim.kac import perfect, perfect_blocks, samplers
from kacsim.kac.constants import RATE
from kacsim.kernels.lookup import named
from kacsim.streams import new_stream
from kacsim.typed import Floats, Integers, Law


def kernel_of(parameters):
    """Return (kernel, arguments) of one algorithm on one engine, from a case's parameters.

    The algorithm is the module of its name, the engine its kernel; the module's ``arguments`` take
    what describes the ensemble, and the algorithm's own parameters.
    """
    own = {key: value for key, value in parameters.items() if key not in NOT_OF_THE_ENSEMBLE}
    # By names that are no literals: a literal would make every case depend on all algorithms'.
    arguments, kernel = (
        named("kacsim.kac", parameters["algorithm"], part)
        for part in ("arguments", samplers.entry(parameters))
    )
    if samplers.is_own(parameters):
        module, part = samplers.TABLES
        make = named("kacsim.kac", module, part)
        laws = (parameters.get(name) for name in samplers.LAWS)
        kernel = functools.partial(kernel, tables=make(*laws))
    return kernel, arguments(**own)


NOT_OF_THE_ENSEMBLE = ("algorithm", *samplers.HOW_TO_DRAW)


def draw(
    algorithm: str,
    *,
    n_particles: int | float,
    time: float,
    n_draws: int,
    seed: int,
    collision_rate: float = RATE,
    engine: str = "ancestral",
    initial: Law | None = None,
    scattering: Law | None = None,
    **parameters: float | None,
) -> Floats:
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
    initial : law of the velocities at time 0: "f0" (default, the paper's), "two_peaks", "uniform"
        or "maxwell", which all have E v**2 = 3/2; a CSV file of a density with the columns x and
        density, linear between its points; or a table of `kacsim.techniques.tabulate`
    scattering : law of the angle theta of a collision, (v, w) -> (v cos(theta) + w sin(theta),
        w cos(theta) - v sin(theta)) (Kac paper, section 2.1): "uniform" (default), "forward" (a
        triangle up to pi / 2), "grazing" (uniform up to pi / 8), or a file or a table as for
        `initial`, in radians. Either of a pair may be the first, so that of its density rho the
        even part (rho(theta) + rho(-theta)) / 2 matters only.
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
    laws = {"initial": initial, "scattering": scattering}
    named_laws = {name: law for name, law in laws.items() if isinstance(law, (str, Path))}
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
        **named_laws,
    )
    checks.raise_problems(case.problems(), samplers.own_law_problems(algorithm, **laws))
    # A case is made of words; tables in memory do not pass through it.
    tables = {name: law for name, law in laws.items() if name not in named_laws}
    kernel, arguments = kernel_of(case.parameters | tables)
    velocities, own = np.empty(n_draws), np.empty(n_draws, np.int64)
    kernel(velocities, own, *arguments, new_stream(seed, f"kac.draw {algorithm} {engine}"))
    return velocities


def draw_equilibrium(
    *, n_particles: int, tolerance: float, n_draws: int, seed: int, energy: float | None = None
) -> tuple[Floats, Integers]:
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


def draw_perfect(
    *, n_particles: int, n_draws: int, seed: int, energy: float | None = None
) -> Floats:
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
