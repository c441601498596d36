"""Study: intervals for Algorithm 2 from the time on where its variance is infinite.

The index of the tail is known exactly, so that the law of a mean is known but for its scale.
"""

import math

from kacsim.cases import make_case
from kacsim.items._lazy import bkw, np, plotting, stable, store, xr

WAYS = {
    "normal": "mean ± standard error",
    "stable": "stable law, index known",
    "blocks": "Student's ratio of blocks",
}


def _case(settings):
    return make_case(
        "bkw",
        speed=settings["speed"],
        time=settings["time"],
        max_nodes=settings["max_nodes"],
        n_draws=settings["n_draws"],
        n_replicates=settings["n_blocks"] * settings["n_runs"],
        seed=settings["seed"],
    )


def cases(settings):
    """Return realizations of Algorithm 2 in blocks, of which several make a run."""
    return [_case(settings)]


def reduce(samples, settings):
    """Return how many runs' intervals cover the exact value, three ways, and how long they are."""
    sample, block = samples[_case(settings).id], settings["n_draws"]
    runs = (settings["n_runs"], settings["n_blocks"])
    speed, time = (np.array(settings[name], float) for name in ("speed", "time"))
    shape = (len(WAYS), speed.size, time.size)
    covered, length = np.full(shape, np.nan), np.full(shape, np.nan)
    index = np.array([bkw.tail_index(one) for one in time])
    for i, j in np.ndindex(shape[1:]):
        mean, square, largest = (
            sample[name].values[i, j].reshape(runs) for name in ("mean", "mean_square", "largest")
        )
        exact = float(bkw.relative_density(speed[i], time[j]))
        for k, (low, high) in enumerate(_intervals(mean, square, largest, block, index[j])):
            covered[k, i, j] = ((low < exact) & (exact < high)).mean()
            length[k, i, j] = np.median(high - low) / exact
    dims, described = ("way", "speed", "time"), store.described
    spread = math.sqrt(stable.LEVEL * (1.0 - stable.LEVEL) / settings["n_runs"])
    n = block * settings["n_blocks"]
    return xr.Dataset(
        {
            "coverage": described(covered, dims, "share of runs whose interval covers the value"),
            "coverage_error": described(
                spread, (), "its standard deviation if intervals are right"
            ),
            "nominal": described(stable.LEVEL, (), "share of right intervals that cover"),
            "length": described(length, dims, "median length over the exact value"),
            "index": described(index, ("time",), "index of the tail, exact"),
            "n_draws": described(n, (), "realizations of a run"),
            "critical_time": described(bkw.critical_time(), (), "time of infinite variance"),
        },
        coords={"way": list(WAYS), "speed": speed, "time": time},
    )


def _intervals(mean, square, largest, block, index):
    """Yield (low, high), float64[run] each, of every way; the stable one only below index 2."""
    whole, n = mean.mean(axis=-1), block * mean.shape[-1]
    error = np.sqrt(np.maximum(square.mean(axis=-1) - whole**2, 0.0) / (n - 1))
    yield whole - error, whole + error
    if index < 2.0:
        constant = stable.frechet_constant(largest, block, index)
        yield stable.stable_interval(whole, n, constant, index)
    else:
        yield np.full_like(whole, np.nan), np.full_like(whole, np.nan)
    yield stable.blocked_interval(mean, square, block)


def draw(dataset):
    """Draw coverage and length of the intervals against time, a column per speed."""
    figure, axes = plotting.panels(2, dataset.sizes["speed"], share_y=False)
    count = dataset.sizes["speed"]
    time = dataset.time.values
    for j, speed in enumerate(dataset.speed.values):
        top, low = axes[j], axes[count + j]
        for k, way in enumerate(WAYS):
            here = dataset.sel(way=way, speed=speed)
            known = np.isfinite(here.length.values)
            error = np.full(known.sum(), float(dataset.coverage_error))
            beside = time[known] + 0.02 * (k - 1)
            plotting.points(top, beside, here.coverage[known], error, k, WAYS[way], line=False)
            plotting.points(low, time[known], here.length[known], None, k, WAYS[way])
        top.axhline(float(dataset.nominal), color="0.4", lw=1, label="if intervals are right")
        for axis in (top, low):
            axis.axvline(float(dataset.critical_time), color="0.4", lw=1, ls=":")
        top.set_ylim(0.0, 1.0)
        top.set_title(f"$c$ = {speed:g} $c_q$")
        top.set_ylabel("coverage")
        low.set_yscale("log")
        low.set_ylabel("length / exact value")
        low.set_xlabel("mean collision times")
    axes[0].legend(fontsize=7, loc="lower left")
    return figure
