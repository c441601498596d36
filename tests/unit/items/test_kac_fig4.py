"""Fig. 4 of the Kac paper, on samples whose TVN is known. No z tests: all is exact."""

import math

import numpy as np
import pytest
from fabricated import about, found, judged, reduced, settings, velocities, with_tvn

LEVELS, ERRORS = {"bird": 0.0102, "poisson": 0.0090}, {"bird": 3e-6, "poisson": 9e-6}
N_DRAWS, N_REPLICATES = 10**7, 6


@pytest.fixture(scope="module")
def dataset():
    def make(case):
        name = case.parameters["algorithm"]
        values = about(LEVELS[name], ERRORS[name], N_REPLICATES)
        return velocities(case, with_tvn(values, N_DRAWS, case.parameters["time"]))

    chosen = settings("kac_fig4", n_draws=N_DRAWS, n_replicates=N_REPLICATES)
    return reduced("kac_fig4", chosen, make)


def test_the_difference_of_the_two_means(dataset):
    """Bird's less Poisson's: 0.0012, more than one value scatters."""
    finding = found("kac_fig4", dataset)["kac_fig4_similar"]
    (part,) = finding.parts
    assert part.measured.value == pytest.approx(0.0012, abs=4e-6)
    assert part.measured.standard_error == pytest.approx(math.hypot(3e-6, 9e-6), rel=0.05)
    assert part.measured.degrees == pytest.approx(6.1, abs=0.3)  # 5 (1 + 9)**2 / (1 + 81)
    assert judged(finding)[0] == "contradicted"
    assert "Bird 0.01020, Poisson 0.00900" in finding.evidence


def test_the_level_of_exact_draws_is_that_of_the_published_width(dataset):
    levels = 0.00123 * np.arange(1, dataset.sizes["bin_width"] + 1)
    other = dataset.assign(floor=("bin_width", levels))
    evidence = found("kac_fig4", other)["kac_fig4_similar"].evidence
    assert "exact draws 0.00123." in evidence


def test_one_value_scatters_more_than_the_mean(dataset):
    """By the root of the number of replicates, at every width."""
    for name, error in ERRORS.items():
        here = dataset.sel(algorithm=name)
        assert here.tvn_error.values == pytest.approx(error, rel=0.05)
        assert here.tvn_spread.values == pytest.approx(error * math.sqrt(6.0), rel=0.05)


def test_the_histograms_are_those_of_the_first_replicate(dataset):
    for name, level in LEVELS.items():
        area = 0.1 * float(dataset.density.sel(algorithm=name).sum())
        first = level + ERRORS[name] * math.sqrt(N_REPLICATES - 1)
        assert area == pytest.approx(1.0 - first, abs=1e-6)
