"""Laws of Maxwell molecules and of Kac's gas at any time, by their moment generating function.

One component of a velocity at time t is a sum of a_i x_i over the leaves of McKean's tree, so that
M(z, t) = E exp(z x) depends on y = z**2 alone for a symmetric law, and phi(y, t) = M(sqrt(y), t)
obeys d phi(y) / dt = -phi(y) + E[phi(U y) phi((1 - U) y)], t in mean collision times. U is uniform
for isotropic scattering in three dimensions, and a squared cosine of a uniform angle on Kac's line.
The right-hand side at y reads phi on the segment from 0 to y only: on each ray the equation is
closed, at complex y too. It is solved there by collocation, and the law follows from an integral
along z = eta + i omega through the saddle point, where nothing cancels, however far the tail is.
"""

import functools
import math

import numpy as np
from scipy import integrate

from kacsim import checks

DEGREES = (24, 40, 64, 96, 144)  # of the polynomials along a ray, tried in turn
TOLERANCE = 1e-11  # of what they leave out, relative to the integrand at the saddle point
GROUP = 12  # rays solved together
SPAN = 2.0  # after which the slope along the ray is taken out anew
PRECISION = {"rtol": 1e-11, "atol": 1e-12}
SMALL = 1e-3  # square of the end of a ray below which its slope is left alone
LENGTH = 11.0  # period of the inverted law, in standard deviations of the tilted one
LEAST = 4.0  # logarithm of M up to which a contour near the middle of the law is tilted
RESOLVED = 1e-8  # relative error above which a value is refused
NEGLIGIBLE = 1e-16  # of the integrand at its largest
MOST_NODES = 4000


def uniform_share(n):
    """Return n nodes and weights on [0, 1/2] of E[s(U, 1 - U)], U uniform and s symmetric.

    Exact for polynomials of a degree below 4 n, as the other one.
    """
    nodes, weights = np.polynomial.legendre.leggauss(2 * n)
    return 0.5 * (nodes[:n] + 1.0), weights[:n]


def squared_cosine_share(n):
    """Return nodes and weights on [0, 1/2] of E[s(U, 1 - U)], U = cos(theta)**2."""
    return np.sin(math.pi * (2.0 * np.arange(n) + 1.0) / (8.0 * n)) ** 2, np.full(n, 1.0 / n)


