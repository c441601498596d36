"""Fig. 7 of the Kac paper: all points of the octant map to one arc, from a real run."""

from kacsim.items import _corners
from kacsim.items._lazy import np, store, xr

PAIR = (1, 2)  # of the text
ORDER = (1, 2, 3)  # of the particles along x, y, z
POINT, IMAGE = ("s", 1, 60), ("o", 2, 60)  # marker, place among the colours, size


def cases(settings):
    """Return recorded runs of the corner points, N = 3."""
    return [_corners.case(settings)]


def reduce(samples, settings):
    """Return some points of the octant, and its corners, before and after a step of the run."""
    sample = samples[_corners.case(settings).id]
    angles, pairs = _corners.two_steps(sample)
    radius = float(np.linalg.norm(sample["corner"].values[0, 0]))
    before = _corners.four_points(radius, angles[0])
    described, dims = store.described, ("point", "particle")
    after = _corners.rotate(before, PAIR, angles[0])
    corner = _corners.rotate(radius * np.eye(3), PAIR, angles[0])
    return xr.Dataset(
        {
            "before": described(before, dims, "points of the octant before the step"),
            "after": described(after, dims, "the same points after the step"),
            "corner": described(corner, ("corner_index", "particle"), "corners after the step"),
            "radius": described(radius, (), "radius of the sphere"),
            "pair": described(PAIR, ("two",), "labels of the pair"),
            "run_pair": described(pairs[0], ("two",), "labels of the pair in the run"),
            "angle": described(np.degrees(angles[0]), (), "angle", "degree"),
        }
    )


def draw(dataset):
    """Draw the points, where they go, the angle, and the arc that holds every image."""
    figure, (axis,) = _corners.sphere_axes(1)
    radius, angle = float(dataset.radius), float(np.radians(dataset.angle))
    _corners.octant(axis, radius)
    _corners.draw_angle(axis, radius, angle, "$\\theta$", 0)
    _corners.draw_arc(axis, dataset.corner.values, ORDER, 0, "image of the octant")
    before, after = dataset.before.values, dataset.after.values
    _corners.draw_step(axis, before, after, ORDER)
    _corners.draw_points(axis, before, ORDER, POINT, "points")
    _corners.draw_points(axis, after, ORDER, IMAGE, "their images")
    axis.set_title(f"pair {PAIR}, $\\theta$ = {float(dataset.angle):.0f}°")
    figure.legend(loc="outside lower center", ncols=3, frameon=False)
    return figure
