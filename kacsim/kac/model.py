"""Kac's model: the initial law f0 and the collision (Kac paper, sections 2.1 and 3)."""

import math

from kacsim.kernels.jit import inlined
from kacsim.variates import maxwell_speed, random_sign, unit_circle


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
    stream : from `new_stream`, advanced
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
def signed_root(energy, stream):
    """Return a velocity of the given energy v**2 with a random sign."""
    return math.sqrt(energy) * random_sign(stream)
