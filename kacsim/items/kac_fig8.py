"""Fig. 8 of the Kac paper: the arc of Fig. 7 maps to a shorter arc, from the same run."""

from kacsim.items import _corners, kac_fig7
from kacsim.items._lazy import estimate, np, store, verdict, xr

PAIR = (3, 1)  # of the text
AXES = (3, 1, 2)  # along x, y, z: as in Fig. 7 the pair's plane is the horizontal one


COUNTS = (
    "n_repeated",
    "n_repeated_changed",
    "n_other",
    "n_other_kept",
    "n_arcs",
    "n_longer",
    "n_chords",
    "n_far",
)
N_ANGLES = 200  # angles, and chords, that are looked at
ROUNDING = 1e-12


def cases(settings):
    """Return recorded runs of the corner points, N = 3."""
    return [_corners.case(settings)]


def reduce(samples, settings):
    """Return points and corners after the step of Fig. 7 and after the next with another pair."""
    sample = samples[_corners.case(settings).id]
    angles, pairs = _corners.two_steps(sample)
    first = kac_fig7.reduce(samples, settings)
    points, corner = ([first[name].values] for name in ("after", "corner"))
    points.append(_corners.rotate(points[0], PAIR, angles[1]))
    corner = np.stack([*corner, _corners.rotate(corner[0], PAIR, angles[1])])
    radius = float(first.radius)
    length = _lengths(corner / radius)
    counts, changes = _corners.step_counts(sample, settings)
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
            "largest_change_repeated": described(
                changes.max(initial=0.0), (), "largest |change| of D at a repeated pair"
            ),
        }
        | counts
        | _arcs()
    )


def _lengths(points):
    """Return the largest angle between two points of each set; points are [set, point, 3]."""
    cosines = np.einsum("sip,sjp->sij", points, points)
    return np.arccos(np.clip(cosines.min(axis=(1, 2)), -1.0, 1.0))


def _arcs():
    """Return how many second arcs are not shorter, and chords that go to 0 before their arcs.

    Over first angles in the middle of equal parts of (0, pi/2); the second one only moves the arc.
    No arc of the octant is longer than pi / (2 sqrt(2)) times its chord.
    """
    middles = (np.arange(N_ANGLES) + 0.5) / N_ANGLES
    first = [_corners.rotate(np.eye(3), kac_fig7.PAIR, 0.5 * np.pi * part) for part in middles]
    second = [_corners.rotate(points, PAIR, 1.0) for points in first]
    longer = _lengths(np.stack(second)) > _lengths(np.stack(first)) - ROUNDING
    chord = np.sqrt(2.0) * np.r_[middles, 1.0]
    arc = 2.0 * np.arcsin(0.5 * chord)
    far = arc > np.pi / np.sqrt(8.0) * chord + ROUNDING
    described = store.described
    return {
        "n_arcs": described(longer.size, (), "first angles looked at"),
        "n_longer": described(longer.sum(), (), "those whose second arc is not shorter"),
        "n_chords": described(far.size, (), "chords looked at"),
        "n_far": described(far.sum(), (), "those whose arc is longer than the bound"),
    }


def claims(dataset):
    """Count what contradicts the text on the arcs of three particles."""
    settings, count = dataset.attrs["settings"], {k: int(dataset[k]) for k in COUNTS}
    runs = f"N = {settings['n_particles']}, {settings['n_draws']} runs until D < "
    runs += f"{settings['tolerance']:g}"
    return [
        verdict.finding(
            "kac_52_same_pair",
            estimate.Share(count["n_repeated_changed"], count["n_repeated"]),
            f"{count['n_repeated']} steps that repeat a pair, {runs}; largest relative change of D "
            f"{estimate.within(float(dataset.largest_change_repeated), settings['rounding'])}.",
        ),
        verdict.finding(
            "kac_52_shrinks",
            estimate.Share(count["n_other_kept"], count["n_other"]),
            f"{count['n_other']} steps with another pair, {runs}.",
        ),
        verdict.finding(
            "kac_fig8_shorter",
            estimate.Exact(count["n_longer"] / count["n_arcs"]),
            f"{count['n_arcs']} first angles; the arc of the run falls from "
            f"{float(dataset.length[0]):.3f} to {float(dataset.length[1]):.3f} rad.",
        ),
        verdict.finding(
            "kac_52_chord",
            estimate.Exact(count["n_far"] / count["n_chords"]),
            f"{count['n_chords']} chords.",
        ),
    ]


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
