"""A node of the trees in the harmonic trap, and its free trajectory (Boltzmann paper, section IV).

By symmetry a node is its radius, and the radial and tangential components of its velocity. On its
way back it is named by where its trajectory is at time 0, (x, y) and velocity (u, v) in its plane:
no null collision changes that, it is all that a leaf needs, and the cosine and sine of omega t give
the rest. Units as in `kacsim.boltzmann.trap`.
"""

import math
from typing import NamedTuple

from kacsim.boltzmann.model import bkw_leaf
from kacsim.elementary.circular import cos_sin
from kacsim.kernels.jit import inlined


class Breathing(NamedTuple):
    """The breathing state: eps, cos and sin of phi0; at time 0 flow / r, thermal speed squared."""

    amplitude: float
    cos: float
    sin: float
    flow: float
    square: float


@inlined
def breathing_state(amplitude, start_phase):
    """Return the breathing state of eq. (31)."""
    cos, sin = cos_sin(start_phase)
    size = 1.0 + amplitude * sin
    return Breathing(amplitude, cos, sin, amplitude * cos / size, (1.0 - amplitude**2) / size)


@inlined
def swelling(cos, sin, state):
    """Return (1 + eps sin(phi), eps cos(phi)), phi = 2 omega t + phi0, from those of omega t."""
    cos_twice, sin_twice = 1.0 - 2.0 * sin * sin, 2.0 * sin * cos
    size = 1.0 + state.amplitude * (sin_twice * state.cos + cos_twice * state.sin)
    return size, state.amplitude * (cos_twice * state.cos - sin_twice * state.sin)


@inlined
def trajectory(radius, radial, tangential, cos, sin):
    """Return (x, y, u, v) of a node; the first axis is its radial one."""
    x, y = radius * cos - radial * sin, -tangential * sin
    return x, y, radial * cos + radius * sin, tangential * cos


@inlined
def node_at(x, y, u, v, cos, sin):
    """Return (radius, radial, tangential) on a trajectory."""
    along, across = x * cos + u * sin, y * cos + v * sin
    speed_along, speed_across = u * cos - x * sin, v * cos - y * sin
    radius = math.sqrt(along * along + across * across)
    if radius == 0.0:
        return 0.0, math.sqrt(speed_along * speed_along + speed_across * speed_across), 0.0
    inward = (along * speed_along + across * speed_across) / radius
    return radius, inward, abs(along * speed_across - across * speed_along) / radius


@inlined
def squared_radius(x, y, u, v, cos, sin):
    """Return the square of the radius on a trajectory."""
    along, across = x * cos + u * sin, y * cos + v * sin
    return along * along + across * across


@inlined
def start_ratio(x, y, u, v, state):
    """Return W of a leaf at time 0: the BKW start over its Maxwellian."""
    along, across = u - state.flow * x, v - state.flow * y
    return bkw_leaf((along * along + across * across) / state.square)
