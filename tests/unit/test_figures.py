"""What the figures show beyond their numbers, on samples made by hand with known answers."""

import itertools
import math

import numpy as np
import pytest
import xarray as xr

from kacsim.drawing import plotting
from kacsim.items import _corners, boltzmann_fig2, boltzmann_fig8, kac_fig6, kac_fig7, kac_fig8
from kacsim.items.kac_fig9 import _excess
from kacsim.statistics import histogram


def recorded(steps, n_particles=3):
    """Return what the sampler of corner points keeps, for steps (p, q, sin(theta)**2)."""
    first, second, part = zip(*steps, strict=True)
    pairs = [{p, q} for p, q, _ in steps]
    same = [False, *(here == before for before, here in itertools.pairwise(pairs))]
    energy = 1.5 * n_particles
    return xr.Dataset(
        {
            "first": ("step", list(first)),
            "second": ("step", list(second)),
            "squared_sine": ("step", list(part)),
            "same_pair": (("run", "after"), [same]),
            "diameter": (("run", "after"), np.ones((1, len(steps)))),
            "corner": (
                ("time", "corner_index", "particle"),
                [math.sqrt(energy) * np.eye(n_particles)],
            ),
        }
    )


# Figs. 6 to 8 of the Kac paper


def test_points_walk_as_printed():
    """By hand: (1, 2) with sin**2 = 1/4, then (3, 1) with sin**2 = 1/2, from the three corners."""
    sample = recorded([(0, 2, 0.9), (0, 1, 0.25), (2, 0, 0.5)])
    path = _corners.walk(np.eye(3), sample, 2)
    assert path.shape == (3, 3, 3)
    assert path[1].tolist() == [[0.25, 0.75, 0], [0.25, 0.75, 0], [0, 0, 1]]
    assert path[2].tolist() == [[0.125, 0.75, 0.125], [0.125, 0.75, 0.125], [0.5, 0, 0.5]]


def test_the_largest_distance_is_over_all_pairs_of_points():
    points = np.array([[[0.0, 0, 0], [3, 4, 0], [1, 0, 0]], [[1.0, 1, 1]] * 3])
    assert _corners.diameters(points).tolist() == [5.0, 0.0]


@pytest.mark.parametrize("first", [(2, 0), (0, 2)])
@pytest.mark.parametrize("second", [(0, 1), (1, 0)])
def test_exchanged_labels_are_the_same_two_steps(first, second):
    """The run's own step on points whose labels are exchanged: particle 0 is shared, so it is 1."""
    sample = recorded([(0, 2, 0.6), (*first, 0.3), (*second, 0.8), (1, 2, 0.5)])
    angles, pairs = _corners.two_steps(sample)
    assert pairs.tolist() == [[k + 1 for k in first], [k + 1 for k in second]]
    points = np.array([[0.2, 0.5, 0.3], [0.7, 0.1, 0.2]])
    by_run = _corners.walk(points, sample.isel(step=[1, 2]), 2)
    names = [0, 2, 1]  # printed particles 1, 2, 3 are these of the run
    printed = np.sqrt(points[:, names])
    for angle, pair, there in zip(angles, ((1, 2), (3, 1)), by_run[1:], strict=True):
        printed = _corners.rotate(printed, pair, angle)
        np.testing.assert_allclose(printed**2, there[:, names], atol=1e-15)


@pytest.mark.parametrize("angle", [0.01, 0.4, 1.2, 1.57])
def test_points_of_fig_7_stand_apart_from_their_images(angle):
    before = _corners.four_points(2.0, angle)
    after = _corners.rotate(before, (1, 2), angle)
    assert (before >= 0.0).all()
    np.testing.assert_allclose(np.linalg.norm(after, axis=1), 2.0)
    np.testing.assert_allclose(after[:, 0], np.tan(angle) * after[:, 1])  # all on one arc
    turned = np.arctan2(before[:, 0], before[:, 1]) - angle
    assert np.degrees(np.abs(turned)).min() > 17.9
    gaps = np.abs(after[:, None, 2] - after[None, :, 2])[~np.eye(4, dtype=bool)]
    assert gaps.min() > 0.2


