"""The measures that tell where the trap's estimators give out, on samples made by hand."""

import numpy as np
import pytest
import xarray as xr

from kacsim.items import boltzmann_extension
from kacsim.items.boltzmann_extension import _measures

N_DRAWS, N_BATCHES = 200, 60


def sample_of(values):
    """Return what the sampler keeps of float64[batch, draw], at one radius and one time."""
    dims = ("radius", "time", "replicate")
    kept = {
        "mean": values.mean(axis=1),
        "mean_square": (values**2).mean(axis=1),
        "largest": values.max(axis=1),
        "nodes": np.full(values.shape[0], 7.0),
    }
    return xr.Dataset({name: (dims, row[None, None]) for name, row in kept.items()})


def measured(values):
    return {name: row[0] for name, row in _measures(sample_of(values), values.shape[1]).items()}


def test_equal_realizations_have_full_weight():
    found = measured(np.full((N_BATCHES, N_DRAWS), 1.7))
    assert found["effective_share"] == pytest.approx(1.0)
    assert found["largest_share"] == pytest.approx(1.0 / (N_BATCHES * N_DRAWS))
    assert found["value"] == pytest.approx(1.7)
    assert found["recursion"] == 7.0


def test_one_realization_can_make_the_sum():
    values = np.zeros((N_BATCHES, N_DRAWS))
    values[3, 5] = 2.0
    found = measured(values)
    assert found["largest_share"] == pytest.approx(1.0)
    assert found["effective_share"] == pytest.approx(1.0 / values.size)


def test_bars_of_normal_values_cover_and_those_of_heavy_tails_do_not():
    """60 batches: the standard deviation of the coverage is 0.06; Pareto of index 1.1 fails it."""
    rng = np.random.default_rng(5)
    normal = measured(2.0 + rng.normal(size=(N_BATCHES, N_DRAWS)))
    heavy = measured(rng.pareto(1.1, size=(N_BATCHES, N_DRAWS)))
    assert abs(normal["coverage"] - 0.6827) < 4 * 0.06
    error = (2.0 + rng.normal(size=(N_BATCHES, N_DRAWS))).std() / np.sqrt(N_BATCHES * N_DRAWS)
    assert normal["error"] == pytest.approx(error, rel=0.05)
    assert heavy["coverage"] < 0.6827 - 4 * 0.06
    assert heavy["largest_share"] > 20 * normal["largest_share"]


def test_times_and_realizations_must_match():
    good = {"turn": [1.0, 2.0], "n_draws": [5, 5]}
    assert boltzmann_extension.problems(good) == []
    assert boltzmann_extension.problems(good | {"n_draws": [5]})
