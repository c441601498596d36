"""The samplers of the equilibrium, declared (Kac paper, section 5).

ε-perfect and perfect draws, the distances of corners, other readings, coupling forward.
"""

import functools
import math

from kacsim.checks import Problem, count, falling, one_of, positive
from kacsim.kac import work
from kacsim.kac.constants import LEVELS, MEAN_ENERGY, SINGLE, WALKS
from kacsim.kac.contraction import blocks_per_draw
from kacsim.samplers import REPLICATE_MEGABYTES, Parameter, Sampler, real, whole

OUTSIDE = "a case carries every value that its declaration sets"

RELATIVE_TOLERANCE = 1e-13  # below this times sqrt(energy) rounding decides when corners meet
LARGEST_CORNERS = 1000  # particles whose corners are compared step by step
MOST_BLOCKS = 100  # blocks per perfect draw


def kac_equilibrium(*, n_particles, tolerance, energy=None):
    """Yield the problems of an epsilon-perfect draw (Kac paper, section 5)."""
    radius = math.sqrt(MEAN_ENERGY * n_particles if energy is None else energy)
    least = RELATIVE_TOLERANCE * radius
    if tolerance < least:
        sentence = f"double precision resolves distances of at least {least:.1e} on this sphere"
        yield Problem("tolerance", tolerance, sentence)


def kac_perfect(*, n_particles, energy=None, block=None):
    """Yield the problems of a perfect draw: corners are followed, and a block may succeed."""
    if n_particles > LARGEST_CORNERS:
        yield Problem("n_particles", n_particles, f"must be at most {LARGEST_CORNERS}")
    elif block is not None and block < n_particles - 2:
        yield Problem("block", block, "no block succeeds with fewer than n_particles - 2 steps")
    elif block is not None and blocks_per_draw(n_particles, block) > MOST_BLOCKS:
        sentence = f"must be longer: fewer than one block in {MOST_BLOCKS} would succeed"
        yield Problem("block", block, sentence)


def kac_readings(*, n_particles, tolerance, **_):
    """Yield the problems of tolerances in units of the sphere's radius, and of many corners."""
    if n_particles > LARGEST_CORNERS:
        yield Problem("n_particles", n_particles, f"must be at most {LARGEST_CORNERS}")
    if max(tolerance) >= 1.0 or min(tolerance) < RELATIVE_TOLERANCE:
        sentence = f"must lie between {RELATIVE_TOLERANCE} and 1, in units of the radius"
        yield Problem("tolerance", tolerance, sentence)


def kac_forward(*, n_particles, tolerance, energy=None):
    """Yield the problems of coupling both ways: corners are compared at every step."""
    if n_particles > LARGEST_CORNERS:
        yield Problem("n_particles", n_particles, f"must be at most {LARGEST_CORNERS}")
    # The limit is taken where corners are nearer than this by a factor of 10**4.
    finest = 1e-4 * tolerance if isinstance(tolerance, float) else tolerance
    yield from kac_equilibrium(n_particles=n_particles, tolerance=finest, energy=energy)


N_PARTICLES = Parameter(
    "n_particles", "n", "number of particles", functools.partial(count, least=2), kind=whole
)
TOLERANCE = Parameter("tolerance", "eps", "epsilon of the perfect sampler", positive, kind=real)
ENERGY = Parameter(
    "energy", "e", "energy of all particles, 3 N / 2 by default", positive, None, kind=real
)
EQUILIBRIUM = Sampler(
    "kac_equilibrium",
    "v_1 at equilibrium, epsilon-perfect, with coupling times",
    (N_PARTICLES, TOLERANCE, ENERGY),
    kernels="perfect",
    check=kac_equilibrium,
    work=work.of_coupling,
    tiny=({"n_particles": 3, "tolerance": 0.1},),
)
PERFECT = Sampler(
    "kac_perfect",
    "v_1 at equilibrium, perfect: epsilon = 0",
    (
        N_PARTICLES,
        ENERGY,
        Parameter(
            "block", "block", "random steps before each sweep, chosen by N if not given",
            functools.partial(count, least=0), None, kind=whole,
        ),
    ),
    kernels="perfect_blocks",
    check=kac_perfect,
    work=work.of_blocks,
    replicate_megabytes=lambda parameters: 8e-6 * LEVELS + REPLICATE_MEGABYTES,
    tiny=({"n_particles": 3},),
)  # fmt: skip
CORNERS = Sampler(
    "kac_corners",
    "the distances of the corners before they meet",
    (N_PARTICLES, TOLERANCE),
    kernels="perfect",
    check=kac_equilibrium,
    work=work.of_corners,
    by_replicate=False,
    tiny=({"n_particles": 3, "tolerance": 0.1},),
)
READINGS = Sampler(
    "kac_readings",
    "coupling times under other readings of the algorithm",
    (
        N_PARTICLES,
        Parameter(
            "walk", "", f"how corner points move: {', '.join((*WALKS, SINGLE))}",
            functools.partial(one_of, allowed=(*WALKS, SINGLE)), shown=True,
        ),
        Parameter(
            "tolerance", "eps", "distances at which to stop, falling, over the sphere's radius",
            positive, kind=real, many=True, whole=falling,
        ),
    ),
    kernels="readings",
    check=kac_readings,
    work=work.of_readings,
    tiny=(
        {"n_particles": 4, "walk": "printed", "tolerance": [0.1, 0.01]},
        {"n_particles": 4, "walk": SINGLE, "tolerance": [0.1]},
    ),
)  # fmt: skip
FORWARD = Sampler(
    "kac_forward",
    "equilibrium draws coupled from the past, by doubling and forward on the same inputs",
    (N_PARTICLES, TOLERANCE, ENERGY),
    kernels="forward",
    check=kac_forward,
    work=work.of_coupling,
    tiny=({"n_particles": 3, "tolerance": 0.1},),
)
SAMPLERS = (EQUILIBRIUM, PERFECT, CORNERS, READINGS, FORWARD)
