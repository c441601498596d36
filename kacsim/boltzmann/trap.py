"""Exact results on the harmonic trap (Boltzmann paper, sections IV and V).

Units: positions in c_eq / omega, velocities in c_eq, phases omega t; the density of the cloud is
normalized to n = 1. `coupling` is n kappa omega**2 / c_eq**3.
"""

import math

import numpy as np

from kacsim.boltzmann import bkw

# Largest ratio of the BKW start to its Maxwellian, eq. (37): (5/3)**(5/2) / e.
MAJORANT = 25.0 / 9.0 * math.sqrt(5.0 / 3.0) / math.e


def swelling(phase, breathing, start_phase=0.0):
    """Return 1 + eps sin(phi), phi = 2 omega t + phi0: the variance of positions per axis."""
    return 1.0 + breathing * np.sin(2.0 * np.asarray(phase, dtype=float) + start_phase)


def cloud(radius, phase, breathing, start_phase=0.0):
    """Return the density of matter eta(r; t) / n of eq. (31a)."""
    variance = swelling(phase, breathing, start_phase)
    return np.exp(-0.5 * np.asarray(radius) ** 2 / variance) / (2.0 * math.pi * variance) ** 1.5


def flow(radius, phase, breathing, start_phase=0.0):
    """Return the radial flow velocity v(r; t) of eq. (31b)."""
    phi = 2.0 * np.asarray(phase, dtype=float) + start_phase
    return breathing * np.cos(phi) / (1.0 + breathing * np.sin(phi)) * np.asarray(radius)


def thermal_speed(phase, breathing, start_phase=0.0):
    """Return c_q(t), the RMS thermal velocity per axis of eq. (31c)."""
    return np.sqrt((1.0 - breathing**2) / swelling(phase, breathing, start_phase))


def energies(phase, breathing, start_phase=0.0):
    """Return (thermal, potential, flow) energy per particle; their sum is always 3 c_eq**2."""
    phi = 2.0 * np.asarray(phase, dtype=float) + start_phase
    size = swelling(phase, breathing, start_phase)
    thermal, potential = 1.5 * (1.0 - breathing**2) / size, 1.5 * size
    return thermal, potential, 1.5 * breathing**2 * np.cos(phi) ** 2 / size


def breathing_density(radius, radial, tangential, phase, breathing, start_phase=0.0):
    """Return f(r; c; t) of the breathing state, eq. (31), for a velocity by its components."""
    width = thermal_speed(phase, breathing, start_phase)
    gap = (radial - flow(radius, phase, breathing, start_phase)) ** 2 + np.square(tangential)
    bell = np.exp(-0.5 * gap / width**2) / (math.sqrt(2.0 * math.pi) * width) ** 3
    return cloud(radius, phase, breathing, start_phase) * bell


def ballistic(radius, radial, tangential, phase):
    """Return (r, radial, tangential) at time 0 of the free trajectory through a point."""
    cos, sin = np.cos(phase), np.sin(phase)
    along, across = radius * cos - radial * sin, -tangential * sin
    speed_along, speed_across = radial * cos + radius * sin, tangential * cos
    there = np.hypot(along, across)
    safe = np.where(there > 0.0, there, 1.0)
    inward = (along * speed_along + across * speed_across) / safe
    turning = np.abs(along * speed_across - across * speed_along) / safe
    still = np.hypot(speed_along, speed_across)
    return there, np.where(there > 0.0, inward, still), np.where(there > 0.0, turning, 0.0)


def relative_start(radius, radial, tangential, breathing, start_phase=0.0):
    """Return f(r; c; 0) / breathing state: the BKW mode at maximal disequilibrium, eq. (18)."""
    width = thermal_speed(0.0, breathing, start_phase)
    gap = (radial - flow(radius, 0.0, breathing, start_phase)) ** 2 + np.square(tangential)
    s = gap / width**2
    return 5.0 / 9.0 * (5.0 / 3.0) ** 1.5 * s * np.exp(-s / 3.0)


def ballistic_density(radius, radial, tangential, phase, breathing, start_phase=0.0):
    """Return f(r; c; t) without collisions: the BKW start carried along free trajectories."""
    start = ballistic(radius, radial, tangential, phase)
    now = breathing_density(radius, radial, tangential, phase, breathing, start_phase)
    return now * relative_start(*start, breathing, start_phase)


def free_shape(phase, breathing, start_phase=0.0):
    """Return K of the cloud without collisions: its density is eq. (7a) of r, of this shape.

    r = r0 (cos + v sin) + w sin of the phase, with r0 normal, v r0 the flow at the start and w of
    the BKW law of shape 3/5; the variance per axis is that of eq. (31).
    """
    across = thermal_speed(0.0, breathing, start_phase) * np.sin(phase)
    return 1.0 - 0.4 * across**2 / swelling(phase, breathing, start_phase)


def free_relative_cloud(radius, phase, breathing, start_phase=0.0):
    """Return the density of matter without collisions over that of eq. (31a)."""
    square = np.asarray(radius) ** 2 / swelling(phase, breathing, start_phase)
    return bkw.relative_of_shape(square, free_shape(phase, breathing, start_phase))


def fraction(radius, phase, breathing, start_phase=0.0, shape=1.0):
    """Return the share of the matter beyond a radius: of eq. (31a), or of the shape of another."""
    size = np.sqrt(swelling(phase, breathing, start_phase))
    return bkw.fraction_of_shape(np.asarray(radius, dtype=float) / size, shape)


def majorant(radius, phase, coupling, breathing, start_phase=0.0):
    """Return the raised frequency of eq. (36), in omega."""
    return MAJORANT * coupling * cloud(radius, phase, breathing, start_phase)


def highest_majorant(breathing, coupling):
    """Return the inner majorant of eq. (39), in omega."""
    return MAJORANT * coupling / (math.sqrt(2.0 * math.pi) * math.sqrt(1.0 - breathing)) ** 3


def constant_recursion(phase, rate):
    """Return the mean recursion of Algorithm 6 with a constant raised frequency: four calls each.

    rec' = 3 rate rec + rate, rec(0) = 1.
    """
    return (4.0 * np.exp(3.0 * rate * np.asarray(phase, dtype=float)) - 1.0) / 3.0
