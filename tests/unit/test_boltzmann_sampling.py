"""Streaming grids of probes: sums against numpy, kernels called with the probe's own numbers.

No z tests: kernels give the values, numpy the sums.
"""

import math

import numpy as np
import pytest

from kacsim.boltzmann import (
    bkw_tree,
    estimators,
    literal,
    literal_trap,
    null_collisions,
    trap_tree,
    uniform_tree,
)
from kacsim.boltzmann import sampling as streaming
from kacsim.cases import make_case
from kacsim.jobs import sampling
from kacsim.kac import probe_tree
from kacsim.mckean import contour, free_leaf
from kacsim.mckean.constants import BKW
from kacsim.samplers import registry
from kacsim.streams import new_stream

SIZE = {"n_draws": 150, "n_replicates": 3, "seed": 5}
TIMES, BUDGET = [0.6, 1.1], 10**6
MAJORANT = (5 / 3) ** 2.5 / math.e
TREE = {"oversampling": 1.4, "onset": 0.3}
LOG_M = -1.8378770664093454 * 1.5
GAS = {"coupling": 2.7, "breathing": 0.3, "start_phase": 0.4}
LAWS = {"majorant_factor": 1.3, "spread": 1.2, "anisotropy": 0.5}
PHYSICS, CHOICES = (2.7, 0.3, 0.4, 1.0), (1.3 * MAJORANT, 1.2, 0.5)


def flow(radius, phase):
    """Return eq. (31b) at time 0."""
    return 0.3 * math.cos(phase) / (1 + 0.3 * math.sin(phase)) * radius


# sampler -> (first axis, other parameters, kernel, function of a probe to the kernel's arguments)
SAMPLERS = {
    "bkw": ("speed", TREE, bkw_tree.estimate, lambda c, t: (c, t, 1.4, 0.3, BUDGET)),
    "bkw_fraction": (
        "threshold",
        TREE,
        bkw_tree.estimate_fraction,
        lambda c, t: (c, t, 1.4, 0.3, BUDGET),
    ),
    "bkw_moment": (
        "oversampling",
        {"onset": 0.3},
        bkw_tree.estimate_moment,
        lambda m, t: (m, t, 0.3, BUDGET),
    ),
    "bkw_literal": (
        "speed",
        {"initial": "bkw"},
        literal.estimate,
        lambda c, t: (c, t, False),
    ),
    "extinction": ("majorant", {}, null_collisions.estimate, lambda nu, t: (t, nu, BUDGET)),
    "uniform_moment": (
        "majorant",
        {},
        uniform_tree.estimate_moment,
        lambda nu, t: (nu, t, BUDGET),
    ),
    "bkw_ancestral": (
        "speed",
        {"cut": 0.1},
        contour.estimate,
        lambda c, t: (contour.SHELL, c, t, LOG_M - 0.5 * c * c, BKW, 0.1, BUDGET),
    ),
    "bkw_fraction_ancestral": (
        "threshold",
        {"method": "free_leaf"},
        free_leaf.estimate,
        lambda c, t: (contour.BEYOND, c, t, 0.0, BKW, BUDGET),
    ),
    "kac_probe": (
        "speed",
        TREE | {"collision_rate": 0.9},
        probe_tree.estimate,
        lambda v, t: (v / math.sqrt(1.5), 0.9 * t, 1.4, 0.9 * 0.3, BUDGET),
    ),
    "trap": (
        "radius",
        GAS | LAWS,
        trap_tree.estimate,
        lambda r, t: (r, flow(r, 0.4), 0.0, t, PHYSICS, CHOICES, BUDGET),
    ),
    "trap_fraction": (
        "radius",
        GAS | LAWS,
        trap_tree.estimate_fraction,
        lambda r, t: (r, t, PHYSICS, CHOICES, BUDGET),
    ),
    "trap_energy": (
        "radius",
        GAS | LAWS,
        trap_tree.estimate_energy,
        lambda r, t: (r, t, PHYSICS, CHOICES, BUDGET),
    ),
    "trap_literal": (
        "radius",
        {"initial": "breathing", "coupling": 2.7, "breathing": 0.3},
        literal_trap.estimate,
        lambda r, t: (r, flow(r, 0.0), t, 2.7, 0.3, True),
    ),
}
FIRSTS = [1.0, 1.6]  # on the first axis, whatever it is


def sampled(sampler, firsts=FIRSTS, times=TIMES):
    """Return (case, name -> array of what its sampler keeps)."""
    axis, others, *_ = SAMPLERS[sampler]
    case = make_case(sampler, **{axis: firsts}, time=times, **others, **SIZE)
    return case, {name: np.asarray(v[1]) for name, v in sampling.run(case).items()}


def test_every_sampler_is_here():
    probing = {name for name, one in registry().items() if one.streaming == "sample"}
    assert set(SAMPLERS) == probing | {"kac_probe"}


@pytest.mark.parametrize("sampler", SAMPLERS)
def test_sums_are_numpys(sampler, monkeypatch):
    """In chunks of 64 draws, and with the 20 largest values kept."""
    monkeypatch.setattr(estimators, "CHUNK", 64)
    monkeypatch.setattr(streaming, "TOP", 20)
    case, found = sampled(sampler)
    _, _, kernel, arguments = SAMPLERS[sampler]
    for i, first in enumerate(FIRSTS):
        for j, time in enumerate(TIMES):
            values = np.empty((SIZE["n_replicates"], SIZE["n_draws"]))
            nodes = np.empty(values.shape, np.int64)
            for k in range(SIZE["n_replicates"]):
                stream = new_stream(case.seed, f"{case.id} probe {i} {j}", k)
                assert kernel(values[k], nodes[k], *arguments(first, time), stream)
            np.testing.assert_allclose(found["mean"][i, j], values.mean(axis=1), rtol=1e-12)
            squares = (values**2).mean(axis=1)
            np.testing.assert_allclose(found["mean_square"][i, j], squares, rtol=1e-12)
            np.testing.assert_allclose(found["largest"][i, j], values.max(axis=1), rtol=1e-12)
            np.testing.assert_allclose(found["nodes"][i, j], nodes.mean(axis=1), rtol=1e-12)
            top = np.sort(values.ravel())[-20:][::-1]
            np.testing.assert_allclose(found["top"][i, j], top, rtol=1e-12)


def test_probes_and_replicates_have_streams_of_their_own():
    """One probe four times, each with three replicates: twelve means."""
    _, found = sampled("bkw", firsts=[0.7, 0.7], times=[0.8, 0.8])
    assert np.unique(found["mean"]).size == 12
