"""Fig. 11.3 of the chapter from samples made by hand: every face and every source differs.

No z tests: expected numbers were put into the samples, or are closed forms by quadrature.
"""

import math

import fabricated
import fabricated_chapter as chapter
import numpy as np
import pytest
from scipy import integrate

N = 4  # replicates
STEP, DRIFT, TEMPERATURE, BOX = 0.25, [0.6, -0.3, 0.0], 1.7, [1.0, 1.5, 0.7]
SPREAD = np.array([1.0, -1.0, 1.0, -1.0])  # of replicates about their mean
ROOT = math.sqrt(N - 1)  # their standard error is the amplitude over this


def moment(power, u):
    """Return the integral of v**power over v > 0 of the normal density of mean u."""

    def f(v):
        bell = math.exp(-((v - u) ** 2) / (2.0 * TEMPERATURE))
        return v**power * bell / math.sqrt(2.0 * math.pi * TEMPERATURE)

    return integrate.quad(f, 0.0, 20.0)[0]


def mean_speed(face, weight):
    u = (DRIFT[0], -DRIFT[0])[face]
    return moment(weight + 1, u) / moment(weight, u)


def rate(u, area, density=5.0):
    return density * area * STEP * moment(1, u)


def steps_of(shift):
    """Return int[replicate, face, number] of 100 steps: 10 f + shift and more without particles."""
    steps = np.zeros((N, 6, 4))
    for face in range(6):
        none = 10.0 * face + shift + SPREAD
        steps[:, face, 0], steps[:, face, 1], steps[:, face, 3] = none, 80.0 - none, 20.0
    return steps


def gas(case, shift, speed, place):
    return chapter.entering(
        case,
        steps_of(shift),
        speed=speed + 0.1 * np.arange(6) + 0.003 * SPREAD[:, None],
        speed_2=2.0 * speed + 0.2 * np.arange(6) + 0.01 * SPREAD[:, None],
        squares=place + 0.01 * np.arange(6) + 0.002 * SPREAD[:, None],
    )


VELOCITY = np.array([[2.0, 9.0, 9.0], [-3.0, 9.0, 9.0], [1.0, 9.0, 9.0], [4.0, 9.0, 9.0]])
WEIGHT = np.array([1.0, 2.0, 3.0, 1.0])
SELECTED = np.array([[30, 0, 10, 60], [20, 0, 20, 60], [30, 0, 10, 60], [20, 0, 20, 60]])


def made(shift=20.0, speed=2.0, place=0.6, selected=SELECTED):
    chosen = fabricated.settings("techniques_fig3", step=STEP, n_draws=100, n_replicates=N)
    assert (chosen["drift"], chosen["half_width"], chosen["density"]) == (DRIFT, BOX, 5.0)

    def make(case):
        if case.name == "weighted_particles":
            return fabricated.variables(
                velocity=(("particle", "axis"), VELOCITY),
                weight=(("particle",), WEIGHT),
                selected=(("replicate", "particle"), selected),
            )
        other = {"injection": 15.0, "outer_gas": 0.0}[case.name]
        return gas(case, shift + other, speed + other, place + other)

    return fabricated.reduced("techniques_fig3", chosen, make)


def test_values_and_errors_by_source_and_face():
    found = made()
    for source, other in (("outer_gas", 0.0), ("injection", 15.0)):
        for face, name in enumerate(("-x", "+x", "-y", "+y", "-z", "+z")):
            here = found.sel(source=source, face=name)
            none = 10.0 * face + 20.0 + other
            mean = (80.0 - none + 60.0) / 100.0
            assert float(here.none) == pytest.approx(none / 100.0)
            assert float(here.none_error) == pytest.approx(0.01 / ROOT)
            assert float(here.rate) == pytest.approx(mean)
            assert float(here.rate_error) == pytest.approx(0.01 / ROOT)
            assert float(here.speed) == pytest.approx(2.0 + other + 0.1 * face)
            assert float(here.speed_error) == pytest.approx(0.003 / ROOT)
            assert float(here.square) == pytest.approx(2.0 * (2.0 + other) + 0.2 * face)
            assert float(here.square_error) == pytest.approx(0.01 / ROOT)
            assert float(here.place) == pytest.approx(0.6 + other + 0.01 * face)
            assert float(here.place_error) == pytest.approx(0.002 / ROOT)
            number = np.array([none, 80.0 - none, 0.0, 20.0])
            shares = found.share.sel(source=source, face=name).values
            assert shares == pytest.approx(number / 100.0)
    # variance over mean of the numbers of each replicate, at the last face of the gas
    ratios = []
    for none in 70.0 + SPREAD:
        m = (80.0 - none + 60.0) / 100.0
        ratios.append(((80.0 - none + 180.0) / 100.0 - m**2) / m)
    last = found.sel(source="outer_gas", face="+z")
    assert float(last.fano) == pytest.approx(np.mean(ratios))
    assert float(last.fano_error) == pytest.approx(np.std(ratios, ddof=1) / 2.0)


