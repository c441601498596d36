"""Injection through the six faces of a cuboid from a drifting Maxwellian gas (section 11.3).

Mass and Boltzmann's constant are 1: velocities on each axis have variance T about the drift. Faces
are in the order of `FACES`; the cuboid reaches from -L to +L on each axis.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from kacsim import checks
from kacsim.elementary.exponential import exp
from kacsim.kernels.jit import inlined, kernel
from kacsim.samplers import declared
from kacsim.streams import new_stream
from kacsim.techniques.constants import (
    FACE,
    NUMBER,
    POSITION,
    PRODUCT,
    REACH,
    SPEED,
    SPEED_2,
    SPEED_4,
    SQUARES,
    SUMS,
    TANGENT_1,
    TANGENT_2,
    VELOCITY,
)
from kacsim.typed import Floats, Integers
from kacsim.variates import exponential, half_normal, random_sign, uniform

POISSON_PIECE = 500.0  # exp(-mean) of a larger mean would be lost


@inlined
def poisson_number(mean, stream):
    """Return a Poisson number by stepping up its cumulative function (chapter, eq. 11.15)."""
    total = 0
    while mean > 0.0:
        part = min(mean, POISSON_PIECE)
        mean -= part
        n, share, u = 0, exp(-part), uniform(stream)
        while u >= share and share > 0.0:
            u -= share
            n += 1
            share *= part / n
        total += n
    return total


@inlined
def inward_speed(s, stream):
    """Return x > 0 of density proportional to x exp(-(x - s)**2 / 2): v f(v), in thermal units.

    Exact, by rejection: under a Gamma(2) law for s <= 0, under a normal and a two-sided Rayleigh
    law about s, weighted s sqrt(2 pi) to 2, for s > 0.
    """
    if s <= 0.0:
        rate = 0.5 * (math.sqrt(s * s + 8.0) - s)
        while True:
            x = (exponential(stream) + exponential(stream)) / rate
            gap = x - s - rate
            if 2.0 * exponential(stream) > gap * gap:
                return x
    normal = s * math.sqrt(2.0 * math.pi)
    while True:
        sign = random_sign(stream)
        if uniform(stream) * (normal + 2.0) < normal:
            x = s + sign * half_normal(stream)
        else:
            x = s + sign * math.sqrt(2.0 * exponential(stream))
        if uniform(stream) * (s + abs(x - s)) < x:
            return x


@inlined
def add_particle(face, position, velocity, half_width, numbers, tallies, n_kept):
    """Add one entering particle to the tallies; return the new number of kept ones.

    Parameters
    ----------
    position, velocity : float64[3]
    numbers : int64[6], particles of this step
    tallies : of (sums, speeds, width, kept), all but the width modified in place:
        float64[6, 8], `SUMS` by face, positions in half widths; int64[6, bins], particles by
        v_n / width; float64[m, 7], `FACE`, `POSITION` and `VELOCITY` of the first particles
    """
    sums, speeds, width, kept = tallies
    axis = face // 2
    one, two = (axis + 1) % 3, (axis + 2) % 3
    speed = abs(velocity[axis])
    a, b = position[one] / half_width[one], position[two] / half_width[two]
    numbers[face] += 1
    speeds[face, int(min(speed / width, speeds.shape[1] - 1))] += 1
    sums[face, NUMBER] += 1.0
    sums[face, SPEED] += speed
    sums[face, SPEED_2] += speed**2
    sums[face, SPEED_4] += speed**4
    sums[face, TANGENT_1] += velocity[one]
    sums[face, TANGENT_2] += velocity[two]
    sums[face, PRODUCT] += a * b
    sums[face, SQUARES] += a * a + b * b
    if n_kept < kept.shape[0]:
        kept[n_kept, FACE] = face
        for k in range(3):
            kept[n_kept, POSITION + k] = position[k]
            kept[n_kept, VELOCITY + k] = velocity[k]
        return n_kept + 1
    return n_kept


@kernel
def inject_steps(n_steps, means, drift, thermal, half_width, counts, tallies, stream):
    """Inject through all faces, step by step (chapter, section 11.3).

    Parameters
    ----------
    means : float64[6], F_j dt, mean number per face and step
    drift, half_width : float64[3]; thermal : float, root of the temperature
    counts : int64[6, most + 1], steps by number of particles, the last for all larger, added to
    tallies : as `add_particle`

    Returns
    -------
    int, kept particles
    """
    position, velocity = np.empty(3), np.empty(3)
    numbers = np.empty(6, np.int64)
    n_kept = 0
    for _ in range(n_steps):
        numbers[:] = 0
        for face in range(6):
            axis, inward = face // 2, 1.0 - 2.0 * (face % 2)
            for _ in range(poisson_number(means[face], stream)):
                for k in range(3):
                    velocity[k] = drift[k] + thermal * random_sign(stream) * half_normal(stream)
                    position[k] = half_width[k] * (2.0 * uniform(stream) - 1.0)
                position[axis] = -inward * half_width[axis]
                s = inward * drift[axis] / thermal
                velocity[axis] = inward * thermal * inward_speed(s, stream)
                n_kept = add_particle(
                    face, position, velocity, half_width, numbers, tallies, n_kept
                )
        for face in range(6):
            counts[face, min(numbers[face], counts.shape[1] - 1)] += 1
    return n_kept


@inlined
def entry(position, velocity, half_width, step):
    """Move a particle to where its path enters the cuboid within a step; return the face, or -1."""
    first, last, face = -1.0, step, -1
    for k in range(3):
        if velocity[k] == 0.0:
            if abs(position[k]) > half_width[k]:
                return -1
            continue
        inward = math.copysign(half_width[k], velocity[k])
        enters = (-inward - position[k]) / velocity[k]
        last = min(last, (inward - position[k]) / velocity[k])
        if enters > first:
            first, face = enters, 2 * k + int(velocity[k] < 0.0)
    if face < 0 or first <= 0.0 or first > last:
        return -1
    for k in range(3):
        position[k] += velocity[k] * first
    return face


@kernel
def move_gas(n_steps, mean, reach, drift, thermal, half_width, step, counts, tallies, stream):
    """Move a piece of the outer gas for one step, over and over, and look at what enters.

    The reference of `inject_steps`: it knows nothing of fluxes. Particles are uniform in a larger
    cuboid, Poisson in number, and fly straight.

    Parameters
    ----------
    mean : float, mean number of particles in the larger cuboid; reach : float64[3], its half widths
    others : as `inject_steps`
    """
    position, velocity = np.empty(3), np.empty(3)
    numbers = np.empty(6, np.int64)
    n_kept = 0
    for _ in range(n_steps):
        numbers[:] = 0
        for _ in range(poisson_number(mean, stream)):
            for k in range(3):
                position[k] = reach[k] * (2.0 * uniform(stream) - 1.0)
                velocity[k] = drift[k] + thermal * random_sign(stream) * half_normal(stream)
            face = entry(position, velocity, half_width, step)
            if face >= 0:
                n_kept = add_particle(
                    face, position, velocity, half_width, numbers, tallies, n_kept
                )
        for face in range(6):
            counts[face, min(numbers[face], counts.shape[1] - 1)] += 1
    return n_kept


def gas(temperature, drift, half_width):
    """Return (drift, thermal velocity, half widths) as the kernels take them."""
    vectors = [np.array(value, dtype=float) for value in (drift, half_width)]
    return vectors[0], math.sqrt(temperature), vectors[1]


def injection(*, density, temperature, drift, half_width, step):
    """Return the parameters of `inject_steps`: mean numbers by face, and the `gas`."""
    from kacsim.techniques import flux  # which imports special functions

    means = flux.face_rates(density, temperature, drift, half_width) * step
    return means, *gas(temperature, drift, half_width)


def outer_gas(*, density, temperature, drift, half_width, step):
    """Return the parameters of `move_gas`: mean number, the reach of its piece, the gas, a step."""
    state = gas(temperature, drift, half_width)
    velocity, thermal, widths = state
    reach = widths + step * (np.abs(velocity) + REACH * thermal)
    return density * float(np.prod(2.0 * reach)), reach, *state, float(step)


def inject(
    *,
    density: float,
    temperature: float,
    drift: Sequence[float] | Floats,
    half_width: Sequence[float] | Floats,
    step: float,
    n_steps: int,
    seed: int,
) -> tuple[Integers, Floats, Floats, Integers]:
    """Draw the particles that enter a cuboid from a drifting Maxwellian gas (section 11.3).

    Parameters
    ----------
    density : float > 0, particles per volume
    temperature : float > 0, variance of each velocity component (mass 1)
    drift : 3 floats, mean velocity
    half_width : 3 floats > 0, the cuboid reaches from -L to +L on each axis
    step : float > 0, duration of a time step
    n_steps : int >= 1
    seed : int >= 0; the same arguments give the same bits

    Returns
    -------
    (int64[n], float64[n, 3], float64[n, 3], int64[n]), face in the order of
    `kacsim.techniques.constants.FACES`, position, velocity, and number of the step

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    state = {"density": density, "temperature": temperature, "drift": list(drift)}
    state |= {"half_width": list(half_width), "step": step}
    checks.raise_problems(declared("injection", state))
    checks.raise_problems(checks.amount(n_draws=1, n_replicates=1, seed=seed))
    checks.raise_problems(checks.count("n_steps", n_steps))
    stream = new_stream(seed, "techniques.inject")
    arguments = injection(**state)
    steps, rows, room = [], [], 64
    for k in range(n_steps):
        before = stream.copy()
        while True:
            counts, kept = np.zeros((6, 2), np.int64), np.empty((room, 7))
            tallies = np.zeros((6, len(SUMS))), np.zeros((6, 1), np.int64), 1.0, kept
            n = inject_steps(1, *arguments, counts, tallies, stream)
            if n < room:
                break
            room, stream = 2 * room, before.copy()
        steps.append(np.full(n, k))
        rows.append(kept[:n])
    table = np.concatenate(rows)
    faces = table[:, FACE].astype(np.int64)
    return faces, table[:, POSITION:VELOCITY], table[:, VELOCITY:], np.concatenate(steps)
