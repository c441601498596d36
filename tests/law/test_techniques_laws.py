"""Tables, rejection and the Gamma identity against the laws that they stand for."""

import math

import numba
import numpy as np
import pytest
from law import compare
from scipy import special

from kacsim import techniques
from kacsim.streams import new_stream
from kacsim.techniques import exact, identity, inverse_transform, model, rejection
from kacsim.techniques.constants import CLOSED, LAWS, SUPPORT
from kacsim.variates import uniform

N = 1_000_000


def through(table, seed, name):
    values = np.empty(compare.scaled(N))
    inverse_transform.through_table(values, table, new_stream(seed, name))
    return values


@numba.njit(error_model="numpy")
def table_in_v(values, low, high, heights, stream):
    """Mutant: a table equally spaced in v, used as if it were equally spaced in u."""
    n = heights.size - 1
    for k in range(values.size):
        place = uniform(stream) * n
        values[k] = low + (high - low) * place / n


@pytest.mark.parametrize("n_table", [1, 7, 64])
@pytest.mark.parametrize("law", ["kac_initial", "exponential", "ramp"])
def test_a_table_has_its_own_law(law, n_table, seed):
    """Null: the law whose cumulative function joins the nodes, exactly. 18 z.

    Statistics: Kolmogorov-Smirnov (1e6 draws see 0.0026) and the mean. Mutants: the law itself,
    which few intervals miss, and a table equally spaced in v.
    """
    table = inverse_transform.law_table(law, n_table)
    values = through(table, seed, f"table {law} {n_table}")
    steps = np.linspace(0.0, 1.0, n_table + 1)
    assert compare.ok(compare.of_distribution(values, lambda v: np.interp(v, table, steps)))
    mean = 0.5 * (table[1:] + table[:-1]).mean()
    assert compare.ok(compare.of_mean(values, mean))
    if n_table == 1 or law != "ramp":
        assert compare.caught(compare.of_distribution(values, exact.CUMULATIVES[law]))
    wrong = np.empty(N // 10)
    heights = exact.CUMULATIVES[law](np.linspace(*SUPPORT[law], n_table + 1))
    table_in_v(wrong, *SUPPORT[law], heights, new_stream(seed, "in v"))
    if n_table > 1:
        z = compare.of_distribution(wrong, lambda v: np.interp(v, table, steps))
        assert compare.caught(z)


@pytest.mark.parametrize(("law", "power"), [("kac_initial", -1), ("exponential", -1), ("ramp", -2)])
def test_the_error_of_a_table_falls_with_its_size(law, power):
    """No random numbers: the largest error in P from 128 to 2048 intervals."""
    sizes, errors = [128, 2048], []
    for size in sizes:
        table = inverse_transform.law_table(law, size)
        places = np.interp(np.linspace(0, size, 40 * size + 1), np.arange(size + 1), table)
        errors.append(np.abs(inverse_transform.table_error(law, table, places)).max())
    assert math.log(errors[1] / errors[0]) / math.log(16) == pytest.approx(power, abs=0.12)


@pytest.mark.parametrize(
    ("law", "envelope"),
    [("kac_initial", "constant"), ("kac_initial", "closer"), ("triangle", "constant")],
)
def test_rejection_has_the_law_and_the_cost(law, envelope, seed):
    """Null: the law, and trials of mean the envelope's area. 9 z.

    Mutants: proposals all accepted, and the cost of a density twice as high.
    """
    values, arguments = np.empty(compare.scaled(N)), rejection.arguments(law, envelope)
    trials = rejection.draw(values, *arguments, new_stream(seed, f"rejection {law} {envelope}"))
    area = exact.envelope_area(law, envelope)
    mean = trials / values.size
    cost = (mean - area) / math.sqrt(area * (area - 1.0) / values.size)
    assert compare.ok(cost)
    assert compare.caught((mean - area / 2) / math.sqrt(area * area / values.size))
    assert compare.ok(compare.of_distribution(values, exact.CUMULATIVES[law]))
    square = 1.5 if law == "kac_initial" else 0.5
    assert compare.ok(compare.of_mean(values**2, square))
    points = np.empty((N // 10, 3))
    rejection.record(points, *arguments, new_stream(seed, "record"))
    assert compare.caught(compare.of_distribution(points[:, 0].copy(), exact.CUMULATIVES[law]))


def test_the_three_ways_to_draw_f0_are_one_law(seed):
    """Null: Gamma identity, rejection and f0. 4 z. Mutants: a table of 64, and an energy less."""
    values, other = np.empty((2, compare.scaled(N)))
    identity.draw(values, new_stream(seed, "identity"))
    rejection.draw(other, *rejection.arguments("kac_initial", "closer"), new_stream(seed, "other"))
    law = exact.CUMULATIVES["kac_initial"]
    assert compare.ok(compare.of_distribution(values, law))
    assert compare.ok(compare.of_distributions(values, other))
    assert compare.ok(compare.of_energy(values))
    assert compare.ok(compare.of_fourth(values, 3.75))
    coarse = through(inverse_transform.law_table("kac_initial", 64), seed, "coarse")
    assert compare.caught(compare.of_distributions(values, coarse))
    assert compare.caught(compare.of_distribution(0.99 * values, law))


def test_exercise_1(seed):
    """Null: p(x) = k exp(-k x), k = 2.7. 2 z. Mutant: log(1 - y) of another rate."""
    x = techniques.draw_by_inversion("exponential", n_draws=compare.scaled(N), seed=seed, rate=2.7)
    assert compare.ok(compare.of_distribution(x, lambda v: -np.expm1(-2.7 * v)))
    assert compare.ok(compare.of_mean(x, 1.0 / 2.7))
    assert compare.caught(compare.of_mean(x, 1.0 / 2.75))


@pytest.mark.parametrize("law", CLOSED)
def test_closed_inverses_have_their_laws(law, seed):
    """Null: P(v) of every law that is inverted in closed form. 3 z: 1e6 draws see 0.0026.

    Mutant: the uniforms themselves a hundredth too large.
    """
    values = techniques.draw_by_inversion(law, n_draws=compare.scaled(N), seed=seed)
    cumulative = exact.CUMULATIVES[law]
    assert compare.ok(compare.of_distribution(values, cumulative))
    wrong = 1.01 * cumulative(values)
    assert compare.caught(compare.of_distribution(wrong, lambda u: np.clip(u, 0.0, 1.0)))


def test_any_law_by_table_and_by_rejection(seed):
    """Null: Normal(0.3, 1.3**2), by callables. 3 z. Mutant: a table equally spaced in v."""

    def law(v):
        return special.ndtr((v - 0.3) / 1.3)

    table = techniques.tabulate(law, -8.0, 8.0, 4001)
    size = {"n_draws": compare.scaled(100_000), "seed": seed}
    drawn = techniques.draw_from_table(table, **size)
    assert compare.ok(compare.of_distribution(drawn, law))
    values, used = techniques.draw_by_rejection(
        lambda v: np.exp(-((v - 0.3) ** 2) / 3.38),
        lambda v: np.exp(0.32 * 1.69 - 0.8 * np.abs(v - 0.3)),
        lambda u: 0.3 + np.where(u < 0.5, np.log(2 * u + 1e-300), -np.log(2 - 2 * u)) / 0.8,
        **size,
    )
    assert compare.ok(compare.of_distribution(values, law))
    trials = used / 2
    area = math.exp(0.32 * 1.69) * 2 / 0.8 / math.sqrt(2 * math.pi * 1.69)
    z = (trials / values.size - area) / math.sqrt(area * (area - 1.0) / values.size)
    assert compare.ok(z)
    equal = np.linspace(-8.0, 8.0, 4002)
    wrong = techniques.draw_from_table(equal, n_draws=10_000, seed=seed)
    assert compare.caught(compare.of_distribution(wrong, law))


def test_cells_are_of_equal_probability(seed):
    """No z: draws fall in the cells of their exact cumulative probability, as numpy counts them."""
    values = np.random.default_rng(seed).normal(size=5000)
    for law in range(len(LAWS)):
        inside = np.clip(values, *SUPPORT[LAWS[law]])
        counts, sums = np.zeros(97, np.int64), np.zeros(4)
        model.fill_cells(inside, law, counts, sums)
        u = np.clip(exact.CUMULATIVES[LAWS[law]](inside), 0, 1 - 1e-16)
        np.testing.assert_array_equal(counts, np.bincount((u * 97).astype(int), minlength=97))
        np.testing.assert_allclose(sums, [(inside**k).sum() for k in (1, 2, 3, 4)], rtol=1e-9)
