"""Where the time of an ancestral draw goes, told by pieces that are timed apart.

The replay is what a kernel that leaves it out saves; energies, angles and signs are drawn in long
loops, which `pieces` times alone; what is left finds the histories.
"""

import importlib
from typing import NamedTuple

import numpy as np

from kacsim.benchmark.timing import draws_for, medians
from kacsim.benchmark.work import ALGORITHMS, kac_arguments
from kacsim.kac import model
from kacsim.kac.constants import RATE
from kacsim.kac.tape import ancestral_draws
from kacsim.kernels.jit import inlined
from kacsim.streams import new_stream

N_PARTICLES = 1000


class Stages(NamedTuple):
    """Seconds of a draw: all of it, and its parts.

    Attributes
    ----------
    finding : histories found, `variates` being what is drawn for them
    """

    draw: float
    finding: float
    variates: float
    energies: float
    angles: float
    replay: float
    signs: float


def no_replay(law):
    """Return a replay that leaves states as they are."""

    @inlined
    def replay(tape, state, n_events):
        pass

    return replay


def without_replay(module):
    """Return the ancestral kernel of an algorithm of Kac's model that replays nothing."""
    return ancestral_draws(model, module.prepare, module.history, no_replay)


def of(draw, without_replay, pieces):
    """Return the Stages of a draw.

    Parameters
    ----------
    draw, without_replay : seconds
    pieces : dict function -> (calls, seconds of all of them), for one draw
    """
    known = [pieces[name][1] for name in ("maxwell_energies", "squared_cosines", "random_sign")]
    variates = sum(seconds for _, seconds in pieces.values()) - sum(known)
    energies, angles, signs = known
    finding = without_replay - sum(known)
    return Stages(draw, finding, variates, energies, angles, draw - without_replay, signs)


def measure(algorithm, pieces, repeats):
    """Return the Stages of one algorithm at `N_PARTICLES`."""
    module = importlib.import_module(f"kacsim.kac.{algorithm}")
    arguments = module.arguments(**kac_arguments(algorithm, N_PARTICLES, RATE))
    stream = new_stream(1, "benchmark")
    kernels = module.ancestral, without_replay(module)

    def call(kernel, n):
        kernel(np.empty(n), np.empty(n, np.int64), *arguments, stream)

    n = min(draws_for(lambda n, kernel=kernel: call(kernel, n)) for kernel in kernels)
    taken = medians({k: lambda k=k: call(kernels[k], n) for k in range(2)}, repeats)
    return of(taken[0] / n, taken[1] / n, pieces)


def table(floors, repeats):
    """Return the rows of all algorithms, in ns, a head first.

    Parameters
    ----------
    floors : dict name of a work -> `kacsim.benchmark.floors.Floor`
    """
    head = ("ancestral draw", "ns", "finding", "its variates", *Stages._fields[3:])
    rows = [head]
    for algorithm in ALGORITHMS:
        floor = floors[f"{algorithm} ancestral, N = {N_PARTICLES}"]
        stages = measure(algorithm, floor.pieces, repeats)
        rows.append((algorithm, *(f"{1e9 * seconds:.1f}" for seconds in stages)))
    return rows
