"""Exercises, means and steps of the chapter from samples made by hand.

No z tests: expected numbers were put into the samples, or are closed forms.
"""

import math

import fabricated
import fabricated_chapter as chapter
import numpy as np
import pytest
from scipy import integrate, stats

from kacsim.items import _techniques

N, SEEDS = 4, 6  # replicates, and seeds of the area
ROOT = math.sqrt(N - 1)
SPREAD = np.array([1.0, -1.0, 1.0, -1.0])
POINTS = [250, 1000]
# relative errors of the area by way, seed and number of points
ERRORS = np.array(
    [
        [[0.02, 0.01], [-0.01, 0.02], [0.03, -0.01], [0.0, 0.01], [-0.02, 0.0], [0.01, -0.02]],
        [[0.01, 0.0], [0.0, -0.01], [0.01, 0.01], [-0.02, 0.0], [0.01, 0.01], [0.0, 0.02]],
    ]
)
AREA = math.sqrt(math.pi) * math.gamma(1.3) / math.gamma(1.8)


def exercises():
    chosen = fabricated.settings(
        "techniques_exercises",
        n_points=POINTS,
        area_n_replicates=SEEDS,
        gas_n_draws=100,
        n_draws=4000,
        n_replicates=N,
    )
    assert (chosen["rate"], chosen["temperature"], chosen["step"]) == (2.5, 1.7, 0.1)

    def make(case):
        if case.name == "inversion":
            return chapter.law(case, mean=fabricated.about(0.41, 0.002, N))
        if case.name == "area":
            return fabricated.variables(
                estimate=(("way", "replicate", "points"), AREA * (1.0 + ERRORS)),
                points=(("points",), POINTS),
            )
        steps = np.zeros((N, 6, 4))
        for face in range(6):
            none = 30.0 + face + SPREAD
            steps[:, face, 0], steps[:, face, 1], steps[:, face, 2] = none, 36.0, 14.0
            steps[:, face, 3] = 50.0 - none
        speed = 3.0 + 0.2 * np.arange(6) + 0.01 * SPREAD[:, None]
        return chapter.entering(case, steps, speed_2=speed)

    return fabricated.reduced("techniques_exercises", chosen, make)


def test_exercises_1_and_2():
    """Steps of all faces: 32.5 +- 1 without a particle, 36 with one, 14 with two, 17.5 more."""
    dataset = exercises()
    found = fabricated.found("techniques_exercises", dataset)
    assert chapter.values(found, "techniques_exercise1") == [
        ("", pytest.approx(0.41), pytest.approx(0.002), N - 1)
    ]
    assert chapter.sets(found, "techniques_exercise1")[0][0] == 0.4
    shares = chapter.values(found, "techniques_exercise2_numbers")
    assert [one[1] for one in shares] == pytest.approx([0.325, 0.36, 0.14])
    assert [one[2] for one in shares] == pytest.approx([0.01 / ROOT, 0.0, 0.0], abs=1e-12)
    printed = [one[0] for one in chapter.sets(found, "techniques_exercise2_numbers")]
    assert printed == pytest.approx([1 / math.e, 1 / math.e, 0.5 / math.e])
    # 36 + 28 + 52.5 particles in 100 steps of 0.1 through a face of 4; three fewer or more
    ((_, value, error, degrees),) = chapter.values(found, "techniques_exercise2_rate")
    assert (value, degrees) == (pytest.approx(1.165 / 0.4), N - 1)
    assert error == pytest.approx(0.03 / 0.4 / ROOT)
    assert chapter.sets(found, "techniques_exercise2_rate")[0][0] == pytest.approx(2.5)


def test_exercise_2_weights_faces_by_their_particles():
    found = fabricated.found("techniques_exercises", exercises())
    ((_, value, error, _),) = chapter.values(found, "techniques_exercise2_velocity")
    squares = []
    for spread in SPREAD:
        number = 36.0 + 28.0 + 3.0 * (20.0 - np.arange(6) - spread)
        squares.append((number * (3.0 + 0.2 * np.arange(6) + 0.01 * spread)).sum() / number.sum())
    assert value == pytest.approx(np.mean(squares))
    assert error == pytest.approx(np.std(squares, ddof=1) / 2.0)
    assert chapter.sets(found, "techniques_exercise2_velocity")[0][:2] == (3.4, 1.7)


