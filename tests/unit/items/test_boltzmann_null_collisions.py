"""Figs. 1, 2 and 7 of the Boltzmann paper: exact statements, trees and null collisions by hand."""

import math

import fabricated
import numpy as np
import pytest

from kacsim.boltzmann import bkw, extinction
from kacsim.items import _extinction, _trees, boltzmann_fig1, boltzmann_fig7

# Fig. 1


def shown(name, **changes):
    chosen = fabricated.settings(name, **changes)
    return fabricated.reduced(name, chosen, None)


def test_eq_5_is_balanced_at_every_time():
    found = shown("boltzmann_fig1", time=[0.0, 2.0])
    claims = fabricated.found("boltzmann_fig1", found)
    parts = claims["boltzmann_5_solution"].parts
    assert [part.label for part in parts] == ["t = 0", "t = 2"]
    assert [part.measured.value for part in parts] == pytest.approx([1.0, 1.0], abs=1e-9)
    assert all(part.printed == 1.0 for part in parts)


def test_the_worst_speed_counts(monkeypatch):
    """A source 3 % too large at c = 2 alone."""
    gain = bkw.gain
    monkeypatch.setattr(bkw, "gain", lambda c, t: gain(c, t) * (1.03 if c == 2.0 else 0.999))
    found = shown("boltzmann_fig1", time=[1.0])
    (part,) = fabricated.found("boltzmann_fig1", found)["boltzmann_5_solution"].parts
    assert part.measured.value == pytest.approx(1.03, rel=1e-9)


def test_negative_densities_are_counted():
    found = shown("boltzmann_fig1", time=[0.0, 2.0])
    claim = "boltzmann_7_positive"
    assert fabricated.found("boltzmann_fig1", found)[claim].parts[0].measured.value == 0.0
    found.density[1, 7] = 0.0  # f must be positive after the start
    wrong = fabricated.found("boltzmann_fig1", found)[claim].parts[0].measured.value
    assert wrong == pytest.approx(1.0 / boltzmann_fig1.N_FINE)
    found = shown("boltzmann_fig1", time=[0.0, 2.0])
    found.density[0, 7] = -1e-9
    assert fabricated.found("boltzmann_fig1", found)[claim].parts[0].measured.value > 0.0


def test_the_rms_speed_is_that_of_three_axes():
    found = shown("boltzmann_fig1")
    (part,) = fabricated.found("boltzmann_fig1", found)["boltzmann_10_rms"].parts
    assert part.measured.value == pytest.approx(math.sqrt(3.0), rel=1e-9)
    assert (part.printed, part.corrected) == (1.0, math.sqrt(3.0))


# Fig. 2


def trees(second_stop=-0.2):
    """Return two recorded trees: a leaf alone, and a collision of (1, 0, 0) with (0, 2, 0).

    Afterwards (0.5, 1, s) and (0.5, 1, -s), s² = 5/4: the energy stays 5.
    """
    s = math.sqrt(1.25)
    return fabricated.variables(
        tree=("branch", [0, 1, 1, 1]),
        start=("branch", [1.0, 1.0, 0.4, 0.4]),
        stop=("branch", [-0.3, 0.4, second_stop, -0.1]),
        parent=("branch", [-1, -1, 0, 0]),
        velocity=(
            ("branch", "axis"),
            [[2.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 1.0, s], [0.5, 1.0, -s]],
        ),
    )


def test_a_tree_returns_the_product_over_its_leaves():
    assert _trees.departures(trees()) == pytest.approx([0.0, 0.0], abs=1e-12)


def test_a_wrong_partner_is_seen():
    """One velocity after the collision changed: c* = (0, 2, 0.1), and momentum tells another M."""
    wrong = trees()
    wrong["velocity"][3, 2] += 0.1
    s = math.sqrt(1.25)
    leaves = [0.25 + 1.0 + 1.25, 0.25 + 1.0 + (0.1 - s) ** 2]
    gap = (leaves[0] + leaves[1] - 1.0 - 4.0 - 0.01) / 2.0
    assert _trees.departures(wrong)[1] == pytest.approx(math.expm1(-gap), rel=1e-9)


