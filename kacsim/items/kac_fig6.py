"""Fig. 6 of the Kac paper: bounding processes of perfect simulation, from a real run."""

import math

from kacsim.items import _corners
from kacsim.items._lazy import estimate, np, plotting, store, verdict, xr
from kacsim.kac.constants import MEAN_ENERGY

START_SHARE = 0.5  # of the energy, that one particle has where a sample path starts
N_STARTS = 200  # starts of the paths that are looked for outside the bounds


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
    described, path = store.described, ("time",)
    start = math.sqrt(2.0 * MEAN_ENERGY * settings["n_particles"])  # of two corners
    counts, _ = _corners.step_counts(sample, settings)
    diameter = sample["diameter"].values[0, : corner.shape[0] - 1]
    return xr.Dataset(
        _sandwich(sample, settings)
        | counts
        | _bounded(sample, settings)
        | {
            "upper": described(corner.max(axis=1), path, "largest v_1 of the corners"),
            "lower": described(corner.min(axis=1), path, "smallest v_1 of the corners"),
            "first_diameter": described(
                np.r_[start, diameter], path, "largest distance D, first run"
            ),
            "ratio_of_four": described(_disjoint(), (), "D after pair (3, 4) over D after (1, 2)"),
        },
        coords={"time": ("time", np.arange(corner.shape[0]) - (corner.shape[0] - 1))},
    )


def _bounded(sample, settings):
    """Return how many coordinates of sample paths were looked at, and were outside the bounds.

    Paths from starts all over the state space, along the whole first run. Energies of any start
    are a weighted mean of the corners', and each step is linear in energies.
    """
    n, steps = settings["n_particles"], sample.sizes["step"]
    # Multiples of square roots modulo 1: starts that fill the space evenly without being drawn.
    roots = np.sqrt([p for p in range(2, 8 * n * n) if all(p % k for k in range(2, p))][:n])
    spaced = -np.log(np.arange(1, N_STARTS + 1)[:, None] * roots % 1.0)
    paths = _corners.walk(spaced / spaced.sum(axis=1, keepdims=True), sample, steps)
    corners = _corners.walk(np.eye(n), sample, steps)
    low, high = corners.min(axis=1, keepdims=True), corners.max(axis=1, keepdims=True)
    outside = (paths < low - settings["rounding"]) | (paths > high + settings["rounding"])
    described = store.described
    return {
        "n_bounded": described(paths.size, (), "coordinates of sample paths looked at"),
        "n_outside": described(outside.sum(), (), "those outside the corners' bounds"),
    }


def _disjoint():
    """Return D after the pairs (1, 2) and (3, 4) of four particles over D after the first."""
    angle = math.pi / 5.0  # any: two corners that share no coordinate stay so
    corners = _corners.rotate(np.eye(4), (1, 2), angle)
    both = np.stack([corners, _corners.rotate(corners, (3, 4), angle)])
    return float(np.divide(*_corners.diameters(both)[::-1]))


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
    """Count what contradicts the text on D and the bounds."""
    settings = dataset.attrs["settings"]
    steps, runs = int(dataset.n_steps), f"N = {settings['n_particles']}, {settings['n_draws']} runs"
    bounded = int(dataset.n_bounded)
    return [
        verdict.finding(
            "kac_52_monotone",
            estimate.Share(int(dataset.n_growing), steps),
            f"{steps} steps, {runs}.",
        ),
        verdict.finding(
            "kac_51_bounds",
            estimate.Exact(int(dataset.n_outside) / bounded),
            f"{bounded} coordinates of {N_STARTS} paths along one run, N = "
            f"{settings['n_particles']}.",
        ),
        verdict.finding(
            "kac_52_four",
            estimate.Exact(float(dataset.ratio_of_four)),
            f"Of {int(dataset.n_other)} steps with another pair, {runs}, "
            f"{int(dataset.n_other_kept)} left D as it was.",
            printed=1.0,
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