def test_exercise_3():
    """Errors squared times N over 0.002**2, over both numbers of points; predicted 42754, 9406."""
    dataset = exercises()
    found = fabricated.found("techniques_exercises", dataset)
    areas = chapter.values(found, "techniques_exercise3_area")
    points = chapter.values(found, "techniques_exercise3_points")
    for k, label in enumerate(("points below the curve", "mean height")):
        last = AREA * (1.0 + ERRORS[k, :, -1])
        error = last.std(ddof=1) / math.sqrt(SEEDS)
        mean = pytest.approx(last.mean())
        assert areas[k] == (label, mean, pytest.approx(error), SEEDS - 1)
        assert chapter.sets(found, "techniques_exercise3_area")[k][0] == pytest.approx(AREA)
        needed = (ERRORS[k] ** 2 * POINTS).mean(axis=1) / 0.002**2
        predicted = (42754.4175, 9406.2912)[k]
        assert points[k][0] == label
        assert points[k][1] == pytest.approx(needed.mean() / predicted)
        spread = needed.std(ddof=1) / math.sqrt(SEEDS) / predicted
        assert points[k][2:] == (pytest.approx(spread), SEEDS - 1)
        rms = np.sqrt((ERRORS[k] ** 2).mean(axis=0))
        assert dataset.rms.values[k] == pytest.approx(rms)
        assert dataset.within.values[k] == pytest.approx([(1, 1), (2, 2)][k] / np.array(SEEDS))


def test_predicted_points_of_exercise_3_by_quadrature():
    """Relative variance of one point over 0.002**2: of a hit in a box of area 2, of a height."""
    dataset = exercises()
    height = integrate.quad(lambda x: (1 - x * x) ** 0.3, -1, 1)[0] / 2
    square = integrate.quad(lambda x: (1 - x * x) ** 0.6, -1, 1)[0] / 2
    expected = [(height - height**2) / height**2, (square - height**2) / height**2]
    assert dataset.needed_exact.values == pytest.approx(np.array(expected) / 0.002**2, rel=1e-6)


# Means


def means():
    return fabricated.reduced(
        "techniques_means",
        fabricated.settings("techniques_means", n_samples=[2, 10, 21, 10_000]),
        None,
    )


def test_means_against_the_binomial_law_of_scipy():
    dataset, p = means(), math.pi**2 / 32
    for n in (2, 10, 21):
        k = np.arange(n + 1)
        weight = stats.binom.pmf(k, n, p)
        values = [np.r_[np.ones(j), np.zeros(n - j)] for j in k]
        variance = np.array([v.var(ddof=1) for v in values])
        here = dataset.sel(n_samples=n)
        assert float(here.variance) == pytest.approx((weight * variance).sum() / (p * (1 - p)))
        for width in (1, 2, 3):
            near = np.abs(k / n - p) <= width * np.sqrt(variance / n)
            assert float(here.near.sel(width=width)) == pytest.approx(weight[near].sum())
        spread = math.sqrt((weight * (k / n - p) ** 2).sum()) / p
        assert float(here.error) == pytest.approx(spread)


def test_claims_of_means():
    found = fabricated.found("techniques_means", means())
    assert [one[:2] for one in chapter.values(found, "techniques_means_unbiased")] == [
        ("N = 2", pytest.approx(1.0)),
        ("N = 10", pytest.approx(1.0)),
    ]
    assert chapter.sets(found, "techniques_means_unbiased")[0][:2] == (1.0, 0.5)
    assert chapter.sets(found, "techniques_means_unbiased")[1][:2] == (1.0, 0.9)
    normal = [one[0] for one in chapter.sets(found, "techniques_means_normal")]
    assert normal == pytest.approx([0.6826895, 0.9544997, 0.9973002])
    shares = [one[1] for one in chapter.values(found, "techniques_means_normal")]
    assert shares == pytest.approx(normal, abs=0.006)
    assert chapter.values(found, "techniques_means_root")[0][1] == pytest.approx(-0.5)
    assert chapter.sets(found, "techniques_means_root")[0][0] == -0.5
    for claim in ("unbiased", "normal", "root"):
        assert chapter.word(found, f"techniques_means_{claim}") == "reproduced"


# Steps

ALONG = {"flight": 0.95, "steps": -0.2, "derivative": 0.9}


def steps(along=ALONG, error=0.003):
    chosen = fabricated.settings("techniques_steps", n_draws=100, n_replicates=N)
    assert chosen["correlation"] == 0.8

    def make(case):
        value = along[case.parameters["way"]]
        mean = np.stack([np.full(N, 1.25), fabricated.about(value, error, N)], axis=1)
        counts = np.zeros((N, 4))
        counts[:, 1], counts[:, 2], counts[:, 3] = 60.0, 20.0, 20.0
        return fabricated.variables(
            mean=(("replicate", "velocity"), mean),
            product=(("replicate",), np.zeros(N)),
            counts=(("replicate", "bin"), counts),
            edge=(("edge",), [-1.0, 1.0, 1.5]),
        )

    return fabricated.reduced("techniques_steps", chosen, make)


