"""The work that kernels are timed with: what the benchmark, its floors and comparisons all run.

`tests/compare_speed.py` loads this file into other checkouts of the project too, so that it uses
what all of them have, and is given the constants.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from kacsim.boltzmann import bkw_tree, trap, trap_tree
from kacsim.kac import draws, perfect

SPAN, STEP = 2.0, 0.01  # from the start to what is drawn; of the algorithms that have one
BUDGET = 10**7
WITH_STEP = ("nanbu_sequential", "nanbu_synchronous", "nanbu_babovsky")
ALGORITHMS = ("bird", "poisson", "poisson_printed", *WITH_STEP)


class Work(NamedTuple):
    """A kernel at one set of parameters.

    Attributes
    ----------
    unit : what its time is told for
    call : function (n, stream) -> int; draws n values and returns the number of units
    """

    unit: str
    call: Callable


def works(rate, mean_energy, breathing):
    """Return name -> Work.

    Parameters
    ----------
    rate, mean_energy : constants of the Kac paper
    breathing : eps of the trap
    """
    found = {}
    for n_particles in (50, 1000):
        found[f"Bird forward, N = {n_particles}"] = _kac("bird", "forward", n_particles, rate)
    for algorithm in ALGORITHMS:
        for n_particles in (50, 1000, 10**9):
            name = f"{algorithm} ancestral, N = {'10⁹' if n_particles == 10**9 else n_particles}"
            found[name] = _kac(algorithm, "ancestral", n_particles, rate)
    found["ε-perfect, N = 50"] = _perfect(50, mean_energy * 50, 1e-6)
    found["BKW tree, t = 2"] = _tree(bkw_tree.estimate, (2.0, SPAN, 1.0, 0.0, BUDGET))
    physics, choices = (3.0, breathing, 0.0, 1.0), (trap.MAJORANT, 1.0, 0.0)
    probe = (0.0, 0.0, 0.0, 3.0)
    found["trap tree, ωt = 3"] = _tree(trap_tree.estimate, (*probe, physics, choices, BUDGET))
    return found


def kac_arguments(algorithm, n_particles, rate):
    """Return what an algorithm's `arguments` take."""
    given = {"n_particles": n_particles, "time": SPAN, "collision_rate": rate}
    return given | ({"time_step": STEP} if algorithm in WITH_STEP else {})


def _kac(algorithm, engine, n_particles, rate):
    """Return the work of one algorithm, told per collision (forward) or per draw (ancestral)."""
    given = kac_arguments(algorithm, n_particles, rate)
    kernel, arguments = draws.kernel_of({"algorithm": algorithm, "engine": engine, **given})

    def call(n, stream):
        collisions = kernel(np.empty(n), np.empty(n, np.int64), *arguments, stream)
        return collisions if engine == "forward" else n

    return Work("collision" if engine == "forward" else "draw", call)


def _perfect(n_particles, energy, tolerance):
    def call(n, stream):
        perfect.couple(np.empty(n), np.empty(n, np.int64), n_particles, energy, tolerance, stream)
        return n

    return Work("draw", call)


def _tree(kernel, arguments):
    def call(n, stream):
        nodes = np.empty(n, np.int64)
        kernel(np.empty(n), nodes, *arguments, stream)
        return int(nodes.sum())

    return Work("node", call)
