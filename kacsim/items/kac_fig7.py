"""Fig. 7 of the Kac paper: all points of the octant map to one arc, from a real run."""

from kacsim.items import _corners
from kacsim.items._lazy import estimate, np, store, verdict, xr

PAIR = (1, 2)  # of the text
ORDER = (1, 2, 3)  # of the particles along x, y, z
POINT, IMAGE = ("s", 1, 60), ("o", 2, 60)  # marker, place among the colours, size


EDGE = 40  # points along an edge of the lattice on the octant, and angles
ROUNDING = 1e-12  # over the radius


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
        | _lattice(angles[0])
        | _identities()
    )


def _lattice(angle):
    """Return how many points of a lattice on the octant a step takes off the arc.

    On it v_1 cos(angle) = v_2 sin(angle), and no coordinate is negative.
    """
    places = range(EDGE + 1)
    shares = [(i, j, EDGE - i - j) for i in places for j in range(EDGE + 1 - i)]
    after = _corners.rotate(np.sqrt(np.array(shares) / EDGE), PAIR, angle)
    beside = np.abs(after[:, 0] * np.cos(angle) - after[:, 1] * np.sin(angle)) > ROUNDING
    off = beside | (after < -ROUNDING).any(axis=1)
    described = store.described
    return {
        "n_lattice": described(len(shares), (), "points of the lattice"),
        "n_off_arc": described(off.sum(), (), "points whose image is not on the arc"),
    }


def _identities():
    """Return how often eq. (12) fails, and how often eqs. (13) and (14) leave the octant.

    Over angles in the middle of equal parts of (0, 2 pi), and v_i, v_j on the unit circle.
    """
    angle = 2.0 * np.pi * (np.arange(4 * EDGE) + 0.5) / (4 * EDGE)
    turned = angle[:EDGE, None]
    v_i, v_j = np.sin(turned), np.cos(turned)
    rotated = v_i * np.cos(angle) + v_j * np.sin(angle)
    fails = np.abs(rotated - np.sin(angle + np.arctan(v_i / v_j))) > ROUNDING
    described = store.described
    return {
        "n_angles": described(fails.size, (), "velocities and angles looked at"),
        "n_unequal": described(fails.sum(), (), "those at which eq. (12) fails"),
        "share_outside": described(
            (np.sin(angle) < 0.0).mean(), (), "angles in (0, 2 pi) that leave the octant"
        ),
    }


def claims(dataset):
    """Count what contradicts the text on the first step."""
    points, angles = int(dataset.n_lattice), int(dataset.n_angles)
    exact = estimate.Exact
    return [
        verdict.finding(
            "kac_fig7_arc",
            exact(int(dataset.n_off_arc) / points),
            f"{points} points of a lattice on the octant.",
        ),
        verdict.finding(
            "kac_52_identity",
            exact(int(dataset.n_unequal) / angles),
            f"{angles} pairs of velocities and angles.",
        ),
        verdict.finding(
            "kac_52_range",
            exact(float(dataset.share_outside)),
            "Share of the angles. The distances of corner points are the same with either range, "
            "because all of them take the same sign.",
        ),
    ]


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