def test_departing_trees_are_counted():
    chosen = fabricated.settings("boltzmann_fig2", n_nodes=3)
    sample = trees()
    n = sample.sizes["branch"]
    places = np.arange(3.0 * n).reshape(n, 3)
    extra = {"begin": (("branch", "axis"), places), "end": (("branch", "axis"), places + 1.0)}
    found = fabricated.reduced("boltzmann_fig2", chosen, lambda case: sample.assign(extra))
    (part,) = fabricated.found("boltzmann_fig2", found)["boltzmann_17_leaves"].parts
    assert part.measured.value == 0.0
    found["departure"] = ("tree", [0.0, 1e-3, 1e-12, -1e-3])
    (part,) = fabricated.found("boltzmann_fig2", found)["boltzmann_17_leaves"].parts
    assert part.measured.value == 0.5


# Fig. 7

CHOSEN = {
    "majorant": [1.0, 2.5],
    "time": [0.5, 1.0, 2.0],
    "claim_time": [0.5, 2.0],
    "n_draws": 10,
    "large_n_draws": 50,
    "n_replicates": 4,
}


def table(scale):
    """Return 1, 2, ... over the grid of majorants and times, times a scale."""
    return scale * (1.0 + np.arange(6.0)).reshape(2, 3)


def fig7():
    """Means of 0.1, 0.2, ... alternating by 0.02, and variances of 1, 2, ... within replicates."""
    chosen = fabricated.settings("boltzmann_fig7", **CHOSEN)
    axes = {"majorant": CHOSEN["majorant"], "time": CHOSEN["time"]}

    def make(case):
        mean = table(0.1)[..., None] + 0.02 * np.array([1.0, -1.0, 1.0, -1.0])
        square = mean**2 + table(1.0)[..., None] * np.array([0.9, 1.1, 0.9, 1.1])
        nodes = table(10.0)[..., None] * np.array([0.9, 1.1, 0.9, 1.1])
        return fabricated.probes(case, axes, mean=mean, mean_square=square, nodes=nodes)

    return fabricated.reduced("boltzmann_fig7", chosen, make)


def test_fig7_predictions():
    found = fig7()
    for nu in CHOSEN["majorant"]:
        for t in CHOSEN["time"]:
            here = found.sel(majorant=nu, time=t)
            f = 1.0 / (1.0 + t)
            assert float(here.exact) == pytest.approx(f)
            assert float(here.recursion_exact) == pytest.approx(2.0 * math.exp(nu * t) - 1.0)
            variance = t / (nu + (nu - 1.0) * t) * f * f
            assert float(here.variance_exact) == pytest.approx(variance)


def test_fig7_claims_take_the_large_run_at_their_times():
    """Leaving out one of four moves a mean by a third of its departure: errors in closed form."""
    claims = fabricated.found("boltzmann_fig7", fig7())
    for k, nu in enumerate(CHOSEN["majorant"]):
        recursion = claims[f"boltzmann_extinction_recursion_{k + 1}"].parts
        variance = claims[f"boltzmann_extinction_variance_{k + 1}"].parts
        assert [part.label for part in variance] == ["t = 0.5", "t = 2"]
        for part, other, j in zip(recursion, variance, (0, 2), strict=True):
            t, value = CHOSEN["time"][j], table(1.0)[k, j]
            assert part.measured.value == pytest.approx(10.0 * value)
            # Standard deviation 0.1 · 2/√3 of the mean, over √4.
            assert part.measured.standard_error == pytest.approx(value / math.sqrt(3.0))
            assert part.printed == pytest.approx(2.0 * math.exp(nu * t) - 1.0)
            # All 200 realizations: within, plus 0.0004 between replicates.
            assert other.measured.value == pytest.approx((value + 4e-4) * 200 / 199)
            gaps = leave_one_out(value, table(0.1)[k, j])
            assert other.measured.standard_error == pytest.approx(gaps)
            assert other.printed == pytest.approx(t / (nu + (nu - 1.0) * t) / (1.0 + t) ** 2)
            assert part.measured.degrees == other.measured.degrees == 3


def leave_one_out(value, mean):
    """Return the jackknife error of the variance of four such replicates."""
    means = mean + 0.02 * np.array([1.0, -1.0, 1.0, -1.0])
    squares = means**2 + value * np.array([0.9, 1.1, 0.9, 1.1])
    left = [np.delete(squares, k).mean() - np.delete(means, k).mean() ** 2 for k in range(4)]
    return math.sqrt(3.0 / 4.0 * ((left - np.mean(left)) ** 2).sum())


