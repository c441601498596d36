"""The trees in the trap against exact results and against the algorithms as printed.

No moment is known here; the
largest of the 1e6 realizations used have a tail index (Hill) of 6.2 or more.
"""

import math

import numpy as np
import pytest
from law import compare
from law import literal_trees as printed
from law.compare import caught, controls, ok, scaled
from law.realizations import (
    GAS,
    LATE,
    N_MUTANT,
    PLACE,
    SPEED,
    TRAP,
    N,
    drawn,
    kernel_draws,
    reduced,
    z_between,
    z_from,
)

from kacsim import boltzmann
from kacsim.boltzmann import literal_trap, trap, trap_tree
from kacsim.streams import new_stream


def test_literal_and_tree_of_the_trap_agree(seed):
    """4 z: the two programs of Algorithm 6 give one law of f / (31), and as many calls."""
    physics, choices = (2.7, 0.3, 0.0, 1.0), (trap.MAJORANT, 1.0, 0.0)
    arguments = 0.8, 0.5, 0.0, 1.5, physics, choices, 10**6
    tree = kernel_draws(trap_tree.estimate, arguments, N, seed, "trap tree")
    plain, calls = kernel_draws(
        literal_trap.estimate, (0.8, 0.5, 1.5, 2.7, 0.3, False), 300_000, seed, "literal trap"
    )
    assert ok(compare.of_means(plain, tree[0]), compare.of_means(calls, tree[1]))
    several = tree[0][tree[1] > 1], plain[calls > 1]
    assert ok(compare.of_distributions(*several))
    alone = (tree[1] == 1).mean(), (calls == 1).mean()
    error = math.sqrt(alone[0] * (1.0 - alone[0]) * (1.0 / scaled(N) + 1.0 / calls.size))
    assert ok((alone[0] - alone[1]) / error)
    # Negative controls: a tenth more collisions, and another speed.
    others = (0.8, 0.5, 1.5, 3.0, 0.3, False), (0.8, 0.9, 1.5, 2.7, 0.3, False)
    for other in controls(*others):
        values, calls = kernel_draws(literal_trap.estimate, other, 300_000, seed, "other trap")
        assert caught(compare.of_distributions(several[0], values[calls > 1])) or caught(
            compare.of_means(calls, tree[1])
        )


def trap_at(position, velocity, time, seed, n=N, **changes):
    given = TRAP | changes
    size = {"n_realizations": scaled(n), "seed": seed}
    return boltzmann.estimate_trap(position, velocity, time, **size, **given)


OTHER_LAWS = [
    {"majorant_factor": 1.7},
    {"spread": 1.2},
    {"anisotropy": 0.7},
    {"majorant_factor": 0.8, "spread": 1.1, "anisotropy": -0.5},
]


@pytest.mark.parametrize("laws", [{}, *OTHER_LAWS], ids=str)
def test_started_in_the_breathing_state_the_trap_has_no_variance(laws, seed):
    """Algorithm 5, no statistics: every realization is eq. (31), and from eq. (18) it is not."""
    one = trap_at(PLACE, SPEED, LATE, seed, 2000, initial="breathing", **laws)
    peculiar = trap.breathing_density(*reduced(PLACE, SPEED), 1.5, 0.3, 0.4)
    exact = 2.0 * 0.6**3 / 1.1**6 * float(peculiar)
    assert one.mean == pytest.approx(exact, rel=1e-12)
    assert one.standard_error <= 1e-9 * exact
    assert one.mean_recursion > 1.5
    assert trap_at(PLACE, SPEED, LATE, seed, 2000, **laws).standard_error > 1e-3 * exact


def test_the_traps_mean_does_not_depend_on_the_sampling_laws(seed):
    """12 z; the printed algorithm with a law and another law's weight is told apart."""
    far = np.array([0.0, 2.5, 0.3]), np.array([0.2, 0.1, -0.9])
    for k, probe in enumerate(((PLACE, SPEED), far, (0.0, np.array([0.3, 0.0, 1.2])))):
        published = trap_at(*probe, LATE, seed)
        for laws in OTHER_LAWS:
            assert ok(z_between(trap_at(*probe, LATE, seed + 1000 + k, **laws), published))
    published = trap_at(PLACE, SPEED, LATE, seed).mean
    wrong = printed.UNWEIGHTED_SPREAD, printed.UNSAMPLED_TILT, printed.UNWEIGHTED_MAJORANT
    for mutation in controls(*wrong):
        assert caught(compare.of_mean(printed_trap(seed, mutation)[0], published))


