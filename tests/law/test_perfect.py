"""Perfect draws, epsilon = 0: the exact equilibrium law of N particles, independent draws."""

import functools

import flawed_blocks as flawed
import numpy as np
import pytest
from law import compare
from scipy import stats

from kacsim import kac
from kacsim.kac import exact, perfect_blocks
from kacsim.streams import new_stream


def law_of(n, energy=None):
    return functools.partial(exact.equilibrium_cumulative, n_particles=n, energy=energy)


@pytest.mark.parametrize(
    ("n", "energy", "n_draws"),
    [(2, 2.3, 1_000_000), (3, None, 1_000_000), (7, 4.9, 400_000), (20, None, 300_000)],
)
def test_draws_follow_the_beta_law(n, energy, n_draws, seed):
    """Null: v_1**2 / E ~ Beta(1/2, (N - 1)/2) with a fair sign, exactly.

    Statistics: Kolmogorov-Smirnov, z of E v**2 and of E v**4. 4e5 draws see a distance of 0.0036
    and 1.2 % of the fourth moment. Mutants: the energy N where 3 N / 2 was drawn, and one particle
    more.
    """
    v = kac.draw_perfect(n_particles=n, energy=energy, n_draws=compare.scaled(n_draws), seed=seed)
    total = 1.5 * n if energy is None else energy
    assert compare.ok(compare.of_distribution(v, law_of(n, energy)))
    assert compare.ok(compare.of_mean(v**2, total / n))
    assert compare.ok(compare.of_mean(v**4, exact.equilibrium_fourth_moment(n, energy)))
    for size, sum_ in ((n, total / 1.5), (n + 1, total)):
        assert compare.caught(compare.of_mean(v**2, sum_ / size))
        assert compare.caught(compare.of_distribution(v, law_of(size, sum_)))


def by_flaw(n, block, size, seed, flaw):
    """Return squares over the energy, drawn with a flaw."""
    v = np.empty(size)
    flawed.draw(v, n, 1.7, block, new_stream(seed, f"law blocks {n} {block}"), flaw)
    return v**2 / 1.7


# What a flaw moves is largest where blocks are short: many fail, and the end is not mixed.
SHAPES = {
    (3, 1): (flawed.AT_THE_END, flawed.OWN_LAW, flawed.NEVER_FAILS, flawed.STATE_KEPT),
    (3, 2): (flawed.AT_THE_END, flawed.OWN_LAW, flawed.NEVER_FAILS),
    (4, 6): (flawed.AT_THE_END, flawed.NEVER_FAILS, flawed.STATE_KEPT),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_short_blocks_are_exact_too(shape, seed):
    """Null: E x**2 = 3 / (N (N + 2)) and the whole law of x = v_1**2 / E, from the kernel.

    Many of these blocks fail. 1e6 draws see 0.5 % of the moment. Mutants: the state at
    the block's end, and those of `flawed_blocks` that show here.
    """
    n, block = shape
    size = compare.scaled(1_000_000)
    v, moment = np.empty(size), 3.0 / (n * (n + 2.0))
    perfect_blocks.draw_beginnings(v, n, 1.7, block, new_stream(seed, f"law short {n} {block}"))
    square = v**2 / 1.7
    assert compare.ok(compare.of_mean(square**2, moment))
    assert compare.ok(compare.of_distribution(square, stats.beta(0.5, 0.5 * (n - 1)).cdf))
    for flaw in compare.controls(*SHAPES[shape]):
        wrong = by_flaw(n, block, size, seed, flaw)
        assert compare.caught(compare.of_mean(wrong**2, moment)), flaw


@pytest.mark.parametrize("shape", SHAPES)
def test_the_flawed_kernel_without_a_flaw_is_exact(shape, seed):
    """Null: as above, so that a mutant is caught for its flaw alone; 1e6 draws."""
    n, block = shape
    square = by_flaw(n, block, compare.scaled(1_000_000), seed, flawed.NONE)
    assert compare.ok(compare.of_mean(square**2, 3.0 / (n * (n + 2.0))))


@pytest.mark.parametrize(("n", "block"), [(3, 1), (3, 5), (6, 40)])
def test_successive_draws_are_independent(n, block, seed):
    """Null: E x_k x_(k+1) = 1 / N**2, at one and at two draws apart. 1e6 pairs see 0.4 %.

    Mutant: energies mixed with those of neighbours, as if a block did not forget.
    """
    v = np.empty(compare.scaled(1_000_000))
    perfect_blocks.draw_beginnings(v, n, 1.0, block, new_stream(seed, f"law apart {n} {block}"))
    x = v**2
    for lag in (1, 2):
        assert compare.ok(compare.of_mean((x[lag:] - 1.0 / n) * (x[:-lag] - 1.0 / n), 0.0))
    mixed = 0.97 * x[1:] + 0.03 * x[:-1]
    assert compare.caught(compare.of_mean((mixed - 1.0 / n) * (x[:-1] - 1.0 / n), 0.0))


@pytest.mark.parametrize(
    ("s", "low", "high"), [(0.7, 0.2, 1.0), (0.7, 0.7, 0.9), (0.7, 0.5, 0.7), (0.7, -0.1, 0.8)]
)
def test_what_is_common_and_what_is_left_make_a_state_s_own_law(s, low, high, seed):
    """Null: x / s ~ Beta(1/2, 1/2), also at both ends of the range. 1e6 draws see a distance of
    0.0023. Mutant: a failing block draws from the whole law.
    """
    size, key = compare.scaled(1_000_000), (seed, f"law shares {low} {high}")
    values = np.empty(size)
    law = stats.beta(0.5, 0.5, scale=s).cdf
    flawed.shares(values, s, low, high, new_stream(*key), flawed.NONE)
    assert compare.ok(compare.of_distribution(values, law))
    if low > 0.0:
        flawed.shares(values, s, low, high, new_stream(*key), flawed.OWN_LAW)
        assert compare.caught(compare.of_distribution(values, law))


def test_a_coarse_tolerance_shows_where_perfect_draws_do_not_depart(seed):
    """Null: epsilon = 0 at N = 3; the same test rejects epsilon = 0.5 there. 2e6 draws."""
    size = {"n_draws": compare.scaled(2_000_000), "seed": seed}
    v = kac.draw_perfect(n_particles=3, **size)
    assert compare.ok(compare.of_distribution(v, law_of(3)))
    v, _ = kac.draw_equilibrium(n_particles=3, tolerance=0.5, **size)
    assert compare.caught(compare.of_distribution(v, law_of(3)))


def test_perfect_draws_are_those_of_a_fine_tolerance(seed):
    """Null: two-sample Kolmogorov-Smirnov at N = 6 against epsilon = 1e-6; 3e5 draws of each see a
    distance of 0.006. Mutant: seven particles of the same energy.
    """
    size = {"n_draws": compare.scaled(300_000), "seed": seed, "energy": 6.0}
    v = kac.draw_perfect(n_particles=6, **size)
    for n, judge in ((6, compare.ok), (7, compare.caught)):
        w, _ = kac.draw_equilibrium(n_particles=n, tolerance=1e-6, **size)
        assert judge(compare.of_distributions(v, w))
