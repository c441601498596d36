"""Figs. 8 and 9 of the Boltzmann paper, from samples made by hand."""

import math

import fabricated
import numpy as np
import pytest
from scipy import integrate, stats

from kacsim.boltzmann import trap
from kacsim.items import boltzmann_fig9

EPS = 9.0 / 41.0
FIG9 = {
    "radius": [0.0, 2.0],
    "turn": [0.5, 1.0, 3.0],
    "large_turn": [0.5, 1.0],
    "claim_turn": [1.0, 3.0],
    "growth_turn": [0.5, 1.0],
    "n_draws": 25,
    "large_n_draws": 100,
    "n_replicates": 4,
}
ALTERNATING = np.array([1.0, -1.0, 1.0, -1.0])


# Fig. 8


def fig8(**changes):
    chosen = fabricated.settings("boltzmann_fig8", **changes)
    return fabricated.reduced("boltzmann_fig8", chosen, None)


def test_the_breathing_state_keeps_its_energy_and_its_transport():
    """thermal + potential + flow = 3/2 ((1 - ε sin φ) + (1 + ε sin φ)) = 3."""
    claims = fabricated.found("boltzmann_fig8", fig8(breathing=0.3))
    (part,) = claims["boltzmann_31_energy"].parts
    assert (part.measured.value, part.printed) == (pytest.approx(1.0), 1.0)
    (part,) = claims["boltzmann_31_amplitude"].parts
    # The range of (1 - ε²)/(1 + ε sin φ) is from 1 - ε to 1 + ε.
    assert part.measured.value == pytest.approx(0.3, rel=2e-3)
    assert part.printed == 0.3
    (part,) = claims["boltzmann_31_transport"].parts
    assert (part.measured.value, part.printed) == (pytest.approx(1.0, rel=1e-9), 1.0)


def test_energy_that_is_lost_is_seen():
    found = fig8()
    found.flow[40] += 0.05
    (part,) = fabricated.found("boltzmann_fig8", found)["boltzmann_31_energy"].parts
    assert part.measured.value == pytest.approx(1.05)


def test_a_cloud_that_does_not_follow_its_flow_is_seen(monkeypatch):
    flow = trap.flow
    monkeypatch.setattr(trap, "flow", lambda *place: 1.1 * flow(*place))
    (part,) = fabricated.found("boltzmann_fig8", fig8())["boltzmann_31_transport"].parts
    assert abs(part.measured.value - 1.0) > 0.05


def test_fig8_density_and_energies():
    found = fig8(breathing=0.3, start_phase=0.2)
    turn, radius = float(found.turn[23]), float(found.radius[11])
    phi = 4.0 * math.pi * turn + 0.2
    size = 1.0 + 0.3 * math.sin(phi)
    here = found.isel(turn=23)
    assert float(here.density[11]) == pytest.approx(math.exp(-(radius**2) / 2 / size) / size**1.5)
    assert float(here.thermal) == pytest.approx(0.5 * 0.91 / size)
    assert float(here.potential) == pytest.approx(0.5 * size)
    assert float(here.flow) == pytest.approx(0.5 * 0.09 * math.cos(phi) ** 2 / size)


# Fig. 9


def breathing(radius, turn):
    """Return f of eq. (31) at c = v(r; 0) = ε r, φ0 = 0."""
    phi = 4.0 * math.pi * turn
    size = 1.0 + EPS * math.sin(phi)
    square = (1.0 - EPS**2) / size
    flow = EPS * math.cos(phi) / size * radius
    cloud = math.exp(-(radius**2) / 2 / size) / (2 * math.pi * size) ** 1.5
    gap = (EPS * radius - flow) ** 2
    return cloud * math.exp(-gap / 2 / square) / (2 * math.pi * square) ** 1.5


def fig9():
    """W: means 0.1 (1 + place), variance 0.5 (1 + place); recursion 10, 20, ... by place."""
    chosen = fabricated.settings("boltzmann_fig9", **FIG9)

    def make(case):
        n_times = len(case.parameters["time"])
        place = 1.0 + np.arange(2.0 * n_times).reshape(2, n_times)[..., None]
        mean = 0.1 * place + 0.01 * ALTERNATING
        axes = {"radius": FIG9["radius"], "time": list(case.parameters["time"])}
        return fabricated.probes(
            case,
            axes,
            mean=mean,
            mean_square=mean**2 + 0.5 * place * (1.0 - 0.2 * ALTERNATING),
            largest=0.3,
            nodes=10.0 * place * (1.0 + 0.1 * ALTERNATING),
        )

    return fabricated.reduced("boltzmann_fig9", chosen, make)


