"""Kac's model: the initial law f0 and the collision (Kac paper, sections 2.1 and 3)."""

import functools
import math

import numpy as np

from kacsim.kernels.jit import inlined
from kacsim.variates import maxwell_speed, random_sign, squared_cosine, unit_circle


@inlined
def initial_energy(stream):
    """Return v**2 under f0(v) = 2/sqrt(pi) v**2 exp(-v**2)."""
    speed = maxwell_speed(stream)
    return speed * speed


@inlined
def initial_velocity(stream):
    """Return a velocity under f0."""
    return maxwell_speed(stream) * random_sign(stream)


@inlined
def collide(v, i, j, stream):
    """Rotate the pair (v_i, v_j) by a uniform angle (Kac paper, section 2.1, step 3).

    Parameters
    ----------
    v : float64[N], velocities, overwritten at i and j; v_i**2 + v_j**2 is conserved
    i, j : distinct indices below N
    stream : uint64[4], advanced; 2.55 uniforms on average
    """
    cos, sin = unit_circle(stream)
    vi, vj = v[i], v[j]
    v[i] = vi * cos + vj * sin
    v[j] = vj * cos - vi * sin


@inlined
def deflect(vi, vj, stream):
    """Return v_i cos(theta) + v_j sin(theta), Nanbu's collision that leaves v_j unchanged."""
    cos, sin = unit_circle(stream)
    return vi * cos + vj * sin


@inlined
def share(energy, i, j, stream):
    """Share the pair's energy as `collide` does, with energies only (v_i**2 in place of v_i).

    A uniform rotation makes v_i**2 = (v_i**2 + v_j**2) cos(theta)**2 with theta uniform, and both
    signs uniform and independent of all energies; the sign of v_1 is drawn once, at the end.
    """
    total = energy[i] + energy[j]
    part = total * squared_cosine(stream)
    energy[i] = part
    energy[j] = total - part


@inlined
def signed_root(energy, stream):
    """Return a velocity of the given energy v**2 with a random sign."""
    return math.sqrt(energy) * random_sign(stream)


def growing(attempt):
    """Give an ancestral kernel a workspace that is as large as its largest history needs.

    Parameters
    ----------
    attempt : kernel (velocities, own, *arguments, stream, first, second, energy) that returns
        (draws done, collisions simulated). When a history does not fit into the workspace it
        puts the stream back to the beginning of that draw and returns.

    Returns
    -------
    function (velocities, own, *arguments, stream) -> int, collisions simulated, as a forward
    kernel; a growing array inside the kernel would cost a reference count per collision
    """

    @functools.wraps(attempt)
    def ancestral(velocities, own, *arguments):
        done, simulated, capacity = 0, 0, 256
        while done < velocities.size:
            first, second = np.empty(capacity, np.int64), np.empty(capacity, np.int64)
            energy = np.empty(capacity + 1)
            more, collisions = attempt(
                velocities[done:], own[done:], *arguments, first, second, energy
            )
            done += more
            simulated += collisions
            capacity *= 2
        return simulated

    return ancestral


@inlined
def copy_state(source, target):
    """Copy a stream's state, uint64[4]."""
    for k in range(4):
        target[k] = source[k]


@inlined
def replay(energy, n_ancestors, first, second, n_events, stream):
    """Draw the ancestors' energies at time 0 and replay their collisions; return that of v_1.

    Parameters
    ----------
    energy : float64[> n_ancestors], overwritten
    first, second : int64[n_events], pairs of ancestors, the latest collision first
    """
    for i in range(n_ancestors):
        energy[i] = initial_energy(stream)
    for event in range(n_events - 1, -1, -1):
        share(energy, first[event], second[event], stream)
    return energy[0]
