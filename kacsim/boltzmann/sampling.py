"""Samplers of the Boltzmann paper: realizations at a grid of probes, streamed into sums."""

import math

import numpy as np

from kacsim.boltzmann import (
    bkw_tree,
    kac_tree,
    literal,
    literal_trap,
    null_collisions,
    trap,
    trap_tree,
)
from kacsim.boltzmann.estimators import chunks
from kacsim.store import described
from kacsim.streams import new_stream

THERMAL = math.sqrt(1.5)  # RMS velocity of eq. (9) of the Kac paper
TOP = 500  # largest values kept at each probe, for the index of the tail


def _bkw(p, speed, time):
    probe = float(speed), float(time), float(p["oversampling"]), float(p["onset"])
    return lambda v, n, s: bkw_tree.estimate(v, n, *probe, p["max_nodes"], s)


def _bkw_fraction(p, threshold, time):
    probe = float(threshold), float(time), float(p["oversampling"]), float(p["onset"])
    return lambda v, n, s: bkw_tree.estimate_fraction(v, n, *probe, p["max_nodes"], s)


def _bkw_literal(p, speed, time):
    equilibrium = p["initial"] == "equilibrium"
    return lambda v, n, s: literal.estimate(v, n, float(speed), float(time), equilibrium, s)


def _extinction(p, majorant, time):
    return lambda v, n, s: null_collisions.estimate(
        v, n, float(time), float(majorant), p["max_nodes"], s
    )


def _trap_laws(p):
    physics = (float(p["coupling"]), float(p["breathing"]), float(p["start_phase"]))
    start = 1.0 if p["initial"] == "bkw" else 0.0
    majorant = trap.MAJORANT * p["majorant_factor"]
    return (*physics, start), (majorant, float(p["spread"]), float(p["anisotropy"]))


def _trap(p, radius, time):
    """Probe at a radius, with the velocity that the flow has there at time 0."""
    physics, choices = _trap_laws(p)
    speed = float(trap.flow(radius, 0.0, physics[1], physics[2]))
    probe = float(radius), speed, 0.0, float(time)
    return lambda v, n, s: trap_tree.estimate(v, n, *probe, physics, choices, p["max_nodes"], s)


def _trap_literal(p, radius, time):
    speed = float(trap.flow(radius, 0.0, p["breathing"]))
    probe = float(radius), speed, float(time), float(p["coupling"]), float(p["breathing"])
    relaxed = p["initial"] == "breathing"
    return lambda v, n, s: literal_trap.estimate(v, n, *probe, relaxed, s)


def _trap_fraction(p, radius, time):
    physics, choices = _trap_laws(p)
    probe = float(radius), float(time)
    return lambda v, n, s: trap_tree.estimate_fraction(
        v, n, *probe, physics, choices, p["max_nodes"], s
    )


def _kac_probe(p, speed, time):
    probe = speed / THERMAL, float(p["collision_rate"] * time)
    more = float(p["oversampling"]), float(p["collision_rate"] * p["onset"])
    return lambda v, n, s: kac_tree.estimate(v, n, *probe, *more, p["max_nodes"], s)


def _bkw_moment(p, oversampling, time):
    probe = float(oversampling), float(time), float(p["onset"])
    return lambda v, n, s: bkw_tree.estimate_moment(v, n, *probe, p["max_nodes"], s)


def _trap_energy(p, radius, time):
    physics, choices = _trap_laws(p)
    probe = float(radius), float(time)
    return lambda v, n, s: trap_tree.estimate_energy(
        v, n, *probe, physics, choices, p["max_nodes"], s
    )


# sampler -> (name of the first probe axis, function that binds a kernel to a probe)
PROBES = {
    "bkw": ("speed", _bkw),
    "bkw_fraction": ("threshold", _bkw_fraction),
    "bkw_literal": ("speed", _bkw_literal),
    "extinction": ("majorant", _extinction),
    "trap_literal": ("radius", _trap_literal),
    "trap": ("radius", _trap),
    "trap_fraction": ("radius", _trap_fraction),
    "trap_energy": ("radius", _trap_energy),
    "bkw_moment": ("oversampling", _bkw_moment),
    "kac_probe": ("speed", _kac_probe),
}


