"""Estimates by McKean's trees against exact laws, where branching has no variance and beyond.

Their variance is finite at every time and their realizations are nowhere large, so that the means
of some ten thousand are normal; with a geometric number of leaves they are looked at nearer.
"""

import math

import numpy as np
import pytest
from law import compare
from law.compare import caught, ok, scaled
from law.realizations import Q, z_of

from kacsim import boltzmann, kac
from kacsim.boltzmann import bkw
from kacsim.mckean import constants, contour, probing, work
from kacsim.streams import new_stream

N = 100_000
METHODS = {"ancestral": (0.4, 7.0, 13.0), "free_leaf": (1.1, 7.0), "geometric": (1.1, 4.0)}
# Negative controls: what the same draws make of a time 3 % later (at the last speed, where the law
# still changes), in standard errors many.
LATER = 1.03


@pytest.mark.parametrize("time", [0.7, 3.1])
@pytest.mark.parametrize("method", METHODS)
def test_bkw(method, time, seed):
    """28 z: f and fractions, c_q = 1.7, before and after the time of Algorithm 2."""
    options = {"n_realizations": scaled(N), "seed": seed, "rms_velocity": Q, "method": method}
    for speed in METHODS[method]:
        one = boltzmann.estimate_bkw(speed, time, **options)
        assert ok(z_of(one, bkw.density(speed, time, Q)))
        share = boltzmann.estimate_bkw_fraction(speed, time, **options)
        assert ok(z_of(share, bkw.fraction(speed, time, Q)))
    if method == "ancestral":
        assert caught(z_of(one, bkw.density(speed, LATER * time, Q)))
        assert caught(z_of(share, bkw.fraction(speed, LATER * time, Q)))


@pytest.mark.parametrize("rate", [0.9, kac.RATE])
@pytest.mark.parametrize("method", METHODS)
def test_kac(method, rate, seed):
    """24 z: f and its tail at t = 3.4, whatever the rate of collisions."""
    options = {"n_realizations": scaled(N), "seed": seed, "method": method}
    for v in {"ancestral": (0.2, 2.5, 6.0)}.get(method, (0.3, 2.1)):
        one = kac.estimate_density(v, 3.4, collision_rate=rate, **options)
        assert ok(z_of(one, kac.density(v, 3.4, rate)))
        tail = kac.estimate_tail(v, 3.4, collision_rate=rate, **options)
        assert ok(z_of(tail, kac.survival(v, 3.4, rate)))
    if method == "ancestral":
        assert caught(z_of(one, kac.density(v, LATER * 3.4, rate)))
        assert caught(z_of(tail, kac.survival(v, LATER * 3.4, rate)))


@pytest.mark.parametrize("cut", [0.05, 0.5, 3.0])
def test_subtrees_that_are_cut(cut, seed):
    """6 z: early, and at a time that no whole tree reaches."""
    options = {"n_realizations": scaled(N), "seed": seed, "cut": cut, "method": "ancestral"}
    for time in (1.7, 25.0):
        share = boltzmann.estimate_bkw_fraction(5.0, time, **options)
        assert ok(z_of(share, bkw.fraction(5.0, time)))
    tail = kac.estimate_tail(4.0, 5.0, **options)
    assert ok(z_of(tail, kac.survival(4.0, 5.0)))


@pytest.mark.parametrize("v", [2.0, 9.0])
def test_leaves_of_tilted_trees(v, seed):
    """4 z: their mean number, of trees that split at least once.

    E n = 1 + (e**t - 1) (1 + kappa B**2 / (1 + B)), and a tree of one leaf has the tilted
    probability e**-t (1 + b) / Q(b, t).
    """
    time = 1.7
    for law in (constants.BKW, constants.KAC):
        bound = probing.bound(contour.TAIL, v, time, law, method="ancestral", cut=0.0, max_nodes=N)
        values, nodes = np.empty(scaled(N)), np.empty(scaled(N), np.int64)
        assert bound(values, nodes, new_stream(seed, f"leaves {v} {law}"))
        mean = work.mean_leaves(v, time, law)
        _, b = work.tilt(v, time, law)
        left = math.exp(-constants.KAPPA[law] * time)
        single = math.exp(-time - b * (1.0 - left)) * (1.0 + b) / (1.0 + b * left)
        assert ok(compare.of_mean(nodes, (mean - single) / (1.0 - single)))
        later = work.mean_leaves(v, LATER * time, law)
        assert caught(compare.of_mean(nodes, (later - single) / (1.0 - single)))
