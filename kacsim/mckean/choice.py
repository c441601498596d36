"""Which method an estimate is made by."""

from kacsim import checks
from kacsim.mckean.constants import CUT, METHODS
from kacsim.mckean.parameters import far, mckean
from kacsim.mckean.work import mean_leaves

BRANCHING, BEST = "branching", "best"
PLAIN = {"oversampling": 1.0, "onset": 0.0}  # of branching, which alone has them
ROOM = 10.0  # times the mean number of leaves that the budget has to hold


def problems(method, cut, tree):
    """Yield the problems of a method and of what only another one has.

    Parameters
    ----------
    tree : dict of what branching takes
    """
    yield from checks.one_of("method", method, (BRANCHING, *METHODS, BEST))
    yield from checks.not_negative("cut", cut)
    if method in METHODS:
        for name, plain in PLAIN.items():
            if tree[name] != plain:
                yield checks.Problem(name, tree[name], f"needs method {BRANCHING}")
    elif method == BRANCHING and cut != 0.0:
        yield checks.Problem("cut", cut, f"needs method {METHODS[0]}")


def chosen(method, probe, time, law, cut, tree, at_speed=False):
    """Return (method, what its kernels take) for arguments that are right each.

    "best" is branching where oversampling is asked for, and else the ancestral method, whose
    variance is finite at every time: with whole trees where the budget holds them, then with
    subtrees replaced by their mean.

    Parameters
    ----------
    probe : dict of the name of a speed and its value, in the unit of the law
    time : in mean collision times
    tree : dict of what branching takes
    at_speed : the density of velocities at that speed is wanted

    Raises
    ------
    ValueError
        If a tree is too large, or the method has no variance there.
    """
    if method == BEST and any(tree[name] != plain for name, plain in PLAIN.items()):
        method = BRANCHING
    if method == BRANCHING:
        return method, tree
    (axis, v), most = *probe.items(), tree["max_nodes"]
    if method == BEST:
        method = METHODS[0]
        cut = cut or (CUT if ROOM * mean_leaves(v, time, law) > most else 0.0)
    own = {"method": method, "cut": cut, "max_nodes": most}
    lists = {axis: [v], "time": [time]}
    checks.raise_problems(far(axis, v))
    checks.raise_problems(mckean(axis=axis, law=law, at_speed=at_speed, **lists, **own))
    return method, own
