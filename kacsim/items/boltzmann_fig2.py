"""Fig. 2 of the Boltzmann paper: one estimation tree, in velocity and in position space."""

from kacsim.cases import make_case
from kacsim.items import _trees
from kacsim.items._lazy import estimate, np, plotting, store, verdict, xr

ROUNDING = 1e-9  # relative difference of two ways to evaluate a tree
KEPT = ("start", "stop", "velocity", "begin", "end", "parent")
LABEL = (0.10, 0.06)  # width and height of a label, in shares of a panel


def _case(settings):
    keys = ("speed", "time", "n_draws", "seed")
    return make_case("bkw_tree", n_replicates=1, **{key: settings[key] for key in keys})


def cases(settings):
    """Return recorded trees of Algorithm 1, from which one of the wanted size is shown."""
    return [_case(settings)]


def reduce(samples, settings):
    """Return the branches of the tree of the wanted size whose labels are farthest apart."""
    sample = samples[_case(settings).id]
    tree = sample["tree"].values
    sizes = np.bincount(tree)
    wanted = np.flatnonzero(sizes == settings["n_nodes"])
    if not wanted.size:
        wanted = np.flatnonzero(sizes == sizes.max())
    chosen = wanted[np.argmax([clearance(sample.isel(branch=tree == k)) for k in wanted])]
    here = sample.isel(branch=tree == chosen)
    variables = {name: (here[name].dims, here[name].values, here[name].attrs) for name in KEPT}
    described = store.described
    variables |= {
        "size": described(here.sizes["branch"], (), "nodes of the tree"),
        "n_wanted": described(wanted.size, (), "recorded trees of this size"),
        "sequence": described(
            np.array(sequences(here["parent"].values), dtype=object),
            ("branch",),
            "sequence of section II, without the zeros at its end",
        ),
        "departure": described(
            _trees.departures(sample), ("tree",), "estimate over the product of the leaves, less 1"
        ),
    }
    return xr.Dataset(variables)


def sequences(parent):
    """Return the sequence that the text gives each branch: 0 at the root, then turns 1 and 2.

    A turn is 1 where the branch of c' is followed and 2 where that of c'_* is (section II, c).

    Parameters
    ----------
    parent : int64[branch], rows of the parents, -1 at the root; of two children c' comes first
    """
    found, children = [""], {}
    for above in parent[1:]:
        children[above] = children.get(above, 0) + 1
        found.append(f"{found[above]}{children[above]}")
    return ["0", *found[1:]]


def claims(dataset):
    """Count the recorded trees whose estimate is not the product over their leaves."""
    gaps = np.abs(dataset.departure.values)
    wrong = estimate.Exact(float((gaps > ROUNDING).mean()))
    evidence = (
        f"{gaps.size} recorded trees of Algorithm 1, evaluated by the printed weights and by the "
        f"product: largest relative difference {estimate.within(gaps.max(), ROUNDING)}."
    )
    return [verdict.finding("boltzmann_17_leaves", wrong, evidence)]


def _label_places(tree):
    """Return where labels stand in both panels, float64[panel, branch, 2]: middles of branches."""
    begins, ends = _ends(tree, "start", "begin"), _ends(tree, "stop", "end")
    return 0.5 * (begins + ends)


def _ends(tree, time, position):
    """Return the beginnings or ends of branches in both panels, float64[panel, branch, 2]."""
    in_time = np.maximum(tree[time].values, 0.0), tree["velocity"].values[:, 1]
    return np.stack([np.stack(in_time, axis=1), tree[position].values[:, :2]])


def clearance(tree):
    """Return how far apart labels are, in labels, and symbols from anything, in half labels."""
    places, ends = _label_places(tree), _ends(tree, "stop", "end")
    if places.shape[1] == 1:
        return np.inf
    size = np.ptp(np.concatenate([places, ends], axis=1), axis=1, keepdims=True) * LABEL
    labels, symbols = places / size + [0.0, 0.5], ends / size
    different = ~np.eye(places.shape[1], dtype=bool)

    def least(some, others, pairs):
        gaps = np.abs(some[:, :, None] - others[:, None, :]).max(axis=-1)
        return gaps[:, pairs].min()

    among = least(labels, labels, different), 2.0 * least(symbols, symbols, different)
    return float(min(*among, 2.0 * least(labels, symbols, ...)))


def draw(dataset):
    """Draw every branch with its sequence: velocity against time, and the path in a plane."""
    figure, axes = plotting.panels(1, 2, height=3.3)
    colours = plotting.distinct(dataset.sizes["branch"])
    places = _label_places(dataset)
    for k, colour in enumerate(colours):
        here = dataset.isel(branch=k)
        start, stop = float(here.start), max(0.0, float(here.stop))
        level = float(here.velocity[1])
        path = np.stack([here.begin.values, here.end.values])[:, :2].T
        axes[0].plot([stop, start], [level, level], color=colour, lw=1.8)
        axes[1].plot(*path, color=colour, lw=1.8)
        if float(here.stop) <= 0.0:
            axes[0].plot(0.0, level, "s", color=colour, ms=5)
            axes[1].plot(*path[:, 1], "s", color=colour, ms=5)
        else:
            ends = dataset.velocity[dataset.parent.values == k, 1].values
            levels = [min(level, *ends), max(level, *ends)]
            axes[0].plot(
                [stop, stop], levels, color="0.4", lw=1.8, solid_capstyle="round", zorder=1
            )
            axes[1].plot(*path[:, 1], "o", color="black", mfc="white", ms=6)
        for axis, place in zip(axes, places[:, k], strict=True):
            plotting.halo_text(axis, f"$c_{{{here.sequence.item()}}}$", place, colour)
    axes[0].set_xlabel("time $t$ in mean collision times")
    axes[0].set_ylabel("$c_y/c_q$")
    axes[1].set_xlabel("$x$ in $c_q$ times the mean collision time")
    axes[1].set_ylabel("$y$ in the same unit")
    return figure
