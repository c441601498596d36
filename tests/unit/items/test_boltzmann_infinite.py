"""The studies of infinite variance, by hand: raised frequencies, intervals, exact deviations."""

import math

import fabricated
import numpy as np
import pytest

from kacsim.boltzmann import bkw, null_moment, second_moment
from kacsim.items import _bkw
from kacsim.statistics import stable, verdict

# Raised frequencies


def raised(square=1.2, trap_square=None, nodes=1.0, **changes):
    """Return the dataset of two ratios, two times, two turns and two factors."""
    chosen = fabricated.settings(
        "boltzmann_trap_variance", ratio=[1.319257, 2.2], time=[0.25, 1.5], turn=[1.0, 2.0],
        factor=[1.0, 1.5], trap_n_draws=[10, 10], n_draws=100, n_replicates=4, **changes,
    )  # fmt: skip

    def make(case):
        if case.name == "uniform_moment":
            axes = {"majorant": [1.319257, 2.2], "time": [0.25, 1.5]}
            return fabricated.probes(case, axes, mean_square=square)
        axes = {"radius": [0.0], "time": case.parameters["time"]}
        factor = case.parameters["majorant_factor"]
        turn = case.parameters["time"][0] / (2.0 * math.pi)
        return fabricated.probes(
            case, axes, mean=2.0, mean_square=4.0 * (1.0 + turn**2 / factor**2),
            nodes=10.0 ** (turn * factor),
        )  # fmt: skip

    return fabricated.reduced("boltzmann_trap_variance", chosen, make)


def test_moments_and_their_error():
    """Mean squares 1.1, 1.3, 1.1, 1.3 of four replicates: 1.2 ± 0.1 / √3."""
    found = raised(square=np.array([1.1, 1.3, 1.1, 1.3]))
    assert found.moment.values == pytest.approx(np.full((2, 2), 1.2))
    assert found.moment_error.values == pytest.approx(np.full((2, 2), 0.1 / math.sqrt(3.0)))
    exact = null_moment.second_moment([0.25, 1.5], 2.2)
    assert found.moment_exact.values[1] == pytest.approx(exact)


def test_deviation_and_work_in_the_trap():
    """Relative deviation turn / factor, 10**(turn factor) nodes: 1e8 at turn 8 / factor."""
    found = raised()
    wanted = np.array([[1.0, 1.0 / 1.5], [2.0, 2.0 / 1.5]])
    assert found.deviation.values == pytest.approx(wanted)
    assert found.deviation_error.values == pytest.approx(np.zeros((2, 2)), abs=1e-9)
    nodes = np.array([[10.0, 10.0**1.5], [100.0, 1000.0]])
    assert found.nodes.values == pytest.approx(nodes)
    assert found.trap_work.values == pytest.approx(nodes * wanted**2)
    assert found.last_turn.values == pytest.approx([8.0, 8.0 / 1.5])


def test_only_moments_with_an_error_are_judged():
    """At 1.32 kappa eta the fourth moment is infinite from about 1.2 on."""
    exact = null_moment.second_moment([0.25], 2.2)[0]
    finding = fabricated.found("boltzmann_trap_variance", raised(square=exact))
    (one,) = finding.values()
    assert [part.label.split(", t = ")[1] for part in one.parts] == ["0.25", "0.25", "1.5"]
    assert one.parts[1].measured.value == pytest.approx(1.0)
    assert one.parts[1].measured.degrees == 3
    far = raised(square=1.5 * exact + np.array([1e-6, -1e-6, 1e-6, -1e-6]))
    word, _ = fabricated.judged(fabricated.found("boltzmann_trap_variance", far)[one.claim])
    assert word == verdict.CONTRADICTED


# Intervals where the variance is infinite


def intervals(mean, square, largest, time):
    """Return the dataset of two runs of four blocks of 25 at c = 1."""
    chosen = fabricated.settings(
        "boltzmann_stable", speed=[1.0], time=[time], n_draws=25, n_blocks=4, n_runs=2
    )

    def make(case):
        axes = {"speed": [1.0], "time": [time]}
        return fabricated.probes(case, axes, mean=mean, mean_square=square, largest=largest)

    return fabricated.reduced("boltzmann_stable", chosen, make)


def test_intervals_are_of_runs():
    """The first run of four blocks has the exact mean, the second is off by one half."""
    exact = float(bkw.relative_density(1.0, 3.0))
    blocks = np.array([0.9, 1.1, 0.95, 1.05, 1.4, 1.6, 1.45, 1.55]) * exact
    found = intervals(blocks, blocks**2 + 0.01 * exact**2, 1.2 * exact, 3.0)
    coverage = found.coverage.sel(speed=1.0, time=3.0)
    assert float(coverage.sel(way="normal")) == 0.5
    assert float(coverage.sel(way="blocks")) == 0.5
    # All squares of a run about its mean, of 100 values.
    parts = [np.var(run) + 0.01 * exact**2 for run in (blocks[:4], blocks[4:])]
    lengths = [2.0 * math.sqrt(part / 99.0) / exact for part in parts]
    assert float(found.length.sel(way="normal")[0, 0]) == pytest.approx(np.median(lengths))
    assert found.index.values == pytest.approx([bkw.tail_index(3.0)])
    assert int(found.n_draws) == 100


def test_the_stable_interval_needs_an_infinite_variance():
    found = intervals(1.0, 1.1, 2.0, 1.0)
    assert np.isnan(found.length.sel(way="stable")).all()
    late = intervals(1.0, 1.1, 2.0, 3.0)
    index = bkw.tail_index(3.0)
    constant = 2.0**index / 25.0
    low, high = stable.stable_interval(1.0, 100, constant, index)
    exact = float(bkw.relative_density(1.0, 3.0))
    assert float(late.length.sel(way="stable")[0, 0]) == pytest.approx((high - low) / exact)


# Exact deviations in the published figures


def test_exact_deviations_stop_where_they_are_infinite_or_unknown():
    found = _bkw.exact_deviation("bkw", [1.0, 7.5], [1.0, 2.5])
    assert found[0, 0] == pytest.approx(second_moment.relative_deviation(1.0, 1.0))
    assert np.isnan(found).tolist() == [[False, True], [True, True]]
    found = _bkw.exact_deviation("bkw_fraction", [2.0, 6.5], [1.0])
    assert found[0, 0] == pytest.approx(second_moment.fraction_deviation(2.0, 1.0))
    assert np.isnan(found[1, 0])