@functools.cache
def collocation(share, degree):
    """Return points float64[n] on [0, 1] and what the collision term needs at them.

    Returns
    -------
    points : float64[n], Chebyshev points from 0 to 1, n = degree + 1
    reading : float64[2 q, n, n], which interpolates at U and at 1 - U times each point
    weights : float64[q]
    """
    angles = math.pi * np.arange(degree + 1) / degree
    points = np.sin(0.5 * angles) ** 2
    nodes, weights = share(degree // 2 + 1)
    wanted = np.concatenate([nodes, 1.0 - nodes])[:, None] * points
    return points, interpolation(points, wanted.ravel()).reshape(*wanted.shape, -1), weights


def interpolation(points, wanted):
    """Return the matrix that interpolates from Chebyshev points, float64[wanted.size, n]."""
    signs = (-1.0) ** np.arange(points.size)
    signs[[0, -1]] *= 0.5
    with np.errstate(divide="ignore", invalid="ignore"):
        matrix = signs / (wanted[:, None] - points)
        matrix /= matrix.sum(axis=1, keepdims=True)
    hits, columns = np.nonzero(wanted[:, None] == points)
    matrix[hits] = 0.0
    matrix[hits, columns] = 1.0
    return matrix


def grow(law, z, time, share, degree):
    """Solve along the rays that end at z**2.

    Parameters
    ----------
    law : object whose mgf(z) is E exp(z x) at time 0 of one component, for complex arrays
    z : complex128[k]
    time : float >= 0, in mean collision times
    share, degree : as for `collocation`

    Returns
    -------
    slope : complex128[k]
    rest : complex128[n, k]: M(sqrt(p) z, t) = exp(p slope) rest[p] at the points p
    """
    points, reading, weights = collocation(share, degree)
    with np.errstate(over="ignore", invalid="ignore"):
        rest = np.asarray(law.mgf(np.sqrt(points)[:, None] * z), dtype=complex)
    if not np.isfinite(rest).all():
        raise ValueError("law: its mgf must be finite where the tail needs it; the tail is too far")
    slope = np.zeros(z.size, dtype=complex)

    def change(_, state):
        state = state.view(complex).reshape(points.size + 1, -1)
        here = np.ascontiguousarray(state[1:])
        # The shares U first, the shares 1 - U after them. Each product is small: on one thread.
        parts = (reading @ here.view(float)).view(complex)
        products = parts[: weights.size] * parts[weights.size :]
        gain = np.einsum("q,qpk->pk", weights, products) - here
        steeper = gain[-1] * here[-1].conj() / (np.abs(here[-1]) ** 2 + SMALL)
        rest_change = gain - points[:, None] * steeper * here
        return np.concatenate([[steeper], rest_change]).view(float).ravel()

    n_spans = max(1, math.ceil(time / SPAN))
    for _ in range(n_spans):
        size = np.maximum(np.log(np.abs(rest[-1]) + 1e-300), -slope.real)
        step = size + 1j * np.unwrap(np.angle(rest), axis=0)[-1]
        rest = rest * np.exp(-points[:, None] * step)
        slope = slope + step
        if time > 0.0:
            state = np.concatenate([[slope], rest]).view(float).ravel()
            found = integrate.solve_ivp(change, (0.0, time / n_spans), state, "DOP853", **PRECISION)
            slope, *rest = found.y[:, -1].copy().view(complex).reshape(points.size + 1, -1)
            rest = np.array(rest)
    return slope, rest


def grow_in_groups(law, z, time, share, degree):
    """As `grow`, a few rays at a time: what they need stays near the processor."""
    groups = [
        grow(law, z[first : first + GROUP], time, share, degree)
        for first in range(0, z.size, GROUP)
    ]
    return tuple(np.concatenate(part, axis=-1) for part in zip(*groups, strict=True))


def left_out(rest):
    """Return the size of the last coefficients of the polynomials along the rays, float64[k]."""
    n = rest.shape[0]
    angles = math.pi * np.arange(n) / (n - 1)
    last = np.cos(np.outer(np.arange(n - 4, n), angles)) * (2.0 / (n - 1))
    last[:, [0, -1]] *= 0.5
    return np.abs(last @ rest).max(axis=0)


def search(law, x, time, share, farthest):
    """Return (eta float64[801], log M(eta, t) there, place of the saddle point).

    One ray gives M at all smaller eta; rays get longer until the saddle point is on one.
    """
    fine = np.linspace(0.0, 1.0, 801)
    while True:
        slope, rest = grow(law, np.array([farthest + 0j]), time, share, DEGREES[2])
        points = np.sin(0.5 * math.pi * np.arange(rest.shape[0]) / (rest.shape[0] - 1)) ** 2
        values = interpolation(points, fine**2) @ rest[:, 0].real
        logs = fine**2 * slope[0].real + np.log(np.maximum(values, 1e-300))
        best = int(np.argmin(logs - fine * farthest * x))
        if best < 780:
            return fine * farthest, logs, best
        farthest *= 1.4


def variance_of(law):
    """Return the variance of one component at time 0, to six digits."""
    width = 1e-3
    return 2.0 * (float(np.real(law.mgf(np.array([width + 0j]))[0])) - 1.0) / width**2


def saddle(law, x, time, share):
    """Return (eta, deviation): where M(eta, t) exp(-eta x) is least, and of the law there."""
    variance = variance_of(law)
    farthest = 2.0 * x / variance + 2.0 / math.sqrt(variance)
    eta, logs, best = search(law, x, time, share, farthest)
    around = np.clip(best, 1, eta.size - 2)
    second = logs[around - 1] - 2.0 * logs[around] + logs[around + 1]
    deviation = math.sqrt(max(second, 0.0)) / eta[1]
    return eta[best], max(deviation, 0.5 * math.sqrt(variance))


def tilt_for(law, x, time, share):
    """Return (eta, deviation) of a contour where nothing cancels, near the middle of the law too.

    eta is that of the saddle point, but at least where log M is LEAST; the deviation is the largest
    of the law when it is tilted by eta or less.
    """
    variance = variance_of(law)
    farthest = 0.3 * x / variance + 4.0 / math.sqrt(variance)
    eta, logs, best = search(law, x, time, share, farthest)
    last = max(best, int(np.argmax(logs > LEAST)))
    widest = float(np.diff(logs[: max(last, 2) + 2], 2).max())
    deviation = math.sqrt(max(widest, 0.0)) / eta[1]
    return eta[last], max(deviation, 0.5 * math.sqrt(variance))


def contour(law, eta, deviation):
    """Return the nodes z = eta + i omega of the trapezoid rule, complex128[k], k odd."""
    step = 2.0 * math.pi / (LENGTH * deviation)
    omega = step * np.arange(MOST_NODES)
    sizes = np.abs(law.mgf(eta + 1j * omega))
    last = int(np.nonzero(sizes > NEGLIGIBLE * sizes[0])[0][-1])
    if last > MOST_NODES - 4:
        raise ValueError("law: its density must be smooth, so that |mgf| falls fast off the axis")
    return eta + 1j * omega[: last + 2 + last % 2]


def invert(law, x, time, share, factor, tilt=None):
    """Return (1 / pi) Re of the integral of exp(-z x) M(z, t) factor(z) over omega.

    Parameters
    ----------
    law : as for `grow`
    x : float >= 0
    time : float >= 0, in mean collision times
    share : `uniform_share` or `squared_cosine_share`
    factor : 1 for the density at x of one component, 1 / z for its upper tail, and others
    tilt : eta >= 0, by default that of `tilt_for`; 0 is the
        Fourier inversion, whose error is 1e-15 of the density at its largest

    Returns
    -------
    (value, error): the error is relative to the value, or to the integrand if there is a tilt: what
        the polynomials leave out, what the trapezoid rule errs by with steps twice as long,
        squared, and rounding

    Raises
    ------
    ValueError
        If the error is above RESOLVED.
    """
    eta, deviation = tilt_for(law, x, time, share)
    eta = eta if tilt is None else tilt
    degrees = DEGREES
    while True:
        z = contour(law, eta, deviation)
        for degree in degrees:
            slope, rest = grow_in_groups(law, z, time, share, degree)
            sizes = np.exp(slope.real - slope[0].real)
            missed = float((sizes * left_out(rest)).max() / abs(rest[-1, 0]))
            if missed < TOLERANCE:
                break
        degrees = degrees[degrees.index(degree) :]
        terms = (np.exp(slope - slope[0].real - z.imag * x * 1j) * rest[-1] * factor(z)).real
        terms[0] *= 0.5
        step = z[1].imag - z[0].imag
        value, coarse = step * terms.sum(), 2.0 * step * terms[::2].sum()
        largest = step * np.abs(terms).sum()
        scale = max(abs(value), 1e-8 * largest) if tilt is None else largest
        aliased = (abs(coarse - value) / scale) ** 2
        if aliased < TOLERANCE:
            break
        deviation *= 1.4
    error = aliased + (missed + 1e-14) * largest / scale
    if error > RESOLVED:
        raise ValueError(f"law: its value at {x!r} is resolved to {error:.1e} only")
    return value / math.pi * math.exp(slope[0].real - eta * x), error


def check(law, time, **places):
    """Raise ValueError unless a law is symmetric and normalized, and time and places are allowed.

    Raises
    ------
    ValueError
        Names the argument, its value and what is allowed.
    """
    problems = list(checks.not_negative("time", time))
    for name, values in places.items():
        for value in np.ravel(values):
            problems += checks.not_negative(name, float(value))
    checks.raise_problems(problems)
    at = np.array([0.0, 0.3 + 0.2j, -0.3 - 0.2j])
    zero, there, back = np.asarray(law.mgf(at), dtype=complex)
    if not (abs(zero - 1.0) < 1e-12 and abs(there - back) < 1e-12):
        raise ValueError(
            f"law: its mgf must be 1 at 0 and even, that of a symmetric law, got {zero:.4g} at 0, "
            f"{there:.4g} and {back:.4g} at 0.3 + 0.2 i and its opposite"
        )


def everywhere(values, one):
    """Return one(x) of each of the values, with their shape."""
    values = np.asarray(values, dtype=float)
    found = [one(float(value)) for value in values.ravel()]
    return np.reshape(found, values.shape) if values.shape else float(found[0])


def series(start, times, share=uniform_share):
    """Return the moments m_n(t) = n! E x**(2 n) / (2 n)! of one component, exactly at each order.

    They are n! times the coefficients of phi: M(z, t) is the sum of m_n z**(2 n) / n!, and at
    equilibrium m_n = (variance / 2)**n, so that they neither grow nor vanish in units where the
    variance is 2. m_n' = -m_n + sum over k of p_k m_k p_(n-k) m_(n-k) / d_n, where p = 1 and
    d_n = n + 1 for uniform shares; p_k = binomial(2 k, k) / 4**k and d = 1 on Kac's line.

    Parameters
    ----------
    start : float64[n], the values at time 0, m_0 = 1
    times : float64[m], rising, in mean collision times
    share : `uniform_share` or `squared_cosine_share`

    Returns
    -------
    float64[m, n]
    """
    start, order = np.asarray(start, dtype=float), np.arange(len(start))
    if share is uniform_share:
        part, divisor = np.ones(order.size), order + 1.0
    else:
        part = np.cumprod(np.concatenate([[1.0], 1.0 - 0.5 / order[1:]]))
        divisor = 1.0

    def change(_, m):
        weighted = part * m
        return np.convolve(weighted, weighted)[: m.size] / divisor - m

    times = np.asarray(times, dtype=float)
    span = 0.0, float(times[-1])
    if span[1] == 0.0:
        return np.tile(start, (times.size, 1))
    found = integrate.solve_ivp(change, span, start, "DOP853", times, rtol=1e-13, atol=1e-15)
    return found.y.T
