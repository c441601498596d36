"""The branching estimators against exact results and against the algorithms as printed.

A z of a mean needs a finite
second moment, and one of a mean square a finite fourth: E_M[(F / M)**p] of BKW is finite for
p < 6.6 at t = 0.5 and p < 4.2 at t = 1 (`bkw.tail_index`), oversampled or not (a mean of
sub-estimates has no heavier tail); of Kac at rate * t <= 0.45 for p < 3.3; extinction with a
majorant of at least alpha f0 stays between 0 and f0.
"""

import math

import numpy as np
import pytest
from law import compare
from law import literal_trees as printed
from law.compare import caught, controls, ok, scaled
from law.realizations import (
    MAJORANT,
    RATE,
    START,
    VELOCITY,
    N,
    Q,
    drawn,
    kernel_draws,
    z_of,
    z_of_leaves,
)

from kacsim import boltzmann, kac
from kacsim.boltzmann import bkw, bkw_tree, extinction, literal


@pytest.mark.parametrize("time", [0.5, 1.0])
def test_bkw(time, seed):
    """16 z: f at three velocities and fractions from 1 to 1e-10; 2 exp(t) - 1 drawings."""
    options = {"n_realizations": scaled(N), "seed": seed, "rms_velocity": Q}
    for velocity in (VELOCITY, 0.4, 7.0):
        one = boltzmann.estimate_bkw(velocity, time, **options)
        exact = bkw.density(np.linalg.norm(velocity), time, Q)
        assert ok(z_of(one, exact))
    # Var of the leaves of a tree: e**t (e**t - 1), of its drawings four times that
    spread = 2.0 * math.sqrt(math.exp(time) * math.expm1(time) / scaled(N))
    assert ok((one.mean_recursion - bkw.mean_recursion(time)) / spread)
    for threshold in (0.0, 3.0, 6.0, 10.2):
        share = boltzmann.estimate_bkw_fraction(threshold, time, **options)
        assert ok(z_of(share, bkw.fraction(threshold, time, Q)))


def test_bkw_as_printed_and_mutants(seed):
    """2 z as printed, and what the same z makes of mutants at a tenth of the realizations."""
    exact = bkw.density(np.linalg.norm(VELOCITY), 0.5, Q)
    for mutation in (printed.AS_PRINTED, *controls(printed.OLD_VELOCITY, printed.ONE_FOR_TWO)):
        options = {"seed": seed, "name": "bkw", "mutation": mutation}
        z = compare.of_mean(drawn(printed.bkw_values, VELOCITY, 0.5, Q, **options), exact)
        assert (ok if mutation == printed.AS_PRINTED else caught)(z)
    exact = bkw.fraction(6.0, 1.0, Q)
    for mutation in (printed.AS_PRINTED, *controls(printed.FORGET_4_PI)):
        options = {"seed": seed, "name": "fraction", "mutation": mutation}
        z = compare.of_mean(drawn(printed.bkw_fraction_values, 6.0, 1.0, Q, **options), exact)
        assert (ok if mutation == printed.AS_PRINTED else caught)(z)


def test_literal_and_tree_agree(seed):
    """3 z: the two programs of Algorithm 2 give one law of F / M (ties, leaves alone, aside)."""
    tree = kernel_draws(bkw_tree.estimate, (2.3, 0.8, 1.0, 0.0, 10**6), N, seed, "tree")
    plain = kernel_draws(literal.estimate, (2.3, 0.8, False), 300_000, seed, "literal")
    assert ok(z_of_leaves(tree[1], 0.8), z_of_leaves(plain[1], 0.8))
    several = [values[nodes > 1] for values, nodes in (tree, plain)]
    assert ok(compare.of_distributions(*several))
    # Negative controls: other times and another speed.
    other = kernel_draws(literal.estimate, (2.2, 0.8, False), 300_000, seed, "other")
    assert caught(compare.of_distributions(several[0], other[0][other[1] > 1]))
    assert caught(z_of_leaves(tree[1], 0.78))


