"""The studies of readings and of directions: sums of draws written down by hand."""

import math

import fabricated
import numpy as np
import pytest

from kacsim import items
from kacsim.items import _readings, kac_readings
from kacsim.kac.constants import RULES
from kacsim.statistics import verdict

# Coupling both ways

EXACT = 4.05  # 3 (9/2)**2 / 15: three particles of energy 9/2


def both_ways(case, fourth=((4.04, 4.06), (4.40, 4.51)), square=((16.5, 16.5), (20.0, 20.0))):
    """Return a sample of two replicates: from the past 4.05, forward 4.455 on average."""
    counts = np.zeros((2, 2, fabricated.N_FINE + 2), np.int64)
    counts[0, :, 161:203] = 10  # every fine bin from 0 to 2.1
    counts[1, :, 161:182] = 20  # up to 1.05 only
    return fabricated.variables(
        counts=(("way", "replicate", "bin"), counts),
        fourth=(("way", "replicate"), fourth),
        fourth_square=(("way", "replicate"), square),
        steps=(("way", "replicate"), [[19.0, 21.0], [18.0, 20.0]]),
        n_far=(("error", "replicate"), [[0, 0], [1, 2]]),
        largest_error=(("error", "replicate"), [[0.3, 0.6], [0.9, 1.2]]),
    )


def directions(make=both_ways, **changes):
    chosen = fabricated.settings("kac_forward", n_draws=500, n_replicates=2, **changes)
    return fabricated.reduced("kac_forward", chosen, make)


def test_forward_coupling_departs_by_a_tenth():
    found = fabricated.found("kac_forward", directions())
    (part,) = found["kac_51_forward"].parts
    assert part.measured.value == pytest.approx(0.1)
    error = math.sqrt((20.0 - 4.455**2) / 1000.0) / EXACT
    assert part.measured.standard_error == pytest.approx(error)
    assert verdict.judge(found["kac_51_forward"], items.published()["kac_51_forward"], 1e-4)[0] == (
        verdict.REPRODUCED
    )


def test_a_smaller_moment_is_no_departure_upward():
    """A sign turned round would call this a gain."""
    less = both_ways.__defaults__[0][0], (3.6, 3.69)
    square = both_ways.__defaults__[1][0], (13.4, 13.4)
    found = fabricated.found("kac_forward", directions(lambda case: both_ways(case, less, square)))
    assert found["kac_51_forward"].parts[0].measured.value == pytest.approx(-0.1)


def test_draws_from_the_past_are_those_of_n_particles():
    found = fabricated.found("kac_forward", directions())
    (part,) = found["kac_51_perfect"].parts
    assert (part.measured.value, part.printed) == (pytest.approx(4.05), pytest.approx(EXACT))
    error = math.sqrt((16.5 - 4.05**2) / 1000.0)
    assert part.measured.standard_error == pytest.approx(error)


def test_the_limit_is_not_the_law_of_few_particles():
    """27/4 of eq. (9); 4.05 at N = 3; (4.5 + 6.75 N) / (N + 2) with a drawn energy at N = 8."""
    found = fabricated.found("kac_forward", directions(other_n_particles=8))
    few, other = found["kac_5_limit"].parts
    assert (few.label, other.label) == ("N = 3, drawn", "N = 8, exact")
    assert (few.printed, other.printed) == (pytest.approx(6.75), pytest.approx(6.75))
    assert few.corrected == pytest.approx(EXACT)
    assert other.measured.value == other.corrected == pytest.approx(58.5 / 10.0)


def test_draws_far_from_their_limit_are_counted_by_kind():
    found = fabricated.found("kac_forward", directions())
    counts = {
        claim: (found[claim].parts[0].measured.successes, found[claim].parts[0].measured.n)
        for claim in ("kac_52_doubling", "kac_5_accuracy")
    }
    assert counts == {"kac_52_doubling": (0, 1000), "kac_5_accuracy": (3, 1000)}
    assert "0.60 ε" in found["kac_52_doubling"].evidence
    assert "1.20 ε" in found["kac_5_accuracy"].evidence