def place_of(size, radius, turn):
    turns = FIG9["turn" if size == "published" else "large_turn"]
    return 1 + FIG9["radius"].index(radius) * len(turns) + turns.index(turn)


def test_fig9_values_stand_at_their_times():
    found = fig9()
    for size, n in (("published", 25), ("large", 100)):
        for radius in FIG9["radius"]:
            for turn in FIG9["turn"]:
                here = found.sel(size=size, radius=radius, turn=turn)
                if size == "large" and turn == 3.0:
                    assert math.isnan(float(here.value))
                    assert math.isnan(float(here.batch))
                    continue
                place, f = place_of(size, radius, turn), breathing(radius, turn)
                assert float(here.exact) == pytest.approx(f, rel=1e-9)
                assert float(here.value) == pytest.approx(0.1 * place * f)
                variance = (0.5 * place + 1e-4) / (4 * n - 1)
                assert float(here.error) == pytest.approx(f * math.sqrt(variance))
                assert float(here.recursion) == pytest.approx(10.0 * place)
                assert float(here.recursion_error) == pytest.approx(place / math.sqrt(3.0))
                assert float(here.largest_share) == pytest.approx(0.3 / (4 * n * 0.1 * place))
                # Replicates depart by 0.01; their standard deviation is 0.02/√3.
                assert float(here.batch) == pytest.approx(math.sqrt(3.0) / 2.0)
                free = breathing(radius, turn) * trap.relative_start(
                    *trap.ballistic(radius, EPS * radius, 0.0, 2 * math.pi * turn), EPS
                )
                assert float(here.ballistic) == pytest.approx(free, rel=1e-9, abs=1e-18)


def jackknifed(statistic, *columns):
    left = np.array([statistic(*(np.delete(one, k).mean() for one in columns)) for k in range(4)])
    return math.sqrt(3.0 / 4.0 * ((left - left.mean()) ** 2).sum())


def test_fig9_growth_compares_the_large_run_at_two_times():
    """Variances 0.5 and 1 at r = 0, 1.5 and 2 at r = 2, plus 10⁻⁴ between replicates each."""
    found = fig9()
    claims = fabricated.found("boltzmann_fig9", found)["boltzmann_trap_variance_time"]
    for part, radius in zip(claims.parts, FIG9["radius"], strict=True):
        first, last = (place_of("large", radius, turn) for turn in FIG9["growth_turn"])
        # f of the breathing state is the same at both half turns.
        ratio = (0.5 * last + 1e-4) / (0.5 * first + 1e-4)
        assert part.measured.value == pytest.approx(ratio - 1.0)
        means = [0.1 * place + 0.01 * ALTERNATING for place in (first, last)]
        squares = [
            mean**2 + 0.5 * place * (1.0 - 0.2 * ALTERNATING)
            for mean, place in zip(means, (first, last), strict=True)
        ]
        error = jackknifed(
            lambda m, s, n, q: (q - n * n) / (s - m * m), means[0], squares[0], means[1], squares[1]
        )
        assert part.measured.standard_error == pytest.approx(error, abs=1e-12)
        assert part.measured.degrees == 3


def test_growth_between_times_of_different_density():
    """From a quarter turn on the breathing state's f changes: the variance is that of f."""
    chosen = FIG9 | {"turn": [0.3, 0.6, 1.0, 1.2], "claim_turn": [0.3, 1.0]}
    chosen |= {"large_turn": [0.3, 1.0, 1.2], "growth_turn": [0.3, 1.0]}
    chosen = fabricated.settings("boltzmann_fig9", **chosen)

    def make(case):
        axes = {"radius": FIG9["radius"], "time": list(case.parameters["time"])}
        return fabricated.probes(case, axes, mean=0.0, mean_square=2.0)

    found = fabricated.reduced("boltzmann_fig9", chosen, make)
    for radius in FIG9["radius"]:
        ratio = (breathing(radius, 1.0) / breathing(radius, 0.3)) ** 2
        assert float(found.growth.sel(radius=radius)) == pytest.approx(ratio)


