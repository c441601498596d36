"""The slope of squared errors: by hand, against statsmodels, and calibrated.

One calibration without a z: the spread of 300 fitted slopes against their standard errors.
"""

import math
import warnings

import numpy as np
import pytest

from kacsim.statistics import slope


def test_slope_of_exact_powers():
    n = np.array([10.0, 30.0, 100.0, 1000.0])
    fitted, level = slope.of_squares(n, (2.7 * n**-0.7) ** 2, np.arange(4))
    assert fitted.value == pytest.approx(-0.7, abs=1e-9)
    assert fitted.standard_error == pytest.approx(0.0, abs=1e-9)
    assert level == pytest.approx(2.7)


def test_slope_of_two_sizes_by_hand():
    """Two sizes: the fitted squares are their means; three groups of two squares at each size.

    Without a group of sum R, in units of the mean of its size, one step of Newton's lowers the
    logarithm of that mean by (R - 2) / (6 - R); the slope is their difference over twice the span
    of log n, and its error that of the jackknife.
    """
    n = np.repeat([10.0, 40.0], 6)
    squares = np.array([1.0, 2.0, 3.0, 1.5, 2.5, 2.0, 0.7, 0.3, 0.5, 0.4, 0.6, 0.5])
    groups = np.repeat(np.arange(6), 2)
    fitted, _ = slope.of_squares(n, squares, groups)
    means, span = (squares[:6].mean(), squares[6:].mean()), math.log(4.0)
    assert fitted.value == pytest.approx(0.5 * math.log(means[1] / means[0]) / span)
    sums = (squares / np.repeat(means, 6)).reshape(6, 2).sum(axis=1)
    steps = np.repeat([-1.0, 1.0], 3) * (sums - 2.0) / (6.0 - sums) / (2.0 * span)
    error = math.sqrt(5 / 6 * ((steps - steps.mean()) ** 2).sum())
    assert fitted.standard_error == pytest.approx(error, rel=1e-6)
    assert fitted.degrees == pytest.approx(5)


def test_slope_and_its_error_are_calibrated(seed):
    """300 sets of 40 normal errors, each twice: bias, spread and stated error agree."""
    rng = np.random.default_rng(seed)
    n = np.repeat(np.geomspace(10.0, 1e5, 40), 2)
    groups = np.repeat(np.arange(40), 2)
    found = []
    for _ in range(300):
        error = 3.0 * n**-0.4 * np.repeat(rng.normal(size=40), 2)
        found.append(slope.of_squares(n, error**2, groups)[0])
    values = np.array([one.value for one in found])
    stated = math.sqrt(np.mean([one.standard_error**2 for one in found]))
    assert values.mean() == pytest.approx(-0.4, abs=0.012)
    assert values.std() / stated == pytest.approx(1.0, abs=0.2)
    single = slope.of_squares(n, (3.0 * n**-0.4) ** 2 * rng.chisquare(1, n.size), np.arange(80))
    assert 0.0 < single[0].standard_error < stated


@pytest.fixture(scope="module")
def sm():
    """Return statsmodels, whose import takes longer than the fits."""
    import statsmodels.api

    return statsmodels.api


def powers(rng):
    """Yield (name, numbers of points, squared errors, groups) that fits find hard."""
    n, pairs = np.repeat(np.geomspace(10.0, 1e5, 40), 2), np.repeat(np.arange(40), 2)
    normal = np.repeat(rng.normal(size=40), 2) ** 2
    yield "each square twice", n, 9.0 * n**-0.8 * normal, pairs
    yield "squares of 1e-30", n, 1e-30 * n**-2.0 * normal, pairs
    n = np.geomspace(3.0, 1e8, 25)
    heavy = n**-1.3 * rng.standard_t(3, 25) ** 2
    heavy[[3, 9]] = 0.0
    yield "zeros and heavy tails", n, heavy, np.arange(25) % 7
    n = np.geomspace(10.0, 1e6, 60)
    wild = n**-0.5 * rng.chisquare(1, 60) * np.exp(2.0 * rng.normal(size=60))
    yield "one large group of many", n, wild, np.r_[np.zeros(30), np.arange(30)].astype(int)
    four = np.array([1e-12, 3e-9, 1e-7, 2e-8])
    yield "a narrow range", np.array([50.0, 50.0, 51.0, 52.0]), four, np.arange(4)
    far = np.array([1.0, 0.01, 1e-20, 1.1])
    yield "one nearly exact", np.array([10.0, 100.0, 1000.0, 10.0]), far, np.arange(4)
    n = np.repeat([2.0, 3.0, 1e9], [1, 2, 40])
    yield "sizes far apart", n, n**-0.3 * rng.chisquare(1, 43), np.arange(43) // 2