def test_times_of_claims_must_be_drawn():
    chosen = fabricated.settings("boltzmann_fig7")
    assert boltzmann_fig7.problems(chosen) == []
    ((key, _),) = boltzmann_fig7.problems(chosen | {"claim_time": [0.6]})
    assert key == "claim_time"


# What the moments of Algorithm 4 say


def relative(t, nu):
    return t / (nu + (nu - 1.0) * t)


def exact_claims():
    return {one.claim: one for one in _extinction.claims(np.array([1.0, 2.5]), 2.0)}


def values(finding):
    return [part.measured.value for part in finding.parts]


def test_moments_against_closed_forms():
    claims = exact_claims()
    assert values(claims["boltzmann_21_density"]) == pytest.approx([1 / 3] * 2, rel=1e-8)
    assert [part.printed for part in claims["boltzmann_21_density"].parts] == [
        pytest.approx(1 / 3)
    ] * 2
    places = [(1.0, 1.0), (1.0, 2.0), (2.5, 1.0), (2.5, 2.0), (0.5, 0.5), (0.8, 2.0)]
    one = claims["boltzmann_29_variance"]
    wanted = [relative(t, nu) for nu, t in places]
    assert values(one) == pytest.approx(wanted, rel=1e-7)
    assert [part.printed for part in one.parts] == pytest.approx(wanted)
    one = claims["boltzmann_29b_infinite"]
    assert values(one) == pytest.approx([1.0, 4.0], rel=1e-6)
    assert [part.printed for part in one.parts] == pytest.approx([1.0, 4.0])
    (part,) = claims["boltzmann_limit_above"].parts
    assert part.measured.value == pytest.approx(relative(1000.0, 2.5), rel=1e-7)
    assert part.printed == pytest.approx(2.0 / 3.0)
    assert values(claims["boltzmann_limit_equal"]) == pytest.approx([1.0] * 3, rel=1e-7)
    falls = [1.0 - relative(1e3, nu) / 1001.0**2 / (relative(1.0, nu) / 4.0) for nu in (1.0, 2.5)]
    assert values(claims["boltzmann_limit_absolute"]) == pytest.approx(falls, rel=1e-7)


def test_eq_26_with_its_source_at_t():
    """At t = 2, f = 1/3: (1 - e^(-2ν))(f - f²/ν) + e^(-2ν) is what is printed."""
    parts = exact_claims()["boltzmann_26_source"].parts
    for part, nu in zip(parts, (1.0, 2.5), strict=True):
        left = math.exp(-2.0 * nu)
        assert part.measured.value == pytest.approx(1 / 3, rel=1e-9)
        assert part.printed == pytest.approx((1 - left) * (1 / 3 - 1 / 9 / nu) + left)
        assert part.corrected == pytest.approx(1 / 3)


def test_growth_and_compromise():
    """Algorithm 2 at c = 1: relative deviations 0.5999 and 1.6023 at t = 1 and 2 (prototype)."""
    claims = exact_claims()
    sharp = (1.6023 / 0.5999) ** 2
    own = [relative(2.0, nu) / relative(1.0, nu) for nu in (1.0, 2.5)]
    wanted = [sharp / one for one in own]
    assert values(claims["boltzmann_no_sharp_increase"]) == pytest.approx(wanted, rel=1e-3)
    saved = 1.0 - relative(2.0, 2.5) / relative(2.0, 1.0)
    paid = (2.0 * math.exp(5.0) - 1.0) / (2.0 * math.exp(2.0) - 1.0) - 1.0
    assert values(claims["boltzmann_compromise"]) == pytest.approx([saved, paid], rel=1e-7)


@pytest.mark.parametrize("nu", [0.5, 0.9, 1.0, 2.5])
def test_moments_by_the_shares_of_trees(nu):
    """No collision or one, at a short time; the cubes of what more of them make are below 60."""
    t = 1e-3
    none = math.exp(-nu * t)
    one = nu * math.exp(-nu * t) * (1.0 - math.exp(-nu * t)) / nu  # a collision of two leaves
    rest = 1.0 - none - one
    for k, moment in enumerate(extinction.moments(t, nu, 3), 1):
        assert moment == pytest.approx(none + one * (1.0 - 1.0 / nu) ** k, abs=60.0 * rest)
