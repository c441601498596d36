"""The studies of the Boltzmann paper's estimators: variance, oversampling, later times, by hand."""

import math

import fabricated
import numpy as np
import pytest
from scipy import stats

from kacsim.boltzmann import bkw
from kacsim.items import _probes, boltzmann_oversampling

# The study of the variance


def variance_study(mean, square):
    """Return the dataset of 4 batches of 25 at t = 0.5 and 3, the largest values 10^(-k/10)."""
    chosen = fabricated.settings("boltzmann_variance", time=[0.5, 3.0], n_draws=25, n_replicates=4)

    def make(case):
        axes = {"oversampling": [1.0], "time": [0.5, 3.0]}
        top = np.broadcast_to(10.0 ** -np.linspace(0.0, 1.0, 11), (1, 2, 11))
        sample = fabricated.probes(case, axes, mean=mean, mean_square=square)
        return sample.assign(top=((*axes, "rank"), top))

    return fabricated.reduced("boltzmann_variance", chosen, make)


def test_coverage_of_batches():
    """Bars of 0.2/√25: means off by half of one, by 0.9, 1.1 and -1.2 of one."""
    mean = 1.0 + np.array([0.5, 0.9, 1.1, -1.2]) * 0.04
    found = variance_study(mean, mean**2 + 0.04)
    assert found.coverage.values == pytest.approx([0.5, 0.5])
    assert found.batch_z.values[0] == pytest.approx([0.5, 0.9, 1.1, -1.2])
    assert found.coverage_error.values == pytest.approx([0.25, 0.25])


def test_second_moment_and_index():
    """Mean squares 1, 3, 1, 3: 2 ± 1/√3, at the first time; the index from two largest values."""
    found = variance_study(1.0, np.array([[1.0, 3.0, 1.0, 3.0], [5.0, 5.0, 7.0, 7.0]]))
    assert found.second_moment.values == pytest.approx([2.0, 6.0])
    assert found.second_moment_error.values == pytest.approx([1.0 / math.sqrt(3.0)] * 2)
    g0 = 1.10452
    exact = 1.0 / (1.0 - (1.0 - 1.0 / g0) * math.exp(0.5))
    assert float(found.second_moment_exact[0]) == pytest.approx(exact, rel=1e-5)
    # Logarithms 0 and -0.1 less that of the third, -0.2, in units of log 10.
    assert found.hill.values == pytest.approx([1.0 / (0.15 * math.log(10.0))] * 2)
    claims = fabricated.found("boltzmann_variance", found)
    (part,) = claims["boltzmann_variance_moment"].parts
    assert (part.measured.value, part.measured.degrees) == (pytest.approx(2.0), 3)
    assert part.measured.standard_error == pytest.approx(1.0 / math.sqrt(3.0))
    assert part.printed == pytest.approx(exact, rel=1e-5)
    (part,) = claims["boltzmann_leaves_variance"].parts
    assert part.measured.value == pytest.approx(g0 - 1.0, abs=1e-5)


# The study of oversampling


def test_cost_times_variance():
    """Nodes 10, 12, 10, 12 and squares H + 1 and H + 2: products 11 and 22 in turn."""
    chosen = fabricated.settings(
        "boltzmann_oversampling", time=[1.0], oversampling=[1.0, 2.0], n_replicates=4, n_nodes=1000
    )
    h = float(bkw.mean_square(1.0))

    def make(case):
        axes = {"oversampling": list(case.parameters["oversampling"]), "time": [1.0]}
        square, nodes = h + np.array([1.0, 2.0, 1.0, 2.0]), np.array([10.0, 12.0, 10.0, 12.0])
        return fabricated.probes(case, axes, mean_square=square, nodes=nodes)

    found = fabricated.reduced("boltzmann_oversampling", chosen, make)
    assert found["product"].values.ravel() == pytest.approx([16.5] * 4)
    assert found.product_error.values.ravel() == pytest.approx([5.5 / math.sqrt(3.0)] * 4)
    # Without oversampling: (G - H)(2 e - 1), G in closed form.
    g = 1.0 / (1.0 - (1.0 - 1.0 / bkw.mean_square(0.0)) * math.e)
    wanted = (g - h) * (2.0 * math.e - 1.0)
    here = found.product_exact.sel(scheme="everywhere", oversampling=1.0)
    assert float(here[0]) == pytest.approx(wanted, rel=1e-6)
    for scheme in boltzmann_oversampling.SCHEMES:
        curve = found.curve.sel(scheme=scheme).values[0]
        assert float(found.best_product.sel(scheme=scheme)[0]) == curve.min()
        assert float(found.best.sel(scheme=scheme)[0]) == found.fine.values[curve.argmin()]


