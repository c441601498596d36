"""Exact results on the BKW mode and on the estimators that probe it (Boltzmann paper, section II).

Velocities are in units of the RMS velocity per axis c_q, time in mean collision times, unless a
function takes `rms_velocity`. M is the Maxwellian of RMS velocity c_q, and s = c**2 / c_q**2.
"""

import math

import numpy as np
from scipy import integrate, optimize, special


def shape(time):
    """Return K(t) = 1 - 2/5 exp(-t/6) of eq. (7)."""
    return 1.0 - 0.4 * np.exp(-np.asarray(time, dtype=float) / 6.0)


def maxwellian(speed, rms_velocity=1.0):
    """Return the density M(c) of the equilibrium, per unit of velocity cubed."""
    s = (np.asarray(speed, dtype=float) / rms_velocity) ** 2
    return np.exp(-0.5 * s) / (math.sqrt(2.0 * math.pi) * rms_velocity) ** 3


def relative_density(speed, time, rms_velocity=1.0):
    """Return f(c; t) / M(c) of the BKW mode, eq. (7)."""
    s = (np.asarray(speed, dtype=float) / rms_velocity) ** 2
    return relative_of_shape(s, shape(time))


def relative_of_shape(s, k):
    """Return f / M of eq. (7a) at s = c**2 / c_q**2 for any shape 3/5 <= K <= 1."""
    polynomial = (5.0 * k - 3.0) / k + (1.0 - k) / k**2 * s
    return 0.5 * k**-1.5 * polynomial * np.exp(-0.5 * s * (1.0 / k - 1.0))


def density(speed, time, rms_velocity=1.0):
    """Return f(c; t), eq. (7); arrays broadcast.

    Parameters
    ----------
    speed : |c| >= 0, in the unit of rms_velocity
    time : >= 0, in mean collision times
    rms_velocity : c_q, per axis
    """
    return relative_density(speed, time, rms_velocity) * maxwellian(speed, rms_velocity)


def fraction(threshold, time, rms_velocity=1.0):
    """Return the fraction of particles with |c| > threshold, without cancellation.

    The integral of 4 pi c**2 f is Q(y) + (1 - K)/(2 K) sqrt(2/pi) y**3 exp(-y**2/2) with
    y = c0 / (sqrt(K) c_q) and Q the Maxwellian's own fraction.
    """
    return fraction_of_shape(np.asarray(threshold, dtype=float) / rms_velocity, shape(time))


def fraction_of_shape(threshold, k):
    """Return the fraction of eq. (7a) beyond c0 / c_q for any shape 3/5 <= K <= 1."""
    y = threshold / np.sqrt(k)
    bell = math.sqrt(2.0 / math.pi) * np.exp(-0.5 * y**2)
    maxwell = special.erfc(y / math.sqrt(2.0)) + bell * y
    return maxwell + (1.0 - k) / (2.0 * k) * bell * y**3


def change(speed, time):
    """Return the time derivative of f(c; t), c_q = 1, by dK/dt = (1 - K) / 6."""
    s, k = np.asarray(speed, dtype=float) ** 2, shape(time)
    polynomial = (5.0 * k - 3.0) / k + (1.0 - k) / k**2 * s
    slope = polynomial * (0.5 * s / k**2 - 1.5 / k) + 3.0 / k**2 + s * (k - 2.0) / k**3
    bell = 0.5 * (2.0 * math.pi * k) ** -1.5 * np.exp(-0.5 * s / k)
    return bell * slope * (1.0 - k) / 6.0


def gain(speed, time, n_nodes=40):
    """Return the source sis(c; t) of eq. (8b) at one speed, c_q = 1, by Gaussian quadrature.

    Over z, the component of c* along c, e, half the square of the others, and mu, the component of
    u' along c - c*, with c'**2 and c'***2 as in `kacsim.boltzmann.model.bkw_scatter`.
    """
    radial, w_radial = np.polynomial.hermite_e.hermegauss(n_nodes)
    level, w_level = np.polynomial.laguerre.laggauss(n_nodes)
    cosine, w_cosine = np.polynomial.legendre.leggauss(n_nodes)
    z, e, mu = np.meshgrid(radial, level, cosine, indexing="ij")
    weight = w_radial[:, None, None] * w_level[:, None] * w_cosine / math.sqrt(8.0 * math.pi)
    total = speed**2 + z**2 + 2.0 * e
    reach = mu * np.sqrt(np.maximum(0.0, total**2 - 4.0 * (speed * z) ** 2))
    first, second = (relative_of_shape((total + r) / 2.0, shape(time)) for r in (reach, -reach))
    return float(maxwellian(speed) * (weight * first * second).sum())


