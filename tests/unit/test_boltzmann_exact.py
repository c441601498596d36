"""The exact results on the Boltzmann paper's estimators against quadratures and their own ODEs.

No random numbers, no false alarms.
"""

import math

import numpy as np
import pytest
from scipy import integrate, optimize

from kacsim import kac
from kacsim.boltzmann import bkw, extinction, trap
from kacsim.kac import probe

Q = 1.7
TIMES = [0.0, 0.5, 1.0, 3.0, 17.0]
EPS, PHASE = 0.3, 0.4


def printed_density(c, time, q):
    """Return eq. (7) as printed, in extended precision."""
    c, q = np.longdouble(c), np.longdouble(q)
    k = 1 - np.longdouble(2) / 5 * np.exp(-np.longdouble(time) / 6)
    pi = np.longdouble("3.14159265358979323846264338327950288")
    bracket = (5 * k - 3) / k + (1 - k) / k**2 * (c / q) ** 2
    return np.exp(-(c**2) / (2 * k * q**2)) / (2 * (np.sqrt(2 * pi * k) * q) ** 3) * bracket


def over_speeds(function, q=1.0):
    """Return the integral of 4 pi c**2 times a function of the speed."""
    return integrate.quad(lambda c: 4 * math.pi * c * c * function(c), 0.0, 40 * q, limit=200)[0]


def extended_integral(function, start, stop, panels=200):
    """Return a composite Gauss-Legendre quadrature in extended precision."""
    nodes, weights = (x.astype(np.longdouble) for x in np.polynomial.legendre.leggauss(16))
    edges = np.linspace(np.longdouble(start), np.longdouble(stop), panels + 1)
    half = (edges[1] - edges[0]) / 2
    points = (edges[:-1] + half)[:, None] + half * nodes
    return float((function(points) * weights).sum() * half)


def slope(function, x, step=1e-4):
    """Return a derivative by central differences of fourth order."""
    near, far = (
        function(x + step) - function(x - step),
        function(x + 2 * step) - function(x - 2 * step),
    )
    return (8 * near - far) / (12 * step)


@pytest.mark.parametrize("time", TIMES)
def test_bkw_density(time):
    """As printed; one particle, 3 c_q**2 of energy, and eq. (18) at the start."""
    c = np.linspace(0.0, 12.0, 50)
    printed = printed_density(c, time, Q).astype(float)
    np.testing.assert_allclose(bkw.density(c, time, Q), printed, rtol=1e-12, atol=1e-18)
    assert over_speeds(lambda c: bkw.density(c, time, Q), Q) == pytest.approx(1.0, rel=1e-9)
    energy = over_speeds(lambda c: c * c * bkw.density(c, time, Q), Q)
    assert energy == pytest.approx(3 * Q * Q, rel=1e-9)


def test_bkw_density_starts_at_eq_18_and_relaxes_to_the_maxwellian():
    c = np.linspace(0.0, 9.0, 40)
    start = 5 * c**2 / (9 * Q**2) * (math.sqrt(6 * math.pi / 5) * Q) ** -3
    start *= np.exp(-(c**2) / (1.2 * Q**2))
    np.testing.assert_allclose(bkw.density(c, 0.0, Q), start, rtol=1e-12, atol=1e-17)
    np.testing.assert_allclose(bkw.density(c, 600.0, Q), bkw.maxwellian(c, Q), rtol=1e-12)


@pytest.mark.parametrize("time", [0.4, 2.0])
@pytest.mark.parametrize("speed", [0.3, 1.0, 2.9])
def test_bkw_density_solves_the_boltzmann_equation(speed, time):
    """df/dt + f is the gain: f(c') f(c'*) over c* and u', in x' = T/2 + mu R (see `model`)."""
    radial, w_radial = np.polynomial.hermite_e.hermegauss(40)
    level, w_level = np.polynomial.laguerre.laggauss(40)
    mu, w_mu = np.polynomial.legendre.leggauss(40)
    z, e, mu = np.meshgrid(radial, level, mu, indexing="ij")
    weight = w_radial[:, None, None] * w_level[:, None] * w_mu / (2 * math.sqrt(2 * math.pi))
    total = speed**2 + z**2 + 2 * e
    reach = np.sqrt(np.maximum(0.0, total**2 - 4 * (speed * z) ** 2)) * mu
    pair = [np.sqrt(np.maximum(0.0, (total + sign * reach) / 2)) for sign in (1, -1)]
    ratios = [bkw.relative_density(c, time) for c in pair]
    gain = bkw.maxwellian(speed) * (weight * ratios[0] * ratios[1]).sum()
    change = slope(lambda t: bkw.density(speed, t), time)
    assert change + bkw.density(speed, time) == pytest.approx(gain, rel=1e-7)


