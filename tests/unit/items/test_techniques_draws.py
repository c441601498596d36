"""Figs. 11.1 and 11.2 of the chapter, its exercises 1, and the initial law: samples made by hand.

No z tests: every expected number is a closed form, or was put into the samples.
"""

import math

import fabricated
import fabricated_chapter as chapter
import numpy as np
import pytest

N = 4  # replicates


def drawn_by_tables():
    """Return the dataset: of 4000 draws 40 at N_t = 4, and 10 at 8, are not in the last cell."""
    chosen = fabricated.settings("techniques_fig1", n_table=[4, 8], n_draws=4000, n_replicates=N)

    def make(case):
        counts = np.full((2, N, chapter.CELLS), 100)
        counts[0, :, 0], counts[0, :, -1] = 140, 60
        counts[1, :, 0], counts[1, :, -1] = 110, 90
        last = np.array([[0.2, 0.3, 0.25, 0.25], [0.1, 0.1, 0.1, 0.1]])
        return chapter.tables(case, counts=counts, last=last)

    return fabricated.reduced("techniques_fig1", chosen, make)


def ramp_error(n_table):
    """Return the largest error of the ramp's table: the first chord, P'' = 2/3."""
    return (math.sqrt(1.0 + 3.0 / n_table) - 1.0) ** 2 / 12.0


def test_fig1_distances_and_errors_of_tables():
    found = drawn_by_tables()
    for n, gap in ((4, 0.01), (8, 0.0025)):
        here = found.sel(law="ramp", n_table=n)
        assert float(here.exact) == pytest.approx(ramp_error(n), rel=1e-6)
        assert float(here.distance) == pytest.approx(gap)
        assert float(here.deviation) == pytest.approx(gap)
        # the chord's largest error lies in its middle, at P = (2 + v) v / 3: 5 and 2 of 40 cells
        node = math.sqrt(1.0 + 3.0 / n) - 1.0
        middle = (2.0 + node / 2.0) * node / 6.0
        edge = round(middle * chapter.CELLS) / chapter.CELLS
        chord = (math.sqrt(1.0 + 3.0 * edge) - 1.0) / node / n - edge
        assert float(here.deviation_exact) == pytest.approx(chord)
        share = edge + gap
        error = math.sqrt(share * (1.0 - share) / 16_000)
        assert float(here.deviation_error) == pytest.approx(error, rel=2e-3)
    assert found.power.values == pytest.approx([-2.0] * 3)
    # of log 2 between the two, from both relative errors
    here = found.sel(law="ramp")
    relative = here.deviation_error.values / [0.01, 0.0025]
    assert float(here.power_error) == pytest.approx(math.hypot(*relative) / math.log(2.0))
    assert float(found["last"]) == pytest.approx(0.25)
    assert float(found.floor) == pytest.approx(0.8275735 / math.sqrt(16_000), rel=1e-6)


def test_fig1_claims():
    """N_t = 4: a quarter of u. The ramp's halvings: log2 of 4/3 over 0.0024826 is 9.07."""
    found = fabricated.found("techniques_fig1", drawn_by_tables())
    assert chapter.values(found, "techniques_fig1_values") == [("", 0.25, 0.0, None)]
    assert chapter.word(found, "techniques_fig1_values") == "contradicted"
    spared = dict(one[:2] for one in chapter.values(found, "techniques_fig1_quick"))
    assert spared["ramp"] == 10 == math.ceil(math.log2(4.0 / 3.0 / ramp_error(8)))
    assert set(spared) == {"kac_initial", "exponential", "ramp"}
    assert chapter.word(found, "techniques_fig1_quick") == "reproduced"


# uniforms and trials per value of the three rejections, with the errors of their means
COSTS = {
    ("kac_initial", "constant"): (9.0, 0.03, 4.5, 0.015),
    ("kac_initial", "closer"): (2.7, 0.006, 1.35, 0.003),
    ("triangle", "constant"): (4.02, 0.002, 2.01, 0.001),
}


def rejected():
    chosen = fabricated.settings("techniques_fig2", n_table=[4], n_draws=4000, n_replicates=N)

    def make(case):
        if case.name == "inverse_transform":
            return chapter.tables(case, uniforms=1.2)
        uniforms, error, trials, spread = COSTS[case.parameters["law"], case.parameters["envelope"]]
        return chapter.law(
            case,
            uniforms=fabricated.about(uniforms, error, N),
            trials=fabricated.about(trials, spread, N),
        )

    return fabricated.reduced("techniques_fig2", chosen, make)


