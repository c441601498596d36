"""Bird's algorithm by others' means, on the same work: N, time, collisions and law.

`obvious_bird` is numba as one writes it first (global generator, sine and cosine, three normals for
f0); `vectorised_bird` numpy, every ensemble's next collision at a time; `native` C.
"""

import math

import numpy as np

from kacsim.benchmark import native
from kacsim.benchmark.timing import medians
from kacsim.kac import bird
from kacsim.kac.constants import RATE
from kacsim.kernels.jit import kernel
from kacsim.streams import new_stream

SPAN = 2.0  # from the start to what is drawn
COLLISIONS = 10**6  # of one measurement
TOGETHER = 1000  # ensembles that numpy keeps in its arrays


@kernel
def obvious_bird(velocities, n_particles, n_collisions):
    """Draw v_1 by Bird's algorithm as one writes it first."""
    v = np.empty(n_particles)
    for draw in range(velocities.size):
        for i in range(n_particles):
            square = 0.0
            for _ in range(3):
                square += 0.5 * np.random.standard_normal() ** 2
            v[i] = math.sqrt(square) if np.random.random() < 0.5 else -math.sqrt(square)
        for _ in range(n_collisions):
            i = np.random.randint(n_particles)
            j = np.random.randint(n_particles - 1)
            if j >= i:
                j += 1
            angle = 2.0 * math.pi * np.random.random()
            vi, vj = v[i], v[j]
            v[i] = vi * math.cos(angle) + vj * math.sin(angle)
            v[j] = vj * math.cos(angle) - vi * math.sin(angle)
        velocities[draw] = v[0]


@kernel
def seed_obvious(seed):
    """Seed the global generator of compiled code, which `obvious_bird` draws from."""
    np.random.seed(seed)


def vectorised_bird(velocities, n_particles, n_collisions, random):
    """Draw v_1 from whole ensembles, as many side by side as `TOGETHER`; random is numpy's."""
    for start in range(0, velocities.size, TOGETHER):
        rows = np.arange(min(TOGETHER, velocities.size - start))
        v = np.sqrt(random.gamma(1.5, size=(rows.size, n_particles)))
        v *= random.choice((-1.0, 1.0), size=v.shape)
        for _ in range(n_collisions):
            i = random.integers(n_particles, size=rows.size)
            j = random.integers(n_particles - 1, size=rows.size)
            j += j >= i
            angle = random.uniform(0.0, 2.0 * np.pi, size=rows.size)
            cos, sin, vi, vj = np.cos(angle), np.sin(angle), v[rows, i], v[rows, j]
            v[rows, i] = vi * cos + vj * sin
            v[rows, j] = vj * cos - vi * sin
        velocities[start : start + rows.size] = v[:, 0]


NAMES = ("numba, obvious", "numpy, vectorised", *native.PEERS)


def peers(seed):
    """Return name -> function (velocities, n_particles, n_collisions) that draws v_1.

    C is among them where a compiler is found.
    """
    random = np.random.default_rng(seed)

    def vectorised(velocities, *ensemble):
        vectorised_bird(velocities, *ensemble, random)

    seed_obvious(seed)
    found = {"numba, obvious": obvious_bird, "numpy, vectorised": vectorised}
    return found | native.peers(seed)


def own(seed):
    """Return the project's kernel as a peer."""
    stream = new_stream(seed, "peers")

    def draw(velocities, *ensemble):
        bird.forward(velocities, np.empty(velocities.size, np.int64), *ensemble, stream)

    return draw


def z_of_fourth_moment(velocities, n_particles):
    """Return (mean, standard error, exact, z) of v_1**4 at time `SPAN` by Bird's algorithm."""
    fourth = velocities**4
    exact = bird.fourth_moment(n_particles=n_particles, time=SPAN, collision_rate=RATE)
    mean, error = fourth.mean(), fourth.std(ddof=1) / math.sqrt(fourth.size)
    return mean, error, exact, (mean - exact) / error


def run(repeats):
    """Print what a collision costs each, and whether its law is right."""
    if native.compiler() is None:
        print(f"no C compiler is there ({', '.join(native.COMPILERS)}): C is left out")
    for n_particles in (50, 1000):
        ensemble = bird.arguments(n_particles=n_particles, time=SPAN, collision_rate=RATE)
        n_draws = max(TOGETHER, COLLISIONS // ensemble[1])
        compare(n_particles, ensemble, n_draws, repeats)


def compare(n_particles, ensemble, n_draws, repeats):
    """Print a line for each, with the same number of draws from ensembles of the same kind."""
    all_draws = {"kacsim": own(1), **peers(1)}
    values, kept = np.empty(n_draws), {name: [] for name in all_draws}

    def call(name):
        all_draws[name](values, *ensemble)
        kept[name].append(values.copy())

    for draw in all_draws.values():
        draw(values[:2], *ensemble)  # compiled
    times = medians({name: lambda name=name: call(name) for name in all_draws}, repeats)
    for name, taken in times.items():
        mean, error, exact, z = z_of_fourth_moment(np.concatenate(kept[name]), n_particles)
        cost = 1e9 * taken / n_draws / ensemble[1]
        print(
            f"Bird forward, N = {n_particles}, {name}: {cost:.1f} ns per collision, "
            f"{taken / times['kacsim']:.1f} times kacsim's; E v1^4 = {mean:.3f} ± {error:.3f}, "
            f"exact {exact:.3f}, z = {z:+.1f}"
        )
