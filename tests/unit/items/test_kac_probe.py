"""The study of probes, on estimates put by hand. No z tests: all is exact."""

import math

import numpy as np
import pytest
from fabricated import about, found, judged, probes, reduced, settings

from kacsim.items import kac_probe

SPEEDS, TIMES, N_REPLICATES, N_DRAWS = [1.0, 0.0, 3.0], [0.4, 2.0], 4, 1000
RATE = math.sqrt(math.pi) / 2


def mean_of(time, k):
    return 0.5 + 0.1 * k + time


@pytest.fixture(scope="module")
def dataset():
    def make(case):
        (time,) = case.parameters["time"]
        axes = {"speed": SPEEDS, "time": [time]}
        means = np.array([[about(mean_of(time, k), 0.01, N_REPLICATES)] for k in range(3)])
        nodes = np.array([[about(5.0 + k, 0.1, N_REPLICATES)] for k in range(3)])
        return probes(case, axes, mean=means, nodes=nodes)

    chosen = settings(
        "kac_probe",
        speed=SPEEDS,
        claim_speed=[3.0, 1.0],
        time=TIMES,
        n_draws=N_DRAWS,
        n_replicates=N_REPLICATES,
    )
    return reduced("kac_probe", chosen, make)


def limit(v):
    """Return the density of eq. (9), over which realizations are given."""
    return math.exp(-v * v / 3.0) / math.sqrt(3.0 * math.pi)


def eq_8(v, time):
    c = 1.0 / (3.0 - 2.0 * math.exp(-RATE * time / 8.0))
    return (
        (1.5 * (1 - c) * c**0.5 + (3 * c - 1) * c**1.5 * v * v)
        * math.exp(-c * v * v)
        / math.pi**0.5
    )


def test_values_stand_at_their_time_and_speed(dataset):
    for time in TIMES:
        for k, v in enumerate(SPEEDS):
            here = dataset.sel(time=time, speed=v)
            assert float(here.value) == pytest.approx(mean_of(time, k) * limit(v))
            assert float(here.error) == pytest.approx(0.01 * limit(v))
            assert float(here.exact) == pytest.approx(eq_8(v, time))
            assert float(here.relative_error) == pytest.approx(0.01 * limit(v) / eq_8(v, time))
            assert float(here.nodes) == pytest.approx(5.0 + k)


def test_the_histogram_of_equal_cost(dataset):
    """A tree of 7 nodes has 4 leaves, an ancestral draw exp(rate t); both signs of v count."""
    here = dataset.sel(time=2.0, speed=3.0)
    draws = N_DRAWS * N_REPLICATES * 4.0 / math.exp(RATE * 2.0)
    expected = 1.0 / math.sqrt(2.0 * draws * eq_8(3.0, 2.0) * 0.1)
    assert float(here.histogram_error) == pytest.approx(expected)


def test_the_density_is_checked_at_the_first_time(dataset):
    finding = found("kac_probe", dataset)["kac_probe_density"]
    assert [part.label for part in finding.parts] == ["v = 3", "v = 1"]
    for part, v, k in zip(finding.parts, (3.0, 1.0), (2, 0), strict=True):
        assert part.measured.value == pytest.approx(mean_of(0.4, k) * limit(v))
        assert part.measured.standard_error == pytest.approx(0.01 * limit(v))
        assert part.measured.degrees == N_REPLICATES - 1
        assert part.printed == pytest.approx(eq_8(v, 0.4))
    assert judged(finding)[0] == "contradicted"


def test_a_velocity_that_is_not_probed_is_refused():
    chosen = settings("kac_probe", speed=SPEEDS, claim_speed=[2.0])
    ((key, sentence),) = kac_probe.problems(chosen)
    assert key == "claim_speed"
    assert "2.0" in sentence


def test_probes_are_oversampled_from_the_time_on():
    """The time from which on they are is one of them."""
    chosen = settings("kac_probe", time=[0.5, 1.5, 2.0], oversampled_time=1.5, oversampling=1.7)
    cases = kac_probe.cases(chosen)
    assert [case.parameters["time"] for case in cases] == [[0.5], [1.5], [2.0]]
    assert [case.parameters["oversampling"] for case in cases] == [1.0, 1.7, 1.7]
