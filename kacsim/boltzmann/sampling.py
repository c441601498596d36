"""Samplers of the Boltzmann paper: realizations at a grid of probes, streamed into sums."""

import numpy as np

from kacsim.boltzmann import literal
from kacsim.boltzmann.estimators import chunks
from kacsim.kernels.lookup import named
from kacsim.store import described
from kacsim.streams import new_stream
from kacsim.sums import add_powers

KEPT = 100_000  # realizations are not kept: for cases that hold other first values
RECORDED_NODES = 64  # larger trees are not recorded
TOP = 500  # largest values kept at each probe, for the index of the tail
SUMMED = {
    "mean": "mean of the realizations",
    "mean_square": "mean square of the realizations",
    "largest": "largest realization",
    "nodes": "mean recursion: t' drawings of one realization",
}


def binding(case):
    """Return (name of the first probe axis, callable(first, time) that binds the kernel there).

    The kernels' module has a function of the sampler's name; it takes the probe and the other
    parameters.
    """
    family, module = case.kernel_module.rsplit(".", 1)
    bind = named(family, module, case.name)
    axis = next(one.name for one in case.sampler.parameters if one.many and one.name != "time")
    fixed = {key: value for key, value in case.parameters.items() if key not in (axis, "time")}
    return axis, lambda first, time: bind(first, time, **fixed)


def sample(case, progress):
    """Draw realizations at every probe of a grid, first axis by time.

    Returns
    -------
    dict of mean, mean_square, largest, nodes[first, time, replicate] (of one realization),
    top[first, time, rank] (the largest values, in descending order)
    """
    p = case.parameters
    axis, bind = binding(case)
    shape = (len(p[axis]), len(p["time"]))
    rows = len(case.replicates)
    sums = {name: np.zeros((*shape, rows)) for name in SUMMED}
    n_top = min(TOP, case.n_draws * rows)
    top = np.full((*shape, n_top), -np.inf)
    done = 0
    for i, first in enumerate(p[axis]):
        for j, time in enumerate(p["time"]):
            draw = bind(first, time)
            for row, replicate in enumerate(case.replicates):
                stream = new_stream(case.seed, f"{case.id} probe {i} {j}", replicate)
                here = i, j, row
                for values, nodes in chunks(draw, case.n_draws, stream):
                    both = np.zeros(2)
                    add_powers(values, both)
                    sums["mean"][here] += both[0]
                    sums["mean_square"][here] += both[1]
                    sums["largest"][here] = max(sums["largest"][here], values.max())
                    sums["nodes"][here] += nodes.sum()
                    top[i, j] = np.partition(np.append(top[i, j], values), -n_top)[-n_top:]
                    done += values.size
                    progress(done)
    for name in ("mean", "mean_square", "nodes"):
        sums[name] /= case.n_draws
    dims = (axis, "time", "replicate")
    variables = {name: described(sums[name], dims, text) for name, text in SUMMED.items()}
    return variables | {
        axis: described(np.array(p[axis], dtype=float), (axis,), axis),
        "time": described(np.array(p["time"], dtype=float), ("time",), "time"),
        "top": described(descending(top), (axis, "time", "rank"), "largest realizations"),
    }


def descending(values):
    """Return values sorted along the last axis, largest first; zeros have no sign."""
    return np.sort(values + 0.0, axis=-1)[..., ::-1]


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
    start, stop = rows[:, literal.START], rows[:, literal.STOP]
    velocity, begin = (rows[:, first : first + 3] for first in (literal.VELOCITY, literal.POSITION))
    end = begin - (start - np.maximum(stop, 0.0))[:, None] * velocity
    vector, one = ("branch", "axis"), ("branch",)
    numbers = np.repeat(np.arange(len(trees)), [tree.shape[0] for tree in trees])
    parent = rows[:, literal.PARENT].astype(np.int64)
    return {
        "tree": described(numbers, one, "number of the tree"),
        "start": described(start, one, "time where the branch begins"),
        "stop": described(stop, one, "drawn t', zero or less at a leaf"),
        "velocity": described(velocity, vector, "velocity of the branch"),
        "begin": described(begin, vector, "position where the branch begins"),
        "end": described(end, vector, "position where it ends"),
        "parent": described(parent, one, "row of the parent, -1 at the root"),
    }