def mean_recursion(time, oversampling=1.0, onset=0.0):
    """Return the mean number of t' drawings of one estimate, eq. (15) for oversampling 1.

    With 2 m sub-estimates behind each collision, N' = (2 m - 1) N + 1 and N(0) = 1.
    """
    time = np.asarray(time, dtype=float)
    growth = 2.0 * oversampling - 1.0
    early = 2.0 * np.exp(np.minimum(onset, time)) - 1.0
    late = np.exp(growth * np.maximum(0.0, time - onset))
    return late * early + (late - 1.0) / growth


def mean_square(time):
    """Return H(t) = E_M[(f / M)**2], the second moment that no estimator can go below."""
    k = shape(time)
    a = 1.0 / k - 1.0
    zero, one = (5.0 * k - 3.0) / k, (1.0 - k) / k**2
    width = 1.0 + 2.0 * a
    moments = zero**2 + 6.0 * zero * one / width + 15.0 * one**2 / width**2
    return 0.25 * k**-3 * width**-1.5 * moments


INITIAL_SECOND_MOMENT = float(mean_square(0.0))  # G(0), 1.10452


def critical_time():
    """Return t* = log(G(0) / (G(0) - 1)), from which the variance is infinite (2.358)."""
    return math.log(INITIAL_SECOND_MOMENT / (INITIAL_SECOND_MOMENT - 1.0))


def second_moment(time):
    """Return G(t) = E_M[(F / M)**2] of Algorithm 2, infinite from `critical_time` on.

    With c drawn from M the two velocities after a collision are again independent Maxwellians,
    so that G' = -G + G**2.
    """
    time = np.asarray(time, dtype=float)
    denominator = 1.0 - (1.0 - 1.0 / INITIAL_SECOND_MOMENT) * np.exp(time)
    with np.errstate(divide="ignore"):
        return np.where(denominator > 0.0, 1.0 / denominator, np.inf)


def mean_inverse(oversampling):
    """Return E[1/N] of the number N of sub-estimates, floor(m) or one more, of mean m."""
    whole = math.floor(oversampling)
    more = oversampling - whole
    return (1.0 - more) / whole + more / (whole + 1.0)


def power_moment(power):
    """Return E_M[h**p] of h = f(.; 0) / M, for p > -3/2."""
    gammas = math.gamma(power + 1.5) / math.gamma(1.5)
    spread = (1.0 + 2.0 * power / 3.0) ** -(power + 1.5)
    return (5.0 / 9.0 * (5.0 / 3.0) ** 1.5 * 2.0) ** power * gammas * spread


def tail_index(time):
    """Return the largest p for which E_M[(F / M)**p] of Algorithm 2 is finite at a time.

    Every power of the product over the leaves obeys G_p' = -G_p + G_p**2, so that it diverges at
    log(G_p(0) / (G_p(0) - 1)); the index is 2 at `critical_time`.
    """
    threshold = 1.0 / -math.expm1(-time)
    return optimize.brentq(lambda p: power_moment(p) - threshold, 1.0 + 1e-9, 60.0)


def second_moment_oversampled(time, oversampling, onset=0.0):
    """Return G(t) when each sub-estimate is a mean of N, by its differential equation.

    G' = -G + (H + (G - H) E[1/N])**2: the mean of N independent estimates of second moment G and
    mean square H has the second moment H + (G - H)/N.

    Parameters
    ----------
    time : float >= 0
    oversampling, onset : m >= 1, used by collisions later than onset
    """
    moment = INITIAL_SECOND_MOMENT
    for start, stop, m in ((0.0, min(onset, time), 1.0), (onset, time, oversampling)):
        if stop > start and math.isfinite(moment):
            moment = _grow(moment, start, stop, mean_inverse(m))
    return moment


def critical_time_oversampled(oversampling, latest=60.0):
    """Return the time from which the variance is infinite with oversampling; inf if not so soon."""
    if math.isfinite(second_moment_oversampled(latest, oversampling)):
        return math.inf
    early = 0.0
    while latest - early > 1e-9:
        middle = 0.5 * (early + latest)
        finite = math.isfinite(second_moment_oversampled(middle, oversampling))
        early, latest = (middle, latest) if finite else (early, middle)
    return early


def _grow(moment, start, stop, kept):
    """Integrate G' over a span; infinite if G explodes."""

    def change(t, g):
        h = mean_square(t)
        return -g + (h + (g - h) * kept) ** 2

    def explodes(_, g):
        return g[0] - 1e6

    explodes.terminal = True
    found = integrate.solve_ivp(
        change, (start, stop), [moment], events=explodes, rtol=1e-9, atol=1e-12
    )
    return math.inf if found.status == 1 else float(found.y[0, -1])
