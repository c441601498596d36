"""Fig. 2 of the Kac paper, on samples whose TVN is known. No z tests: all is exact."""

import math

import numpy as np
import pytest
from fabricated import about, eq_8, found, judged, reduced, settings, velocities, with_tvn
from scipy import stats

from kacsim import items

N_DRAWS = 10**7
MANY = {"n_replicates": 4, "other_n_replicates": 2, "line_n_replicates": 10}
STEPS, NUMBERS = [0.5, 1.0, 0.25], [10, 5]  # not in order: the largest step is not the first
LINE = {
    ("bird", 50): 0.0095,
    ("bird", 100): 0.0093,
    ("poisson", 50): 0.0092,
    ("poisson", 100): 0.0091,
}
ERRORS = {("bird", 50): 1e-5, ("bird", 100): 2e-5, ("poisson", 50): 3e-5, ("poisson", 100): 4e-5}


def level(reading, n, step):
    """Return a TVN that falls with the step, by more for 10 particles; another for each reading."""
    return (0.02 if n == 10 else 0.01) * step + (0.005 if reading == "nanbu_sequential" else 0.001)


def make(case):
    p = case.parameters
    key = p["algorithm"], p["n_particles"]
    if key in LINE:
        values = about(LINE[key], ERRORS[key], case.n_replicates)
    else:
        values = about(level(*key, p["time_step"]), 5e-5, case.n_replicates)
    return velocities(case, with_tvn(values, N_DRAWS, p["time"]))


@pytest.fixture(scope="module")
def findings():
    sizes = {"n_draws": N_DRAWS, "time_step": STEPS, "n_particles": NUMBERS}
    sizes["other_bin_widths"] = [0.5]
    return found("kac_fig2", reduced("kac_fig2", settings("kac_fig2", **sizes, **MANY), make))


def wide(law):
    """Return the probabilities of bins of 0.1, from those of the fine ones."""
    return np.r_[law[0], law[1:-1:2] + law[2:-1:2], law[-1]]


def dealt(value, n_replicates):
    """Return the mean TVN over all ways to deal draws whose share `value` is in the lower tail.

    The others follow eq. (8); the number of a bin in a part of all draws is nearly normal.
    """
    law = wide(eq_8(2.0))
    drawn = (1.0 - value) * law
    drawn[0] += value
    spread = np.sqrt(
        np.maximum(drawn * (1.0 - drawn), 1e-20) / N_DRAWS * (1.0 - 1.0 / n_replicates)
    )
    return 0.5 * stats.foldnorm(np.abs(drawn - law) / spread, scale=spread).mean().sum()


def floor(law, n_draws):
    """Return half the sum of sqrt(2 p (1 - p) / (pi n)) over bins of 0.1."""
    p = wide(law)
    return 0.5 * np.sqrt(2.0 * p * (1.0 - p) / (math.pi * n_draws)).sum()


def normal():
    edges = np.linspace(-8.0, 8.0, 321)
    return np.diff(stats.norm.cdf(edges), prepend=0.0, append=1.0)


def test_the_line_has_a_part_for_all_that_the_sentence_covers(findings):
    parts = {part.label: part.measured for part in findings["kac_fig2_line"].parts}
    for (name, n), value in LINE.items():
        title = "Bird" if name == "bird" else "Poisson (exact)"
        mean = parts.pop(f"{title}, N = {n}")
        assert mean.value == pytest.approx(dealt(value, mean.degrees + 1), abs=2e-6)
        assert mean.standard_error == pytest.approx(ERRORS[name, n], rel=0.02)
        assert mean.degrees == (9 if (name, n) == ("bird", 50) else 3)
    (exact,) = parts.values()
    assert exact.value == pytest.approx(floor(eq_8(2.0), N_DRAWS), rel=2e-3)
    assert exact.standard_error == 0.0


def test_differences_to_the_line(findings):
    """The line less the other, at every N, and less exact draws of eq. (8) (N infinite)."""
    line = dealt(0.0095, 10)
    endless = line - floor(eq_8(2.0), N_DRAWS)
    wanted = {
        "kac_fig2_bird_larger_n": {
            "N = 100": line - dealt(0.0093, 4),
            "N = ∞, exact draws": endless,
        },
        "kac_fig2_poisson": {
            "N = 50": line - dealt(0.0092, 4),
            "N = 100": line - dealt(0.0091, 4),
            "N = ∞, exact draws": endless,
        },
    }
    for claim, gaps in wanted.items():
        parts = {part.label: part.measured.value for part in findings[claim].parts}
        assert parts == pytest.approx(gaps, abs=5e-6)


def test_errors_of_the_differences(findings):
    fifty, hundred, endless = (part.measured for part in findings["kac_fig2_poisson"].parts)
    assert fifty.standard_error == pytest.approx(math.hypot(1e-5, 3e-5), rel=0.02)
    assert hundred.standard_error == pytest.approx(math.hypot(1e-5, 4e-5), rel=0.02)
    assert endless.standard_error == pytest.approx(1e-5, rel=0.02)
    assert endless.degrees == 9


def test_the_standard_normal_baseline_is_its_own_noise(findings):
    (part,) = findings["kac_fig2_normal"].parts
    assert part.measured.value == pytest.approx(
        dealt(0.0095, 10) - floor(normal(), N_DRAWS), abs=5e-6
    )
    assert part.measured.standard_error == pytest.approx(1e-5, rel=0.02)
    assert judged(findings["kac_fig2_normal"])[0] == "contradicted"


def test_the_fall_from_the_largest_step_to_the_smallest(findings):
    """0.75 times the slope against the step, updated in place, for every N."""
    parts = {part.label: part.measured for part in findings["kac_fig2_step"].parts}
    assert set(parts) == {"N = 10", "N = 5"}
    assert parts["N = 10"].value == pytest.approx(0.015, abs=4e-6)
    assert parts["N = 5"].value == pytest.approx(0.0075, abs=4e-6)
    assert parts["N = 5"].standard_error == pytest.approx(math.sqrt(2.0) * 5e-5, rel=0.02)
    assert parts["N = 5"].degrees == pytest.approx(6, rel=0.02)
    assert judged(findings["kac_fig2_step"])[0] == "reproduced"


def test_noise_falls_as_one_over_the_root_of_the_draws(findings):
    """A hundred times the draws: a tenth; what bins cause would stay."""
    (part,) = findings["kac_44_discretization"].parts
    assert part.measured.value == pytest.approx(0.1, rel=2e-3)
    assert (part.printed, part.corrected) == (1.0, pytest.approx(0.1))
    assert judged(findings["kac_44_discretization"])[0] == "corrected"


def test_words_are_those_of_the_sentence():
    """Just below 0.01, and to several decimals."""
    published = items.published()
    assert (published["kac_fig2_line"]["low"], published["kac_fig2_line"]["high"]) == (0.009, 0.01)
    for claim in ("kac_fig2_bird_larger_n", "kac_fig2_poisson", "kac_fig2_normal"):
        assert (published[claim]["low"], published[claim]["high"]) == (-0.0005, 0.0005)
