"""Plain-Python twins of McKean's trees: recursion, complex arithmetic, a finer and longer contour.

The trees take the same variates in the same order. What is made of one, the values of its leaves
integrated out or not, is written from the formulas in complex numbers and with scipy's functions.
"""

import cmath
import math
import warnings
from typing import NamedTuple

import numpy as np
from scipy import integrate, optimize

from kacsim import variates as random


class Law(NamedTuple):
    """One component's initial law (its density and its transform) and how a share splits."""

    moment: float  # E[U (1 - U)]
    excess: float  # beta: the transform is exp(ell z**2) (1 + beta z**2)
    ell: float
    density: object
    is_bkw: bool


def bkw_density(x):
    return math.exp(-x * x / 1.2) / math.sqrt(1.2 * math.pi) * (2.0 / 3.0 + 5.0 / 9.0 * x * x)


def kac_density(x):
    return 2.0 / math.sqrt(math.pi) * x * x * math.exp(-x * x)


BKW = Law(1.0 / 6.0, 0.2, 0.3, bkw_density, True)
KAC = Law(1.0 / 8.0, 0.5, 0.25, kac_density, False)


def log_transform(law, eta, time):
    """Return log E exp(eta v_1(t))."""
    b, left = law.excess * eta * eta, math.exp(-law.moment * time)
    return law.ell * eta * eta + b * (1.0 - left) + math.log1p(b * left)


def saddle(law, v, time):
    """Return where the derivative of the logarithm is v."""
    if v == 0.0:
        return 0.0
    left = math.exp(-law.moment * time)
    beta = law.excess * left

    def slope(eta):
        drift = 2.0 * eta * (law.ell + law.excess * (1.0 - left))
        return drift + 2.0 * beta * eta / (1.0 + beta * eta * eta) - v

    return optimize.brentq(slope, 0.0, v / (2.0 * law.ell) + 1e-9, xtol=1e-15)


def part_of(law, share, left, candidate, b, stream):
    if candidate < 1.0:
        return candidate if law.is_bkw else random.squared_cosine(stream)
    x = b * share * math.exp(-law.moment * left)
    if (candidate - 1.0) * (1.0 + x) >= law.moment * x * x:
        return None
    if law.is_bkw:
        return sorted(random.uniform(stream) for _ in range(3))[1]
    cos, _ = random.unit_circle(stream)
    return (1.0 + cos * math.sqrt(random.uniform(stream))) / 2.0


def rate_of(law, share, b):
    most = b * share
    return 1.0 + law.moment * most * most / (1.0 + most)


def ends(law, share, left, b, cut, stream):
    """Give the ends of a subtree: (share, time still to go) each, as they are reached."""
    rate = rate_of(law, share, b)
    while share >= cut:
        left -= random.exponential(stream) / rate
        if left <= 0.0:
            yield share, 0.0
            return
        part = part_of(law, share, left, random.uniform(stream) * rate, b, stream)
        if part is not None:
            yield from ends(law, share * part, left, b, cut, stream)
            yield from ends(law, share - share * part, left, b, cut, stream)
            return
    yield share, left


def split_tree(law, time, b, cut, stream):
    """Return the ends of a whole tree that splits at least once."""
    rate = rate_of(law, 1.0, b)
    while True:
        left = time + math.log1p(random.uniform(stream) * math.expm1(-rate * time)) / rate
        while left > 0.0:
            part = part_of(law, 1.0, left, random.uniform(stream) * rate, b, stream)
            if part is not None:
                first = list(ends(law, part, left, b, cut, stream))
                return first + list(ends(law, 1.0 - part, left, b, cut, stream))
            left -= random.exponential(stream) / rate


def weight_at(quantity, v, z):
    """Return F(z) exp(-z v)."""
    if quantity == "shell" and v == 0.0:
        return -z * z / (2.0 * math.pi)
    factor = {
        "density": 1.0, "tail": 1.0 / z, "beyond": 2.0 / z + 2.0 * v,
        "shell": z / (2.0 * math.pi * v) if v else 0.0,
    }[quantity]  # fmt: skip
    return factor * cmath.exp(-z * v)


def of_tree(law, quantity, v, found, b, eta):
    """Return the quantity that a tree gives, over its tilt's density, by a contour."""
    omega = 0.25 * np.arange(101)
    z = eta + 1j * omega
    total = np.exp(law.ell * z * z)
    for share, left in found:
        kept = share * math.exp(-law.moment * left)
        square = law.excess * z * z
        total = total * (1.0 + square * kept) / (1.0 + b * kept)
        total = total * np.exp((square - b) * (share - kept))
    values = [weight_at(quantity, v, one) for one in z]
    return 0.25 / math.pi * (total * values * np.where(omega == 0.0, 0.5, 1.0)).real.sum()