@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize("threshold", [0.0, 1.1, 3.4, 6.0, 11.0, 17.0])
def test_fraction(threshold, time):
    """Down to 1e-21: an extended-precision quadrature of 4 pi c**2 times the printed density."""
    wanted = extended_integral(
        lambda c: 4 * np.longdouble(math.pi) * c**2 * printed_density(c, time, Q),
        threshold,
        threshold + 17 * Q,
    )
    assert bkw.fraction(threshold, time, Q) == pytest.approx(wanted, rel=1e-11)


def test_fraction_reaches_far_and_falls_by_the_density():
    assert bkw.fraction(0.0, 1.0, Q) == 1.0
    assert 0.0 < bkw.fraction(17.0, 1.0, Q) < 1e-20
    for threshold in (0.6, 3.4, 9.0):
        fall = slope(lambda c: bkw.fraction(c, 1.0, Q), threshold)
        shell = 4 * math.pi * threshold**2 * bkw.density(threshold, 1.0, Q)
        assert -fall == pytest.approx(shell, rel=1e-8)


@pytest.mark.parametrize("time", TIMES)
def test_mean_square(time):
    wanted = over_speeds(lambda c: bkw.maxwellian(c) * bkw.relative_density(c, time) ** 2)
    assert bkw.mean_square(time) == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize("power", [-1.2, 0.5, 1.0, 2.0, 3.7, 9.0])
def test_power_moment(power):
    """In s = c**2 / c_q**2; the substitution s = x**10 tames the singularity at -1.2."""

    def integrand(x):
        s = x**10
        h = 5 / 9 * (5 / 3) ** 1.5 * s * math.exp(-s / 3)
        return h**power * math.sqrt(s / (2 * math.pi)) * math.exp(-s / 2) * 10 * x**9

    wanted = integrate.quad(integrand, 0.0, 2.0, limit=400, epsabs=0.0)[0]
    assert bkw.power_moment(power) == pytest.approx(wanted, rel=1e-7)


def test_known_numbers():
    assert pytest.approx(1.10452, abs=5e-6) == bkw.INITIAL_SECOND_MOMENT
    assert bkw.power_moment(2.0) == pytest.approx(bkw.INITIAL_SECOND_MOMENT, rel=1e-12)
    assert bkw.power_moment(1.0) == pytest.approx(1.0, rel=1e-12)
    assert bkw.critical_time() == pytest.approx(2.358, abs=5e-4)
    assert bkw.second_moment(0.5) == pytest.approx(1.18486, abs=5e-6)
    assert bkw.tail_index(bkw.critical_time()) == pytest.approx(2.0, abs=1e-9)
    assert bkw.tail_index(1.0) > 4.0 > bkw.tail_index(1.1)
    assert pytest.approx(1.44897, abs=5e-6) == probe.INITIAL_SECOND_MOMENT
    assert probe.critical_time() == pytest.approx(1.322, abs=5e-4)
    assert probe.critical_time(0.9) * 0.9 == pytest.approx(1.1716, abs=1e-4)


def test_kac_initial_second_moment_by_quadrature():
    def integrand(v):
        m = math.exp(-v * v / 3) / math.sqrt(3 * math.pi)
        return kac.density(v, 0.0, 0.9) ** 2 / m

    wanted = integrate.quad(integrand, -12.0, 12.0)[0]
    assert pytest.approx(wanted, rel=1e-9) == probe.INITIAL_SECOND_MOMENT


def test_second_moment_solves_its_equation_and_explodes():
    """G' = -G + G**2."""
    for time in (0.3, 1.0, 2.0):
        g = bkw.second_moment(time)
        assert slope(bkw.second_moment, time) == pytest.approx(g * g - g, rel=1e-8)
    assert bkw.second_moment(0.0) == pytest.approx(bkw.INITIAL_SECOND_MOMENT, rel=1e-14)
    assert bkw.second_moment(bkw.critical_time() - 1e-6) > 1e5
    np.testing.assert_array_equal(bkw.second_moment([2.4, 40.0]), np.inf)


