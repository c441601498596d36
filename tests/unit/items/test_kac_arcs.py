"""Figs. 6 to 8 of the Kac paper: recorded runs of corner points written down by hand."""

import math

import fabricated
import numpy as np
import pytest

from kacsim import items
from kacsim.items import _corners, kac_fig6
from kacsim.statistics import verdict

# Distances D after each step, and whether a step repeats the pair before it. With tolerance 0.1:
# run 1: other pair, falls; repeated, stays; below the tolerance from then on (not compared).
# run 2: repeated, grows; other pair, stays; other pair, falls.
DIAMETER = [[3.0, 2.0, 2.0, 0.05, 0.06], [3.0, 3.5, 3.5, 1.0, math.nan]]
SAME_PAIR = [[0, 0, 1, 0, 0], [0, 1, 0, 0, 0]]
INPUTS = {  # steps of the first run, in the order of time; sin(theta)**2 = 1/4 is 30 degrees
    "first": [0, 2, 0, 1, 0],
    "second": [1, 0, 2, 0, 1],
    "squared_sine": [0.25, 0.5, 0.3, 0.6, 0.2],
}


def corners(case, diameter=DIAMETER, same_pair=SAME_PAIR, inputs=INPUTS):
    """Return recorded runs; corner points stay where they start (only the figure shows them)."""
    n = case.parameters["n_particles"]
    path = np.tile(math.sqrt(1.5 * n) * np.eye(n), (len(inputs["first"]) + 1, 1, 1))
    return fabricated.variables(
        corner=(("time", "corner_index", "particle"), path),
        diameter=(("run", "after"), diameter),
        same_pair=(("run", "after"), np.array(same_pair, np.int8)),
        **{name: (("step",), values) for name, values in inputs.items()},
    )


def shown(name, make=corners, **changes):
    chosen = fabricated.settings(name, tolerance=0.1, n_draws=2, **changes)
    return fabricated.reduced(name, chosen, make)


# Fig. 6


def test_steps_are_counted_by_what_they_do():
    found = shown("kac_fig6", n_particles=4)
    counts = {
        "n_steps": 6,
        "n_growing": 1,
        "n_repeated": 2,
        "n_repeated_changed": 1,
        "n_other": 4,
        "n_other_kept": 1,
    }
    assert {name: int(found[name]) for name in counts} == counts


def test_rounding_is_no_change():
    slightly = [[3.0, 3.0 + 1e-12, 3.0 - 1e-12, 2.0, math.nan]]
    made = {"diameter": slightly, "same_pair": [[0, 1, 0, 0, 0]]}
    found = shown("kac_fig6", lambda case: corners(case, **made), n_particles=4)
    names = ("n_growing", "n_repeated_changed", "n_other_kept")
    assert [int(found[name]) for name in names] == [0, 0, 1]


def test_growing_steps_are_the_share_that_contradicts():
    claims = fabricated.found("kac_fig6", shown("kac_fig6", n_particles=4))
    share = claims["kac_52_monotone"].parts[0].measured
    assert (share.successes, share.n) == (1, 6)


def long_run(case):
    """Return a run of 60 steps of four particles, at the end of which the bounds are close."""
    random = np.random.default_rng(3)
    pairs = np.array([random.permutation(4)[:2] for _ in range(60)])
    inputs = {"first": pairs[:, 0], "second": pairs[:, 1], "squared_sine": random.random(60)}
    made = {"diameter": np.full((1, 60), 1.0), "same_pair": np.zeros((1, 60))}
    return corners(case, inputs=inputs, **made)


def test_paths_are_looked_for_outside_the_bounds_at_every_step(monkeypatch):
    """Energies of any start lie between the corners'; those of another walk do not."""
    found = shown("kac_fig6", long_run, n_particles=4)
    claims = fabricated.found("kac_fig6", found)
    assert int(found.n_bounded) == 61 * kac_fig6.N_STARTS * 4
    assert claims["kac_51_bounds"].parts[0].measured.value == 0.0
    walk = _corners.walk

    def other(shares, sample, n_steps):
        turned = sample.assign(squared_sine=1.0 - sample.squared_sine)
        return walk(shares, sample if len(shares) == 4 else turned, n_steps)

    monkeypatch.setattr(_corners, "walk", other)
    claims = fabricated.found("kac_fig6", shown("kac_fig6", long_run, n_particles=4))
    assert claims["kac_51_bounds"].parts[0].measured.value > 0.1


