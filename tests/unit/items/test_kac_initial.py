"""The study of the initial law, on cells filled by hand. No z tests: all is exact."""

import numpy as np
import pytest
from fabricated import about, found, judged, reduced, settings, variables
from scipy import stats

CELLS, N_REPLICATES, N_DRAWS = 10007, 4, 10007 * 20
WAYS = ("constant", "closer", "identity")
SQUARES = {"constant": 1.50, "closer": 1.51, "identity": 1.49}
UNIFORMS = {"constant": 9.0, "closer": 6.0, "identity": 7.0}


def cells(moved):
    """Return counts of a replicate: as many in each cell, some moved from the last to the first.

    The cumulative share is then too large by the share moved, everywhere.
    """
    counts = np.full(CELLS, N_DRAWS // CELLS)
    counts[0] += moved
    counts[-1] -= moved
    return counts


MOVED = {"constant": 2, "closer": 4, "identity": 8}


def make(case):
    p, dims = case.parameters, ("replicate",)
    if case.name == "inverse_transform":
        many = len(p["n_table"])
        moments = np.zeros((many, N_REPLICATES, 4))
        moments[:, :, 1] = [about(2.0 - 0.1 * k, 0.001, N_REPLICATES) for k in range(many)]
        counts = [[cells(16 * (k + 1) // 16)] * N_REPLICATES for k in range(many)]
        return variables(
            counts=(("n_table", *dims, "cell"), counts),
            moment=(("n_table", *dims, "power"), moments),
            uniforms=(("n_table", *dims), np.full((many, N_REPLICATES), 1.0)),
        )
    name = p.get("envelope", "identity")
    moments = np.zeros((N_REPLICATES, 4))
    moments[:, 1] = about(SQUARES[name], 0.0002, N_REPLICATES)
    return variables(
        counts=((*dims, "cell"), [cells(MOVED[name])] * N_REPLICATES),
        moment=((*dims, "power"), moments),
        uniforms=(dims, about(UNIFORMS[name], 0.5, N_REPLICATES)),
    )


@pytest.fixture(scope="module")
def dataset():
    chosen = settings("kac_initial", n_draws=N_DRAWS, n_replicates=N_REPLICATES, n_table=[4, 8])
    return reduced("kac_initial", chosen, make)


def test_distances_are_of_all_replicates_together(dataset):
    """As many moved in each replicate: the share moved; its p-value is that of all draws."""
    n = N_DRAWS * N_REPLICATES
    for name in WAYS:
        here = dataset.sel(way=name)
        far = MOVED[name] / N_DRAWS
        assert float(here.distance) == pytest.approx(far)
        assert float(here.p_value) == pytest.approx(stats.kstwobign.sf(far * np.sqrt(n)), rel=1e-6)
    assert dataset.table_distance.values == pytest.approx([1 / N_DRAWS, 2 / N_DRAWS])
    assert float(dataset.floor) == pytest.approx(stats.kstwobign.ppf(0.5) / np.sqrt(n), rel=1e-6)


def test_uniforms_and_squares_stand_at_their_way(dataset):
    for name in WAYS:
        here = dataset.sel(way=name)
        assert float(here.uniforms) == pytest.approx(UNIFORMS[name])
        assert float(here.uniforms_error) == pytest.approx(0.5)
        assert float(here.square) == pytest.approx(SQUARES[name])
    assert dataset.table_square.values == pytest.approx([2.0, 1.9])


def test_trials_take_two_uniforms_each(dataset):
    """The constant 2/(√π e), the largest f0 (at v = 1), on [-5, 5]; |v| exp(-2 v²/3) touches f0."""
    predicted = dict(zip(WAYS, dataset.predicted.values, strict=True))
    assert predicted["constant"] == pytest.approx(2.0 * 10.0 * 2.0 / (np.sqrt(np.pi) * np.e))
    # The ratio |v| exp(-v²/3) · 2/√π is largest at v² = 3/2; the integral of the envelope is 3/2.
    top = 2.0 / np.sqrt(np.pi) * np.sqrt(1.5) * np.exp(-0.5)
    assert predicted["closer"] == pytest.approx(2.0 * 1.5 * top)
    assert np.isnan(predicted["identity"])


def test_the_second_moment_is_checked_for_the_exact_ways(dataset):
    finding = found("kac_initial", dataset)["kac_initial_square"]
    for name, part in zip(WAYS, finding.parts, strict=True):
        assert part.measured.value == pytest.approx(SQUARES[name])
        assert part.measured.standard_error == pytest.approx(0.0002)
        assert part.measured.degrees == N_REPLICATES - 1
        assert part.printed == 1.5
    assert judged(finding, 1)[0] == "reproduced"
    assert "with 8 intervals it gives 1.9000" in finding.evidence