def test_closed_forms_beside_them():
    found = made()
    areas = [4.0 * 1.5 * 0.7] * 2 + [4.0 * 1.0 * 0.7] * 2 + [4.0 * 1.0 * 1.5] * 2
    inward = [0.6, -0.6, -0.3, 0.3, 0.0, 0.0]
    for face in range(6):
        here = found.isel(face=face)
        u = inward[face]
        assert float(here.rate_exact) == pytest.approx(rate(u, areas[face]), rel=1e-6)
        assert float(here.speed_exact) == pytest.approx(moment(2, u) / moment(1, u), rel=1e-6)
        assert float(here.speed_unweighted) == pytest.approx(moment(1, u) / moment(0, u), rel=1e-6)
        assert float(here.square_exact) == pytest.approx(moment(3, u) / moment(1, u), rel=1e-6)
        assert here.share_exact.values[:3] == pytest.approx(
            np.exp(-rate(u, areas[face])) * rate(u, areas[face]) ** np.arange(3) / [1, 1, 2],
            rel=1e-6,
        )


def test_choice_among_weighted_particles():
    """Lengths 2, 0, 3, 4: means 27 / 9 by length, 9 / 5 by weight; drawn 3.1 and 3.0."""
    found = made()
    assert float(found.weighted_speed_exact) == pytest.approx((2 * 2 + 3 * 1 + 4 * 4) / 9.0)
    assert float(found.weighted_speed_bare) == pytest.approx((1 * 2 + 3 * 1 + 1 * 4) / 5.0)
    assert float(found.weighted_speed) == pytest.approx(3.05)
    assert float(found.weighted_speed_error) == pytest.approx(0.05 / ROOT)
    assert float(found.weighted_outward) == 0.0
    outward = SELECTED + np.array([0, 5, 0, 0])
    assert float(made(selected=outward).weighted_outward) == 20.0


def test_claims_take_the_moved_gas_at_their_faces():
    found = fabricated.found("techniques_fig3", made())
    flux = rate(0.6, 4.0 * 1.5 * 0.7)
    assert chapter.values(found, "techniques_fig3_limits") == [
        ("", pytest.approx(1.2), pytest.approx(0.01 / ROOT), N - 1)
    ]
    printed, _, corrected = chapter.sets(found, "techniques_fig3_limits")[0]
    assert printed == pytest.approx(flux * 1.5 / 0.7, rel=1e-6)
    assert corrected == pytest.approx(flux, rel=1e-6)
    # +x has 30 steps of 100 without a particle, -y has 40
    against = [rate(-0.6, 4.0 * 1.5 * 0.7), rate(-0.3, 4.0 * 1.0 * 0.7)]
    for k, none in enumerate((0.3, 0.4)):
        label, value, error, degrees = chapter.values(found, "techniques_fig3_rate")[k]
        assert label == f"no particle, face {('+x', '-y')[k]}"
        assert (value, degrees) == (pytest.approx(none), N - 1)
        assert error == pytest.approx(0.01 / ROOT)
        printed, rival, _ = chapter.sets(found, "techniques_fig3_rate")[k]
        assert printed == pytest.approx(math.exp(-against[k]), rel=1e-6)
        assert rival == pytest.approx(math.exp(-against[k] / STEP), rel=1e-5)
    assert chapter.values(found, "techniques_fig3_position") == [
        ("", pytest.approx(0.6), pytest.approx(0.002 / ROOT), N - 1)
    ]
    assert chapter.sets(found, "techniques_fig3_position")[0][0] == pytest.approx(2.0 / 3.0)
    for k in range(2):
        label, value, error, degrees = chapter.values(found, "techniques_fig3_weight")[k]
        assert (label, degrees) == (f"face {('-x', '+x')[k]}", N - 1)
        assert (value, error) == (pytest.approx(2.0 + 0.1 * k), pytest.approx(0.003 / ROOT))
        printed, rival, _ = chapter.sets(found, "techniques_fig3_weight")[k]
        assert printed == pytest.approx(mean_speed(k, 1), rel=1e-6)
        assert rival == pytest.approx(mean_speed(k, 0), rel=1e-6)
    assert chapter.values(found, "techniques_fig3_particles") == [
        ("", pytest.approx(3.05 * 9 / 23), pytest.approx(0.05 / ROOT * 9 / 23), N - 1)
    ]
    sets = chapter.sets(found, "techniques_fig3_particles")
    assert sets[0][:2] == pytest.approx((1.0, 1.8 * 9 / 23))