def printed_trap(seed, mutation=printed.AS_PRINTED, n=N_MUTANT):
    values, calls = np.empty(scaled(n)), np.empty(scaled(n), np.int64)
    stream = new_stream(seed, "printed trap")
    printed.trap_values(values, calls, PLACE, SPEED, LATE, GAS, mutation, stream)
    return values, calls


def test_trap_as_printed(seed):
    """4 z: vectors, units and four sub-estimates as printed give the kernel's law."""
    one = trap_at(PLACE, SPEED, LATE, seed)
    values, calls = printed_trap(seed, n=200_000)
    physics = 2.0 * 5.0 * 0.6**2 / 1.1**3, 0.3, 0.4, 1.0
    arguments = (*reduced(PLACE, SPEED), 1.5, physics, (trap.MAJORANT, 1.0, 0.0), 10**6)
    ratios, nodes = kernel_draws(trap_tree.estimate, arguments, N, seed, "trap")
    equilibrium = trap.breathing_density(*reduced(PLACE, SPEED), 1.5, 0.3, 0.4)
    ratios *= 2.0 * 0.6**3 / 1.1**6 * float(equilibrium)
    assert ok(z_from(values, one), compare.of_means(calls, nodes))
    assert ok(compare.of_distributions(ratios[nodes > 1], values[calls > 1]))
    alone = (nodes == 1).mean(), (calls == 1).mean()
    error = math.sqrt(alone[0] * (1.0 - alone[0]) * (1.0 / scaled(N) + 1.0 / calls.size))
    assert ok((alone[0] - alone[1]) / error)
    for mutation in controls(printed.OLD_VELOCITY, printed.ONE_FOR_TWO, printed.ALWAYS_ACCEPT):
        values, calls = printed_trap(seed, mutation)
        assert caught(z_from(values, one))
        assert caught(compare.of_distributions(ratios[nodes > 1], values[calls > 1]))


def test_shares_of_the_trap_as_printed(seed):
    """2 z: Algorithm 7, and what the same z makes of a forgotten 4 pi."""
    for radius in (0.4, 2.5):
        size = {"n_realizations": scaled(N), "seed": seed}
        one = boltzmann.estimate_trap_fraction(radius, LATE, **size, **TRAP)
        for mutation in (printed.AS_PRINTED, *controls(printed.FORGET_4_PI)):
            options = {"seed": seed, "name": "share", "mutation": mutation}
            values = drawn(printed.trap_fraction_values, radius, LATE, GAS, False, **options)
            assert (ok if mutation == printed.AS_PRINTED else caught)(z_from(values, one))


def shares(radius, phase, seed, *, energy=False):
    """Return realizations of the share of matter beyond a radius, or of its energy."""
    kernel = trap_tree.estimate_energy if energy else trap_tree.estimate_fraction
    arguments = radius, phase, (2.7, 0.3, 0.4, 1.0), (trap.MAJORANT, 1.0, 0.0), 10**6
    return kernel_draws(kernel, arguments, N, seed, f"share {radius} {phase}")[0]


@pytest.mark.parametrize("phase", [1.5, math.pi])
def test_mass_and_energy_of_the_trap(phase, seed):
    """4 z: one particle and 3 c_eq**2 of energy."""
    assert ok(compare.of_mean(shares(0.0, phase, seed), 1.0))
    assert ok(compare.of_mean(shares(0.0, phase, seed, energy=True), 3.0))


@pytest.mark.parametrize(("energy", "exact"), [(False, 1.0), (True, 3.0)])
def test_mass_and_energy_as_printed_and_mutants(energy, exact, seed):
    """2 z as printed; collisions without loss keep neither."""
    for mutation in (printed.AS_PRINTED, *controls(printed.FORGET_LOSS)):
        options = {"seed": seed, "name": "mass", "mutation": mutation, "n": 400_000}
        values = drawn(printed.trap_fraction_values, 0.0, LATE, GAS, energy, **options)
        z = compare.of_mean(values, exact)
        assert (ok if mutation == printed.AS_PRINTED else caught)(z)


@pytest.mark.parametrize("radius", [0.7, 2.0, 4.5])
def test_share_after_a_whole_turn(radius, seed):
    """3 z: at omega t = 2 pi the share beyond a radius is the breathing state's, eq. (31)."""
    values = shares(radius, 2.0 * math.pi, seed)

    def breathing(phase):
        y = radius / math.sqrt(float(trap.swelling(phase, 0.3, 0.4)))
        bell = math.sqrt(2.0 / math.pi) * y * math.exp(-0.5 * y * y)
        return math.erfc(y / math.sqrt(2.0)) + bell

    assert ok(compare.of_mean(values, breathing(2.0 * math.pi)))
    # Negative control: the share a third of a radian later.
    assert caught(compare.of_mean(values, breathing(2.0 * math.pi + 0.33)))
