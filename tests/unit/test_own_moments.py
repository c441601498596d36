"""Exact moments for any laws, against the linear system of all monomials. No z tests."""

import math

import numpy as np
import pytest
from law.own_moments import Angles, moment
from law.test_own_physics import ANGLES, FILES, INITIAL, PEAKS, points
from scipy import integrate

from kacsim import kac
from kacsim.kac import own_drawn, own_moments

PROCESS = {"n_particles": 7, "time": 1.7, "collision_rate": 0.9}
GIVEN = {"initial": FILES["initial"], "scattering": FILES["scattering"]}


def given(kind, name):
    return GIVEN[kind] if name == "file" else name


@pytest.mark.parametrize("algorithm", own_moments.ALGORITHMS)
@pytest.mark.parametrize("scattering", ["file", "forward", "grazing", "uniform"])
@pytest.mark.parametrize("initial", ["file", "two_peaks"])
def test_of_seven_particles(initial, scattering, algorithm):
    found = own_moments.fourth_moment(
        algorithm=algorithm,
        initial=given("initial", initial),
        scattering=given("scattering", scattering),
        **PROCESS,
    )
    wanted = moment(4, INITIAL[initial], ANGLES[scattering], algorithm, **PROCESS)
    assert found == pytest.approx(wanted, rel=1e-9)


@pytest.mark.parametrize("n", [7, math.inf])
@pytest.mark.parametrize("algorithm", own_moments.ALGORITHMS)
def test_the_papers_laws(algorithm, n):
    rate = {"algorithm": algorithm, "collision_rate": 0.9}
    found = own_moments.fourth_moment(1.7, n, **rate)
    assert found == pytest.approx(kac.fourth_moment(1.7, n, **rate), rel=1e-12)


def test_many_particles_approach_the_equation():
    laws = {"initial": "two_peaks", "scattering": "forward"}
    limit = own_moments.fourth_moment(1.7, **laws)
    assert own_moments.fourth_moment(1.7, 10**9, **laws) == pytest.approx(limit, rel=1e-7)


def test_the_shared_part_of_an_angle():
    """E cos² sin²: 1/8 of a uniform angle; of 0 to 1/8 pi, 1/8 - sin(pi/2) / (4 pi)."""
    assert own_moments.shared(own_drawn.scattering_law()) == pytest.approx(1 / 8)
    grazing = own_moments.shared(own_drawn.scattering_law("grazing"))
    assert grazing == pytest.approx(1 / 8 - 1 / (4 * math.pi))
    assert grazing == pytest.approx(Angles(np.ones_like, [0.0, math.pi / 8]).mean(2, 2))


@pytest.mark.parametrize(
    ("initial", "moments"),
    [
        (None, (1.5, 3.75)),
        ("maxwell", (1.5, 6.75)),
        ("uniform", (1.5, 4.5**2 / 5)),
        ("two_peaks", (PEAKS[2], PEAKS[4])),
        ("file", (INITIAL["file"][2], INITIAL["file"][4])),
    ],
)
def test_the_start(initial, moments):
    law = own_drawn.initial_law(given("initial", initial))
    assert own_moments.moments_at_start(law) == pytest.approx(moments)
    v = np.linspace(-9.0, 9.0, 18001)
    cumulative = own_moments.cumulative(law, v)
    assert cumulative[0] == pytest.approx(0.0, abs=1e-9)
    assert cumulative[-1] == pytest.approx(1.0)
    middle = 0.5 * (v[1:] + v[:-1])
    assert (np.diff(cumulative) * middle**2).sum() == pytest.approx(moments[0], rel=1e-4)


def test_the_start_of_a_file_point_by_point():
    """No symmetry of the law hides one that is turned over."""
    law, (x, density) = own_drawn.initial_law(FILES["initial"]), points("initial")
    total = np.trapezoid(density, x)
    v = np.linspace(x[0], x[-1], 1003)[1:-1]
    v = v[np.abs(v[:, None] - x).min(axis=1) > 1e-3]
    slope = (own_moments.cumulative(law, v + 1e-5) - own_moments.cumulative(law, v - 1e-5)) / 2e-5
    assert slope == pytest.approx(np.interp(v, x, density) / total, rel=1e-5, abs=1e-8)


def test_the_density_of_the_start_has_no_hole():
    law = own_drawn.initial_law("two_peaks")
    whole = integrate.quad(lambda v: 1.0 - float(own_moments.cumulative(law, np.array(v))), 0, 9)[0]
    assert whole == pytest.approx(0.5 * _mean_size(), rel=1e-6)


def _mean_size():
    """Return E |v| of a normal variate of variance 0.29 about 1.1."""
    s, m = math.sqrt(0.29), 1.1
    bell = math.exp(-0.5 * (m / s) ** 2) / math.sqrt(2.0 * math.pi)
    return 2.0 * s * bell + m * math.erf(m / s / math.sqrt(2.0))


@pytest.mark.parametrize(
    ("wrong", "allowed"),
    [
        ({"algorithm": "nanbu_synchronous"}, "poisson, bird"),
        ({"time": -1.0}, "at least 0"),
        ({"collision_rate": 0.0}, "positive"),
        ({"initial": "peaks"}, "f0, two_peaks"),
        ({"scattering": "peaks"}, "uniform, forward"),
        ({"n_particles": 1}, "2"),
    ],
)
def test_bad_input(wrong, allowed):
    (name,) = wrong
    with pytest.raises(ValueError, match=f"{name} = .*{allowed}"):
        own_moments.fourth_moment(**({"time": 1.0} | wrong))
