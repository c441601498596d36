"""Fig. 2 of the Boltzmann paper: one estimation tree, in velocity and in position space."""

from kacsim.cases import make_case
from kacsim.items._lazy import np, plotting, store, xr


def _case(settings):
    keys = ("speed", "time", "n_draws", "seed")
    return make_case("bkw_tree", n_replicates=1, **{key: settings[key] for key in keys})


def cases(settings):
    """Return recorded trees of Algorithm 1, from which one of the wanted size is shown."""
    return [_case(settings)]


def reduce(samples, settings):
    """Return the branches of the first tree that has the wanted number of nodes."""
    sample = samples[_case(settings).id]
    tree = sample["tree"].values
    sizes = np.bincount(tree)
    wanted = np.flatnonzero(sizes == settings["n_nodes"])
    chosen = int(wanted[0]) if wanted.size else int(np.argmax(sizes))
    here = tree == chosen
    variables = {
        name: (sample[name].dims, sample[name].values[here], sample[name].attrs)
        for name in ("start", "stop", "velocity", "begin", "end", "parent")
    }
    variables["size"] = store.described(here.sum(), (), "nodes of the tree")
    return xr.Dataset(variables)


def draw(dataset):
    """Draw every branch: velocity against time, and the path in a plane."""
    figure, axes = plotting.panels(1, 2)
    for k in range(dataset.sizes["branch"]):
        here = dataset.isel(branch=k)
        colour = plotting.COLOURS[k % len(plotting.COLOURS)]
        start, stop = float(here.start), max(0.0, float(here.stop))
        level = float(here.velocity[1])
        axes[0].plot([stop, start], [level, level], color=colour, lw=1.5)
        if int(here.parent) >= 0:
            above = float(dataset.velocity[int(here.parent), 1])
            axes[0].plot([start, start], [above, level], color="0.6", lw=0.8, ls=":")
        axes[1].plot(*np.stack([here.begin.values, here.end.values])[:, :2].T, color=colour, lw=1.5)
        if float(here.stop) <= 0.0:
            axes[0].plot(0.0, level, "s", color=colour, ms=4)
            axes[1].plot(*here.end.values[:2], "s", color=colour, ms=4)
        else:
            axes[1].plot(*here.end.values[:2], "o", color="black", mfc="none", ms=5)
    axes[0].set_xlabel("time $t$ in mean collision times")
    axes[0].set_ylabel("$c_y/c_q$")
    axes[0].set_title("squares: the tree meets the start")
    axes[1].set_xlabel("$x$")
    axes[1].set_ylabel("$y$")
    axes[1].set_title("circles: collisions")
    axes[1].set_aspect("equal", adjustable="datalim")
    return figure
