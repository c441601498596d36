"""Every Boltzmann kernel gives its twin's realizations, one by one (see boltzmann_twins.py).

No statistics, no false alarms. The bits differ, since a twin rounds elsewhere: values agree to
1e-10, node counts and the final state of the stream exactly.
"""

import functools
import math

import boltzmann_twins as twins
import numpy as np
import pytest

from kacsim.boltzmann import (
    bkw_tree,
    literal,
    literal_trap,
    model,
    null_collisions,
    trap,
    trap_node,
    trap_tree,
)
from kacsim.kac import probe_tree
from kacsim.streams import new_stream

BUDGET = 10**6
LAWS = {"bkw": (bkw_tree.estimate, twins.BKW), "kac": (probe_tree.estimate, twins.KAC)}
# (oversampling, onset, time)
GROWTH = [(1.0, 0.0, 1.3), (1.4, 0.0, 1.1), (1.4, 0.5, 1.3), (2.0, 0.3, 1.1), (2.7, 5.0, 1.3)]
PHYSICS = {"bkw": (4.9, 0.3, 0.4, 1.0), "breathing": (4.9, 0.3, 0.4, 0.0)}
CHOICES = [(trap.MAJORANT, 1.0, 0.0), (2.3, 1.3, 0.7), (0.9, 1.1, 0.2)]


def assert_same(kernel, arguments, twin, n, key):
    """Compare n realizations of a kernel with those of a twin; return the largest tree."""
    streams = new_stream(*key), new_stream(*key)
    values, nodes = np.full(n, np.nan), np.zeros(n, np.int64)
    assert kernel(values, nodes, *arguments, streams[0])
    wanted, calls = zip(*(twin(streams[1]) for _ in range(n)), strict=True)
    np.testing.assert_array_equal(nodes, calls)
    np.testing.assert_allclose(values, wanted, rtol=1e-10, atol=1e-13)
    np.testing.assert_array_equal(*streams)
    return nodes.max()


@pytest.mark.parametrize(("oversampling", "onset", "time"), GROWTH)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("speed", [0.0, 0.7, 3.1])
def test_tree(law, speed, oversampling, onset, time, seed):
    kernel, twin_law = LAWS[law]
    probe = speed, time, oversampling, onset
    twin = functools.partial(twins.probe, twin_law, *probe)
    assert assert_same(kernel, (*probe, BUDGET), twin, 150, (seed, f"twin {law}")) > 10


@pytest.mark.parametrize(("oversampling", "onset", "time"), GROWTH)
@pytest.mark.parametrize("threshold", [0.0, 1.9, 2.1, 6.0])
def test_fraction(threshold, oversampling, onset, time, seed):
    probe = threshold, time, oversampling, onset
    twin = functools.partial(twins.fraction, *probe)
    assert_same(bkw_tree.estimate_fraction, (*probe, BUDGET), twin, 100, (seed, "twin fraction"))


@pytest.mark.parametrize(("oversampling", "onset", "time"), GROWTH)
def test_moment(oversampling, onset, time, seed):
    probe = oversampling, time, onset
    twin = functools.partial(twins.moment, *probe)
    assert_same(bkw_tree.estimate_moment, (*probe, BUDGET), twin, 150, (seed, "twin moment"))


@pytest.mark.parametrize("ratio", [0.8, 1.0, 2.5])
@pytest.mark.parametrize("time", [0.0, 0.7, 1.6])
def test_extinction(time, ratio, seed):
    twin = functools.partial(twins.extinction, time, ratio)
    longest = assert_same(
        null_collisions.estimate, (time, ratio, BUDGET), twin, 400, (seed, "twin extinction")
    )
    assert longest > 1 or time == 0.0


@pytest.mark.parametrize("choices", CHOICES, ids=str)
@pytest.mark.parametrize("initial", PHYSICS)
@pytest.mark.parametrize("node", [(0.0, 0.4, 0.9), (0.0, 0.0, 0.0), (0.8, -0.5, 1.1)], ids=str)
def test_trap(node, initial, choices, seed):
    physics = PHYSICS[initial]
    twin = functools.partial(twins.trap_probe, *node, 1.9, physics, choices)
    arguments = (*node, 1.9, physics, choices, BUDGET)
    assert assert_same(trap_tree.estimate, arguments, twin, 60, (seed, "twin trap")) > 10


def test_a_node_at_the_centre_moves_outward():
    """No statistics; a trajectory through the centre, and one beside it."""
    assert trap_node.node_at(0.0, 0.0, 0.3, 0.4, 1.0, 0.0) == (0.0, 0.5, 0.0)
    beside = trap_node.node_at(1e-3, 0.0, 0.3, 0.4, 1.0, 0.0)
    assert beside == pytest.approx((1e-3, 0.3, 0.4))


@pytest.mark.parametrize("energy", [False, True])
@pytest.mark.parametrize("threshold", [0.0, 1.1, 2.6])
def test_trap_beyond(threshold, energy, seed):
    kernel = trap_tree.estimate_energy if energy else trap_tree.estimate_fraction
    probe = threshold, 1.9, PHYSICS["bkw"], CHOICES[1]
    twin = functools.partial(twins.trap_beyond, *probe, energy=energy)
    assert_same(kernel, (*probe, BUDGET), twin, 80, (seed, "twin beyond"))