def test_exact_claims():
    """Sums over eq. (11.15), numbers found in its steps, and the spread that a mean has not."""
    found = fabricated.found("techniques_fig3", made())
    sums = chapter.values(found, "techniques_fig3_variance")
    assert len(sums) == 9
    assert [one[1] for one in sums] == pytest.approx([1.0] * 9, abs=1e-9)
    assert [one[0] for one in chapter.sets(found, "techniques_fig3_variance")] == [1.0] * 9
    numbers = chapter.values(found, "techniques_fig3_recipe")
    rates = [one[0] for one in chapter.sets(found, "techniques_fig3_recipe")]
    assert rates == [0.5, 30.0, 1000.0]
    assert [one[1] for one in numbers] == pytest.approx(rates, rel=1e-3)
    lost = [one[1] for one in chapter.values(found, "techniques_fig3_fixed")]
    assert lost == pytest.approx([math.sqrt(2.0), 1.0])
    for claim in ("variance", "recipe", "fixed", "discrete"):
        assert chapter.word(found, f"techniques_fig3_{claim}") == "reproduced"


def test_discrete_particles_by_the_delta_method():
    """Variance of sum v**2 / sum v over 1e6 particles, by moments of the drifting gas."""
    found = fabricated.found("techniques_fig3", made())
    m = [moment(k, 0.6) for k in range(5)]
    mean = m[2] / m[1]
    variance = (m[4] - 2.0 * mean * m[3] + mean**2 * m[2]) / m[1] ** 2 / 1e6
    ((_, value, error, _),) = chapter.values(found, "techniques_fig3_discrete")
    assert (value, error) == (pytest.approx(math.sqrt(variance) / mean, rel=1e-6), 0.0)


def test_verdicts_turn_round_with_the_gas():
    """The printed limits and the unweighted speed are told from the right ones."""
    flux = rate(0.6, 4.0 * 1.5 * 0.7)
    right = fabricated.found("techniques_fig3", exactly(flux, mean_speed(0, 1), mean_speed(1, 1)))
    assert chapter.word(right, "techniques_fig3_limits") == "corrected"
    assert chapter.word(right, "techniques_fig3_weight") == "reproduced"
    wide = exactly(flux * 1.5 / 0.7, mean_speed(0, 0), mean_speed(1, 0))
    wrong = fabricated.found("techniques_fig3", wide)
    assert chapter.word(wrong, "techniques_fig3_limits") == "reproduced"
    assert chapter.word(wrong, "techniques_fig3_weight") == "contradicted"


def exactly(flux, first, second):
    """Return the dataset with a rate through -x and speeds at -x and +x as given."""
    dataset = made()
    gas_at = {"source": "outer_gas"}
    dataset.rate.loc[gas_at | {"face": "-x"}] = flux
    dataset.rate_error.loc[gas_at | {"face": "-x"}] = 1e-4
    for face, value in (("-x", first), ("+x", second)):
        dataset.speed.loc[gas_at | {"face": face}] = value
        dataset.speed_error.loc[gas_at | {"face": face}] = 1e-4
    return dataset