def test_the_density_is_that_of_a_coordinate():
    """Uniform from 0 to the radius, sqrt(9/2) = 2.12, for three particles; 1/2.1 as drawn here."""
    found = directions()
    assert found.density_exact.values == pytest.approx(1.0 / math.sqrt(4.5), rel=1e-12)
    assert found.density.sel(way="backward").values == pytest.approx(1.0 / 2.1, rel=1e-12)
    forward = found.density.sel(way="forward").values
    assert forward[:10] == pytest.approx(1.0 / 1.05, rel=1e-12)
    assert forward[-10:] == pytest.approx(0.0)


# Readings

CHOSEN = {
    "other_n_particles": [20],
    "free_tolerance": [0.5, 0.1],
    "n_draws": 400,
    "few_n_draws": 400,
    "single_n_draws": 400,
    "counted_n_draws": 2,
    "counted_n_replicates": 1,
}
PUBLISHED = (948.2, 155.0, 0.32)  # mean, and the deviation and the skewness that its range implies


def times(case, fitting=None, numbers=PUBLISHED, draws=(3000.0, 3300.0)):
    """Return sums of coupling times, 100 steps for each place of the tolerance, deviation 1.

    Parameters
    ----------
    fitting : (walk, N, rule, tolerance over the radius) of the reading that has `numbers`
    draws : times of the algorithm as printed
    """
    if case.name == "kac_equilibrium":
        return fabricated.variables(coupling_time=(("draw",), draws))
    walk, n, tolerance = (case.parameters[k] for k in ("walk", "n_particles", "tolerance"))
    rules = RULES if walk != "single" else RULES[:1]
    values = np.zeros((3, len(rules), len(tolerance), case.n_replicates))
    values[0] = 100.0 * np.arange(1, len(tolerance) + 1)[:, None]
    values[1] = 1.0
    if fitting and fitting[:2] == (walk, n):
        place = int(np.argmin(np.abs(np.array(tolerance) - fitting[3])))
        mean, spread, skewness = numbers
        values[:, rules.index(fitting[2]), place] = np.array(
            [mean, spread**2, skewness * spread**3]
        )[:, None]
    dims = ("rule", "tolerance", "replicate")
    sums = {name: (dims, v) for name, v in zip(("mean", "variance", "third"), values, strict=True)}
    return fabricated.variables(tolerance=(("tolerance",), tolerance), **sums)


def readings(*made, **changes):
    chosen = fabricated.settings("kac_readings", **CHOSEN | changes)
    return fabricated.reduced("kac_readings", chosen, lambda case: times(case, *made))


def test_every_reading_is_a_row():
    """Six ways of stepping and one at another N, by rules and tolerances; single; other counts."""
    found = readings()
    assert int(found.n_readings) == (6 + 1) * 8 * 8 + 8 + 6
    keys = zip(
        found.walk.values,
        found.n_particles.values,
        found.rule.values,
        found.tolerance_name.values,
        strict=True,
    )
    assert len(set(keys)) == int(found.n_readings)


def test_the_reading_that_fits_is_found():
    found = readings(("half", 50, "energies", 1e-3), PUBLISHED, (3500.0, 3501.0))
    assert (int(found.n_mean), int(found.n_range), int(found.n_all)) == (1, 1, 1)
    (place,) = np.flatnonzero(found.fits.values.all(axis=1))
    row = [found[name].values[place] for name in ("walk", "n_particles", "rule", "tolerance_name")]
    assert row == ["half", 50, "energies", "D² < ε, E = 1"]


@pytest.mark.parametrize(
    ("numbers", "fits"),
    [
        ((948.2, 155.0, 0.32), [1, 1, 1]),
        ((1000.0, 155.0, 0.32), [0, 1, 1]),
        ((948.2, 80.0, 0.32), [1, 0, 0]),  # too narrow
        ((948.2, 270.0, 0.32), [1, 0, 0]),  # too wide
        ((948.2, 155.0, -1.2), [1, 0, 0]),  # skewed to the other side
        ((948.2, 330.0, 1.2), [1, 1, 0]),  # skewed so that one end fits
        ((984.2, 155.0, 0.32), [0, 1, 1]),  # digits interchanged
    ],
)
def test_mean_and_range_are_each_wanted(numbers, fits):
    found = readings(("printed", 20, "largest", 0.0182574), numbers, few_n_draws=6000)
    at = (found.n_particles.values == 20) & (found.tolerance_name.values == "0.1")
    at &= found.rule.values == "largest"
    assert found.fits.values[at].tolist() == [fits]