def test_fig9_recursions_fall_outwards_and_grow_with_time():
    """Published recursions: 10, 20, 30 at r = 0 and 40, 50, 60 at r = 2, errors of 10/√3 %."""
    claims = fabricated.found("boltzmann_fig9", fig9())
    place = claims["boltzmann_recursion_place"].parts
    assert [part.label for part in place] == ["ωt = 2π", "ωt = 6π"]
    assert [part.measured.value for part in place] == pytest.approx([1 - 50 / 20, 1 - 60 / 30])
    for part, ratio in zip(place, (2.5, 2.0), strict=True):
        error = ratio * 0.1 / math.sqrt(3.0) * math.sqrt(2.0)
        assert part.measured.standard_error == pytest.approx(error)
    time = claims["boltzmann_recursion_time"].parts
    assert [part.label for part in time] == ["r = 0", "r = 2"]
    assert [part.measured.value for part in time] == pytest.approx([1 - 20 / 30, 1 - 50 / 60])
    # (4 exp(3 ν t) - 1)/3 at ωt = 2π and 6π with ν of eq. (39).
    rate = (5 / 3) ** 2.5 / math.e * 3.0 / (2 * math.pi * (1 - EPS)) ** 1.5
    constant = [(4 * math.exp(3 * rate * 2 * math.pi * turn) - 1) / 3 for turn in (1.0, 3.0)]
    wanted = [20 / constant[0], 50 / constant[0], 30 / constant[1], 60 / constant[1]]
    parts = claims["boltzmann_38_constant"].parts
    assert [1.0 - part.measured.value for part in parts] == pytest.approx(wanted)
    errors = [one * 0.1 / math.sqrt(3.0) for one in wanted]
    assert [part.measured.standard_error for part in parts] == pytest.approx(errors)


def test_fig9_is_far_from_its_final_state():
    """W = 0.3 at r = 0 and 0.6 at r = 2 in the published run at three turns."""
    parts = fabricated.found("boltzmann_fig9", fig9())["boltzmann_far"].parts
    assert [part.measured.value for part in parts] == pytest.approx([0.7, 0.4])
    for part, place in zip(parts, (3, 6), strict=True):
        error = math.sqrt((0.5 * place + 1e-4) / 99)
        assert part.measured.standard_error == pytest.approx(error)
        assert part.measured.degrees == 3


def test_raised_frequencies():
    """The ratio s e^(-s/3) is largest at s = 3; eq. (36) at the centre where φ = 3π/2."""
    claims = fabricated.found("boltzmann_fig9", fig9())
    prefactor = (5 / 3) ** 2.5 / math.e
    (part,) = claims["boltzmann_37_prefactor"].parts
    assert (part.measured.value, part.printed) == pytest.approx((prefactor, prefactor), rel=1e-6)
    highest = prefactor * 3.0 / (2 * math.pi * (1 - EPS)) ** 1.5
    (part,) = claims["boltzmann_39_highest"].parts
    assert (part.measured.value, part.printed) == pytest.approx((highest, highest), rel=1e-5)
    (part,) = claims["boltzmann_36_bound"].parts
    assert part.measured.value == 0.0
    (part,) = claims["boltzmann_fig9_start"].parts
    assert part.measured.value == 0.0


def test_a_bound_that_is_too_low_is_seen(monkeypatch):
    monkeypatch.setattr(trap, "MAJORANT", 0.9 * trap.MAJORANT)
    (part,) = fabricated.found("boltzmann_fig9", fig9())["boltzmann_36_bound"].parts
    assert part.measured.value > 0.0


def test_turns_of_claims_must_be_drawn():
    chosen = fabricated.settings("boltzmann_fig9")
    assert boltzmann_fig9.problems(chosen) == []
    for key in ("claim_turn", "growth_turn", "large_turn"):
        ((found, _),) = boltzmann_fig9.problems(chosen | {key: [0.123]})
        assert found == key


def test_free_density_by_a_convolution():
    """r = r0 (cos + ε sin) + w sin at ωt = 0.9: w of eq. (18), one axis at a time."""
    t = 0.9
    scale, width = math.cos(t) + EPS * math.sin(t), math.sqrt(1 - EPS**2) * math.sin(t)

    def marginal(x):  # of the BKW start on one axis, of variance 1
        return stats.norm.pdf(x, scale=math.sqrt(0.6)) * (2 / 3 + 5 / 9 * x * x)

    def density(x):  # of r on one axis
        def integrand(w):
            return marginal(w) * stats.norm.pdf((x - width * w) / scale) / scale

        return integrate.quad(integrand, -9.0, 9.0, epsabs=1e-14)[0]

    r, h = 1.3, 1e-3
    slope = (density(r + h) - density(r - h)) / (2 * h)
    wanted = -slope / (2 * math.pi * r)  # of an isotropic law from its marginal
    found = trap.cloud(r, t, EPS) * trap.free_relative_cloud(r, t, EPS)
    assert float(found) == pytest.approx(wanted, rel=1e-5)
