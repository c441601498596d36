"""Fig. 9 of the Kac paper and the studies of coupling: draws and times written down by hand."""

import math

import fabricated
import numpy as np
import pytest
from scipy import stats

from kacsim import items
from kacsim.items import kac_coupling, kac_fig9
from kacsim.statistics import verdict

# Fig. 9

SIZE = {"n_draws": 100, "n_replicates": 4}
TIMES = {  # of the replicates
    "mean": [940.0, 944.0, 956.0, 952.0],  # of all 948, their variance 40
    "variance": [20000.0, 20040.0, 19960.0, 19840.0],  # mean 19960
    "min": [480.0, 430.0, 500.0, 470.0],
    "max": [1500.0, 1650.0, 1400.0, 1810.0],
}


def equilibrium(case, times=TIMES, draws=(948.0,), moments=None):
    """Return a sample of epsilon-perfect draws, of which `draws` times are kept."""
    base = fabricated.velocities(case, **(moments or {"v4": 6.5, "v8": 100.0}))
    found = base.drop_vars(["collisions", "own_collisions", "own_variance"])
    return found.assign(
        coupling_time=("draw", np.array(draws)),
        **{f"coupling_{name}": ("replicate", np.array(v)) for name, v in times.items()},
    )


def fig9(make=equilibrium, **changes):
    return fabricated.reduced("kac_fig9", fabricated.settings("kac_fig9", **SIZE | changes), make)


def judged(claim, found):
    return verdict.judge(found[claim], items.published()[claim], 1e-4)[0]


def test_coupling_times_are_those_of_all_replicates():
    """Mean of means; total variance 19960 + 40 over 400 draws; extremes of the extremes."""
    claims = fabricated.found("kac_fig9", fig9())
    mean = claims["kac_fig9_coupling_mean"].parts[0].measured
    assert (mean.value, mean.degrees) == (948.0, math.inf)
    assert mean.standard_error == pytest.approx(math.sqrt(20000.0 / 400.0))
    least = claims["kac_fig9_coupling_min"].parts[0].measured
    assert (least.value, least.degrees) == (430.0, 3)
    assert least.standard_error == pytest.approx(np.std([480, 430, 500, 470], ddof=1))
    most = claims["kac_fig9_coupling_max"].parts[0].measured
    assert (most.value, most.degrees) == (1810.0, 3)
    assert most.standard_error == pytest.approx(np.std([1500, 1650, 1400, 1810], ddof=1))


def of_published(mean, least, most):
    """Return what is found with narrow times around some values."""
    times = {
        "mean": np.full(4, mean),
        "variance": np.full(4, 0.01),
        "min": least + np.array([0.0, 0.1, 0.2, 0.1]),
        "max": most - np.array([0.0, 0.1, 0.2, 0.1]),
    }
    return fabricated.found("kac_fig9", fig9(lambda case: equilibrium(case, times)))


@pytest.mark.parametrize(
    ("times", "words"),
    [
        ((948.2, 422.0, 1811.0), "rrr"),
        ((982.4, 224.0, 1118.0), "ccc"),  # digits interchanged
        ((948.2, 1811.0, 422.0), "rcc"),  # ends interchanged
        ((952.0, 530.0, 2101.0), "ccc"),  # beyond the published sets by little
    ],
)
def test_published_times_are_reproduced_and_others_contradicted(times, words):
    found = of_published(*times)
    wanted = [{"r": verdict.REPRODUCED, "c": verdict.CONTRADICTED}[word] for word in words]
    assert [judged(f"kac_fig9_coupling_{end}", found) for end in ("mean", "min", "max")] == wanted


def test_spreads_of_the_published_extremes_are_those_of_a_gamma_law():
    """Smallest and largest of 1e5 draws of the gamma law with our mean, deviation and skewness."""
    law = stats.gamma(4.0 / 0.333**2)
    # The smallest of n draws has the chance 1 - u**(1/n) below it, u uniform.
    chances = -np.expm1(np.log(np.random.default_rng(5).random(100_000)) / 1e5)
    entries = items.published()
    for end, drawn in (("min", law.ppf(chances)), ("max", law.isf(chances))):
        spread = drawn.std() / law.std() * 184.6
        assert entries[f"kac_fig9_coupling_{end}"]["spread"] == pytest.approx(spread, rel=0.02)
    mean = entries["kac_fig9_coupling_mean"]["spread"]
    assert mean == pytest.approx(184.6 / math.sqrt(1e5), rel=0.02)


def test_extremes_of_fewer_draws_vary_more():
    """So that the replicates' deviation is none too small for the extremes of all."""
    random, shape = np.random.default_rng(6), 4.0 / 0.333**2
    drawn = random.gamma(shape, size=(100, 20, 5000))
    for extreme in (np.min, np.max):
        few, all_draws = extreme(drawn, axis=2).std(), extreme(drawn, axis=(1, 2)).std()
        assert few > 0.95 * all_draws


def distance(law):
    """Return the TVN of a law's cumulative function to Normal(0, 3/2), in bins of 0.1."""
    edges = np.arange(-80, 81) / 10.0
    gaps = np.diff(law(edges)) - np.diff(stats.norm.cdf(edges, scale=math.sqrt(1.5)))
    return 0.5 * np.abs(gaps).sum()  # beyond the edges both have less than 1e-8