def ancestral(law, quantity, v, time, cut, stream):
    """Return (realization, ends) of the method whose leaves are integrated out."""
    tilt = saddle(law, v, time)
    b, eta = law.excess * tilt * tilt, max(tilt, 2.0)
    least = cut / (law.excess * eta * eta)
    mean = math.exp(log_transform(law, tilt, time) - law.ell * tilt * tilt)
    if least > 1.0:
        found = list(ends(law, 1.0, time, b, least, stream))
        return mean * of_tree(law, quantity, v, found, b, eta), len(found)
    chance = math.exp(-time) * (1.0 + b) / mean
    known = of_tree(law, quantity, v, [(1.0, 0.0)], b, eta)
    found = split_tree(law, time, b, least, stream)
    drawn = of_tree(law, quantity, v, found, b, eta)
    return mean * (chance * known + (1.0 - chance) * drawn), len(found)


def last_leaf(law, quantity, v, rest, share):
    """Return the quantity for a sum of `rest` and the last leaf, by quadrature or differences."""
    a = math.sqrt(share)
    y = (v - rest) / a
    if quantity == "density":
        return law.density(y) / a
    if quantity in ("tail", "beyond"):
        tail = integrate.quad(law.density, y, max(y, 0.0) + 14.0, epsabs=0.0, limit=200)[0]
        return tail if quantity == "tail" else 2.0 * tail + 2.0 * v * law.density(y) / a
    step = 1e-3
    f = [law.density(y + k * step) for k in (-2, -1, 1, 2)]
    slope = (f[0] - 8.0 * f[1] + 8.0 * f[2] - f[3]) / (12.0 * step)
    return -slope / (share * 2.0 * math.pi * v)


def leaf_value(law, theta, stream):
    variance = 2.0 * law.ell
    square = 5.0 / 9.0 if law.is_bkw else 2.0
    constant = 2.0 / 3.0 if law.is_bkw else 0.0
    mean, deviation = variance * theta, math.sqrt(variance)
    second = mean * mean + variance
    if random.uniform(stream) * (constant + square * second) < constant:
        return mean + deviation * random.normal(stream)
    if random.uniform(stream) * second < mean * mean:
        part = deviation * random.normal(stream)
    else:
        part = deviation * math.sqrt(2.0) * random.maxwell_speed(stream)
    plus, minus = (mean + part) ** 2, (mean - part) ** 2
    return mean + part if random.uniform(stream) * (plus + minus) < plus else mean - part


def with_values(law, quantity, v, shares, eta, stream):
    """Return (quantity over exp(eta v_1) times the transforms of the leaves drawn, all shares).

    A leaf is drawn as soon as a larger one is known.
    """
    largest, rest, transforms, seen = 0.0, 0.0, 1.0, []
    for share in shares:
        seen.append(share)
        drawn, largest = min(share, largest), max(share, largest)
        if drawn > 0.0:
            a = math.sqrt(drawn)
            rest += a * leaf_value(law, eta * a, stream)
            transforms *= math.exp(law.ell * eta**2 * drawn) * (1.0 + law.excess * eta**2 * drawn)
    return transforms * math.exp(-eta * rest) * last_leaf(law, quantity, v, rest, largest), seen


def free_leaf(law, quantity, v, time, cut, stream):
    eta = saddle(law, v, time)
    b = law.excess * eta * eta
    shares = (share for share, _ in ends(law, 1.0, time, b, 0.0, stream))
    value, seen = with_values(law, quantity, v, shares, eta, stream)
    mean = math.exp(log_transform(law, eta, time) - law.ell * eta * eta)
    return value * mean / math.prod(1.0 + b * share for share in seen), len(seen)


def counted(law, share, n, stream):
    """Give the shares of n leaves of a native tree; the side with fewer leaves goes first."""
    if n == 1:
        yield share
        return
    one = 1 + random.index_below(n - 1, stream)
    part = random.uniform(stream)
    part = part if law.is_bkw else random.squared_cosine(stream)
    fewer = min(one, n - one)
    yield from counted(law, share * part, fewer, stream)
    yield from counted(law, share - share * part, n - fewer, stream)


def geometric(law, quantity, v, time, cut, stream):
    eta = saddle(law, v, time)
    x = law.excess * eta * eta * math.exp(-law.moment * time)
    native = math.exp(-time)
    p = 1.0 / (1.0 + math.expm1(time) * (1.0 + law.moment * x * x / (1.0 + x)))
    n = 1 + random.failures_before_success(random.gap_scale(p), stream)
    weight = native / p * ((1.0 - native) / (1.0 - p)) ** (n - 1)
    shares = counted(law, 1.0, n, stream)
    return weight * with_values(law, quantity, v, shares, eta, stream)[0], n


def exact(law, quantity, v, time):
    """Return the quantity by quadrature of the transform that log_transform is the logarithm of."""
    eta = max(saddle(law, v, time), 2.0)
    left = math.exp(-law.moment * time)

    def real(omega):
        z = eta + 1j * omega
        square = law.excess * z * z
        transform = cmath.exp(law.ell * z * z + square * (1.0 - left)) * (1.0 + square * left)
        return (transform * weight_at(quantity, v, z)).real

    with warnings.catch_warnings():  # the tolerance asks for more than rounding allows
        warnings.simplefilter("ignore", integrate.IntegrationWarning)
        return integrate.quad(real, 0.0, 30.0, epsabs=0.0, epsrel=1e-12, limit=400)[0] / math.pi