def test_the_gain_in_time_ends_where_the_variance_does():
    """Blow-ups of the prototype: 2.358 without, 3.97 at m = 1.5."""
    chosen = fabricated.settings("boltzmann_oversampling", time=[1.0], claim_oversampling=1.5)
    dataset = fabricated.reduced(
        "boltzmann_oversampling",
        chosen,
        lambda case: fabricated.probes(
            case, {"oversampling": list(case.parameters["oversampling"]), "time": [1.0]}
        ),
    )
    (part,) = fabricated.found("boltzmann_oversampling", dataset)[
        "boltzmann_oversampling_gain"
    ].parts
    assert part.measured.value == pytest.approx(3.97 - 2.358, abs=0.005)


# The study of later times


def test_later_times():
    """Recursions of 10 and 1000, one turn apart: a factor of 100 a turn, and the budget's turn."""
    chosen = fabricated.settings(
        "boltzmann_extension",
        density_radius=[0.0],
        fraction_radius=[3.0],
        turn=[2.0, 3.0],
        n_draws=[20, 5],
        n_replicates=4,
        max_nodes=10**6,
        largest_share=0.05,
    )

    def make(case):
        late = case.n_draws == 5
        largest = 0.5 if case.name == "trap" and late else 0.01
        radius = 0.0 if case.name == "trap" else 3.0
        return fabricated.probes(
            case,
            {"radius": [radius], "time": list(case.parameters["time"])},
            mean=1.0,
            mean_square=2.0,
            largest=largest * 4 * case.n_draws,
            nodes=1000.0 if late else 10.0,
        )

    found = fabricated.reduced("boltzmann_extension", chosen, make)
    assert list(found.sampler.values) == ["trap", "trap_fraction"]
    assert list(found.radius.values) == [0.0, 3.0]
    assert found.value.values == pytest.approx(1.0)
    assert found.largest_share.values == pytest.approx(np.array([[0.01, 0.5], [0.01, 0.01]]))
    assert list(found.n_believed.values) == [1, 2]
    assert found.growth.values == pytest.approx([100.0] * 2)
    assert found.last_turn.values == pytest.approx([4.5] * 2)  # 10**6 is 1.5 turns after 1000
    assert list(found.n_draws.values) == [80, 20]
    nominal = [2.0 * stats.t.cdf(1.0, n - 1) - 1.0 for n in (20, 5)]
    assert found.nominal.values == pytest.approx(nominal)
    errors = [math.sqrt(p * (1 - p) / 4) for p in nominal]
    assert found.coverage_error.values == pytest.approx(errors)
    # 80 and 20 realizations of variance 1, divisor n - 1 in each of four batches.
    errors = [math.sqrt(1.0 / 19 / 4), math.sqrt(1.0 / 4 / 4)]
    assert found.error.values == pytest.approx(np.array([errors] * 2))


def test_the_worst_batch_is_the_farthest_from_the_mean_of_all():
    """Means 1, 2, 3, 6: their mean is 3, their variance 14/3; means that are all equal give 0."""
    means = [[[1.0, 2.0, 3.0, 6.0], [5.0, 5.0, 5.0, 5.0]]]
    sample = fabricated.variables(mean=(("radius", "time", "replicate"), means))
    expected = [[3.0 / math.sqrt(14.0 / 3.0), 0.0]]
    assert _probes.worst_batch(sample) == pytest.approx(np.array(expected))
