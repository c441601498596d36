"""Estimates from initial laws without a closed form, against the equation of the transform.

The reference is deterministic: the equation of E exp(z v_1), solved along rays at complex z, and an
integral through the saddle point (`kacsim.boltzmann.transform`), to 1e-10.
"""

import functools
import math

import numpy as np
import pytest
from law.compare import caught, ok, scaled
from law.realizations import z_of

from kacsim import boltzmann, kac
from kacsim.boltzmann import transform

N = 3000
TWO = boltzmann.Mixture(((0.5, (0.6,)), (1.75, (0.4,))))
RING = boltzmann.Transform(lambda z: np.cosh(1.2 * z) * np.exp(0.2 * z * z))


FACTORS = {"density": lambda z: 1.0 + 0.0 * z, "tail": lambda z: 1.0 / z, "slope": lambda z: z}


@functools.cache
def exact(quantity, law, v, time, share):
    """Return the density of a component, its tail or minus its derivative."""
    return transform.invert(law, v, time, share, FACTORS[quantity])[0]


def fraction(speed, time):
    parts = (exact(one, TWO, speed, time, transform.uniform_share) for one in ("tail", "density"))
    tail, density = parts
    return 2.0 * tail + 2.0 * speed * density


@pytest.mark.parametrize("cut", [0.0, 0.5])
@pytest.mark.parametrize("speed", [1.1, 5.3])
def test_two_temperatures(speed, cut, seed):
    """8 z: the density at a speed and the fraction beyond it, t = 1.7."""
    options = {"initial": TWO, "n_realizations": scaled(N), "seed": seed, "cut": cut}
    one = boltzmann.estimate_relaxation(speed, 1.7, **options)
    slope = exact("slope", TWO, speed, 1.7, transform.uniform_share)
    assert ok(z_of(one, slope / (2.0 * math.pi * speed)))
    beyond = boltzmann.estimate_relaxation_fraction(speed, 1.7, **options)
    assert ok(z_of(beyond, fraction(speed, 1.7)))
    # Negative control: twice the time.
    assert caught(z_of(beyond, fraction(speed, 3.4)))


@pytest.mark.parametrize("cut", [0.0, 0.5])
@pytest.mark.parametrize("v", [0.4, 4.1])
def test_two_speeds_on_the_line(v, cut, seed):
    """8 z: the density at v and the tail beyond it, rate 0.9, t = 1.7."""
    options = {"initial": RING, "n_realizations": scaled(N), "seed": seed, "cut": cut}
    share, span = transform.squared_cosine_share, 0.9 * 1.7
    one = kac.estimate_relaxation(-v, 1.7, collision_rate=0.9, **options)
    assert ok(z_of(one, exact("density", RING, v, span, share)))
    beyond = kac.estimate_relaxation_tail(v, 1.7, collision_rate=0.9, **options)
    assert ok(z_of(beyond, exact("tail", RING, v, span, share)))
    assert caught(z_of(beyond, exact("tail", RING, v, 2.0 * span, share)))
