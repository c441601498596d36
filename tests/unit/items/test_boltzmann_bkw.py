"""Figs. 3 to 6 of the Boltzmann paper and their oversampled versions, from samples made by hand."""

import math

import fabricated
import numpy as np
import pytest
from scipy import integrate, optimize

from kacsim import items
from kacsim.boltzmann import second_moment

SIZES = {"n_draws": 25, "large_n_draws": 100, "n_replicates": 4}
TIMES = [0.5, 3.0]
FIGURES = ["boltzmann_fig3", "boltzmann_fig4", "boltzmann_fig5", "boltzmann_fig6"]


def printed(c, t):
    """Return f(c; t) of eq. (7), c_q = 1."""
    k = 1.0 - 0.4 * math.exp(-t / 6.0)
    bracket = (5.0 * k - 3.0) / k + (1.0 - k) / k**2 * c * c
    return math.exp(-c * c / (2.0 * k)) / (2.0 * (2.0 * math.pi * k) ** 1.5) * bracket


def maxwellian(c):
    return math.exp(-c * c / 2.0) / (2.0 * math.pi) ** 1.5


def fraction(c, t):
    return integrate.quad(lambda x: 4.0 * math.pi * x * x * printed(x, t), c, c + 14.0)[0]


def axis_of(name):
    return "threshold" if name[:14] in ("boltzmann_fig5", "boltzmann_fig6") else "speed"


def exact(name, first, t):
    """Return (exact value, unit of the realizations) at a probe."""
    if axis_of(name) == "speed":
        return printed(first, t), maxwellian(first)
    return fraction(first, t), 1.0


def made(name, departure, sigma=0.3, **changes):
    """Return (dataset, settings): relative to the exact mean, replicates depart as given.

    Parameters
    ----------
    departure : float64[4], of the replicates' means, in own standard errors of the mean
    sigma : standard deviation of a realization over the exact value, divisor n - 1
    """
    axis = axis_of(name)
    firsts = changes.pop("firsts", [1.0, 4.0])
    chosen = fabricated.settings(name, **({axis: firsts, "time": TIMES} | SIZES | changes))

    def make(case):
        n = case.n_draws
        ratio = np.array([[np.divide(*exact(name, c, t)) for t in TIMES] for c in firsts])
        mean = ratio[..., None] * (1.0 + np.asarray(departure) * sigma / math.sqrt(n))
        square = mean**2 + (ratio[..., None] * sigma) ** 2 * (n - 1) / n
        content = {"mean": mean, "mean_square": square}
        content["largest"] = ratio[..., None] * [2.0, 5.0, 3.0, 4.0]
        content["nodes"] = np.array([7.0, 9.0, 7.0, 9.0]) * (1.0 + np.arange(2))[:, None]
        return fabricated.probes(case, {axis: firsts, "time": TIMES}, **content)

    return fabricated.reduced(name, chosen, make), chosen


@pytest.mark.parametrize("suffix", ["", "_oversampled"])
@pytest.mark.parametrize("figure", FIGURES)
def test_values_errors_and_counts_of_the_figures(figure, suffix):
    """Departures of 0.5, -1.1, 0.9 and 1.2 standard errors: two of four bars cover."""
    name = figure + suffix
    departure = np.array([0.5, -1.1, 0.9, 1.2])
    found, _ = made(name, departure)
    axis = axis_of(name)
    for size, n in (("published", 25), ("large", 100)):
        for c in (1.0, 4.0):
            for t in TIMES:
                here = found.sel({"size": size, axis: c, "time": t})
                wanted, _ = exact(name, c, t)
                shift = departure.mean() * 0.3 / math.sqrt(n)
                assert float(here.exact) == pytest.approx(wanted, rel=1e-8)
                assert float(here.value) == pytest.approx(wanted * (1.0 + shift), rel=1e-8)
                assert float(here.actual_error) == pytest.approx(wanted * shift, rel=1e-6)
                # Within and between replicates, over all 4 n realizations.
                between = np.mean((departure - departure.mean()) ** 2) * 0.09 / n
                spread = math.sqrt((0.09 * (n - 1) / n + between) * 4 * n / (4 * n - 1))
                assert float(here.spread) == pytest.approx(wanted * spread, rel=1e-8)
                error = wanted * spread / math.sqrt(4 * n)
                assert float(here.error) == pytest.approx(error, rel=1e-8)
                # The largest realization is 5 of a sum of 4 n (1 + shift), in exact values.
                share = 5.0 / (4 * n * (1.0 + shift))
                assert float(here.largest_share) == pytest.approx(share, rel=1e-8)
                nodes = 8.0 * (1 + TIMES.index(t))
                assert float(here.recursion) == pytest.approx(nodes)
                # Of 7, 9, 7, 9 times a factor: standard deviation 2/√3, error 1/√3.
                error = (1 + TIMES.index(t)) / math.sqrt(3.0)
                assert float(here.recursion_error) == pytest.approx(error)
                assert int(here.covered) == 2
        assert int(found.sel(size=size).n_draws) == 4 * n
    assert float(found.nominal) == pytest.approx(0.6827, abs=5e-5)


