"""Fig. 10 of the Boltzmann paper, from samples made by hand."""

import math

import fabricated
import numpy as np
import pytest
from scipy import integrate, stats

from kacsim.items import _trap, _trap_claims

EPS = 9.0 / 41.0
FIG10 = {
    "radius": [0.0, 2.0, 5.5],
    "turn": [1.0, 3.0],
    "large_turn": [1.0],
    "n_draws": 25,
    "large_n_draws": 100,
    "n_replicates": 4,
}
ALTERNATING = np.array([1.0, -1.0, 1.0, -1.0])


def fig10(**changes):
    """Means 0.1 (1 + place); relative deviations 2 and 3 at the ends of the radii."""
    chosen = fabricated.settings("boltzmann_fig10", **(FIG10 | changes))

    def make(case):
        n_times = len(case.parameters["time"])
        place = 1.0 + np.arange(3.0 * n_times).reshape(3, n_times)[..., None]
        deviation = np.array([2.0, 9.0, 3.0])[:, None, None]
        mean = 0.1 * place
        return fabricated.probes(
            case,
            {"radius": FIG10["radius"], "time": list(case.parameters["time"])},
            mean=mean,
            mean_square=mean**2 * (1.0 + (deviation * (1.0 + 0.1 * ALTERNATING)) ** 2),
            nodes=(12.0 - place) * (1.0 + 0.1 * ALTERNATING),
        )

    return fabricated.reduced("boltzmann_fig10", chosen, make)


def maxwellian_fraction(radius):
    return float(stats.chi.sf(radius, 3))


def test_fig10_fractions():
    """At whole turns the cloud has its size of the start, variance 1 per axis."""
    found = fig10()
    for radius in FIG10["radius"]:
        for turn in FIG10["turn"]:
            here = found.sel(radius=radius, turn=turn)
            wanted = maxwellian_fraction(radius)
            assert float(here.exact) == pytest.approx(wanted, rel=1e-9)
            assert float(here.ballistic) == pytest.approx(wanted, rel=1e-9)
            k = FIG10["radius"].index(radius) * 2 + FIG10["turn"].index(turn)
            assert float(here.sel(size="published").value) == pytest.approx(0.1 * (1 + k))
            gap = 0.1 * (1 + k) - wanted
            assert float(here.sel(size="published").actual_error) == pytest.approx(gap)
    assert np.isnan(found.sel(size="large", turn=3.0).value).all()


def test_fig10_fractions_at_another_time():
    """At ωt = 1 the variance is 1 + ε sin 2, the shape 1 - 0.4 (1 - ε²) sin² 1 / (1 + ε sin 2)."""
    found = fig10(turn=[0.5 / math.pi], large_turn=[0.5 / math.pi])
    size = 1 + EPS * math.sin(2.0)
    k = 1 - 0.4 * (1 - EPS**2) * math.sin(1.0) ** 2 / size

    def density(x):  # eq. (7a) in units of the size
        bracket = (5 * k - 3) / k + (1 - k) / k**2 * x * x
        bell = math.exp(-x * x / 2 / k) / (2 * (2 * math.pi * k) ** 1.5)
        return 4 * math.pi * x * x * bracket * bell

    radius = 2.0
    here = found.sel(radius=radius).isel(turn=0)
    wanted = integrate.quad(density, radius / math.sqrt(size), 12.0)[0]
    assert float(here.ballistic) == pytest.approx(wanted, rel=1e-8)
    assert float(here.exact) == pytest.approx(maxwellian_fraction(radius / math.sqrt(size)))
    (part,) = fabricated.found("boltzmann_fig10", found)["boltzmann_fig10_ballistic"].parts
    ratios = found.isel(turn=0).ballistic / found.isel(turn=0).exact
    worst = float(ratios[int(np.abs(ratios.values - 1).argmax())])
    assert part.measured.value == pytest.approx(worst)
    assert abs(worst - 1.0) > 0.2


def test_fig10_claims():
    claims = fabricated.found("boltzmann_fig10", fig10())
    parts = claims["boltzmann_fig10_ballistic"].parts
    assert [part.label for part in parts] == ["ωt = 2π", "ωt = 6π"]
    assert [part.measured.value for part in parts] == pytest.approx([1.0, 1.0], rel=1e-9)
    # Published recursions 11, 10 at r0 = 0 and 7, 6 at r0 = 5.5.
    parts = claims["boltzmann_fig10_recursion"].parts
    assert [part.measured.value for part in parts] == pytest.approx([1 - 7 / 11, 1 - 6 / 10])
    (part,) = claims["boltzmann_trap_rarefaction"].parts
    # The mean of (1.1², 0.9², ...) is 1.01: both ends by the same factor.
    assert part.measured.value == pytest.approx(3.0 / 2.0)
    assert part.measured.standard_error == pytest.approx(0.0, abs=1e-12)
    assert part.measured.degrees == 3
    parts = claims["boltzmann_40_density"].parts
    assert [part.measured.value for part in parts] == pytest.approx([1.0] * 3, rel=1e-6)


def test_of_fig10_names_the_ends():
    evidence = fabricated.found("boltzmann_fig10", fig10())["boltzmann_trap_rarefaction"].evidence
    assert "from r0 = 0 to 5.5" in evidence
    assert "from 1 to 1.2e-06" in evidence
    assert _trap_claims.THRESHOLDS == (0.5, 2.0, 5.5)


def test_a_turn_of_the_trap_is_two_pi():
    chosen = fabricated.settings("boltzmann_fig10", turn=[0.25, 1.0, 3.0], large_turn=[1.0])
    cases = _trap.cases_by_size("trap_fraction", chosen)
    times = {size: case.parameters["time"] for size, case in cases.items()}
    assert times["published"] == pytest.approx([1.570796327, 6.283185307, 18.849555922])
    assert times["large"] == pytest.approx([6.283185307])
