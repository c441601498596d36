"""Forward and ancestral draws have one law: of v_1, of its own collisions, and of both together.

The fourth moments are tested exactly elsewhere; these tests see the rest of the law, and what the
ancestral engine might lose: collisions between ancestors, the order within a step, the steps that
are skipped.
"""

import math

import numpy as np
import pytest
from law import compare, flawed_kernels
from law.algorithms import own_parameters
from scipy import stats

from kacsim import kac
from kacsim.kac import draws
from kacsim.kac.samplers import ENGINES
from kacsim.streams import new_stream

RATE = 0.9
# (particles, time, steps, draws)
SHAPES = [(3, 5.1, 15, 1_000_000), (7, 5.1, 6, 1_000_000), (50, 1.7, 10, 500_000)]


def parameters_of(algorithm, engine, n, time, steps):
    return {
        "algorithm": algorithm,
        "engine": engine,
        "n_particles": n,
        "time": time,
        "collision_rate": RATE,
        **own_parameters(algorithm, time, steps),
    }


def fill(kernel, arguments, n_draws, key):
    """Return (velocities, own collisions) of a kernel called with the arguments and a stream."""
    velocities, own = np.empty(n_draws), np.empty(n_draws, np.int64)
    kernel(velocities, own, *arguments[0], new_stream(*key), *arguments[1])
    return velocities, own


def sample(algorithm, engine, n, time, steps, n_draws, seed):
    kernel, arguments = draws.kernel_of(parameters_of(algorithm, engine, n, time, steps))
    n_draws = compare.scaled(n_draws)
    return fill(kernel, (arguments, ()), n_draws, (seed, f"engines {algorithm} {engine} {n}"))


def by_steps(n, time, steps):
    return stats.binom(steps, RATE * time / steps)


def by_time(n, time, steps):
    return stats.poisson(RATE * time)


# The exact laws of the number of collisions of particle 1.
OWN_LAWS = {
    "nanbu_sequential": by_steps,
    "nanbu_synchronous": by_steps,
    "nanbu_babovsky": by_steps,
    "bird": lambda n, time, steps: stats.binom(math.ceil(RATE * n * time / 2), 2 / n),
    "poisson": by_time,
    "poisson_printed": by_time,
}


def own_z(own, law):
    """Return z of Pearson's test of the numbers of own collisions, the last class open."""
    top = int(law.ppf(1.0 - 1e-9)) + 1
    p = law.pmf(np.arange(top + 1))
    counts = np.bincount(np.minimum(own, top + 1), minlength=top + 2)
    return compare.of_counts(counts, np.r_[p, max(0.0, 1.0 - p.sum())])


def own_z_between(own, other):
    """Return z of the two-sample chi-squared test of the numbers of own collisions."""
    n = np.zeros((2, max(own.max(), other.max()) + 1))
    for row, found in zip(n, (own, other), strict=True):
        row[:] = np.bincount(found, minlength=row.size)
    known = n.sum(axis=0) >= 40.0
    n = np.c_[n[:, known], n[:, ~known].sum(axis=1)]
    n = n[:, n.sum(axis=0) >= 40.0]
    statistic, _, freedom, _ = stats.chi2_contingency(n, correction=False)
    return compare.of_p(stats.chi2.sf(statistic, freedom))


def moments_of_own(velocities, own):
    """Return number, mean of v**4 and its squared error of the draws with k own collisions."""
    fourth = np.square(np.square(velocities))
    n = np.bincount(own)
    mean, square = (np.bincount(own, x) / np.maximum(n, 1) for x in (fourth, np.square(fourth)))
    return n, mean, (square - mean**2) / np.maximum(n - 1, 1)


def joint_z(a, b):
    """Return z of E[v**4 | k own collisions], compared for every k that 1000 draws have."""
    zs = [
        (mean - other) / math.sqrt(error + other_error)
        for n, mean, error, m, other, other_error in zip(
            *moments_of_own(*a), *moments_of_own(*b), strict=False
        )
        if min(n, m) > 1000
    ]
    return compare.of_squares(zs)


@pytest.fixture(
    scope="module",
    params=[(algorithm, *shape) for algorithm in kac.ALGORITHMS for shape in SHAPES],
    ids=lambda p: f"{p[0]}-n{p[1]}",
)
def both(request):
    """Return parameters, and seed -> engine -> (velocities, own collisions), kept."""
    algorithm, *shape = request.param
    return request.param, compare.kept(
        lambda seed: {name: sample(algorithm, name, *shape, seed) for name in ENGINES}
    )


