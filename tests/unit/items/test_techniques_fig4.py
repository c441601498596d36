"""Fig. 11.4 of the chapter from samples made by hand: another power of N in every place.

No z tests. Powers are put into the samples; where errors scatter, `slope.of_squares`, which has
tests of its own, is given what the samples hold.
"""

import math

import fabricated
import fabricated_chapter as chapter
import numpy as np
import pytest

from kacsim.statistics import slope

DIMENSIONS = [2, 3, 4, 5]
VOLUMES = {2: math.pi / 4, 3: math.pi / 6, 4: math.pi**2 / 32, 5: math.pi**2 / 60}
LATTICE = {2: -0.71, 3: -0.62, 4: -0.47, 5: -0.38}
RANDOM = {2: -0.52, 3: -0.53, 4: -0.54, 5: -0.55}
SOBOL = {2: -0.81, 3: -0.72, 4: -0.63, 5: -0.61}
LARGEST, MOST, FIRST = 40, 59, 10  # edges: of the figure, of the fits, from which on
EDGES = np.arange(1, MOST + 1)
SHOWN = np.arange(1, LARGEST + 1.0) ** 4  # N of the figure
ODD = np.where(EDGES % 2 == 1, 0.05, -0.02)  # odd edges err more
GOOD = np.array([0.5, -0.2, 0.9, -0.3])  # errors of the seeds at N = 1
BAD = np.array([0.02, -0.04, 0.03])  # of the bad generator, at every N


def lattice(d):
    return ODD * EDGES ** (d * LATTICE[d])


def good():
    wave = 1.0 + 0.3 * np.cos(np.arange(SHOWN.size))
    return GOOD[:, None] * wave * SHOWN**-0.48


def sphere_points(case):
    n, generator = np.array(case.parameters["n_points"], dtype=float), case.parameters["generator"]
    if case.parameters["dimension"] == [4]:
        errors = {
            "good": good(),
            "exhausted": BAD[:, None] * np.ones(n.size),
            "congruential": np.full((2, 1), 0.001) * n**-0.1,
        }[generator][None]
    else:
        powers = RANDOM if generator == "good" else SOBOL
        seeds = np.array([0.3, -0.4])[:, None]
        errors = np.array([seeds * n ** powers[d] for d in DIMENSIONS])
    return chapter.points(case, errors, VOLUMES)


def made(**changes):
    sizes = {"n_replicates": 4, "bad_n_replicates": 3, "congruential_n_replicates": 2}
    chosen = fabricated.settings(
        "techniques_fig4",
        **{
            "dimension": DIMENSIONS,
            "largest_edge": LARGEST,
            "power_largest_edge": MOST,
            "fit_from_edge": FIRST,
            "smallest_circle": 20,
            "largest_circle": 200,
            "n_circles": 150,
            "many_n_replicates": 2,
        }
        | sizes
        | changes,
    )

    def make(case):
        if case.name == "sphere_points":
            return sphere_points(case)
        if case.name == "circle_lattice":
            edge = np.arange(20.0, 170.0)
            inside = VOLUMES[2] * edge**2 * (1.0 + 0.4 * edge**-1.4)
            return fabricated.variables(inside=(("edge",), inside), edge=(("edge",), edge))
        dimensions = case.parameters["dimension"]
        whole = [VOLUMES[d] * EDGES**d * (1.0 + lattice(d)) for d in dimensions]
        return fabricated.variables(
            inside=(("dimension", "edge"), whole),
            dimension=(("dimension",), dimensions),
            edge=(("edge",), EDGES),
        )

    return fabricated.reduced("techniques_fig4", chosen, make)


