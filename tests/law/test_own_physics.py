"""Initial laws and scattering angles of one's own: exact moments at finite N, the law without end.

Everything is awkward: N = 7, t = 1.7, rate 0.9; f0 has two unlike peaks and a jump, the density of
the angle has no symmetry, so that odd moments count too.
"""

import csv
import functools
import math

import numba
import numpy as np
import pytest
from law import compare
from law.algorithms import own_parameters
from law.own_moments import Angles, Moments, moment
from scipy import interpolate, special

from kacsim import kac, techniques
from kacsim.kac import own_drawn, own_law, reference
from kacsim.kac.samplers import ALGORITHMS, ENGINES
from kacsim.kernels.provenance import ROOT
from kacsim.streams import new_stream
from kacsim.variates import pair_below

TIME, RATE, N = 1.7, 0.9, 7
STEPS = 5
EXAMPLES = ROOT / "docs/examples"
FILES = {name: EXAMPLES / f"own_{name}.csv" for name in ("initial", "scattering")}
# Of an angle whose density falls as (2 - theta)**2 from -0.3 to 2.
TABLE = techniques.tabulate(lambda x: -((2.0 - x) ** 3), -0.3, 2.0, 16)


def points(name):
    """Return the columns of an example's file."""
    with open(FILES[name], encoding="utf-8") as file:
        rows = [[float(word) for word in row] for row in list(csv.reader(file))[1:]]
    return np.array(rows).T


def moments_of(x, density):
    """Return E v**k for k = 0..4 of a density linear between points, by Gauss's rule."""
    nodes, weights = np.polynomial.legendre.leggauss(5)
    total = np.zeros(5)
    for k in range(1, len(x)):
        half, share = 0.5 * (x[k] - x[k - 1]), 0.5 * (1.0 + nodes)
        v, height = x[k - 1] + 2.0 * half * share, density[k - 1] * (1 - share) + density[k] * share
        total += [half * (weights * height * v**power).sum() for power in range(5)]
    return total / total[0]


def in_steps(values):
    """Return the density of a table, the same share between each value and the next."""
    return lambda x: 1.0 / np.diff(values)[np.searchsorted(values, x) - 1]


# two_peaks: -1.1 or 1.1 and a normal variate of variance 0.29
PEAKS = (1.0, 0.0, 1.5, 0.0, 1.1**4 + 6 * 1.1**2 * 0.29 + 3 * 0.29**2)
INITIAL = {"file": moments_of(*points("initial")), "two_peaks": PEAKS}
ANGLES = {
    "file": Angles(lambda x: np.interp(x, *points("scattering")), points("scattering")[0]),
    "table": Angles(in_steps(TABLE), TABLE),
    "forward": Angles(lambda x: 0.5 * math.pi - x, [0.0, 0.5 * math.pi]),
    "grazing": Angles(np.ones_like, [0.0, math.pi / 8]),
    "uniform": Angles(np.ones_like, np.linspace(0.0, math.pi, 9)),
}
GIVEN = {"file": FILES["scattering"], "table": TABLE}


def process(algorithm, rate=RATE):
    own = own_parameters(algorithm, TIME, STEPS)
    return {"n_particles": N, "time": TIME, "collision_rate": rate, **own}


def velocities(algorithm, engine, initial, scattering, n_draws, seed):
    initial = FILES["initial"] if initial == "file" else initial
    return kac.draw(
        algorithm,
        engine=engine,
        initial=initial,
        scattering=GIVEN.get(scattering, scattering),
        n_draws=compare.scaled(n_draws),
        seed=seed,
        **process(algorithm),
    )


