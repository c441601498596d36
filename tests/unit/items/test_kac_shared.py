"""What the Kac items share, on samples and datasets made by hand."""

import numpy as np
import pytest
import xarray as xr
from fabricated import bins, settings, variables

from kacsim.items import _kac, kac_statements


def test_a_moment_is_that_of_all_replicates():
    """Replicates of mean v**4 1 and 3: mean 2; of mean v**8 20, so a variance of 16."""
    moment = np.array([[0.0, 1.0, 0.0, 15.0], [0.0, 3.0, 0.0, 25.0]])
    sample = variables(moment=(("replicate", "order"), moment))
    sample = sample.assign_coords(order=("order", [2, 4, 6, 8]))
    chosen = settings("kac_fig4", n_draws=50, n_replicates=2)
    case = _kac.velocity_case(chosen | {"seed": 1}, "bird", 50)
    mean = _kac.fourth_moment_of(sample, case)
    assert mean.value == 2.0
    assert mean.standard_error == pytest.approx(0.4)  # 4 over the root of 100 draws


def test_a_tvn_is_that_of_the_published_width():
    """The first width, whatever its size, with a degree of freedom less than replicates."""
    tables = {
        "tvn": (("algorithm", "bin_width"), [[0.1, 0.2, 0.3]]),
        "tvn_error": (("algorithm", "bin_width"), [[0.01, 0.02, 0.03]]),
    }
    coords = {"algorithm": ["bird"], "bin_width": [0.1, 0.05, 0.5]}
    dataset = xr.Dataset(tables, coords=coords, attrs={"settings": {"n_replicates": 20}})
    mean = _kac.tvn_of(dataset, algorithm="bird")
    assert (mean.value, mean.standard_error, mean.degrees) == (0.1, 0.01, 19)


def test_the_energy_has_not_grown_before_anything_collides():
    """E (sum of v**2)**2 of independent velocities is N (15/4 + (N - 1) 9/4) at the start."""
    here = kac_statements._against_n(5, {"time": 1e-9, "time_step": 1e-9})
    assert here["growth"] == pytest.approx([0.0, 0.0], abs=1e-8)


def test_bars_are_shares_of_all_draws():
    """Of 50 draws 20 are beyond all bars, in both tails, and 30 in the bar from 0 to 0.1."""
    counts = [bins({0.0: 50}), bins({-np.inf: 12, 0.05: 30, 8.0: 8})]
    sample = variables(counts=(("replicate", "bin"), counts))
    density, edges = _kac.histogram_of(sample, 0.1, replicate=1)
    assert density.sum() * 0.1 == pytest.approx(0.6)
    assert density[np.searchsorted(edges, 0.01) - 1] == pytest.approx(6.0)