@pytest.mark.parametrize("time", [0.0, 0.5, 1.7, 2.3])
def test_oversampling_by_one_is_no_oversampling(time):
    for onset in (0.0, 0.9, 9.0):
        wanted = pytest.approx(float(bkw.second_moment(time)), rel=1e-6)
        assert bkw.second_moment_oversampled(time, 1.0, onset) == wanted
    assert bkw.second_moment_oversampled(2.4, 1.0) == math.inf


@pytest.mark.parametrize(("m", "inverse"), [(1.0, 1.0), (1.5, 0.75), (2.0, 0.5), (2.25, 11 / 24)])
def test_oversampled_second_moment(m, inverse):
    """G' = -G + (H + (G - H) E[1/N])**2, N = 1 or 2 with even chances for m = 1.5."""
    assert bkw.mean_inverse(m) == pytest.approx(inverse, rel=1e-14)
    for time in (0.7, 1.9):
        g, h = bkw.second_moment_oversampled(time, m), float(bkw.mean_square(time))
        change = slope(lambda t: bkw.second_moment_oversampled(t, m), time, step=1e-2)
        assert change == pytest.approx(-g + (h + (g - h) * inverse) ** 2, rel=1e-4)
        late = bkw.second_moment_oversampled(time, m, onset=0.6)
        assert g * (1 - 1e-6) <= late <= bkw.second_moment(time) * (1 + 1e-6)
    early = bkw.second_moment_oversampled(0.7, m, onset=0.8)
    assert early == pytest.approx(float(bkw.second_moment(0.7)), rel=1e-6)


@pytest.mark.parametrize(("m", "onset"), [(1.0, 0.0), (1.5, 0.0), (1.5, 0.8), (2.0, 5.0)])
def test_mean_recursion(m, onset):
    """N' = (2 m - 1) N + 1 with m = 1 before the onset; 2 exp(t) - 1 for m = 1."""
    for time in (0.3, 1.9):
        growth = 2 * (m if time > onset else 1.0) - 1
        n = bkw.mean_recursion(time, m, onset)
        change = slope(lambda t: bkw.mean_recursion(t, m, onset), time)
        assert change == pytest.approx(growth * n + 1, rel=1e-9)
    assert bkw.mean_recursion(0.0, m, onset) == 1.0
    assert bkw.mean_recursion(1.9, 1.0, onset) == pytest.approx(2 * math.exp(1.9) - 1)
    join = [bkw.mean_recursion(0.8 + gap, m, onset) for gap in (-1e-9, 1e-9)]
    assert join[0] == pytest.approx(join[1], rel=1e-7)


@pytest.mark.parametrize("majorant", [0.8, 0.92, 1.6])
def test_extinction(majorant):
    """f' = -alpha f**2; S = E F**2 obeys S' = nu (S (1 - 2 x + alpha**2 S / nu**2) - S)."""
    rate, start = 2.3, 0.4

    def second(t):
        f = extinction.density(t, rate, start)
        return extinction.variance(t, rate, start, majorant) + f * f

    for time in (0.4, 1.3):
        f, s = extinction.density(time, rate, start), second(time)
        assert slope(lambda t: extinction.density(t, rate, start), time) == pytest.approx(
            -rate * f * f, rel=1e-9
        )
        change = -2 * rate * f * s + rate**2 * s * s / majorant
        assert slope(second, time) == pytest.approx(change, rel=1e-8)
        n = extinction.mean_recursion(time, majorant)
        grown = slope(lambda t: extinction.mean_recursion(t, majorant), time)
        assert grown == pytest.approx(majorant * (n + 1), rel=1e-9)
    assert extinction.density(0.0, rate, start) == start
    assert extinction.variance(0.0, rate, start, majorant) == 0.0
    assert extinction.mean_recursion(0.0, majorant) == 1.0