def test_curves_lie_between_the_probes():
    found, _ = made("boltzmann_fig3", np.zeros(4))
    for t in (TIMES[0], TIMES[-1]):
        line = found.curve_time.interp(fine_time=t)
        assert float(line.sel(speed=4.0)) == pytest.approx(printed(4.0, t), rel=1e-9)
    line = found.curve_speed.interp(fine_speed=4.0)
    assert float(line.sel(time=3.0)) == pytest.approx(printed(4.0, 3.0), rel=1e-9)


def test_unbiased_takes_the_large_run_where_its_error_has_an_error():
    """At t = 3 no moment above 1.6 is finite: two parts are left, c = 1 and 4 at t = 0.5."""
    found, _ = made("boltzmann_fig3", np.full(4, 0.8))
    one = fabricated.found("boltzmann_fig3", found)["boltzmann_unbiased"]
    assert [part.label for part in one.parts] == ["c = 1 c_q, t = 0.5", "c = 4 c_q, t = 0.5"]
    for part in one.parts:
        assert part.measured.value == pytest.approx(1.0 + 0.8 * 0.03, rel=1e-7)
        error = 0.3 * math.sqrt(99 / 100 * 400 / 399) / 20.0
        assert part.measured.standard_error == pytest.approx(error, rel=1e-7)
        assert math.isinf(part.measured.degrees)
        assert part.printed == 1.0


def test_unbiased_stops_where_the_fourth_moment_is_infinite():
    """Of one leaf E[h⁴] over M by quadrature; of a tree it is infinite from -log(1 - 1/E[h⁴]) on.

    The number of leaves is geometric, P(n) = exp(-t) (1 - exp(-t))ⁿ⁻¹.
    """

    def integrand(c):
        return 4.0 * math.pi * c * c * (printed(c, 0.0) / maxwellian(c)) ** 4 * maxwellian(c)

    leaf = integrate.quad(integrand, 0.0, 20.0, epsabs=0.0)[0]
    last = -math.log1p(-1.0 / leaf)
    found, _ = made("boltzmann_fig3", np.zeros(4))
    found = found.assign_coords(time=[last - 0.01, last + 0.01])
    (one,) = fabricated.found("boltzmann_fig3", found).values()
    labels = [f"c = {c} c_q, t = {last - 0.01:g}" for c in (1, 4)]
    assert [part.label for part in one.parts] == labels


def test_recursion_is_the_mean_over_speeds_with_its_own_error():
    found, _ = made("boltzmann_fig4", np.zeros(4))
    claims = fabricated.found("boltzmann_fig4", found)
    for k, t in enumerate(TIMES):
        (part,) = claims[f"boltzmann_recursion_{k + 1}"].parts
        assert part.measured.value == pytest.approx(8.0 * (k + 1))
        # Two independent speeds of error (k + 1)/√3.
        error = (k + 1) / math.sqrt(3.0) / math.sqrt(2.0)
        assert part.measured.standard_error == pytest.approx(error)
        assert part.measured.degrees == 2 * 3
        assert part.printed == pytest.approx(2.0 * math.exp(t) - 1.0)
    for part, t in zip(claims["boltzmann_15_recursion"].parts, TIMES, strict=True):
        assert part.measured.value == pytest.approx(2.0 * math.exp(t) - 1.0, rel=1e-9)
        assert part.printed == pytest.approx(2.0 * math.exp(t) - 1.0)


def fallen(start, t):
    """Return the speed where f is a millionth of f(start), by a root search."""
    level = printed(start, t) / 1e6
    return optimize.brentq(lambda c: printed(c, t) - level, max(start, 1.3), 9.0, xtol=1e-12)


