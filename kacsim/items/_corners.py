"""What Figs. 6 to 8 of the Kac paper share: recorded runs of the corner points."""

from kacsim.cases import make_case
from kacsim.items._lazy import np, plotting, store

KEYS = ("n_particles", "tolerance", "n_draws", "seed")


def case(settings):
    """Return the case of recorded runs."""
    return make_case("kac_corners", n_replicates=1, **{key: settings[key] for key in KEYS})


def step_counts(sample, settings):
    """Return (dict of counts of the steps of all recorded runs, changes of D at repeated pairs).

    Of the steps before D falls below the tolerance: the smaller D, the more digits are lost in it.
    A step counts as one that left D as it was, or changed it, by whether its relative change goes
    beyond rounding.
    """
    rounding = settings["rounding"]
    diameter, same = sample["diameter"].values, sample["same_pair"].values.astype(bool)
    change = diameter[:, 1:] / diameter[:, :-1] - 1.0
    valid, repeated = diameter[:, :-1] >= settings["tolerance"], same[:, 1:]
    valid &= np.isfinite(change)
    counts = {
        "n_steps": (valid, "steps of all runs compared"),
        "n_growing": (valid & (change > rounding), "steps that raised D"),
        "n_repeated": (valid & repeated, "steps that repeat a pair"),
        "n_repeated_changed": (
            valid & repeated & (np.abs(change) > rounding),
            "such steps that changed D",
        ),
        "n_other": (valid & ~repeated, "steps with another pair"),
        "n_other_kept": (
            valid & ~repeated & (change > -rounding),
            "such steps that left D as it was",
        ),
    }
    found = {name: store.described(which.sum(), (), text) for name, (which, text) in counts.items()}
    return found, np.abs(change[valid & repeated])


def walk(shares, sample, n_steps):
    """Follow points through the last steps of the first recorded run, up to time 0.

    Parameters
    ----------
    shares : float64[point, particle], the points' energies over their sum at time -n_steps
    sample : the recorded runs
    n_steps : int, at most those of the run

    Returns
    -------
    float64[n_steps + 1, point, particle], the energies over their sum
    """
    inputs = (sample[name].values[-n_steps:] for name in ("first", "second", "squared_sine"))
    path = [np.array(shares, dtype=float)]
    for p, q, part in zip(*inputs, strict=True):
        here = path[-1].copy()
        pair = here[:, p] + here[:, q]
        here[:, p], here[:, q] = part * pair, (1.0 - part) * pair
        path.append(here)
    return np.stack(path)


def diameters(points):
    """Return the largest distance of points[time, point, particle] at each time."""
    gaps = points[:, :, None, :] - points[:, None, :, :]
    return np.sqrt((gaps**2).sum(axis=-1)).max(axis=(1, 2))


def two_steps(sample):
    """Return two steps of the first recorded run with different pairs, in the text's own order.

    Of three particles two different pairs share one. The text has (1, 2) and then (3, 1), so the
    shared particle is called 1, its first partner 2 and the other one 3; where the run names a
    pair the other way round, its angle is 90 degrees less the run's.

    Returns
    -------
    (float64[2] the angles in radians, int[2, 2] the pairs as the run names them, from 1)
    """
    other = int(np.flatnonzero(sample["same_pair"].values[0, 1:] == 0)[0]) + 1
    pairs = np.stack([sample["first"].values, sample["second"].values], axis=1)[[other - 1, other]]
    part = sample["squared_sine"].values[[other - 1, other]]
    (shared,) = set(pairs[0]) & set(pairs[1])
    as_printed = np.array([pairs[0, 0] == shared, pairs[1, 1] == shared])
    return np.arcsin(np.sqrt(np.where(as_printed, part, 1.0 - part))), pairs + 1


def rotate(points, pair, angle):
    """Return points after a step: v_i becomes e sin(angle), v_j e cos(angle), eqs. (13), (14).

    Parameters
    ----------
    points : float64[point, 3], velocities
    pair : (i, j), counted from 1
    angle : in radians
    """
    after = np.array(points, dtype=float)
    i, j = np.array(pair) - 1
    size = np.hypot(after[:, i], after[:, j])
    after[:, i], after[:, j] = size * np.sin(angle), size * np.cos(angle)
    return after


def four_points(radius, angle):
    """Return four points of the octant that a step of the pair (1, 2) moves by 18 degrees or more.

    Their images differ, because their v_3 do.
    """
    height = np.radians([14.0, 32.0, 48.0, 66.0])
    turned = (angle + np.radians([54.0, 18.0, 72.0, 36.0])) % (0.5 * np.pi)
    flat = np.cos(height)
    return radius * np.stack([flat * np.sin(turned), flat * np.cos(turned), np.sin(height)], axis=1)