def test_extinction_variance_is_infinite_late_below_the_rate():
    """nu = 0.8 < alpha f0 = 0.92: from alpha f0 t = r / (1 - r) on, r = 0.8 / 0.92."""
    late = 0.8 / 0.92 / (1 - 0.8 / 0.92) / 0.92
    assert extinction.variance(0.999 * late, 2.3, 0.4, 0.8) < math.inf
    assert extinction.variance(1.001 * late, 2.3, 0.4, 0.8) == math.inf
    assert extinction.variance(1e6, 2.3, 0.4, 0.92) < math.inf


@pytest.mark.parametrize("phase", [0.0, 0.7, 2.9, 40.0])
def test_breathing_state(phase):
    """One particle, 3 c_eq**2 of energy, and each energy by its own quadrature."""
    args = phase, EPS, PHASE
    thermal, potential, flow = trap.energies(*args)
    assert thermal + potential + flow == pytest.approx(3.0, rel=1e-14)
    assert over_speeds(lambda r: trap.cloud(r, *args)) == pytest.approx(1.0, rel=1e-9)
    wanted = over_speeds(lambda r: r * r / 2 * trap.cloud(r, *args))
    assert potential == pytest.approx(wanted, rel=1e-9)
    wanted = over_speeds(lambda r: trap.flow(r, *args) ** 2 / 2 * trap.cloud(r, *args))
    assert flow == pytest.approx(wanted, rel=1e-9)
    assert thermal == pytest.approx(1.5 * trap.thermal_speed(*args) ** 2, rel=1e-14)


def test_breathing_cloud_is_carried_by_its_flow():
    """d eta/dt + div(eta v) = 0 at a point, for phases omega t."""
    for radius, phase in ((0.4, 0.3), (1.9, 2.2)):
        change = slope(lambda t: trap.cloud(radius, t, EPS, PHASE), phase)  # noqa: B023

        def flux(r, phase=phase):
            return r * r * trap.cloud(r, phase, EPS, PHASE) * trap.flow(r, phase, EPS, PHASE)

        assert change == pytest.approx(-slope(flux, radius) / radius**2, rel=1e-8)


NODES = [(0.0, 0.4, 0.9), (0.8, -0.5, 1.1), (2.6, 0.0, 0.0), (1.3, 0.7, 0.0), (0.0, 0.0, 0.0)]


@pytest.mark.parametrize("phase", [0.0, 0.3, math.pi / 2, 2.9, 31.0])
@pytest.mark.parametrize("node", NODES, ids=str)
def test_free_trajectories(node, phase):
    """Energy and angular momentum are kept, as by a vector on its ellipse; (31) is carried."""
    r, radial, tangential = (float(x) for x in trap.ballistic(*node, phase))
    place, speed = np.array([node[0], 0.0]), np.array(node[1:])
    there = place * math.cos(phase) - speed * math.sin(phase)
    assert r == pytest.approx(math.hypot(*there), abs=1e-14)
    energy = r**2 + radial**2 + tangential**2
    assert energy == pytest.approx(sum(x * x for x in node), rel=1e-13)
    assert r * abs(tangential) == pytest.approx(node[0] * node[2], abs=1e-14)
    now = trap.breathing_density(*node, phase, EPS, PHASE)
    start = trap.breathing_density(r, radial, tangential, 0.0, EPS, PHASE)
    assert now == pytest.approx(float(start), rel=1e-11)
    free = trap.ballistic_density(*node, phase, EPS, PHASE)
    ratio = trap.relative_start(r, radial, tangential, EPS, PHASE)
    assert free == pytest.approx(float(start * ratio), rel=1e-11)


def test_start_of_the_trap():
    """f(0) / (31) is the BKW mode's own ratio in the peculiar velocity; its maximum is eq. (37)."""
    width = float(trap.thermal_speed(0.0, EPS, PHASE))
    flow = float(trap.flow(0.8, 0.0, EPS, PHASE))
    for a, b in ((0.3, 0.0), (-1.4, 0.9), (0.0, 2.2)):
        ratio = trap.relative_start(0.8, flow + a, b, EPS, PHASE)
        assert ratio == pytest.approx(bkw.relative_density(math.hypot(a, b), 0.0, width), rel=1e-12)
    found = optimize.minimize_scalar(
        lambda c: -bkw.relative_density(c, 0.0), bounds=(0.1, 5.0), method="bounded"
    )
    assert pytest.approx(-found.fun, rel=1e-9) == trap.MAJORANT
    assert found.x == pytest.approx(math.sqrt(3.0), rel=1e-4)