@functools.cache
def exact(order, algorithm, initial, scattering, rate=RATE):
    return moment(
        order, INITIAL[initial], ANGLES[scattering], algorithm, **process(algorithm, rate)
    )


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_moments(algorithm, engine, seed):
    """Null: E v_1 .. E v_1**4 of this N and step, f0 of a file and the angle of a table.

    Statistics: z of the means; 1e6 draws see half a percent of E v and of E v**4. Mutants: the
    mirrored f0, and other angles.
    """
    v = velocities(algorithm, engine, "file", "table", 1_000_000, seed)
    found = [exact(k, algorithm, "file", "table") for k in (1, 2, 3, 4)]
    assert compare.ok(*(compare.of_mean(v**k, found[k - 1]) for k in (1, 2, 3, 4)))
    assert compare.caught(compare.of_mean(v, -found[0]), compare.of_mean(v**3, -found[2]))
    assert compare.caught(compare.of_mean(v, exact(1, algorithm, "file", "forward")))


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("scattering", ["file", "forward", "grazing", "uniform"])
def test_angles(scattering, engine, seed):
    """Null: E v_1**2 = 3/2 and E v_1**4 of Kac's process from two peaks, for every kind of angle.

    1e6 draws have a standard error of 0.1 % of E v**4, and from the start to the equilibrium it
    grows by half. Mutants: the rate one ninth larger, where anything changes, and other angles.
    """
    given = "uniform" if scattering == "uniform" else scattering
    v = velocities("poisson", engine, "two_peaks", given, 1_000_000, seed)
    assert compare.ok(compare.of_mean(v, 0.0), compare.of_energy(v))
    assert compare.ok(compare.of_fourth(v, exact(4, "poisson", "two_peaks", scattering)))
    other = "grazing" if scattering != "grazing" else "forward"
    assert compare.caught(compare.of_fourth(v, exact(4, "poisson", "two_peaks", other)))


@numba.njit(error_model="numpy")
def pair_moments(n, n_collisions, n_draws, tables, stream):
    """Return sums of v_1 v_2, its square, v_1**2 v_2**2 and the square of that."""
    found = np.zeros(4)
    v = own_law.ensemble(n, tables)
    for _ in range(n_draws):
        for i in range(n):
            own_law.start(v, i, stream)
        for _ in range(n_collisions):
            i, j = pair_below(n, stream)
            own_law.collide(v, i, j, stream)
        product = v.velocity[0] * v.velocity[1]
        found += np.array([product, product**2, product**2, product**4])
    return found


PAIR_COLLISIONS = 6


def exact_pair(exponents, angles):
    """Return E v_1**a v_2**b after some collisions of Bird's pairs."""
    m = Moments(N, sum(exponents), angles)
    step = np.linalg.matrix_power(m.mean_collision(), PAIR_COLLISIONS)
    return float((step @ m.start(INITIAL["file"]))[m.place[exponents + (0,) * (N - 2)]])


def test_two_particles(seed):
    """Null: E v_1 v_2 and E v_1**2 v_2**2 of Bird's particles, from a file by a table's angles.

    1e6 draws have standard errors of 1.6 and 0.15 %. Mutants: other angles, and no collisions.
    """
    tables = own_drawn.tables(str(FILES["initial"]), TABLE)
    n = compare.scaled(1_000_000)
    product, square, squares, fourth = (
        pair_moments(N, PAIR_COLLISIONS, n, tables, new_stream(seed)) / n
    )
    error, errors = (math.sqrt((b - a**2) / n) for a, b in ((product, square), (squares, fourth)))
    wanted = [exact_pair(one, ANGLES["table"]) for one in ((1, 1), (2, 2))]
    assert compare.ok((product - wanted[0]) / error, (squares - wanted[1]) / errors)
    other = exact_pair((1, 1), ANGLES["forward"])
    assert compare.caught((product - other) / error)
    assert compare.caught((squares - INITIAL["file"][2] ** 2) / errors)


def by_points(x, density):
    """Return the cumulative function of a density linear between points."""

    def cumulative(v):
        found = np.zeros_like(v)
        for k in range(1, len(x)):
            width = x[k] - x[k - 1]
            t = np.clip((v - x[k - 1]) / width, 0.0, 1.0) if width else 0.0
            found += width * (density[k - 1] * t + 0.5 * (density[k] - density[k - 1]) * t**2)
        return found / np.trapezoid(density, x)

    return cumulative