def sample(case, progress):
    """Draw realizations at every probe of a grid, first axis by time.

    Returns
    -------
    dict of mean, mean_square, largest, nodes[first, time, replicate] (of one realization),
    top[first, time, rank] (the largest values, in descending order)
    """
    p = case.parameters
    axis, bind = PROBES[case.sampler]
    shape = (len(p[axis]), len(p["time"]))
    rows = len(case.replicates)
    sums = np.zeros((4, *shape, rows))
    n_top = min(TOP, case.n_draws * rows)
    top = np.full((*shape, n_top), -np.inf)
    done = 0
    for i, first in enumerate(p[axis]):
        for j, time in enumerate(p["time"]):
            draw = bind(p, first, time)
            for row, replicate in enumerate(case.replicates):
                stream = new_stream(case.seed, f"{case.id} probe {i} {j}", replicate)
                place = (slice(None), i, j, row)
                for values, nodes in chunks(draw, case.n_draws, stream):
                    sums[place] += values.sum(), (values * values).sum(), 0.0, nodes.sum()
                    sums[2, i, j, row] = max(sums[2, i, j, row], values.max())
                    top[i, j] = np.partition(np.append(top[i, j], values), -n_top)[-n_top:]
                    done += values.size
                    progress(done)
    sums[[0, 1, 3]] /= case.n_draws
    dims = (axis, "time", "replicate")
    names = {
        "mean": "mean of the realizations",
        "mean_square": "mean square of the realizations",
        "largest": "largest realization",
        "nodes": "mean recursion: t' drawings of one realization",
    }
    variables = {
        name: described(sums[k], dims, text) for k, (name, text) in enumerate(names.items())
    }
    return variables | {
        axis: described(np.array(p[axis], dtype=float), (axis,), axis),
        "time": described(np.array(p["time"], dtype=float), ("time",), "time"),
        "top": described(descending(top), (axis, "time", "rank"), "largest realizations"),
    }


def descending(values):
    """Return values sorted along the last axis, largest first; zeros have no sign."""
    return np.sort(values + 0.0, axis=-1)[..., ::-1]


RECORDED_NODES = 64  # larger trees are not recorded


def sample_bkw_tree(case, progress):
    """Record trees of Algorithm 1 (Fig. 2).

    Returns
    -------
    dict of tree, start, stop, parent[branch] and velocity, begin, end[branch, axis]; parents are
    counted from the first branch of the tree
    """
    p = case.parameters
    trees = []
    for k in range(case.n_draws):
        stream = new_stream(case.seed, case.id, k)
        trees.append(literal.record(float(p["speed"]), float(p["time"]), RECORDED_NODES, stream))
    progress(case.n_draws)
    rows = np.concatenate(trees)
    span = rows[:, 0] - np.maximum(rows[:, 1], 0.0)
    vector, one = ("branch", "axis"), ("branch",)
    numbers = np.repeat(np.arange(len(trees)), [tree.shape[0] for tree in trees])
    return {
        "tree": described(numbers, one, "number of the tree"),
        "start": described(rows[:, 0], one, "time where the branch begins"),
        "stop": described(rows[:, 1], one, "drawn t', zero or less at a leaf"),
        "velocity": described(rows[:, 2:5], vector, "velocity of the branch"),
        "begin": described(rows[:, 5:8], vector, "position where the branch begins"),
        "end": described(
            rows[:, 5:8] - span[:, None] * rows[:, 2:5], vector, "position where it ends"
        ),
        "parent": described(rows[:, 8].astype(np.int64), one, "row of the parent, -1 at the root"),
    }


SAMPLERS = dict.fromkeys(PROBES, sample) | {"bkw_tree": sample_bkw_tree}
