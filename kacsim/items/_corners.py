"""What Figs. 6 to 8 of the Kac paper share: recorded runs of the corner points."""

from kacsim.cases import make_case
from kacsim.items._lazy import np, plotting

KEYS = ("n_particles", "tolerance", "n_draws", "seed")


def case(settings):
    """Return the case of recorded runs."""
    return make_case("kac_corners", n_replicates=1, **{key: settings[key] for key in KEYS})


def arc(point_a, point_b, n=60):
    """Return float64[n, 3], the great-circle arc between two points of one sphere."""
    a, b = np.asarray(point_a), np.asarray(point_b)
    along = np.linspace(0.0, 1.0, n)[:, None]
    chord = (1.0 - along) * a + along * b
    return chord / np.linalg.norm(chord, axis=1, keepdims=True) * np.linalg.norm(a)


def octant(axis, radius):
    """Draw the outline and a net of the sphere's first octant on a 3-D axis."""
    angle = np.linspace(0.0, np.pi / 2, 40)
    for fixed in np.linspace(0.0, np.pi / 2, 7):
        cos, sin = np.cos(angle), np.sin(angle)
        level = np.full_like(angle, radius * np.sin(fixed))
        ring = radius * np.cos(fixed)
        style = {"color": "0.8", "lw": 0.5}
        axis.plot(ring * cos, ring * sin, level, **style)
        axis.plot(radius * np.cos(fixed) * cos, radius * np.sin(fixed) * cos, radius * sin, **style)
    for name, setter in zip(
        "123", (axis.set_xlabel, axis.set_ylabel, axis.set_zlabel), strict=True
    ):
        setter(f"$v_{name}$", labelpad=-8)
    axis.tick_params(labelsize=6, pad=-3)
    axis.set(xticks=[0, radius], yticks=[0, radius], zticks=[0, radius])
    for plane in (axis.xaxis, axis.yaxis, axis.zaxis):
        plane.set_pane_color("white")
        plane.set_ticklabels(["0", "$\\sqrt{E}$"])
    axis.zaxis.set_rotate_label(False)
    axis.grid(visible=False)
    axis.view_init(elev=25, azim=35)
    axis.set_box_aspect((1, 1, 1))


def draw_image(axis, points, colour, label):
    """Draw the image of the octant after a step: the arc through the corners' images."""
    gaps = np.linalg.norm(points[:, None] - points[None, :], axis=-1)
    i, j = np.unravel_index(np.argmax(gaps), gaps.shape)
    axis.plot(*arc(points[i], points[j]).T, color=colour, lw=2.5, label=label)
    axis.scatter(*points.T, color=colour, s=18, depthshade=False)


def sphere_axes(count):
    """Return (figure, axes) of 3-D panels in a row."""
    return plotting.panels(1, count, projection="3d", height=3.0)
