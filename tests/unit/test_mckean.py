"""McKean's trees: every kernel gives its twin's realizations, one by one, and the exact law.

No statistics, no false alarms. A twin integrates along a finer contour, or by quadrature: values
agree to 1e-7, numbers of ends and the final state of the stream exactly.
"""

import math

import mckean_twins as twins
import numpy as np
import pytest

from kacsim.boltzmann import bkw, mckean_tree
from kacsim.kac import exact
from kacsim.mckean import constants, contour, probing, work
from kacsim.streams import new_stream

BUDGET = 10**6
LAWS = {constants.BKW: twins.BKW, constants.KAC: twins.KAC}
QUANTITIES = {
    "density": contour.DENSITY,
    "tail": contour.TAIL,
    "beyond": contour.BEYOND,
    "shell": contour.SHELL,
}
TWINS = {"ancestral": twins.ancestral, "free_leaf": twins.free_leaf, "geometric": twins.geometric}


def draw(n, stream, quantity, v, time, law, *, method="ancestral", cut=0.0, **more):
    values, nodes = np.full(n, np.nan), np.zeros(n, np.int64)
    tree = {"method": method, "cut": cut, "max_nodes": BUDGET}
    bound = probing.bound(QUANTITIES[quantity], v, time, law, **tree, **more)
    assert bound(values, nodes, stream)
    return values, nodes


@pytest.mark.parametrize("method", TWINS)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(("v", "time"), [(0.7, 1.7), (3.1, 0.4), (5.3, 2.2)])
@pytest.mark.parametrize("quantity", QUANTITIES)
def test_realizations(quantity, v, time, law, method, seed):
    n = 40 if method == "ancestral" else 20
    streams = [new_stream(seed, f"twin {quantity} {law} {method}") for _ in range(2)]
    values, nodes = draw(n, streams[0], quantity, v, time, law, method=method)
    twin = TWINS[method]
    wanted, ends = zip(
        *(twin(LAWS[law], quantity, v, time, 0.0, streams[1]) for _ in range(n)), strict=True
    )
    np.testing.assert_array_equal(nodes, ends)
    np.testing.assert_allclose(values, wanted, rtol=1e-7)
    np.testing.assert_array_equal(*streams)
    assert nodes.max() > 2


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(("v", "time", "cut"), [(0.3, 1.7, 0.5), (3.1, 4.0, 0.2), (6.0, 3.0, 5.0)])
def test_subtrees_that_are_cut(law, v, time, cut, seed):
    streams = [new_stream(seed, f"cut {law}") for _ in range(2)]
    values, nodes = draw(40, streams[0], "tail", v, time, law, cut=cut)
    pairs = [twins.ancestral(LAWS[law], "tail", v, time, cut, streams[1]) for _ in range(40)]
    np.testing.assert_allclose(values, [value for value, _ in pairs], rtol=1e-7)
    np.testing.assert_array_equal(nodes, [ends for _, ends in pairs])
    np.testing.assert_array_equal(*streams)


@pytest.mark.parametrize("law", LAWS)
def test_sums_of_powers_stand_for_small_shares(law, seed):
    """A tree of a thousand leaves, most of them in the sums."""
    streams = [new_stream(seed, f"large {law}") for _ in range(2)]
    values, nodes = draw(3, streams[0], "density", 2.6, 7.0, law)
    pairs = [twins.ancestral(LAWS[law], "density", 2.6, 7.0, 0.0, streams[1]) for _ in range(3)]
    np.testing.assert_allclose(values, [value for value, _ in pairs], rtol=1e-9)
    assert nodes.max() > 300


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("time", [0.0, 0.3, 20.0])
@pytest.mark.parametrize("v", [0.0, 0.004, 0.6, 2.0, 6.0, 9.5])
@pytest.mark.parametrize("quantity", ["density", "tail", "beyond"])
def test_a_root_that_is_cut_gives_the_exact_law(quantity, v, time, law, seed):
    """One end of share 1: the closed form, to the error of the contour."""
    values, nodes = draw(2, new_stream(seed), quantity, v, time, law, cut=1e9)
    np.testing.assert_allclose(
        values, twins.exact(LAWS[law], quantity, v, time), rtol=1e-8, atol=1e-13
    )
    assert list(nodes) == [1, 1]


@pytest.mark.parametrize("time", [0.3, 7.0])
@pytest.mark.parametrize("speed", [0.0, 0.0099, 0.0101, 0.6, 4.0, 10.0, 30.0])
def test_closed_forms_of_the_bkw_mode(speed, time, seed):
    """The speeds about 0.01 are on both sides of the series of sinh(z v) / v."""
    tree = {"method": "ancestral", "cut": 1e9, "max_nodes": 10}
    values, nodes = np.empty(1), np.empty(1, np.int64)
    assert mckean_tree.bkw_ancestral(speed, time, **tree)(values, nodes, new_stream(seed))
    assert values[0] == pytest.approx(bkw.relative_density(speed, time), rel=1e-8)
    if speed <= 10.0:
        bound = mckean_tree.bkw_fraction_ancestral(speed, time, **tree)
        assert bound(values, nodes, new_stream(seed))
        assert values[0] == pytest.approx(bkw.fraction(speed, time), rel=1e-8)


@pytest.mark.parametrize("time", [0.3, 7.0])
@pytest.mark.parametrize("v", [0.0, 0.5, 4.0, 12.0])
def test_closed_forms_of_kac(v, time, seed):
    span = exact.RATE * time
    for quantity, law in (("density", exact.density), ("tail", exact.survival)):
        value = draw(1, new_stream(seed), quantity, v, span, constants.KAC, cut=1e9)[0][0]
        assert value == pytest.approx(law(v, time), rel=1e-8)


def test_the_start_is_exact_without_a_draw(seed):
    values, nodes = draw(5, new_stream(seed), "tail", 1.3, 0.0, constants.KAC)
    np.testing.assert_allclose(values, exact.survival(1.3, 0.0), rtol=1e-8)
    assert set(nodes) == {1}


def test_a_tree_past_its_budget_is_told(seed):
    values, nodes = np.zeros(50), np.zeros(50, np.int64)
    for method in TWINS:
        tree = {"method": method, "cut": 0.0, "max_nodes": 30}
        bound = probing.bound(contour.TAIL, 2.0, 4.0, constants.BKW, **tree)
        assert not bound(values, nodes, new_stream(seed))
        assert -1 in nodes


@pytest.mark.parametrize("law", LAWS)
def test_the_exact_mean_number_of_leaves(law):
    """E n under the tilt, from d/ds of the generating function: numbers by its own equation."""
    v, time = 4.2, 1.9
    eta, b = work.tilt(v, time, law)
    assert eta == pytest.approx(twins.saddle(LAWS[law], v, time), abs=1e-7)
    # A node of share rho splits at 1 + kappa x**2 / (1 + x); integrate the mean over shares of x.
    x = b * math.exp(-LAWS[law].moment * time)
    mean = 1.0 + math.expm1(time) * (1.0 + LAWS[law].moment * x * x / (1.0 + x))
    assert work.mean_leaves(v, time, law) == pytest.approx(mean, rel=1e-6)
    assert work.mean_ends(v, 6.0, law, 0.5) < 0.1 * work.mean_leaves(v, 6.0, law)