def test_replicates_share_one_law():
    """Means 900 and 1000, variances 7 and 9, third moments 5: of all 8 + 2500, and 5 + 3 * 50."""
    sums = {"mean": [900.0, 1000.0], "variance": [7.0, 9.0], "third": [5.0, 5.0]}
    dims = ("rule", "tolerance", "replicate")
    sample = fabricated.variables(**{name: (dims, [[values]]) for name, values in sums.items()})
    case = kac_readings._counted(fabricated.settings("kac_readings"))
    mean, error, spread, skewness = _readings.moments(sample, case, 0, 0)[:4]
    assert (mean, spread) == (950.0, pytest.approx(math.sqrt(2508.0)))
    assert error == pytest.approx(spread / math.sqrt(case.n_draws * case.n_replicates))
    assert skewness == pytest.approx(155.0 / 2508.0**1.5)


def test_tolerances_are_over_the_radius():
    """For N = 50 and epsilon = 1e-6: radius sqrt(75), sqrt(50) or 1; roots for squares."""
    named = kac_readings._named(fabricated.settings("kac_readings"), 50)
    wanted = {
        "ε, E = 3N/2": 1.1547e-7,
        "ε, E = N": 1.41421e-7,
        "ε, E = 1": 1e-6,
        "D² < ε, E = 3N/2": 1.1547e-4,
        "D² < ε, E = N": 1.41421e-4,
        "D² < ε, E = 1": 1e-3,
        "0.1": 0.011547,
        "0.5": 0.057735,
    }
    assert named == pytest.approx(wanted, rel=1e-5)


def test_a_free_tolerance_is_interpolated():
    """Means 100, 200, ... at falling tolerances: 948.2 lies between the 9th and the 10th."""
    found = readings()
    inside = found.free.sel(rule_place=0).values[0]
    numbers = dict(zip(found.which.values, inside, strict=True))
    assert numbers["mean"] == pytest.approx(948.2)
    assert numbers["spread"] == pytest.approx(1.0)
    assert (int(found.n_free), int(found.n_free_fit)) == (7 * 8, 0)


def test_other_counts_are_of_the_printed_algorithm():
    """Times 3000 and 3300: both need 4096; 1096 and 796 steps are left."""
    found = readings()
    mean = {
        str(rule): float(found.number.values[k, 0])
        for k, rule in enumerate(found.rule.values)
        if rule in kac_readings.COUNTS
    }
    assert mean == pytest.approx(
        {
            "power of two that suffices": 4096.0,
            "steps left from there, b in Fig. 6": 946.0,
            "collisions of one particle": 126.0,
            "sweeps of N/2 pairs": 126.0,
            "sweeps of N pairs": 63.0,
            "every other step": 1575.0,
        }
    )


def test_the_implied_deviation_is_that_of_our_shape():
    """Mean 3200, 200 above the smallest and 100 below the largest time; published 526.2, 862.8."""
    found = readings(None, PUBLISHED, (3000.0, 3300.0, 3300.0))
    spread = math.sqrt(20000.0)
    assert found.implied_spread.values == pytest.approx(
        [526.2 * spread / 200.0, 862.8 * spread / 100.0]
    )
    assert (float(found.own_mean), float(found.own_spread)) == (3200.0, pytest.approx(spread))


def test_collisions_of_one_particle_in_the_published_mean():
    """A step has a given one of 50 particles with chance 1/25: 38 of them take 950 steps."""
    found = readings()
    assert (int(found.n_events), float(found.event_mean)) == (38, pytest.approx(950.0))
    assert float(found.event_spread) == pytest.approx(math.sqrt(38.0 * 0.96) * 25.0)