def test_disjoint_pairs_leave_four_corners_as_far_apart(monkeypatch):
    (part,) = fabricated.found("kac_fig6", shown("kac_fig6", n_particles=4))["kac_52_four"].parts
    assert (part.measured.value, part.printed) == (pytest.approx(1.0, abs=1e-15), 1.0)
    pairs = []
    rotate = _corners.rotate

    def noted(points, pair, angle):
        pairs.append(pair)
        return rotate(points, pair, angle)

    monkeypatch.setattr(_corners, "rotate", noted)
    kac_fig6._disjoint()
    assert pairs == [(1, 2), (3, 4)]


def test_three_particles_would_come_nearer():
    """Negative control: pairs (1, 2) and (3, 1) shrink D, so that the ratio tells."""
    once = _corners.rotate(np.eye(3), (1, 2), math.pi / 5.0)
    both = np.stack([once, _corners.rotate(once, (3, 1), math.pi / 5.0)])
    before, after = _corners.diameters(both)
    assert after / before < 0.99


# Figs. 7 and 8


def test_the_first_step_is_exact():
    claims = fabricated.found("kac_fig7", shown("kac_fig7"))
    values = {claim: one.parts[0].measured.value for claim, one in claims.items()}
    assert values == {"kac_fig7_arc": 0.0, "kac_52_identity": 0.0, "kac_52_range": 0.5}


def test_a_lattice_covers_the_octant():
    """Its points number 41 * 42 / 2, the corners among them."""
    found = shown("kac_fig7")
    assert int(found.n_lattice) == 861
    assert int(found.n_angles) == 40 * 160


MUTANT_STEPS = {
    "pair not moved": lambda points, pair, angle: points,
    "own split kept": lambda points, pair, angle: points[:, [1, 0, 2]],
    "angle from the other axis": lambda points, pair, angle: _rotate(points, pair[::-1], angle),
    "rotated, not set": lambda points, pair, angle: (
        points
        @ np.array(
            [
                [math.cos(angle), -math.sin(angle), 0.0],
                [math.sin(angle), math.cos(angle), 0.0],
                [0.0, 0.0, 1.0],
            ]
        )
    ),
}
_rotate = _corners.rotate


@pytest.mark.parametrize("name", MUTANT_STEPS)
def test_points_off_the_arc_are_seen(name, monkeypatch):
    monkeypatch.setattr(_corners, "rotate", MUTANT_STEPS[name])
    found = shown("kac_fig7")
    off = fabricated.found("kac_fig7", found)["kac_fig7_arc"].parts[0].measured.value
    assert off > 0.5


def test_the_second_arc_is_what_the_first_angle_leaves():
    """A quarter circle, and pi / 2 - theta after the next pair: 60 degrees here."""
    found = shown("kac_fig8", rounding=1e-9)
    assert found.angle.values[0] == pytest.approx(30.0)
    assert found.length.values == pytest.approx([math.pi / 2.0, math.pi / 3.0])


def test_arcs_and_chords_are_counted():
    claims = fabricated.found("kac_fig8", shown("kac_fig8", rounding=1e-9))
    same, other = (claims[f"kac_52_{name}"].parts[0].measured for name in ("same_pair", "shrinks"))
    assert (same.successes, same.n) == (1, 2)
    assert (other.successes, other.n) == (1, 4)
    for claim in ("kac_fig8_shorter", "kac_52_chord"):
        assert claims[claim].parts[0].measured.value == 0.0


def test_an_arc_that_only_moves_is_not_shorter(monkeypatch):
    """Mutant: the second step takes the pair of the first one again."""
    monkeypatch.setattr(
        _corners, "rotate", lambda points, pair, angle: _rotate(points, (1, 2), angle)
    )
    found = fabricated.found("kac_fig8", shown("kac_fig8", rounding=1e-9))
    assert found["kac_fig8_shorter"].parts[0].measured.value == 1.0


@pytest.mark.parametrize(
    ("claim", "item", "clean"),
    [
        ("kac_52_monotone", "kac_fig6", "n_growing"),
        ("kac_52_same_pair", "kac_fig8", "n_repeated_changed"),
        ("kac_52_shrinks", "kac_fig8", "n_other_kept"),
    ],
)
def test_one_step_contradicts_and_many_without_one_reproduce(claim, item, clean):
    found = shown(item)
    entry = items.published()[claim]
    word, _ = verdict.judge(fabricated.found(item, found)[claim], entry, 1e-4)
    assert word == verdict.CONTRADICTED
    for name in ("n_steps", "n_repeated", "n_other"):
        found[name] = 20_000
    found[clean] = 0
    word, _ = verdict.judge(fabricated.found(item, found)[claim], entry, 1e-4)
    assert word == verdict.REPRODUCED