def test_the_second_arc_is_90_degrees_less_the_first_angle():
    """By hand: the images (0, 0, 1) and (sin t, cos t, 0) go to points of scalar product sin t."""
    settings = {"n_particles": 3, "tolerance": 1e-6, "n_draws": 1, "seed": 1, "rounding": 1e-9}
    angle = math.radians(25.0)
    sample = recorded([(0, 1, math.sin(angle) ** 2), (2, 0, 0.37)])
    samples = {_corners.case(settings).id: sample}
    found = kac_fig8.reduce(samples, settings)
    np.testing.assert_allclose(np.degrees(found.length), [90.0, 65.0])
    np.testing.assert_allclose(np.degrees(np.arcsin(np.sqrt(0.37))), found.angle[1])
    seventh = kac_fig7.reduce(samples, settings)
    assert float(seventh.angle) == pytest.approx(25.0)
    np.testing.assert_array_equal(found.point[0], seventh.after)
    assert seventh.pair.values.tolist() == [1, 2]


def test_bounds_and_sample_paths_meet_where_they_do():
    """With sin**2 = 1 a step moves all of q to p: two steps couple all points, from -4 on, at -2.

    From -1 and -2 the corner 3 stays alone, so that T is 4.
    """
    steps = [(0, 1, 1.0)] * 3 + [(0, 1, 1.0), (0, 2, 1.0), (1, 0, 1.0), (1, 0, 1.0)]
    settings = {"n_particles": 3, "drawn_tolerance": 0.01}
    found = xr.Dataset(kac_fig6._sandwich(recorded(steps), settings))
    marks = [int(found[name]) for name in ("n_back", "n_met", "n_coupled")]
    assert marks == [4, 2, 2]
    root = math.sqrt(4.5)
    np.testing.assert_allclose(found["drawn_upper"], [root, root, root, 0, 0])
    np.testing.assert_allclose(found["drawn_lower"], [0, 0, root, 0, 0], atol=1e-12)
    at_start = math.sqrt(4.5 * (0.5 + 0.5 / 3))
    assert found["sample_path"].values[0].max() == pytest.approx(at_start)


def test_sample_paths_meet_before_the_bounds():
    """N = 2: one step couples; at a coarse tolerance the paths count as met where they start."""
    sample = recorded([(0, 1, 0.5), (0, 1, 0.5)], n_particles=2)
    apart = 2.0 * math.sqrt(3.0) * math.sin(0.5 * (math.acos(0.5) - math.asin(0.5)))
    settings = {"n_particles": 2, "drawn_tolerance": apart + 0.001}
    found = xr.Dataset(kac_fig6._sandwich(sample, settings))
    marks = [int(found[name]) for name in ("n_back", "n_met", "n_coupled")]
    assert marks == [1, 1, 0]


def test_a_tolerance_that_the_run_need_not_reach_is_refused():
    good = {"tolerance": 1e-6, "drawn_tolerance": 1e-6}
    assert list(kac_fig6.problems(good)) == []
    assert [key for key, _ in kac_fig6.problems(good | {"drawn_tolerance": 1e-7})] == [
        "drawn_tolerance"
    ]


# Fig. 9 of the Kac paper


def test_three_particles_are_uniform_beside_the_limit_law():
    """Archimedes: on a sphere v_1 is uniform, here on +-sqrt(9/2). All draws between 0 and 1/2."""
    counts = np.zeros((2, histogram.FINE_BINS + 2), int)
    counts[:, 161:171] = 40  # ten fine bins
    sample = xr.Dataset({"counts": (("replicate", "bin"), counts)})
    settings = {"n_particles": 3, "bin_width": 0.1, "other_bin_widths": [0.5, 0.2]}
    variables, edges = _excess(sample, settings)
    found = xr.Dataset(variables)
    assert np.diff(edges) == pytest.approx(0.5)
    half = math.erf(0.5 / math.sqrt(3.0)) / 2.0 / 0.5  # mean of eq. (9) over the bin
    level = 1.0 / (2.0 * math.sqrt(4.5))
    middle = list(edges).index(0.0)
    assert float(found["excess"][middle]) == pytest.approx(2.0 - half)
    assert float(found["finite_excess"][middle]) == pytest.approx(level - half)
    share = 0.5 * level
    error = math.sqrt(share * (1.0 - share) / 800) / 0.5
    assert float(found["excess_error"][middle]) == pytest.approx(error)