def arc_ends(points):
    """Return the two points farthest from each other, float64[2, 3]."""
    gaps = np.linalg.norm(points[:, None] - points[None, :], axis=-1)
    return points[list(np.unravel_index(np.argmax(gaps), gaps.shape))]


def arc(point_a, point_b, n=60):
    """Return float64[n, 3], the great-circle arc between two points of one sphere."""
    a, b = np.asarray(point_a), np.asarray(point_b)
    along = np.linspace(0.0, 1.0, n)[:, None]
    chord = (1.0 - along) * a + along * b
    return chord / np.linalg.norm(chord, axis=1, keepdims=True) * np.linalg.norm(a)


def octant(axis, radius, order=(1, 2, 3)):
    """Draw the outline and a net of the sphere's first octant, particles `order` along x, y, z."""
    angle = np.linspace(0.0, np.pi / 2, 40)
    for fixed in np.linspace(0.0, np.pi / 2, 7):
        cos, sin = np.cos(angle), np.sin(angle)
        level = np.full_like(angle, radius * np.sin(fixed))
        ring = radius * np.cos(fixed)
        style = {"color": "0.85", "lw": 0.5, "zorder": 1}
        axis.plot(ring * cos, ring * sin, level, **style)
        axis.plot(radius * np.cos(fixed) * cos, radius * np.sin(fixed) * cos, radius * sin, **style)
    axis.tick_params(labelsize=6, pad=-3)
    for name, plane in zip(order, (axis.xaxis, axis.yaxis, axis.zaxis), strict=True):
        plane.set_label_text(f"$v_{name}$")
        plane.labelpad = -8
        plane.set_pane_color("white")
        plane.set_ticks([0, radius], ["0", "$\\sqrt{E}$"])
    axis.zaxis.set_rotate_label(False)
    axis.grid(visible=False)
    axis.view_init(elev=25, azim=35)
    axis.set_box_aspect((1, 1, 1), zoom=1.15)


def draw_angle(axis, radius, angle, letter, colour):
    """Draw the angle of a step along the rim of the plane of its pair, x and y, from the y axis."""

    def on_rim(part, size):
        return size * radius * np.array([np.sin(part * angle), np.cos(part * angle), 0.0])

    for end in (0.0, 1.0):
        ray = np.stack([on_rim(end, 1.0), on_rim(end, 1.09)])
        axis.plot(*ray.T, color=plotting.COLOURS[colour], lw=1, zorder=2)
    rim = arc(on_rim(0.0, 1.05), on_rim(1.0, 1.05))
    axis.plot(*rim.T, color=plotting.COLOURS[colour], lw=1, zorder=2)
    middle = {"ha": "center", "va": "center", "color": plotting.COLOURS[colour], "zorder": 2}
    axis.text(*on_rim(0.5, 1.16), letter, **middle)


def draw_arc(axis, points, order, colour, label):
    """Draw the image of the octant: the arc between the two images of corners farthest apart."""
    ends = arc_ends(points)[:, np.array(order) - 1]
    axis.plot(*arc(*ends).T, color=plotting.COLOURS[colour], lw=2.5, zorder=3, label=label)


def draw_step(axis, before, after, order):
    """Draw the circles on which a step moves points."""
    place = np.array(order) - 1
    for start, end in zip(before[:, place], after[:, place], strict=True):
        turned = np.linspace(np.arctan2(start[1], start[0]), np.arctan2(end[1], end[0]), 30)
        ring = np.hypot(*start[:2])
        path = ring * np.cos(turned), ring * np.sin(turned), np.full(30, start[2])
        axis.plot(*path, color="0.3", ls=":", lw=1, zorder=4)


def draw_points(axis, points, order, symbol, label=None):
    """Draw points, numbered where the symbol (marker, place among the colours, size) has room."""
    marker, colour, size = symbol
    style = {"marker": marker, "ms": np.sqrt(size), "mew": 1.5, "color": plotting.COLOURS[colour]}
    points = points[:, np.array(order) - 1]
    axis.plot(*points.T, ls="none", zorder=5, label=label, **style)
    if size >= 60:
        for k, point in enumerate(points):
            number = {"color": "white", "size": 6, "ha": "center", "va": "center", "zorder": 6}
            axis.text(*point, str(k + 1), **number)


def sphere_axes(count):
    """Return (figure, axes) of 3-D panels in a row, what is drawn last in front."""
    figure, axes = plotting.panels(1, count, projection="3d", height=3.2)
    for axis in axes:
        axis.computed_zorder = False
    return figure, axes
