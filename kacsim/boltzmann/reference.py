"""The Boltzmann equation solved for any isotropic initial law: density and fraction, no draw.

Maxwell molecules with isotropic scattering, uniform gas, time in mean collision times. One
component has the moment generating function of `kacsim.boltzmann.transform`, density g and upper
tail G; the density of the velocity is -g'(c) / (2 pi c), and the fraction of particles that are
faster than c is 2 G(c) + 2 c g(c). The relative error is 1e-10 or less, however small the value.
"""

import math

from kacsim.boltzmann.transform import check, everywhere, invert, uniform_share


def density(law, speed, time, tilt=None):
    """Return f(c; t), per unit of velocity cubed.

    Parameters
    ----------
    law : the law at time 0: an object whose mgf(z) returns E exp(z x), x one component of the
        velocity, for complex arrays z
    speed : float or array of |c| >= 0
    time : float >= 0, in mean collision times
    tilt : real part of the contour, by default through the saddle point; 0 is the plain Fourier
        inversion, whose digits are lost where f falls below 1e-15 of its largest value

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed; a law whose mgf is infinite, or is not
        computed, where the tail needs it, or so uneven that a relative error of 1e-8 is not kept.
    """
    check(law, time, speed=speed)

    def one(c):
        def factor(z):
            return z / (2.0 * math.pi * c) if c > 0.0 else -(z**2) / (2.0 * math.pi)

        return invert(law, c, time, uniform_share, factor, tilt)[0]

    return everywhere(speed, one)


def fraction(law, threshold, time):
    """Return the fraction of particles with |c| > threshold; arguments as `density`."""
    check(law, time, threshold=threshold)

    def one(c):
        return invert(law, c, time, uniform_share, lambda z: 2.0 / z + 2.0 * c)[0]

    return everywhere(threshold, one)