def lattice_power(d, first, last):
    """Return the fit over edges in blocks of ten."""
    edge = np.arange(first, last + 1)
    squares = lattice(d)[first - 1 : last] ** 2
    return slope.of_squares(edge.astype(float) ** d, squares, np.arange(edge.size) // 10)[0]


def good_power():
    n = np.broadcast_to(SHOWN, good().shape).ravel()
    return slope.of_squares(n, good().ravel() ** 2, np.repeat(np.arange(4), SHOWN.size))[0]


@pytest.fixture(scope="module")
def dataset():
    return made()


@pytest.fixture(scope="module")
def found(dataset):
    return fabricated.found("techniques_fig4", dataset)


def test_powers_of_the_shown_dimension(dataset):
    line = dataset.shown_slope
    assert float(line[0]) == pytest.approx(lattice_power(4, 1, LARGEST).value)
    assert float(dataset.upper_slope) == pytest.approx(lattice_power(4, FIRST, LARGEST).value)
    assert float(line.sel(line="good")) == pytest.approx(good_power().value)
    error = dataset.shown_slope_error.sel(line="good")
    assert float(error) == pytest.approx(good_power().standard_error)
    assert float(line.sel(line="exhausted")) == pytest.approx(0.0, abs=1e-9)
    assert float(line.sel(line="congruential")) == pytest.approx(-0.1)


def test_powers_by_dimension_and_their_degrees(dataset):
    for d in DIMENSIONS:
        power = lattice_power(d, FIRST, MOST)
        here = dataset.sel(dimension=d)
        assert float(here.slope.sel(way="lattice")) == pytest.approx(power.value)
        assert float(here.slope_error.sel(way="lattice")) == pytest.approx(power.standard_error)
        assert float(here.slope_degrees.sel(way="lattice")) == pytest.approx(power.degrees)
        assert float(here.slope.sel(way="random")) == pytest.approx(RANDOM[d])
        assert float(here.slope.sel(way="sobol")) == pytest.approx(SOBOL[d])
    assert float(dataset.circle_slope) == pytest.approx(-0.7)


def test_root_mean_squares_volumes_and_the_advantage(dataset):
    last = dataset.isel(edge=-1)
    for name, errors in (("good", good()[:, -1]), ("exhausted", BAD)):
        squares = errors**2
        root = math.sqrt(squares.mean())
        spread = squares.std(ddof=1) / math.sqrt(squares.size) / (2.0 * root)
        assert float(last.rms.sel(generator=name)) == pytest.approx(root)
        assert float(last.rms_error.sel(generator=name)) == pytest.approx(spread)
    volume = VOLUMES[4] * (1.0 + good()[:, -1])
    assert float(dataset.volume) == pytest.approx(volume.mean())
    assert float(dataset.volume_error) == pytest.approx(volume.std(ddof=1) / 2.0)
    assert float(dataset.lattice_volume) == pytest.approx(
        VOLUMES[4] * (1.0 + lattice(4)[LARGEST - 1])
    )
    # one point: root of (1 - p) / p; the lattice over M = 20 to 40, every N alike
    p, top = VOLUMES[4], slice(LARGEST // 2 - 1, LARGEST)
    level = math.sqrt(np.mean(lattice(4)[top] ** 2 * EDGES[top] ** 4.0))
    assert float(dataset.advantage) == pytest.approx(math.sqrt((1.0 - p) / p) / level)
    assert float(dataset.line_power) == pytest.approx(-1.0, abs=1e-6)


def test_claims_of_the_shown_dimension(found):
    lattice_4, random = lattice_power(4, 1, LARGEST), good_power()
    values = chapter.values(found, "techniques_fig4_lattice")
    upper = lattice_power(4, FIRST, LARGEST).value
    assert [one[1] for one in values] == pytest.approx([lattice_4.value, upper])
    assert [one[2] for one in values] == [0.0, 0.0]
    ((_, value, error, degrees),) = chapter.values(found, "techniques_fig4_random")
    assert (value, error) == pytest.approx((random.value, random.standard_error))
    assert degrees == 3
    ((_, value, error, degrees),) = chapter.values(found, "techniques_fig4_difference")
    assert value == pytest.approx(random.value - lattice_4.value)
    assert (error, degrees) == (pytest.approx(random.standard_error), 3)
    p, top = VOLUMES[4], slice(LARGEST // 2 - 1, LARGEST)
    level = math.sqrt(np.mean(lattice(4)[top] ** 2 * EDGES[top] ** 4.0))
    ratio = math.sqrt((1.0 - p) / p) / level
    as_well = chapter.values(found, "techniques_fig4_as_well")
    assert as_well == [("", pytest.approx(ratio), 0.0, None)]
    volumes = chapter.values(found, "techniques_fig4_volume")
    assert volumes[0][1] == pytest.approx(VOLUMES[4] * (1.0 + lattice(4)[LARGEST - 1]))
    assert volumes[1][1] == pytest.approx((VOLUMES[4] * (1.0 + good()[:, -1])).mean())
    assert volumes[1][3] == 3
    for printed, _, _ in chapter.sets(found, "techniques_fig4_volume"):
        assert printed == pytest.approx(0.30842513753404244)
    assert chapter.sets(found, "techniques_fig4_one")[0][:2] == (-1.0, -2.0)


def test_claim_of_the_generator_that_runs_out(found):
    """Over the exact error of as many independent points; three seeds."""
    squares = BAD**2
    root, p = math.sqrt(squares.mean()), VOLUMES[4]
    exact = math.sqrt((1.0 - p) / p / LARGEST**4)
    spread = squares.std(ddof=1) / math.sqrt(3) / (2.0 * squares.mean()) / math.log(10.0)
    assert chapter.values(found, "techniques_fig4_bad") == [
        ("", pytest.approx(math.log10(root / exact)), pytest.approx(spread), 2)
    ]


def test_claims_by_dimension(found):
    powers = {d: lattice_power(d, FIRST, MOST) for d in DIMENSIONS}
    cases = (
        ("techniques_fig4_powers", [3, 4, 5], lambda d: (d * powers[d].value, d)),
        ("techniques_fig4_higher", [5], lambda d: (powers[d].value + 0.5, 1)),
        ("techniques_fig4_only", [2, 3], lambda d: (-0.5 - powers[d].value, 1)),
    )
    for claim, dimensions, expected in cases:
        rows = chapter.values(found, claim)
        assert [one[0] for one in rows] == [f"d = {d}" for d in dimensions]
        for d, (_, value, error, degrees) in zip(dimensions, rows, strict=True):
            wanted, factor = expected(d)
            assert value == pytest.approx(wanted)
            assert error == pytest.approx(factor * powers[d].standard_error)
            assert degrees == pytest.approx(powers[d].degrees)
    ((_, value, _, _),) = chapter.values(found, "techniques_fig4_circle")
    assert value == pytest.approx(-0.7)
    assert chapter.sets(found, "techniques_fig4_circle") == [(-1.0, -0.5, -0.75)]


def test_verdicts_where_the_lattice_falls_otherwise(dataset):
    """Powers of the lattice with small errors: as printed, and turned round."""
    changed = dataset.copy(deep=True)
    changed.slope_error[:] = 1e-4
    for d, power in ((2, -0.75), (3, -0.64), (4, -0.5), (5, -0.4)):
        changed.slope.loc[{"way": "lattice", "dimension": d}] = power
    changed["circle_slope"], changed["circle_slope_error"] = -0.751, 1e-4
    changed["circle_slope_degrees"] = 99.0
    found = fabricated.found("techniques_fig4", changed)
    names = ("powers", "higher", "only", "circle")
    words = [chapter.word(found, f"techniques_fig4_{name}") for name in names]
    assert words == ["reproduced", "reproduced", "reproduced", "corrected"]
    for d in DIMENSIONS:
        changed.slope.loc[{"way": "lattice", "dimension": d}] = -1.0 / d if d < 5 else -0.6
    changed["circle_slope"] = -1.001
    found = fabricated.found("techniques_fig4", changed)
    words = [chapter.word(found, f"techniques_fig4_{name}") for name in names]
    assert words == ["contradicted", "contradicted", "contradicted", "reproduced"]
