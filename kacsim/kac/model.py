"""Kac's model: the initial law f0 and the collision (Kac paper, sections 2.1 and 3)."""

import math

import numpy as np

from kacsim.jit import inlined
from kacsim.variates import exponential, half_normal, random_sign, squared_cosine, unit_circle


@inlined
def initial_energy(stream):
    """Return v**2 under f0(v) = 2/sqrt(pi) v**2 exp(-v**2): Gamma(3/2, 1) = Exp + Z**2/2."""
    z = half_normal(stream)
    return exponential(stream) + 0.5 * z * z


@inlined
def initial_velocity(stream):
    """Return a velocity under f0: the root of `initial_energy` with a random sign."""
    return math.sqrt(initial_energy(stream)) * random_sign(stream)


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


@inlined
def grown(array):
    """Return the array copied into one twice as long."""
    longer = np.empty(2 * array.size, array.dtype)
    longer[: array.size] = array
    return longer


@inlined
def fill_initial_energies(energy, n, stream):
    """Draw the first n energies under f0; return the array, replaced by a longer one if short."""
    while energy.size < n:
        energy = grown(energy)
    for i in range(n):
        energy[i] = initial_energy(stream)
    return energy