@pytest.mark.parametrize("choice", range(3))
@pytest.mark.parametrize("k", range(7), ids=[name for name, *_ in powers(np.random.default_rng(0))])
def test_slope_is_that_of_statsmodels(k, choice, sm):
    """The Gamma family's quasi-likelihood with logarithmic link, and its fit without each group.

    statsmodels' Gamma family has no place for squares below 1e-20: they are given in units of
    their mean, which only the level feels. One iteration of its Newton method is the step of the
    jackknife.
    """
    _, n, squares, groups = list(powers(np.random.default_rng(choice)))[k]
    fitted, level = slope.of_squares(n, squares, groups)
    design, unit = sm.add_constant(np.log(n)), squares.mean()
    family = sm.families.Gamma(sm.families.links.Log())
    glm = sm.GLM(squares / unit, design, family=family).fit(tol=1e-14, maxiter=5000)
    assert fitted.value == pytest.approx(0.5 * glm.params[1], rel=1e-6, abs=1e-9)
    assert level == pytest.approx(math.sqrt(unit) * math.exp(0.5 * glm.params[0]), rel=1e-6)
    start = {"start_params": glm.params, "method": "newton", "maxiter": 1, "disp": False}
    without = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # one iteration does not converge
        for g in np.unique(groups):
            rest = groups != g
            one = sm.GLM((squares / unit)[rest], design[rest], family=family).fit(**start)
            without.append(0.5 * one.params[1])
    many = len(without)
    error = math.sqrt((many - 1) / many * ((without - np.mean(without)) ** 2).sum())
    if error > 1e6:  # without a group nothing fixes the slope
        assert fitted.standard_error > 1e6
    else:
        assert fitted.standard_error == pytest.approx(error, rel=1e-4)


def test_degrees_by_hand():
    """Three groups at 1, 10 and 100, a pair each, weigh 1, 0, 1: one degree. Alike: one a seed."""
    n, squares = np.array([1.0, 1.0, 10.0, 10.0, 100.0, 100.0]), np.arange(1.0, 7.0)
    apart, _ = slope.of_squares(n, squares, np.repeat([0, 1, 2], 2))
    assert apart.degrees == pytest.approx(1.0)
    alike, _ = slope.of_squares(
        np.tile([2.0, 4.0, 9.0], 7), np.arange(1.0, 22.0), np.arange(21) // 3
    )
    assert alike.degrees == pytest.approx(6.0)


@pytest.mark.parametrize("k", [0, 2])
def test_the_error_is_near_that_of_the_sandwich(k, sm):
    """Of groups of like size: the Gamma family's GEE, not corrected for their number."""
    _, n, squares, groups = list(powers(np.random.default_rng(1)))[k]
    family = sm.families.Gamma(sm.families.links.Log())
    gee = sm.GEE(
        squares / squares.mean(),
        sm.add_constant(np.log(n)),
        groups,
        family=family,
        cov_struct=sm.cov_struct.Independence(),
    ).fit(maxiter=5000, ctol=1e-12)
    ratio = slope.of_squares(n, squares, groups)[0].standard_error / (0.5 * gee.bse[1])
    assert 0.9 < ratio < 2.0


def test_another_model_has_another_slope(sm):
    """Negative control: Poisson's family, and groups as if each square were one."""
    _, n, squares, groups = next(powers(np.random.default_rng(1)))
    fitted, _ = slope.of_squares(n, squares, groups)
    poisson = sm.GLM(squares, sm.add_constant(np.log(n)), family=sm.families.Poisson()).fit()
    assert abs(0.5 * poisson.params[1] - fitted.value) > 0.01
    alone, _ = slope.of_squares(n, squares, np.arange(n.size))
    assert alone.standard_error < 0.8 * fitted.standard_error
