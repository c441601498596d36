"""The Kac equation solved for any symmetric initial law: density and tail, no draw.

As `kacsim.boltzmann.reference`, on a line: the velocity is the component itself, and a collision
shares the squares as the squared cosine of a uniform angle, the only law of the angle here.
"""

import numpy as np

from kacsim.boltzmann.transform import check, everywhere, invert, squared_cosine_share
from kacsim.checks import positive, raise_problems
from kacsim.kac.constants import RATE


def density(law, v, time, collision_rate=RATE, tilt=None):
    """Return f(v, t), the density at one velocity.

    Parameters
    ----------
    law : the law at time 0: an object whose mgf(z) returns E exp(z v) for complex arrays z
    v : float or array of velocities
    time : float >= 0, t of the Kac paper
    tilt : as for `kacsim.boltzmann.reference.density`

    Raises
    ------
    ValueError
        As `kacsim.boltzmann.reference.density`.
    """
    raise_problems(positive("collision_rate", collision_rate))
    speed = np.abs(v)
    check(law, time, v=speed)
    share, own = squared_cosine_share, collision_rate * time
    return everywhere(speed, lambda x: invert(law, x, own, share, np.ones_like, tilt)[0])


def tail(law, v, time, collision_rate=RATE):
    """Return P(V > v), without cancellation in the upper tail; arguments as `density`."""
    raise_problems(positive("collision_rate", collision_rate))
    check(law, time, v=np.abs(v))
    share, own = squared_cosine_share, collision_rate * time

    def one(x):
        above = invert(law, abs(x), own, share, lambda z: 1.0 / z)[0]
        return above if x >= 0.0 else 1.0 - above

    return everywhere(v, one)
