"""What the samplers about coupling return is what their kernels draw, replicate by replicate."""

import numpy as np
import pytest

from kacsim.cases import make_case
from kacsim.jobs import sampling
from kacsim.kac import forward, readings
from kacsim.kac.constants import RULES
from kacsim.statistics.histogram import fine_edges
from kacsim.streams import CHUNK, new_stream

SIZE = {"n_draws": CHUNK + 5, "n_replicates": 2, "seed": 8}


def values_of(variables):
    return {name: np.asarray(values) for name, (_, values, _) in variables.items()}


@pytest.mark.parametrize("walk", ["printed", "single"])
def test_sums_are_those_of_all_stopping_times(walk):
    tolerance = [0.5, 0.05]
    case = make_case("kac_readings", n_particles=3, walk=walk, tolerance=tolerance, **SIZE)
    found = values_of(sampling.run(case))
    n_rules = len(RULES) if walk == "printed" else 1
    for k in range(2):
        stream = new_stream(case.seed, case.id, k)
        times = np.zeros((SIZE["n_draws"], n_rules, 2), np.int64)
        for part in (times[:CHUNK], times[CHUNK:]):
            if walk == "printed":
                bound = readings.arguments(**case.parameters)
                readings.stopping_times(part, *bound, stream)
            else:
                readings.stopping_times_single(part, 3, np.array(tolerance), stream)
        gap = times - times.mean(axis=0)
        wanted = {
            "mean": times.mean(axis=0),
            "variance": (gap**2).mean(axis=0),
            "third": (gap**3).mean(axis=0),
            "least": times.min(axis=0),
            "most": times.max(axis=0),
        }
        for name, values in wanted.items():
            np.testing.assert_allclose(found[name][..., k], values, rtol=1e-8, atol=1e-6)


def test_directions_are_those_of_the_kernel():
    case = make_case("kac_forward", n_particles=4, tolerance=0.02, **SIZE)
    found = values_of(sampling.run(case))
    edges = np.r_[-np.inf, fine_edges(), np.inf]
    for k in range(2):
        stream = new_stream(case.seed, case.id, k)
        corners, errors = np.empty((2, SIZE["n_draws"], 4)), np.empty((SIZE["n_draws"], 2))
        times = np.empty((SIZE["n_draws"], 2), np.int64)
        for part in (slice(0, CHUNK), slice(CHUNK, None)):
            given = corners[0, part], corners[1, part], errors[part], times[part]
            forward.couple_both_ways(*given, 4, 6.0, 0.02, stream)
        fourth = (corners**4).sum(axis=2) / 4.0
        np.testing.assert_allclose(found["fourth"][:, k], fourth.mean(axis=1))
        np.testing.assert_allclose(found["fourth_square"][:, k], (fourth**2).mean(axis=1))
        np.testing.assert_allclose(found["steps"][:, k], times.mean(axis=0))
        np.testing.assert_allclose(found["largest_error"][:, k], errors.max(axis=0) / 0.02)
        np.testing.assert_array_equal(found["n_far"][:, k], (errors >= 0.02).sum(axis=0))
        for way in range(2):
            np.testing.assert_array_equal(
                found["counts"][way, k], np.histogram(corners[way], edges)[0]
            )
