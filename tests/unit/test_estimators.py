"""Estimates of the public functions against numpy on the same realizations.

No z tests: the realizations are given, or drawn twice.
"""

import math

import numpy as np
import pytest

from kacsim import kac, techniques
from kacsim.boltzmann import estimators
from kacsim.streams import new_stream
from kacsim.techniques import integration

VALUES = np.array([0.3, -1.7, 2.9, 0.1, 4.1, -0.6, 2.2])
NODES = np.array([1, 3, 1, 5, 7, 1, 3])


@pytest.mark.parametrize("chunk", [3, 100])
def test_an_estimate_is_numpys(chunk, monkeypatch):
    """Seven given realizations, in chunks and in one go, times a factor of 2.5."""
    monkeypatch.setattr(estimators, "CHUNK", chunk)
    done = 0

    def draw(values, nodes, stream):
        nonlocal done
        part = slice(done, done + values.size)
        values[:], nodes[:] = VALUES[part], NODES[part]
        done += values.size
        return True

    one = estimators.estimate_from(draw, 2.5, VALUES.size, 1, "given")
    assert one.mean == pytest.approx(2.5 * VALUES.mean())
    assert one.variance == pytest.approx(2.5**2 * VALUES.var(ddof=1))
    error = 2.5 * VALUES.std(ddof=1) / math.sqrt(VALUES.size)
    assert one.standard_error == pytest.approx(error)
    assert one.mean_recursion == pytest.approx(NODES.mean())
    assert one.n_realizations == VALUES.size


def test_a_probe_of_the_kac_equation_knows_only_the_rate_times_the_time():
    """All times in units of the collision time, the onset too: the same realizations.

    Negative control: the onset as it was.
    """
    size = {"n_realizations": 500, "seed": 1, "oversampling": 1.5}
    fast = kac.estimate_density(0.7, 0.5, collision_rate=2.0, onset=0.25, **size)
    assert fast == kac.estimate_density(0.7, 1.0, collision_rate=1.0, onset=0.5, **size)
    assert fast != kac.estimate_density(0.7, 1.0, collision_rate=1.0, onset=0.25, **size)


def test_an_integral_is_numpys():
    seen = []

    def function(x):
        seen.append(np.exp(x))
        return seen[-1]

    value, error = techniques.integrate(function, -1.0, 2.5, n_points=6, seed=1)
    heights = np.concatenate(seen)
    assert heights.size == 6
    assert value == pytest.approx(3.5 * heights.mean())
    assert error == pytest.approx(3.5 * heights.std(ddof=1) / math.sqrt(6))


def test_a_volume_is_a_binomial_share():
    share, error = techniques.sphere_volume(2, 50, seed=1)
    counts = np.empty(1, np.int64)
    stream = new_stream(1, "techniques.sphere_volume")
    integration.count_good(counts, np.array([50]), 2, stream)
    assert 0 < counts[0] < 50
    assert share == counts[0] / 50
    assert error == pytest.approx(math.sqrt(share * (1 - share) / 50))