def test_rarefaction_is_the_largest_factor_along_the_axis():
    """The factor from c = 1 is 3.55; the largest from any starting point is 5.02."""
    found, _ = made("boltzmann_fig4", np.zeros(4))
    found = found.assign_coords(time=[1.0, 3.0])
    (part,) = fabricated.found("boltzmann_fig4", found)["boltzmann_rarefaction"].parts
    factors = {}
    for start in (0.0, 1.0, 1.8, 2.0, 2.1, 2.2, 2.5, 3.0):
        ends = np.array([start, fallen(start, 1.0)])
        one = second_moment.relative_deviation(ends, 1.0)
        factors[start] = one[1] / one[0]
    assert factors[1.0] == pytest.approx(3.55, abs=0.005)
    assert max(factors, key=factors.get) in (2.1, 2.2)
    assert part.measured.value == pytest.approx(max(factors.values()), rel=1e-3)


def test_variance_never_falls():
    found, _ = made("boltzmann_fig4", np.zeros(4))
    (part,) = fabricated.found("boltzmann_fig4", found)["boltzmann_variance_increases"].parts
    assert part.measured.value == 0.0


def test_a_billionth_costs_what_the_second_moment_says(monkeypatch):
    """With E[(F/M)²] = h² + 4 at every speed: own quadratures of Algorithm 3 and its threshold."""
    monkeypatch.setattr(
        second_moment,
        "at_speed",
        lambda c, t: np.array([(printed(x, t) / maxwellian(x)) ** 2 + 4.0 for x in c]),
    )
    found, _ = made("boltzmann_fig6", np.zeros(4))
    claims = fabricated.found("boltzmann_fig6", found)
    t = TIMES[0]
    c0 = optimize.brentq(lambda c: fraction(c, t) - 1e-9, 4.0, 7.0, xtol=1e-10)
    width = c0 / (c0 * c0 - 2.0)

    def square(c):
        weight = 4.0 * math.pi * c * c * (width + c - c0) ** 2 / width
        return (
            weight**2
            * (printed(c, t) ** 2 + 4.0 * maxwellian(c) ** 2)
            * width
            / (width + c - c0) ** 2
        )

    second = integrate.quad(square, c0, c0 + 3.0, epsabs=0.0)[0]
    relative = math.sqrt(second / 1e-18 - 1.0)
    assert claims["boltzmann_billionth"].parts[0].measured.value == pytest.approx(
        relative / 100.0, rel=1e-6
    )
    particles = 1.0 / (1e-9 * (relative / 100.0) ** 2)
    drawings = 1e4 * (2.0 * math.exp(t) - 1.0)
    assert claims["boltzmann_burden"].parts[0].measured.value == pytest.approx(
        math.log10(particles / drawings), rel=1e-6
    )


def test_eq_19_is_a_density_on_both_branches(monkeypatch):
    found, _ = made("boltzmann_fig6", np.zeros(4))
    parts = fabricated.found("boltzmann_fig6", found)["boltzmann_19_density"].parts
    assert [part.label for part in parts] == [f"c0 = {c} c_q" for c in ("0.5", "2", "6")]
    assert [part.measured.value for part in parts] == pytest.approx([1.0] * 3, rel=1e-6)
    for c0, c in ((0.5, 3.0), (2.0, 2.0), (6.0, 6.3)):
        wanted = 2.0 / (2.0 + c - c0) ** 2
        if c0 > 2.0:
            wanted = c0 * (c0**2 - 2.0) / ((c0**2 - 2.0) * (c - c0) + c0) ** 2
        assert second_moment.sampling_density(c, c0) == pytest.approx(wanted, rel=1e-12)


def test_figures_whose_bars_are_counted_elsewhere_find_nothing():
    for name in ("boltzmann_fig5", *(f"{figure}_oversampled" for figure in FIGURES)):
        found, _ = made(name, np.zeros(4))
        assert fabricated.found(name, found) == {}


@pytest.mark.parametrize("suffix", ["", "_oversampled"])
@pytest.mark.parametrize("figure", FIGURES)
def test_figs_3_and_5_are_against_time_and_figs_4_and_6_along_an_axis(figure, suffix):
    found, _ = made(figure + suffix, np.zeros(4))
    panels = items.load(figure + suffix).draw(found).axes
    symbol = {"speed": "c", "threshold": "c_0"}[axis_of(figure)]
    titles, labels = ["$t$ = 0.5", "$t$ = 3"], {f"${symbol}/c_q$"}
    if figure in ("boltzmann_fig3", "boltzmann_fig5"):
        titles = [f"${symbol}$ = {first} $c_q$" for first in (1, 4)]
        labels = {"time $t$ in mean collision times"}
    assert [panel.get_title() for panel in panels[:2]] == titles
    assert {panel.get_xlabel() for panel in panels[2:4]} == labels
