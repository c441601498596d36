"""Fig. 5 of the Kac paper, on a few tail values put by hand. No z tests: all is exact."""

import math

import numpy as np
import pytest
from fabricated import bins, eq_8, found, judged, reduced, settings, velocities

N_DRAWS, N_REPLICATES, THRESHOLDS = 10**6, 2, [3.0, 3.5, 4.0]
# Draws above 3 by the lower end of their fine bin, in each of two replicates; below -3 likewise.
TAILS = {"bird": {3.0: 1300, 3.5: 190, 4.5: 10, -3.05: 900, -4.0: 100}, "poisson": {3.1: 1470}}
ABOVE = {"bird": [1500, 200, 10], "poisson": [1470, 0, 0]}


@pytest.fixture(scope="module")
def dataset():
    def make(case):
        tail = TAILS[case.parameters["algorithm"]]
        one = bins(tail | {0.0: N_DRAWS - sum(tail.values())})
        other = bins(tail | {0.5: N_DRAWS - sum(tail.values())})
        kept = np.linspace(3.0, 3.05, 40, endpoint=False)
        return velocities(case, np.array([one, other]), kept_velocity=kept)

    return reduced(
        "kac_fig5",
        settings("kac_fig5", n_draws=N_DRAWS, n_replicates=N_REPLICATES, tail_threshold=THRESHOLDS),
        make,
    )


def test_shares_count_the_upper_tail_of_all_replicates(dataset):
    for name, above in ABOVE.items():
        shares = dataset.tail_share.sel(algorithm=name).values
        assert shares == pytest.approx(np.array(above) / N_DRAWS)
        assert int(dataset.n_draws.sel(algorithm=name)) == N_REPLICATES * N_DRAWS


def test_exact_tails(dataset):
    edges = np.linspace(-8.0, 8.0, 321)
    law = eq_8(2.0)
    for x, tail in zip(THRESHOLDS, dataset.tail_exact.values, strict=True):
        assert tail == pytest.approx(law[1:][edges >= x - 1e-9].sum(), rel=1e-7)


def test_intervals_are_of_95_percent(dataset):
    """None of n: from 0 to 1 - 0.025**(1 / n)."""
    none = dataset.sel(algorithm="poisson", threshold=4.0)
    assert float(none.tail_low) == 0.0
    assert float(none.tail_high) == pytest.approx(1.0 - 0.025 ** (1.0 / (2 * N_DRAWS)))


def test_the_mean_excess_is_over_both_tails(dataset):
    """Middles of the bins; from -3.05 to -3 is as far out as from 3 to 3.05."""
    excess = {"bird": [0.025] * 2200 + [0.525] * 190 + [0.975] * 100 + [1.525] * 10}
    excess["poisson"] = [0.125] * 1470
    finding = found("kac_fig5", dataset)["kac_fig5_shape"]
    for name, part in zip(("bird", "poisson"), finding.parts, strict=True):
        values = np.tile(excess[name], N_REPLICATES)
        assert part.measured.value == pytest.approx(values.mean())
        assert part.measured.standard_error == pytest.approx(values.std() / math.sqrt(values.size))
        assert int(dataset.n_beyond.sel(algorithm=name)) == values.size
    assert judged(finding)[0] == "contradicted"


def test_the_excess_that_eq_8_gives(dataset):
    """By eq. (8) in the same bins, of which the one from 3 on is the first."""
    (part, _) = found("kac_fig5", dataset)["kac_fig5_shape"].parts
    law = eq_8(2.0)[1:-1][np.linspace(-8.0, 7.95, 320) >= 3.0 - 1e-9]
    assert law.size == 100
    wanted = (law * (0.025 + 0.05 * np.arange(100))).sum() / law.sum()
    assert part.printed == pytest.approx(wanted, rel=1e-6)


def test_evidence_names_the_intervals_that_miss(dataset):
    """Of 2952, 327 and 25 expected Bird counts 3000, 400 and 20, Poisson 2940 and then none."""
    law, edges = eq_8(2.0), np.linspace(-8.0, 8.0, 321)
    expected = [2 * N_DRAWS * law[1:][edges >= x - 1e-9].sum() for x in THRESHOLDS]
    assert expected == pytest.approx([2952, 327, 25], abs=1)
    evidence = found("kac_fig5", dataset)["kac_fig5_shape"].evidence
    assert "miss the exact tail: Bird at 3.5; Poisson at 3.5, 4." in evidence


def test_the_histogram_is_a_density_of_the_kept_values(dataset):
    """All 40 kept values lie in the first bin, of width 0.05."""
    assert dataset.density.sel(algorithm="bird").values == pytest.approx([20.0] + [0.0] * 99)
    assert int(dataset.n_kept.sel(algorithm="poisson")) == 40
