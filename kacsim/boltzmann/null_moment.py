"""The second moment of Algorithm 6 in a uniform gas (Boltzmann paper, sections III to V).

A collision at the raised frequency makes W = W1 + a (W3 W4 - W1 W2) of four independent estimates,
a = kappa eta / raised frequency: W1 and W2 at the pair's velocities, W3 and W4 after it. With c and
c* drawn from M, so are the two velocities after it, and the mean of W is h = f / M. Hence
G = E_M[W**2] obeys, t in mean collision times 1 / (kappa eta),

    G' = -2 G + 2 a G**2 + 2 chi(t),  chi = E_M[(1 - a h(c*)) h(c) h(c') h(c'*)],

and, where h = 1, it tends to 1 if a < 1/2 and starts below (1 - a) / a, but grows without bound
from above it. Velocities are in c_q.
"""

import functools
import math

import numpy as np
from scipy import integrate, interpolate, optimize, special

from kacsim.boltzmann import bkw

RADIAL, COSINES = 48, 40  # nodes of the means over speeds and over directions
LARGE = 1e8  # of a moment that counts as infinite
LATEST = 60.0  # collision times after which h is 1


@functools.cache
def _quadrature():
    """Return what a pair's energies are averaged over: half the sum, half the difference, weights.

    With P, Q = (c +- c*) / sqrt(2), independent Maxwellians, c**2 and c*'**2 are
    (P**2 + Q**2) / 2 +- |P| |Q| mu, mu uniform before and, independently, after the collision.
    """
    level, weight = special.roots_genlaguerre(RADIAL, 0.5)  # of a Gamma(3/2) variate
    weight = weight / weight.sum()
    first, second = np.meshgrid(level, level, indexing="ij")
    middle = first + second
    cosine, w_cosine = np.polynomial.legendre.leggauss(COSINES)
    reach = 2.0 * np.sqrt(first * second)[..., None] * cosine
    return middle[..., None], reach, np.outer(weight, weight), 0.5 * w_cosine


def correlations(time):
    """Return (E[h h' h'*], E[h h* h' h'*]) over pairs of M: chi is their difference, a times."""
    middle, reach, pair, cosine = _quadrature()
    shape = bkw.shape(time)
    above, below = (bkw.relative_of_shape(middle + r, shape) for r in (reach, -reach))
    one, both = above @ cosine, (above * below) @ cosine
    return float((pair * one * both).sum()), float((pair * both * both).sum())


@functools.cache
def _tables():
    """Return both correlations against exp(-t / 6), as interpolating functions."""
    left = 0.5 - 0.5 * np.cos(math.pi * np.arange(25) / 24.0)
    # Of such points in closed form: scipy would multiply the distances in a random order.
    weights = (-1.0) ** np.arange(25)
    weights[[0, -1]] *= 0.5
    values = np.array([correlations(-6.0 * math.log(max(one, 1e-300))) for one in left])
    return [interpolate.BarycentricInterpolator(left, column, wi=weights) for column in values.T]


def chi(time, ratio):
    """Return chi(t) for a raised frequency of `ratio` kappa eta."""
    left = math.exp(-time / 6.0)
    first, second = (float(table(left)) for table in _tables())
    return first - second / ratio


def second_moment(times, ratio):
    """Return G at times, float64[...]; infinite from `critical_time` on.

    Parameters
    ----------
    times : >= 0, in mean collision times
    ratio : raised frequency over kappa eta, > 0
    """
    times = np.asarray(times, dtype=float)
    solved = _solved(float(ratio), max(LATEST, float(times.max())))
    end = solved.t[-1] if solved.status == 1 else math.inf
    inside = np.minimum(times, solved.t[-1])
    inverse = solved.sol(inside.ravel())[0].reshape(times.shape)
    return np.divide(1.0, inverse, out=np.full(times.shape, math.inf), where=times < end)


def critical_time(ratio):
    """Return the time from which the variance is infinite; inf from `safe_ratio` on."""
    solved = _solved(float(ratio), LATEST)
    return float(solved.t_events[0][0]) if solved.status == 1 else math.inf


@functools.lru_cache(maxsize=256)
def _solved(ratio, latest):
    """Solve for 1 / G, which passes through 0 where G is infinite: r' = 2 r - 2 a - 2 chi r**2."""

    def change(time, inverse):
        return 2.0 * inverse - 2.0 / ratio - 2.0 * chi(time, ratio) * inverse**2

    def vanishes(_, inverse):
        return inverse[0]

    vanishes.terminal = True
    start = [1.0 / bkw.INITIAL_SECOND_MOMENT]
    return integrate.solve_ivp(
        change, (0.0, latest), start, "DOP853", events=vanishes, rtol=1e-10, atol=1e-13,
        dense_output=True,
    )  # fmt: skip


@functools.cache
def safe_ratio():
    """Return the least ratio for which the variance stays finite for ever."""
    low, high = 2.0, 2.5
    while high - low > 1e-6:
        middle = 0.5 * (low + high)
        lasts = math.isinf(critical_time(middle))
        low, high = (low, middle) if lasts else (middle, high)
    return high


def mean_calls(time, ratio):
    """Return the mean number of t' drawings of one tree: four calls at each collision."""
    return (4.0 * np.exp(3.0 * ratio * np.asarray(time, dtype=float)) - 1.0) / 3.0


def best_ratio(time):
    """Return (ratio, calls times variance) that make the least work for a given error."""

    def work(ratio):
        excess = float(second_moment(time, ratio)) - float(bkw.mean_square(time))
        return math.log(float(mean_calls(time, ratio)) * excess) if excess < LARGE else 1e3

    found = optimize.minimize_scalar(work, bounds=(1.0, 3.0), method="bounded")
    return float(found.x), math.exp(float(found.fun))


def fourth_moment_time(ratio):
    """Return about the time from which E_M[W**4] is infinite, the velocities' part left out.

    As if the four estimates of a collision did not know its velocities: exact where h = 1, and an
    upper bound where a velocity makes all four large together.
    """
    a = 1.0 / ratio

    def change(_, g):
        g2, g3, g4 = g
        x = (
            1.0 - a,
            g2 * (1.0 - 2.0 * a + a**2 * g2),
            g3 * (1.0 - 3.0 * a + 3.0 * a**2 * g2 - a**3 * g3),
            g4 * (1.0 - 4.0 * a + 6.0 * a**2 * g2 - 4.0 * a**3 * g3 + a**4 * g4),
        )
        y = (a, (a * g2) ** 2, a**3 * g3**2, (a * a * g4) ** 2)
        second = x[1] + 2.0 * x[0] * y[0] + y[1]
        third = x[2] + 3.0 * x[1] * y[0] + 3.0 * x[0] * y[1] + y[2]
        fourth = x[3] + 4.0 * x[2] * y[0] + 6.0 * x[1] * y[1] + 4.0 * x[0] * y[2] + y[3]
        return [ratio * (new - old) for new, old in zip((second, third, fourth), g, strict=True)]

    def explodes(_, g):
        return g[2] - LARGE

    explodes.terminal = True
    start = [bkw.power_moment(float(power)) for power in (2, 3, 4)]
    found = integrate.solve_ivp(change, (0.0, LATEST), start, events=explodes, rtol=1e-8)
    return float(found.t[-1]) if found.status == 1 else math.inf
