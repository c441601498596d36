"""Fig. 6 of the Kac paper: bounding processes of perfect simulation, from a real run."""

import math

from kacsim.items import _corners
from kacsim.items._lazy import np, plotting, store, verdict, xr
from kacsim.kac.constants import MEAN_ENERGY

START_SHARE = 0.5  # of the energy, that one particle has where a sample path starts


def problems(settings):
    """Yield (key, sentence) of a tolerance that the run need not reach."""
    if settings["drawn_tolerance"] < settings["tolerance"]:
        yield "drawn_tolerance", f"must be at least tolerance = {settings['tolerance']}"


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
        _sandwich(sample, settings)
        | {
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


def _sandwich(sample, settings):
    """Return the last steps of the first run as Fig. 6 depicts them, with -T, -a and -b.

    T is the smallest power of two from which the bounds meet by time 0 (the run's own length if
    none does), -b the time at which they meet, -a that at which the sample paths between them do.
    """
    n, tolerance = settings["n_particles"], settings["drawn_tolerance"]
    radius = math.sqrt(MEAN_ENERGY * n)
    starts = START_SHARE * np.eye(n) + (1.0 - START_SHARE) / n
    longest = sample.sizes["step"]
    powers = [2**k for k in range(longest.bit_length()) if 2**k < longest]
    for n_steps in (*powers, longest):
        corners = radius * np.sqrt(_corners.walk(np.eye(n), sample, n_steps))
        coupled = _corners.diameters(corners) < tolerance
        if coupled[-1]:
            break
    paths = radius * np.sqrt(_corners.walk(starts, sample, n_steps))
    met = _corners.diameters(paths) < tolerance
    described, time = store.described, ("drawn_time",)
    return {
        "drawn_upper": described(corners[:, :, 0].max(axis=1), time, "largest v_1 of the corners"),
        "drawn_lower": described(corners[:, :, 0].min(axis=1), time, "smallest v_1 of the corners"),
        "sample_path": described(paths[:, :, 0], (*time, "start"), "v_1 of sample paths"),
        "drawn_time": described(np.arange(n_steps + 1) - n_steps, time, "steps before time 0"),
        "n_back": described(n_steps, (), "T, where the bounds start", "steps"),
        "n_met": described(n_steps - met.argmax(), (), "a, where the sample paths meet", "steps"),
        "n_coupled": described(n_steps - coupled.argmax(), (), "b, where the bounds meet", "steps"),
    }


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
    """Draw the bounds of one coordinate as Fig. 6 does, and the distances of the whole run."""
    figure, axes = plotting.panels(1, 2, height=3.1)
    _draw_sandwich(axes[0], dataset)
    time, right = dataset.time.values, axes[1]
    gap = np.where(dataset.upper > dataset.lower, dataset.upper - dataset.lower, np.nan)
    right.step(time, gap, where="post", color="0.6", lw=0.8, label="upper $-$ lower bound")
    style = {"where": "post", "color": plotting.COLOURS[2]}
    right.step(time, dataset.first_diameter, label="distance $D$", **style)
    tolerance = dataset.attrs["settings"]["tolerance"]
    right.axhline(tolerance, color="black", ls=":", lw=1, label="tolerance $\\varepsilon$")
    right.set_yscale("log")
    right.set_ylabel("distance")
    for axis in axes:
        axis.set_xlabel("time in steps")
    for axis, height in zip(axes, (1.07, 1.0), strict=True):
        plotting.legend_on_top(axis, height)
    return figure


def _draw_sandwich(axis, dataset):
    """Draw bounds and sample paths from -T to 0, and mark -T, -a and -b."""
    time = dataset.drawn_time.values
    for k, path in enumerate(dataset.sample_path.values.T):
        label = None if k else "sample paths"
        axis.step(time, path, where="post", color="0.65", lw=0.6, label=label)
    style = {"where": "post", "lw": 1.2}
    axis.step(time, dataset.drawn_upper, color=plotting.COLOURS[1], label="upper bound", **style)
    axis.step(
        time, dataset.drawn_lower, ls="--", color=plotting.COLOURS[0], label="lower bound", **style
    )
    marks = (("n_back", "T", "center"), ("n_met", "a", "right"), ("n_coupled", "b", "left"))
    for name, letter, side in marks:
        place = -int(dataset[name])
        axis.axvline(place, color="black", ls=":", lw=0.8, zorder=0)
        where = {"transform": axis.get_xaxis_transform(), "ha": side, "va": "bottom"}
        axis.text(place, 1.01, f"$-{letter}$", **where)
    axis.set_ylabel("velocity $v_1$")