@pytest.mark.parametrize("equilibrium", [False, True])
def test_literal(equilibrium, seed):
    """The plain recursion of the package against the same in Python: f / M at c = (1.7, 0, 0)."""
    m = math.exp(-0.5 * 1.7**2) / math.sqrt(2.0 * math.pi) ** 3

    def twin(stream):
        f, nodes = twins.literal(np.array([1.7, 0.0, 0.0]), 1.3, equilibrium, stream)
        return f / m, nodes

    key = (seed, "twin literal")
    assert assert_same(literal.estimate, (1.7, 1.3, equilibrium), twin, 200, key) > 10


def test_literal_is_exact_at_equilibrium(seed):
    """Every realization of f / M is 1, trees of many branches included; from eq. (18) none is."""
    values, nodes = np.empty(500), np.empty(500, np.int64)
    literal.estimate(values, nodes, 1.7, 1.5, True, new_stream(seed, "null variance"))
    assert nodes.max() > 20
    np.testing.assert_allclose(values, 1.0, rtol=1e-11)
    literal.estimate(values, nodes, 1.7, 1.5, False, new_stream(seed, "null variance"))
    assert abs(values - 1.0).max() > 0.1


def test_literal_trap_is_exact_in_the_breathing_state(seed):
    """Every realization of f / (31) is 1, collisions included; from eq. (18) none is."""
    values, nodes = np.empty(300), np.empty(300, np.int64)
    probe = 0.8, 0.5, 1.9, 4.9, 0.3
    literal_trap.estimate(values, nodes, *probe, True, new_stream(seed, "null variance"))
    assert nodes.max() > 10
    np.testing.assert_allclose(values, 1.0, rtol=1e-10)
    literal_trap.estimate(values, nodes, *probe, False, new_stream(seed, "null variance"))
    assert abs(values - 1.0).max() > 0.1


def test_realizations_do_not_depend_on_the_batch(seed):
    (together, single), nodes = np.empty((2, 20)), np.empty(20, np.int64)
    streams = new_stream(seed, "batch"), new_stream(seed, "batch")
    arguments = (0.8, -0.5, 1.1, 1.9, PHYSICS["bkw"], CHOICES[0], BUDGET)
    trap_tree.estimate(together, nodes, *arguments, streams[0])
    for k in range(20):
        trap_tree.estimate(single[k : k + 1], nodes[k : k + 1], *arguments, streams[1])
    np.testing.assert_array_equal(together, single)


def test_another_twin_is_told_apart(seed):
    """Negative controls of the comparison: another onset, another law of c*, another start."""
    key = (seed, "other")
    twin = functools.partial(twins.probe, twins.BKW, 0.7, 1.3, 1.4, 0.4)
    with pytest.raises(AssertionError):
        assert_same(bkw_tree.estimate, (0.7, 1.3, 1.4, 0.5, BUDGET), twin, 150, key)
    arguments = (0.8, -0.5, 1.1, 1.9, PHYSICS["bkw"])
    for other in (CHOICES[1], (trap.MAJORANT, 1.0, 1e-6), (trap.MAJORANT, 1.0 + 1e-6, 0.0)):
        twin = functools.partial(twins.trap_probe, *arguments, other)
        with pytest.raises(AssertionError):
            assert_same(trap_tree.estimate, (*arguments, CHOICES[0], BUDGET), twin, 60, key)


def test_recorded_tree(seed):
    """Collisions keep momentum and energy: c* = c' + c'* - c must satisfy both; branches join."""
    n_collisions = 0
    for k in range(20):
        rows = literal.record(1.7, 2.5, 4000, new_stream(seed, "record", k))
        parents = rows[:, 8].astype(int)
        for parent in np.flatnonzero(rows[:, 1] > 0.0):
            n_collisions += 1
            children = np.flatnonzero(parents == parent)
            c, (a, b) = rows[parent, 2:5], rows[children, 2:5]
            other = a + b - c
            assert a @ a + b @ b == pytest.approx(c @ c + other @ other, rel=1e-12)
            np.testing.assert_array_equal(rows[children, 0], rows[parent, 1])
            end = rows[parent, 5:8] - (rows[parent, 0] - rows[parent, 1]) * c
            np.testing.assert_allclose(rows[children, 5:8], [end, end], atol=1e-12)
        assert not np.isin(np.flatnonzero(rows[:, 1] <= 0.0), parents).any()
        budget = max(1, rows.shape[0] - 1)
        again = literal.record(1.7, 2.5, budget, new_stream(seed, "record", k))
        assert again.shape[0] == (1 if rows.shape[0] == 1 else 0)
    assert n_collisions > 50


def test_copies_stay_whole_numbers(seed):
    """More sub-estimates than any budget: a whole number all the same."""
    for oversampling, wanted in ((1.0, 1), (3.0, 3), (1e15, 10**15), (1e50, 2**53 + 1)):
        assert model.copies(oversampling, new_stream(seed, "copies")) == wanted