def test_the_histogram_is_compared_with_the_laws_of_fifty_particles():
    """By scipy: v = sqrt(E B) with B ~ Beta(1/2, 49/2), E = 75, or E ~ Gamma(75, 1) by bins."""
    half = stats.beta(0.5, 24.5)

    def fixed(v, energy=75.0):
        return 0.5 + 0.5 * np.sign(v) * half.cdf(np.minimum(1.0, v**2 / energy))

    energies = np.linspace(30.0, 140.0, 2201)
    weights = stats.gamma(75.0).pdf(energies)
    weights /= weights.sum()

    def drawn(v):
        return sum(w * fixed(v, e) for w, e in zip(weights, energies, strict=True))

    found = fabricated.found("kac_fig9", fig9())["kac_fig9_histogram"]
    assert [part.label for part in found.parts] == ["E = 3N/2", "E drawn"]
    values = [part.measured.value for part in found.parts]
    assert values == pytest.approx([distance(fixed), distance(drawn)], rel=2e-3)
    assert judged("kac_fig9_histogram", {"kac_fig9_histogram": found}) == verdict.REPRODUCED


def test_energy_n_is_far_from_the_curve():
    """Negative control of the histogram's row: with E = N = 50 the same distance is 0.093."""
    narrow = distance(
        lambda v: 0.5 + 0.5 * np.sign(v) * stats.beta(0.5, 24.5).cdf(np.minimum(1.0, v**2 / 50.0))
    )
    assert narrow > items.published()["kac_fig9_histogram"]["high"]


def test_the_energy_is_that_of_f0_and_of_eq_9():
    """E v**2 = 3/2 of both, by Gamma(3/2, 1) and by Normal(0, 3/2); the text has 1."""
    found = fabricated.found("kac_fig9", fig9())
    parts = found["kac_3_energy"].parts
    assert [part.label for part in parts] == ["initial density", "eq. (9)"]
    for part in parts:
        assert part.measured.value == pytest.approx(1.5, rel=1e-9)
        assert (part.printed, part.corrected) == (1.0, 1.5)
    assert judged("kac_3_energy", found) == verdict.CORRECTED
    # (4.5 + 6.75 N) / (N + 2); 6.75 N / (N + 2); 3 N / (N + 2) at N = 50
    assert (
        "6.577 with that, 6.490 with E = 3N/2 and 2.885 with E = N"
        in found["kac_3_energy"].evidence
    )


def test_work_is_counted_in_steps_of_a_corner():
    """1 + 2 + 3 + 4 + 5 steps for t = 5, or 1 + 2 + 4 + 8; 10 or 7 for t = 4; 1 and 1 for t = 1."""
    found = fig9(lambda case: equilibrium(case, draws=(5.0, 4.0, 1.0)))
    ratios = np.array([15.0 / 15.0, 10.0 / 7.0, 1.0])
    (part,) = fabricated.found("kac_fig9", found)["kac_52_doubling_cost"].parts
    assert part.measured.value == pytest.approx(ratios.mean())
    assert part.measured.standard_error == pytest.approx(ratios.std() / math.sqrt(3.0))


def test_the_moment_in_the_evidence_is_that_of_energy_three_halves():
    """E v**4 = 6.5, its error from E v**8 = 100 over 400 draws; exactly 6.4904."""

    def make(case):
        own = case.parameters["energy"] is None
        return equilibrium(case, moments={"v4": 6.5 if own else 3.0, "v8": 100.0})

    assert kac_fig9.ENERGIES[0] == "three_halves"
    evidence = fabricated.found("kac_fig9", fig9(make))["kac_fig9_histogram"].evidence
    z = (6.5 - 6.75 * 50.0 / 52.0) / math.sqrt((100.0 - 6.5**2) / 400.0)
    assert f"E v₁⁴ is 6.50, z = {z:.1f} " in evidence


# Against N and epsilon


def test_the_study_keeps_its_axes_apart():
    """Times 10 N at the fixed epsilon, and 100 - 20 log(epsilon) at the fixed N."""

    def make(case):
        n, e = case.parameters["n_particles"], case.parameters["tolerance"]
        mean = 100.0 - 20.0 * math.log(e) if n == 50 and e != 1e-6 else 10.0 * n
        times = {
            "mean": [mean - 1.0, mean + 1.0],
            "variance": [8.0, 8.0],
            "min": [mean - 9.0, mean - 7.0],
            "max": [mean + 5.0, mean + 6.0],
        }
        return equilibrium(case, times)

    chosen = fabricated.settings(
        "kac_coupling", n_particles=[3, 20], tolerance=[0.1, 1e-4], n_draws=8, n_replicates=2
    )
    found = fabricated.reduced("kac_coupling", chosen, make)
    assert found.n_mean.values == pytest.approx([30.0, 200.0])
    assert found.n_spread.values == pytest.approx([3.0, 3.0])
    assert found.n_error.values == pytest.approx([0.75, 0.75])
    assert found.n_least.values == pytest.approx([21.0, 191.0])
    assert found.n_most.values == pytest.approx([36.0, 206.0])
    assert float(found.slope) == pytest.approx(20.0)
    assert float(found.slope_error) == pytest.approx(0.75 * math.sqrt(2.0) / math.log(1000.0))


def test_the_contraction_rate_is_that_of_all_pairs_and_angles():
    """N = 3: d -> (a, 1 - a)(d_p + d_q), E a**2 = 3/8, over the three pairs, by matrices."""
    total = np.zeros((3, 3))
    for p, q, r in ((0, 1, 2), (0, 2, 1), (1, 2, 0)):
        merged = np.zeros((3, 3))
        merged[np.ix_([p, q], [p, q])] = 2.0 * 3.0 / 8.0
        merged[r, r] = 1.0
        total += merged / 3.0
    d = np.array([2.0, -1.0, -1.0])
    assert kac_coupling.contraction_rate(3) == pytest.approx(1.0 - d @ total @ d / (d @ d))
    steps = math.log(3.0 * 4.5 / 2.0 / 0.01) / -math.log(1.0 - 5.0 / 12.0)
    assert kac_coupling.predicted_steps(3, 0.1) == pytest.approx(steps)
