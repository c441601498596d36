"""Fig. 8 of the Kac paper: the arc of Fig. 7 maps to a shorter arc, from the same run."""

from kacsim.items import _corners, kac_fig7
from kacsim.items._lazy import np, store, xr

PAIR = (3, 1)  # of the text
AXES = (3, 1, 2)  # along x, y, z: as in Fig. 7 the pair's plane is the horizontal one


def cases(settings):
    """Return recorded runs of the corner points, N = 3."""
    return [_corners.case(settings)]


def reduce(samples, settings):
    """Return points and corners after the step of Fig. 7 and after the next with another pair."""
    angles, pairs = _corners.two_steps(samples[_corners.case(settings).id])
    first = kac_fig7.reduce(samples, settings)
    points, corner = ([first[name].values] for name in ("after", "corner"))
    points.append(_corners.rotate(points[0], PAIR, angles[1]))
    corner = np.stack([*corner, _corners.rotate(corner[0], PAIR, angles[1])])
    radius = float(first.radius)
    cosines = np.einsum("sip,sjp->sij", corner, corner) / radius**2
    length = np.arccos(np.clip(cosines.min(axis=(1, 2)), -1.0, 1.0))
    described, each = store.described, ("stage", "two")
    return xr.Dataset(
        {
            "point": described(points, ("stage", "index", "particle"), "the points of Fig. 7"),
            "corner": described(corner, ("stage", "corner_index", "particle"), "corner points"),
            "length": described(length, ("stage",), "arc length over radius", "rad"),
            "pair": described([kac_fig7.PAIR, PAIR], each, "labels of the pair"),
            "run_pair": described(pairs, each, "labels of the pair in the run"),
            "angle": described(np.degrees(angles), ("stage",), "angle", "degree"),
            "radius": described(radius, (), "radius of the sphere"),
        }
    )


def draw(dataset):
    """Draw the arc of Fig. 7 with its axes turned, and what the next step makes of it."""
    figure, axes = _corners.sphere_axes(2)
    radius, points = float(dataset.radius), dataset.point.values
    labels = [f"arc of {float(length):.3f} rad" for length in dataset.length]
    for stage, axis in enumerate(axes):
        _corners.octant(axis, radius, AXES)
        if stage:
            angle = float(np.radians(dataset.angle[1]))
            _corners.draw_angle(axis, radius, angle, "$\\theta'$", 3)
            _corners.draw_step(axis, *points, AXES)
        for k in range(stage + 1):
            _corners.draw_arc(axis, dataset.corner.values[k], AXES, (0, 3)[k], labels[k])
        _corners.draw_points(axis, points[0], AXES, kac_fig7.IMAGE, "images of Fig. 7")
    _corners.draw_points(axes[1], points[1], AXES, ("^", 6, 14), "their images")
    handles, names = axes[1].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside lower center", ncols=4, frameon=False)
    axes[0].set_title(f"after pair {kac_fig7.PAIR}, axes turned")
    axes[1].set_title(f"after pair {PAIR}, $\\theta'$ = {float(dataset.angle[1]):.0f}°")
    return figure
