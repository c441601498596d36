"""Fig. 6 of the Kac paper: bounding processes of perfect simulation, from a real run."""

import math

from kacsim.items import _corners
from kacsim.items._lazy import np, plotting, store, verdict, xr
from kacsim.kac.constants import MEAN_ENERGY


def cases(settings):
    """Return recorded runs of the corner points."""
    return [_corners.case(settings)]


def reduce(samples, settings):
    """Return the corner points' envelope of one coordinate, and how D and pairs behaved."""
    sample = samples[_corners.case(settings).id]
    corner = sample["corner"].values[:, :, 0]
    diameter, same = sample["diameter"].values, sample["same_pair"].values.astype(bool)
    change = diameter[:, 1:] / diameter[:, :-1] - 1.0
    valid, repeated = np.isfinite(change), same[:, 1:]
    described, path = store.described, ("time",)
    start = math.sqrt(2.0 * MEAN_ENERGY * settings["n_particles"])  # of two corners
    rounding = settings["rounding"]
    return xr.Dataset(
        {
            "path": described(corner, ("time", "corner_index"), "v_1 of every corner"),
            "upper": described(corner.max(axis=1), path, "largest v_1 of the corners"),
            "lower": described(corner.min(axis=1), path, "smallest v_1 of the corners"),
            "first_diameter": described(
                np.r_[start, diameter[0, : corner.shape[0] - 1]],
                path,
                "largest distance D, first run",
            ),
            "n_steps": described(valid.sum(), (), "steps of all runs compared"),
            "n_growing": described((change[valid] > rounding).sum(), (), "steps that raised D"),
            "n_repeated": described((valid & repeated).sum(), (), "steps that repeat a pair"),
            "largest_change_repeated": described(
                np.abs(change[valid & repeated]).max(initial=0.0), (), "largest |change| of D"
            ),
            "n_other": described((valid & ~repeated).sum(), (), "steps with another pair"),
            "n_other_kept": described(
                (valid & ~repeated & (change > -rounding)).sum(),
                (),
                "such steps that left D as it was",
            ),
        },
        coords={"time": ("time", np.arange(corner.shape[0]) - (corner.shape[0] - 1))},
    )


def claims(dataset):
    """Count the steps that contradict what the text says of D."""
    steps, repeated = int(dataset.n_steps), int(dataset.n_repeated)
    settings = dataset.attrs["settings"]
    kept, other = int(dataset.n_other_kept), int(dataset.n_other)
    rounding = settings["rounding"]
    changed = float(float(dataset.largest_change_repeated) > rounding)
    runs = f"N = {settings['n_particles']}, {settings['n_draws']} runs"
    return [
        verdict.Finding(
            "kac_52_monotone", int(dataset.n_growing), 0.0, evidence=f"{steps} steps, {runs}."
        ),
        verdict.Finding(
            "kac_52_same_pair",
            changed,
            0.0,
            evidence=f"{repeated} steps that repeat a pair; largest relative change "
            f"{float(dataset.largest_change_repeated):.1e}, {runs}.",
        ),
        verdict.Finding(
            "kac_52_shrinks",
            kept,
            0.0,
            evidence=f"{other} steps with another pair, {runs}; the text argues with three.",
        ),
    ]


def draw(dataset):
    """Draw the envelope of one coordinate from time -n to 0, linear and in its late stage."""
    figure, axes = plotting.panels(1, 2)
    time = dataset.time.values
    for k in range(dataset.sizes["corner_index"]):
        axes[0].step(time, dataset.path.values[:, k], where="post", color="0.7", lw=0.6)
    axes[0].step(time, dataset.upper, where="post", color=plotting.COLOURS[1], label="upper bound")
    style = {"where": "post", "color": plotting.COLOURS[0], "ls": "--", "label": "lower bound"}
    axes[0].step(time, dataset.lower, **style)
    axes[0].set_ylabel("$v_1$ of the corner points")
    axes[0].legend()
    gap = np.where(dataset.upper > dataset.lower, dataset.upper - dataset.lower, np.nan)
    axes[1].step(time, gap, where="post", color="0.6", lw=0.8, label="upper $-$ lower bound")
    axes[1].step(
        time, dataset.first_diameter, where="post", color=plotting.COLOURS[2], label="distance $D$"
    )
    tolerance = dataset.attrs["settings"]["tolerance"]
    axes[1].axhline(tolerance, color="black", ls=":", lw=1, label="tolerance $\\varepsilon$")
    axes[1].set_yscale("log")
    axes[1].set_ylabel("distance")
    axes[1].legend()
    for axis in axes:
        axis.set_xlabel("step, from the coupling time to 0")
    return figure