# Figs. 2 and 8 of the Boltzmann paper


def test_branches_carry_the_sequence_of_their_turns():
    """A tree drawn by hand: 0 splits into 1 and 2, 1 into 11 and 12, 12 into 121 and 122."""
    parent = np.array([-1, 0, 1, 1, 3, 3, 0])
    assert boltzmann_fig2.sequences(parent) == ["0", "1", "11", "12", "121", "122", "2"]
    assert boltzmann_fig2.sequences(np.array([-1])) == ["0"]


def tree(stop, levels):
    """Return a recorded tree of one collision at t = stop, its two children at these velocities."""
    velocity = np.array([[1.0, 0.0, 0.0], [1.0, levels[0], 0.0], [1.0, levels[1], 0.0]])
    start, end = np.array([3.0, stop, stop]), np.array([stop, -1.0, -1.0])
    lives = (start - np.maximum(end, 0.0))[:, None]
    begin = np.array([[0.0, 0.0, 0.0], *[-(3.0 - stop) * velocity[0]] * 2])
    branch = {
        "start": start,
        "stop": end,
        "parent": np.array([-1, 0, 0]),
        "velocity": velocity,
        "begin": begin,
        "end": begin - lives * velocity,
    }
    dims = {1: ("branch",), 2: ("branch", "axis")}
    return xr.Dataset({name: (dims[part.ndim], part) for name, part in branch.items()})


def test_of_trees_of_one_size_the_most_readable_is_shown():
    crowded, clear = tree(2.9, (0.5, 0.49)), tree(1.5, (1.0, -1.0))
    assert boltzmann_fig2.clearance(clear) > 1.0 > boltzmann_fig2.clearance(crowded)
    settings = {"speed": 1.0, "time": 3.0, "n_draws": 3, "n_nodes": 3, "seed": 1}
    small = clear.isel(branch=[0])
    sample = xr.concat([crowded, clear, small], "branch")
    sample["tree"] = ("branch", [0] * 3 + [1] * 3 + [2])
    found = boltzmann_fig2.reduce({boltzmann_fig2._case(settings).id: sample}, settings)
    np.testing.assert_array_equal(found.velocity, clear.velocity)
    assert [int(found["size"]), int(found.n_wanted)] == [3, 2]
    assert found.sequence.values.tolist() == ["0", "1", "2"]
    none = boltzmann_fig2.reduce(
        {boltzmann_fig2._case(settings).id: sample}, settings | {"n_nodes": 9}
    )
    assert int(none["size"]) == 3


def test_levels_are_named_where_the_cloud_is_smallest():
    """There eq. (31a) is s**(-3/2) exp(-r**2 / 2 s), s = 1 - eps, at 3/8 of the turn."""
    settings = {"breathing": 9 / 41, "start_phase": 0.0, "largest_radius": 5.8}
    places = boltzmann_fig8._label_places(boltzmann_fig8.reduce({}, settings))
    small = 1.0 - settings["breathing"]
    assert len(places) == len(boltzmann_fig8.LEVELS)
    for (turn, radius), level in zip(places, boltzmann_fig8.LEVELS, strict=True):
        assert turn == pytest.approx(0.375, abs=0.003)
        exact = math.sqrt(-2.0 * small * math.log(level * small**1.5))
        assert radius == pytest.approx(exact, abs=0.01)


@pytest.mark.parametrize("count", [1, 7, 9, 15])
def test_branches_have_colours_of_their_own(count):
    assert len({tuple(np.atleast_1d(colour)) for colour in plotting.distinct(count)}) == count