@pytest.mark.parametrize(("m", "onset"), [(1.0, 0.0), (1.5, 0.0), (1.5, 0.3), (2.3, 0.0)])
def test_second_moment(m, onset, seed):
    """8 z: E F / M = 1 whatever the oversampling, and E (F / M)**2 by its equation, at t = 0.5."""
    values, _ = kernel_draws(
        bkw_tree.estimate_moment, (m, 0.5, onset, 10**6), 3 * N, seed, f"moment {m}"
    )
    exact = bkw.second_moment_oversampled(0.5, m, onset)
    assert ok(compare.of_mean(values, 1.0), compare.of_mean(values**2, exact))
    # Negative controls: as if not oversampled, and another time.
    if m > 1.0:
        assert caught(compare.of_mean(values**2, bkw.second_moment(0.5)))
    assert caught(compare.of_mean(values**2, bkw.second_moment_oversampled(0.4, m, 0.0)))


def test_oversampled_density(seed):
    """4 z: m = 1.5 keeps the mean at a probe, near and far, from t = 0 and from t = 0.4 on."""
    for velocity in (0.4, 7.0):
        for onset in (0.0, 0.4):
            one = boltzmann.estimate_bkw(
                velocity,
                1.0,
                n_realizations=scaled(N),
                seed=seed,
                rms_velocity=Q,
                oversampling=1.5,
                onset=onset,
            )
            assert ok(z_of(one, bkw.density(velocity, 1.0, Q)))
            # Negative control: the density 6 % of a collision time later.
            assert caught(z_of(one, bkw.density(velocity, 1.06, Q)))


@pytest.mark.parametrize("majorant", [0.92, MAJORANT])
def test_extinction(majorant, seed):
    """6 z: mean, variance and recursion at t = 0.8, alpha = 2.3, f0 = 0.4."""
    options = {"rate": RATE, "initial": START, "majorant": majorant}
    one = boltzmann.estimate_extinction(0.8, n_realizations=scaled(N), seed=seed, **options)
    f = extinction.density(0.8, RATE, START)
    variance = extinction.variance(0.8, RATE, START, majorant)
    spread = 2.0 * math.sqrt(math.exp(0.8 * majorant) * math.expm1(0.8 * majorant) / scaled(N))
    assert ok(z_of(one, f))
    assert ok((one.mean_recursion - extinction.mean_recursion(0.8, majorant)) / spread)
    arguments = 0.8, RATE, START, majorant
    values = drawn(printed.extinction_values, *arguments, seed=seed, name="extinction")
    # The standard error of the sample variance, from the fourth moment of the printed algorithm.
    error = ((values - f) ** 2).std() / math.sqrt(scaled(N))
    assert ok((one.variance - variance) / error)
    for mutation in controls(printed.ONE_FOR_TWO, printed.ALWAYS_ACCEPT):
        options = {"seed": seed, "name": "extinction", "mutation": mutation}
        values = drawn(printed.extinction_values, *arguments, **options)
        assert caught(compare.of_mean(values, f))
        assert caught(compare.of_mean((values - f) ** 2, variance))


@pytest.mark.parametrize("rate", [0.9, kac.RATE])
def test_kac(rate, seed):
    """16 z: f(v, 0.5) of the Kac equation, and with sub-estimates from t = 0.2 on."""
    for v in (-0.7, 0.1, 2.5, 4.0):
        for m in (1.0, 1.5):
            one = kac.estimate_density(
                v,
                0.5,
                n_realizations=scaled(N),
                seed=seed,
                collision_rate=rate,
                oversampling=m,
                onset=0.2 * (m - 1.0),
            )
            assert ok(z_of(one, kac.density(v, 0.5, rate)))


def test_kac_as_printed_and_mutants(seed):
    """2 z as printed."""
    for v in (0.7, 2.5):
        exact = kac.density(v, 0.5, 0.9)
        for mutation in (printed.AS_PRINTED, *controls(printed.OLD_VELOCITY, printed.ONE_FOR_TWO)):
            options = {"seed": seed, "name": "kac", "mutation": mutation, "n": 400_000}
            z = compare.of_mean(drawn(printed.kac_values, v, 0.5, 0.9, **options), exact)
            assert (ok if mutation == printed.AS_PRINTED else caught)(z)
