"""Maxwell molecules for the plain-Python twins of the algorithms: velocities of three components.

The law is that of the chapters on collisions: the mean velocity of a pair stays, half the relative
speed gets a uniform direction. A Gamma(5/2) variate is the sum of a Gamma(3/2) and an exponential.
"""

import math

import numpy as np
import variate_twins

from kacsim import variates as random


def point(height, cos, sin):
    """Return the point of a sphere over that of a circle, at a height."""
    return np.array([*(math.sqrt(1 - height**2) * np.array([cos, sin])), height])


def height(stream):
    return 2 * random.uniform(stream) - 1


def points(n, stream):
    """Return n points on the sphere: all heights, then all angles."""
    heights = [height(stream) for _ in range(n)]
    return [point(one, *random.unit_circle(stream)) for one in heights]


def scattered(a, b, direction):
    """Return the velocities of a pair that leaves along a direction."""
    turned = np.linalg.norm(a - b) / 2 * direction
    return (a + b) / 2 + turned, (a + b) / 2 - turned


class Forward:
    """One particle, one collision at a time."""

    @staticmethod
    def start(stream):
        speed = math.sqrt(1.2 * (random.maxwell_speed(stream) ** 2 + random.exponential(stream)))
        return speed * point(height(stream), *random.unit_circle(stream))

    @staticmethod
    def collided(a, b, stream):
        return scattered(a, b, point(height(stream), *random.unit_circle(stream)))


class Ancestral:
    """All ancestors, then all collisions of a batch."""

    @staticmethod
    def starts(n, stream):
        squares = variate_twins.energies(n, stream)
        squares = [square + random.exponential(stream) for square in squares]
        directions = points(n, stream)
        return [math.sqrt(1.2 * s) * one for s, one in zip(squares, directions, strict=True)]

    inputs = staticmethod(points)
    collided = staticmethod(scattered)

    @staticmethod
    def value(velocity, stream):
        return velocity
