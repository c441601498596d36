"""Fig. 8 of the Kac paper: the arc of Fig. 7 maps to a shorter arc, from the same run."""

from kacsim.items import _corners
from kacsim.items._lazy import np, plotting, store, xr


def cases(settings):
    """Return recorded runs of the corner points, N = 3."""
    return [_corners.case(settings)]


def reduce(samples, settings):
    """Return the corners after each step until the first one with another pair shrank the arc."""
    sample = samples[_corners.case(settings).id]
    same = sample["same_pair"].values[0].astype(bool)
    other = int(np.flatnonzero(~same[1:])[0]) + 1
    steps = [other, other + 1]
    corner = sample["corner"].values[steps]
    pairs = np.stack([sample["first"].values, sample["second"].values], axis=1) + 1
    cosines = np.einsum("sip,sjp->sij", corner, corner) / np.sum(corner[0, 0] ** 2)
    length = np.arccos(np.clip(cosines.min(axis=(1, 2)), -1.0, 1.0))
    described = store.described
    return xr.Dataset(
        {
            "corner": described(corner, ("stage", "corner_index", "particle"), "corner points"),
            "length": described(length, ("stage",), "arc length over radius", "rad"),
            "pair": described(pairs[[other - 1, other]], ("stage", "two"), "labels of the pair"),
            "radius": described(np.linalg.norm(corner[0, 0]), (), "radius of the sphere"),
        }
    )


def draw(dataset):
    """Draw the arc before and after the step with another pair."""
    figure, axes = _corners.sphere_axes(2)
    for stage, axis in enumerate(axes):
        _corners.octant(axis, float(dataset.radius))
        for k in range(stage + 1):
            label = f"length {float(dataset.length[k]):.3f} rad"
            points = dataset.corner.values[k]
            _corners.draw_image(axis, points, plotting.COLOURS[k], label)
        i, j = dataset.pair.values[stage]
        axis.set_title(f"after pair ({i}, {j})")
        axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.08), ncols=2, frameon=False)
    return figure
