"""Fig. 1 of the Kac paper, on samples whose TVN is known. No z tests: all is exact."""

import math
import re

import numpy as np
import pytest
from fabricated import about, eq_8, found, judged, reduced, settings, velocities, with_tvn

from kacsim import items

ERROR, N_REPLICATES, N_DRAWS = 2e-4, 4, 10**7
SEQUENTIAL, SYNCHRONOUS = "nanbu_sequential", "nanbu_synchronous"
LEVELS = {
    (SEQUENTIAL, 0.01): 0.0200,
    (SEQUENTIAL, 1.0): 0.0470,
    (SYNCHRONOUS, 0.01): 0.0215,
    (SYNCHRONOUS, 1.0): 0.0350,
}


@pytest.fixture(scope="module")
def chosen():
    return settings("kac_fig1", n_draws=N_DRAWS, n_replicates=N_REPLICATES)


@pytest.fixture(scope="module")
def dataset(chosen):
    def make(case):
        level = LEVELS[case.parameters["algorithm"], case.parameters["time_step"]]
        values = about(level, ERROR, N_REPLICATES)
        return velocities(case, with_tvn(values, N_DRAWS, case.parameters["time"]))

    return reduced("kac_fig1", chosen, make)


@pytest.fixture(scope="module")
def findings(dataset):
    return found("kac_fig1", dataset)


@pytest.mark.parametrize(
    ("claim", "reading", "step"),
    [
        ("kac_fig1_small_step", SEQUENTIAL, 0.01),
        ("kac_fig1_large_step", SEQUENTIAL, 1.0),
        ("kac_41_reading", SYNCHRONOUS, 1.0),
    ],
)
def test_levels(findings, claim, reading, step):
    (part,) = findings[claim].parts
    assert part.measured.value == pytest.approx(LEVELS[reading, step], abs=2e-6)
    assert part.measured.standard_error == pytest.approx(ERROR, rel=0.01)
    assert part.measured.degrees == N_REPLICATES - 1


def test_evidence_gives_the_spread_of_one_value_and_the_other_reading(findings):
    """The error is that of a mean of four: one value varies twice as much."""
    evidence = findings["kac_fig1_large_step"].evidence
    assert "one TVN varies by 0.0004" in evidence
    assert "Nanbu (synchronous): 0.0350 ± 0.0002" in evidence


def test_the_printed_numbers_are_those_of_the_text():
    """Section 4.4: 0.0187 and 0.0482 for the left and the right graph."""
    published = items.published()
    assert published["kac_fig1_small_step"]["printed"] == "0.0187"
    assert published["kac_fig1_large_step"]["printed"] == "0.0482"
    assert published["kac_41_reading"]["printed"] == "0.0482"


def test_verdicts(findings):
    """0.047 is a value of the large step, 0.035 is none: 3.5 spreads of 0.0014 are allowed."""
    assert judged(findings["kac_fig1_large_step"], 1)[0] == "reproduced"
    assert judged(findings["kac_41_reading"], 1)[0] == "contradicted"


def test_the_gain_of_the_smaller_step(findings):
    parts = {part.label: part.measured for part in findings["kac_fig1_step"].parts}
    gains = {"Nanbu (sequential)": 0.0270, "Nanbu (synchronous)": 0.0135}
    assert set(parts) == set(gains)
    for label, gain in gains.items():
        assert parts[label].value == pytest.approx(gain, abs=4e-6)
        assert parts[label].standard_error == pytest.approx(math.sqrt(2.0) * ERROR, rel=0.01)
        assert parts[label].degrees == pytest.approx(2 * (N_REPLICATES - 1), rel=0.01)


def test_the_level_of_exact_draws(findings, dataset):
    """Half the sum of sqrt(2 p (1 - p) / (pi n)), for 1e5 draws ten times that for 1e7."""
    (part,) = findings["kac_44_bins"].parts
    law = eq_8(2.0)
    pairs = np.r_[law[0], law[1:-1:2] + law[2:-1:2], law[-1]]
    wanted = 0.5 * np.sqrt(2.0 * pairs * (1.0 - pairs) / (math.pi * N_DRAWS)).sum()
    assert part.measured.value == pytest.approx(wanted, rel=2e-3)
    scott = (24.0 * math.sqrt(math.pi)) ** (1 / 3) * math.sqrt(1.5) * N_DRAWS ** (-1 / 3)
    assert float(dataset.scott) == pytest.approx(scott)


def test_the_distance_of_the_published_pair(findings):
    """Root of the squares of (0.0187 - 0.0200) and (0.0482 - 0.0470), in units of 0.0004."""
    far = math.hypot(0.0013, 0.0012) / (2 * ERROR)
    words = re.findall(r"(0\.\d+): 0\.\d+, (\d+\.\d)", findings["kac_44_bins"].evidence)
    assert [width for width, _ in words] == ["0.05", "0.1", "0.2", "0.5"]
    assert [float(value) for _, value in words] == pytest.approx([far] * 4, abs=0.06)


def test_the_histogram_is_that_of_the_first_replicate(dataset):
    """`about` begins above the mean; what lies in the tails is in no bar."""
    for (reading, step), level in LEVELS.items():
        area = 0.1 * dataset.density.sel(reading=reading, time_step=step).sum()
        first = level + ERROR * math.sqrt(N_REPLICATES - 1)
        assert float(area) == pytest.approx(1.0 - first, abs=1e-6)