def test_steps_reduced():
    dataset = steps()
    assert dataset.along.values == pytest.approx(list(ALONG.values()))
    assert dataset.along_error.values == pytest.approx([0.003] * 3)
    assert dataset.normal.values == pytest.approx([1.25] * 3)
    # 60 of 100 over a width of 2, 20 over one of 0.5
    assert dataset.density.values == pytest.approx(np.tile([0.3, 0.4], (3, 1)))


def test_claims_of_steps():
    """Closed form 0.8 root(pi / 2); the printed steps by adaptive quadrature."""
    found = fabricated.found("techniques_steps", steps())
    normal = stats.norm
    below = integrate.quad(
        lambda r: r * math.exp(-r * r / 2) * normal.pdf(r) / normal.cdf(r), 0.0, 12.0
    )[0]
    exact = 0.8 * math.sqrt(math.pi / 2)
    summed, flight = chapter.values(found, "techniques_steps_velocity")
    assert summed == ("summed over the flux", pytest.approx(exact, rel=1e-5), 0.0, None)
    assert flight == ("straight flight", pytest.approx(0.95), pytest.approx(0.003), N - 1)
    for printed, _, corrected in chapter.sets(found, "techniques_steps_velocity"):
        assert printed == pytest.approx(-0.8 * below, rel=1e-5)
        assert corrected == pytest.approx(exact)
    assert chapter.values(found, "techniques_steps_separable")[0][1] == pytest.approx(-0.3)
    assert chapter.sets(found, "techniques_steps_separable")[0][0] == -0.3
    assert chapter.word(found, "techniques_steps_separable") == "reproduced"
    lines = chapter.values(found, "techniques_steps_flux")[::2]
    assert [one[1] for one in lines] == pytest.approx([1.0] * 3, rel=1e-6)
    shares = chapter.values(found, "techniques_steps_flux")[1::2]
    printed = [one[0] for one in chapter.sets(found, "techniques_steps_flux")]
    assert printed[::2] == [1.0] * 3
    total, *parts = (
        integrate.quad(lambda v: v * normal.pdf(v - 0.46), 0, end, epsabs=1e-13)[0]
        for end in (12.0, 0.5, 1.0, 2.5)
    )
    for k, part in enumerate(parts):
        assert shares[k][1] == pytest.approx(part / total, rel=1e-5)
        assert printed[1::2][k] == pytest.approx(part / total, rel=1e-9)  # the closed form's


def test_the_verdict_on_the_steps_hangs_on_the_flight_alone():
    exact, words = 0.8 * math.sqrt(math.pi / 2), []
    for flight, others in ((exact, 7.0), (-0.2069, exact)):
        dataset = steps({"flight": flight, "steps": others, "derivative": others}, error=1e-4)
        found = fabricated.found("techniques_steps", dataset)
        words.append(chapter.word(found, "techniques_steps_velocity"))
    assert words == ["corrected", "contradicted"]


def test_pearsons_p_value_has_a_degree_less_than_bins():
    """Three shares of 100 draws, (36, 36, 28) for (40, 30, 30): exp(-x/2) of two degrees."""
    statistic = 16 / 40 + 36 / 30 + 4 / 30
    p_value = _techniques.chi_squared([36, 36, 28], [0.4, 0.3, 0.3])
    assert p_value == pytest.approx(math.exp(-statistic / 2.0))


@pytest.mark.parametrize(("face", "inward"), [(0, 0.5), (1, -0.5), (2, -0.2), (3, 0.2)])
def test_a_drift_inward_makes_entering_particles_faster(face, inward):
    """The flux v f(v) up to an edge over the whole; at -x the inward normal is +x."""
    edges, temperature = np.array([0.0, 0.7, 1.9]), 1.3

    def flux(v):
        return v * math.exp(-((v - inward) ** 2) / (2.0 * temperature))

    upto = [integrate.quad(flux, 0.0, edge)[0] for edge in (0.0, 0.7, 1.9, 20.0)]
    chosen = {"drift": [0.5, -0.2, 0.0], "temperature": temperature}
    law = _techniques.speed_law(chosen, edges, face)
    assert law == pytest.approx(np.diff(upto) / upto[-1], rel=1e-6)