SPREAD = math.sqrt(0.29)
FIRST = {
    "two_peaks": lambda v: 0.5 * sum(special.ndtr((v + s) / SPREAD) for s in (-1.1, 1.1)),
    "uniform": lambda v: np.clip(0.5 + v / (2.0 * math.sqrt(4.5)), 0.0, 1.0),
    "maxwell": lambda v: special.ndtr(v / math.sqrt(1.5)),
    "file": by_points(*points("initial")),
}


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("initial", FIRST)
def test_initial_laws(initial, engine, seed):
    """Null: before any collision v_1 has the initial law.

    Statistic: Kolmogorov-Smirnov; 5e5 draws see a distance of 0.0032. Mutant: v shifted by 0.02.
    """
    given = FILES["initial"] if initial == "file" else initial
    n_draws = compare.scaled(500_000)
    v = kac.draw("poisson", n_particles=2, time=1e-12, n_draws=n_draws, seed=seed, engine=engine,
                 initial=given)  # fmt: skip
    assert compare.ok(compare.of_distribution(v, FIRST[initial]))
    assert compare.caught(compare.of_distribution(v + 0.02, FIRST[initial]))


class Peaks:
    """The law of two_peaks, for the equation solved without draws."""

    def mgf(self, z):
        return np.cosh(1.1 * z) * np.exp(0.5 * 0.29 * z**2)


class Paper:
    """The paper's f0, density 2 / sqrt(pi) v**2 exp(-v**2)."""

    def mgf(self, z):
        return (1.0 + 0.5 * z**2) * np.exp(0.25 * z**2)


def endless(law, time):
    """Return the cumulative function of the Kac equation, to 1e-4, from its solution at points."""
    grid = np.linspace(0.0, 5.5, 23)
    above = interpolate.CubicSpline(grid, reference.tail(law, grid, time, RATE))
    return lambda v: np.where(v < 0.0, above(np.minimum(-v, 5.5)), 1.0 - above(np.minimum(v, 5.5)))


@functools.cache
def solved(name, time=TIME):
    if name == "f0":  # eq. (8), which a test below takes for the solution
        return functools.partial(kac.cumulative, time=time, collision_rate=RATE)
    return endless(Peaks(), time)


@pytest.mark.parametrize("initial", ["two_peaks", "f0"])
def test_law_without_end(initial, seed):
    """Null: infinitely many particles follow the Kac equation, solved without draws.

    Statistic: Kolmogorov-Smirnov; 1e6 draws see a distance of 0.0023. Mutant: 0.3 later.
    """
    v = kac.draw("poisson", n_particles=math.inf, time=TIME, n_draws=compare.scaled(1_000_000),
                 seed=seed, collision_rate=RATE, initial=initial,
                 scattering=[-math.pi, math.pi])  # fmt: skip
    assert compare.ok(compare.of_energy(v), compare.of_distribution(v, solved(initial)))
    assert compare.caught(compare.of_distribution(v, solved(initial, TIME + 0.3)))


def test_eq_8_is_the_solution_of_the_equation():
    """No draws: the paper's closed form and the solution by transforms agree, from its f0."""
    v = np.linspace(0.0, 5.0, 6)
    found = reference.tail(Paper(), v, TIME, RATE)
    assert found == pytest.approx(kac.survival(v, TIME, RATE), rel=1e-9)
    assert found != pytest.approx(kac.survival(v, TIME, 1.01 * RATE), rel=1e-6)


def test_moments_are_those_of_the_package_for_the_paper():
    """No draws: the linear system of this test against the exact fourth moments of the package."""
    paper = (1.0, 0.0, 1.5, 0.0, 3.75)
    for algorithm in ALGORITHMS:
        known = process(algorithm) | {"n_particles": 4}
        wanted = kac.fourth_moment(
            known.pop("time"), known.pop("n_particles"), algorithm=algorithm, **known
        )
        known = process(algorithm) | {"n_particles": 4}
        assert moment(4, paper, ANGLES["uniform"], algorithm, **known) == pytest.approx(wanted)