def test_fig2_costs_and_their_errors():
    found = rejected()
    for k, (uniforms, error, trials, spread) in enumerate(COSTS.values()):
        here = found.isel(way=k)
        assert float(here.uniforms) == pytest.approx(uniforms)
        assert float(here.uniforms_error) == pytest.approx(error)
        assert float(here.trials) == pytest.approx(trials)
        assert float(here.trials_error) == pytest.approx(spread)
    assert float(found.table_uniforms) == pytest.approx(1.2)
    # the constant's area is ten times the top of f0 on [-5, 5]; 2v under 2 is half the area
    assert found.predicted.values[[0, 2]] == pytest.approx(
        [40.0 / math.sqrt(math.pi) / math.e, 4.0]
    )


def test_fig2_claims():
    found = fabricated.found("techniques_fig2", rejected())
    assert chapter.values(found, "techniques_fig2_half") == [
        ("choices", pytest.approx(2.01), pytest.approx(0.001), N - 1),
        ("random numbers", pytest.approx(4.02), pytest.approx(0.002), N - 1),
    ]
    assert [one[0] for one in chapter.sets(found, "techniques_fig2_half")] == [2.0, 4.0]
    # 1 - 2.7 / 9, its error from 0.006 / 2.7 and 0.03 / 9
    error = 0.3 * math.hypot(0.006 / 2.7, 0.03 / 9.0)
    ((_, saved, spread, degrees),) = chapter.values(found, "techniques_fig2_closer")
    assert (saved, spread, degrees) == (pytest.approx(0.7), pytest.approx(error), N - 1)
    # 2.7 / 1.2 - 1; four functions of each of 1.35 trials
    assert chapter.values(found, "techniques_fig2_table") == [
        ("random numbers", pytest.approx(1.25), pytest.approx(0.005), N - 1),
        ("elementary functions", pytest.approx(5.4), pytest.approx(0.012), N - 1),
    ]
    assert chapter.word(found, "techniques_fig2_closer") == "reproduced"
    assert chapter.word(found, "techniques_fig2_table") == "reproduced"


def test_fig2_turns_round_where_rejection_is_cheaper(monkeypatch):
    """A closer envelope that is dearer, and cheaper than a table in one kind of work."""
    monkeypatch.setitem(COSTS, ("kac_initial", "closer"), (9.9, 0.006, 4.95, 0.003))
    found = fabricated.found("techniques_fig2", rejected())
    assert chapter.word(found, "techniques_fig2_closer") == "contradicted"
    monkeypatch.setitem(COSTS, ("kac_initial", "closer"), (1.1, 0.0006, 0.55, 0.0003))
    found = fabricated.found("techniques_fig2", rejected())
    assert chapter.word(found, "techniques_fig2_table") == "contradicted"


def test_initial_law_by_table_rejection_and_identity():
    chosen = fabricated.settings("kac_initial", n_table=[4, 8], n_draws=4000, n_replicates=N)
    known = {"constant": (8.3, 1.48), "closer": (2.5, 1.51), "identity": (3.1, 1.52)}

    def make(case):
        if case.name == "inverse_transform":
            return chapter.tables(case, uniforms=[[1.0], [1.5]], square=[[1.3], [1.45]])
        uniforms, square = known[case.parameters.get("envelope", "identity")]
        counts = np.full((N, chapter.CELLS), 100)
        if case.parameters.get("envelope") == "closer":
            counts[:, 0], counts[:, 1] = [70, 80, 80, 90], [130, 120, 120, 110]
        square = fabricated.about(square, 0.01, N)
        return chapter.law(case, square=square, uniforms=uniforms, counts=counts)

    found = fabricated.reduced("kac_initial", chosen, make)
    assert found.square.values == pytest.approx([1.48, 1.51, 1.52])
    assert found.square_error.values == pytest.approx([0.01] * 3)
    assert found.uniforms.values == pytest.approx([8.3, 2.5, 3.1])
    assert found.distance.values == pytest.approx([0.0, 0.005, 0.0])
    assert found.table_uniforms.values == pytest.approx([1.0, 1.5])
    assert found.table_square.values == pytest.approx([1.3, 1.45])