def test_velocities_have_one_law(both, seed):
    """Null: one law of v_1**2, fair signs. Statistics: two-sample Kolmogorov-Smirnov and
    chi-squared on 64 bins of equal share, binomial z of the signs.

    1e6 draws of each engine see a distance of 0.0032 and 3.6 % in one bin (5e5: 0.0045, 5 %),
    and a share of positive velocities of 0.502.
    """
    found = both[1](seed)
    energies = [found[name][0] ** 2 for name in ENGINES]
    assert compare.ok(compare.of_distributions(*energies))
    assert compare.ok(compare.of_histograms(*energies))
    for v, _ in found.values():
        assert compare.ok(compare.of_share((v > 0.0).sum(), v.size, 0.5))


def test_own_collisions_have_the_exact_law(both, seed):
    """Null: Poisson(rate t); Binomial(steps, rate dt) with steps; Binomial(M, 2/N) for Bird.

    Statistic: chi-squared. 1e6 draws see a mean that is 0.5 % off. Of an algorithm that is not in
    the table above the engines are compared with each other.
    """
    (algorithm, *shape, _), drawn = both
    owns = [own for _, own in drawn(seed).values()]
    if algorithm in OWN_LAWS:
        for own in owns:
            assert compare.ok(own_z(own, OWN_LAWS[algorithm](*shape)))
    else:
        assert compare.ok(own_z_between(*owns))


def test_velocity_and_own_collisions_have_one_joint_law(both, seed):
    """Null: one E[v_1**4 | k own collisions] for each k. Statistic: sum of squared z.

    1e6 draws of each engine see about 3 % of the moment at the k that a fifth of them has.
    """
    assert compare.ok(joint_z(*both[1](seed).values()))


# kernel with a flag, (algorithm it copies, particles, time, steps)
MUTANTS = {
    "inner collisions forgotten": (flawed_kernels.poisson, ("poisson", 3, 5.1, None)),
    "order within the step forgotten": (
        flawed_kernels.nanbu_sequential,
        ("nanbu_sequential", 7, 5.25, 5),
    ),
    "gaps one too long": (flawed_kernels.bird, ("bird", 7, 1.7, None)),
}
MUTANT_DRAWS = 2_000_000


@pytest.mark.parametrize("name", MUTANTS)
def test_mutants_are_caught(name, seed):
    """Negative controls: the same kernel passes without its mutation and fails with it.

    2e6 draws of each against the forward engine, where the mutation matters most: many inner
    collisions of three particles, steps in which nearly all collide. Own collisions tell only a
    mutated gap.
    """
    kernel, what = MUTANTS[name]
    algorithm, *shape = what
    reference = sample(algorithm, "forward", *shape, MUTANT_DRAWS, seed)
    arguments = draws.kernel_of(parameters_of(algorithm, "ancestral", *shape))[1]
    for mutated in (False, True):
        key = (seed, f"engines mutant {algorithm} {mutated}")
        one = fill(kernel, (arguments, (mutated,)), compare.scaled(MUTANT_DRAWS), key)
        energies = one[0] ** 2, reference[0] ** 2
        statistics = compare.of_distributions, compare.of_histograms
        velocity_zs = [z(*energies) for z in statistics] + [joint_z(one, reference)]
        assert (compare.caught if mutated else compare.ok)(*velocity_zs)
        told = mutated and name == "gaps one too long"
        found = own_z(one[1], OWN_LAWS[algorithm](*shape))
        assert (compare.caught if told else compare.ok)(found)


def test_own_collisions_of_a_wrong_rate_are_caught(seed):
    """Negative controls: 1e6 exact draws against a mean 1 % too large, and draws of 2 %; 1 z."""
    _, own = sample("poisson", "ancestral", 7, 1.7, None, 1_000_000, seed)
    assert compare.caught(own_z(own, stats.poisson(1.01 * RATE * 1.7)))
    _, late = sample("poisson", "forward", 7, 1.02 * 1.7, None, 1_000_000, seed)
    assert compare.caught(own_z_between(own, late))
    _, same = sample("poisson", "forward", 7, 1.7, None, 1_000_000, seed)
    assert compare.ok(own_z_between(own, same))


def test_signs_of_a_mutant_are_caught(seed):
    """Negative control: 1 % of the negative velocities made positive."""
    v, _ = sample("poisson", "ancestral", 7, 1.7, None, 1_000_000, seed)
    positive = (v > 0.0).sum() + 0.01 * (v < 0.0).sum()
    assert compare.caught(compare.of_share(positive, v.size, 0.5))
