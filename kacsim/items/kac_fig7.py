"""Fig. 7 of the Kac paper: all points of the octant map to one arc, from a real run."""

from kacsim.items import _corners
from kacsim.items._lazy import np, plotting, store, xr


def cases(settings):
    """Return recorded runs of the corner points, N = 3."""
    return [_corners.case(settings)]


def reduce(samples, settings):
    """Return some points of the octant before and after the first step of the first run."""
    sample = samples[_corners.case(settings).id]
    p, q = int(sample["first"][0]), int(sample["second"][0])
    part = float(sample["squared_sine"][0])
    corner = sample["corner"].values
    radius = float(np.linalg.norm(corner[0, 0]))
    before = _spread_points(radius)
    after = before.copy()
    pair = before[:, p] ** 2 + before[:, q] ** 2
    after[:, p], after[:, q] = np.sqrt(part * pair), np.sqrt((1.0 - part) * pair)
    described, dims = store.described, ("point", "particle")
    return xr.Dataset(
        {
            "before": described(before, dims, "points of the octant before the step"),
            "after": described(after, dims, "the same points after the step"),
            "corner": described(corner[1], ("corner_index", "particle"), "corners after the step"),
            "radius": described(radius, (), "radius of the sphere"),
            "pair": described([p + 1, q + 1], ("two",), "labels of the pair"),
            "angle": described(np.degrees(np.arcsin(np.sqrt(part))), (), "angle", "degree"),
        }
    )


def _spread_points(radius):
    """Return four fixed points spread over the octant, float64[4, 3]."""
    weights = np.array([[6, 2, 2], [2, 6, 2], [2, 2, 6], [1, 5, 4]], dtype=float)
    return radius * np.sqrt(weights / weights.sum(axis=1, keepdims=True))


def draw(dataset):
    """Draw the points, where they go, and the arc that holds every image."""
    figure, (axis,) = _corners.sphere_axes(1)
    _corners.octant(axis, float(dataset.radius))
    _corners.draw_image(axis, dataset.corner.values, plotting.COLOURS[0], "image of the octant")
    before, after = dataset.before.values, dataset.after.values
    for ends in np.stack([before, after], axis=1):
        axis.plot(*ends.T, color="0.4", ls=":", lw=1)
    style = {"depthshade": False, "zorder": 5}
    axis.scatter(*before.T, color=plotting.COLOURS[1], marker="s", s=24, label="points", **style)
    axis.scatter(*after.T, color=plotting.COLOURS[2], marker="^", s=30, label="images", **style)
    i, j = dataset.pair.values
    axis.set_title(f"pair ({i}, {j}), $\\theta$ = {float(dataset.angle):.0f}°")
    figure.legend(loc="outside lower center", ncols=3, frameon=False)
    return figure
