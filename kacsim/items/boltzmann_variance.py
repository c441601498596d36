"""Study: the second moment of Algorithm 2, infinite from t* on, and what that does to its bars."""

import math

from kacsim.cases import make_case
from kacsim.items._lazy import bkw, estimate, np, plotting, store, verdict, xr

HILL_SHARE = 0.2  # of the kept largest values: those taken for the index of the tail


def _moment_case(settings):
    return make_case(
        "bkw_moment",
        oversampling=[1.0],
        time=settings["time"],
        n_draws=settings["n_draws"],
        n_replicates=settings["n_replicates"],
        seed=settings["seed"],
        max_nodes=settings["max_nodes"],
    )


def cases(settings):
    """Return realizations of F / M at velocities drawn from M, in independent batches."""
    return [_moment_case(settings)]


def reduce(samples, settings):
    """Return second moments, tail indices, means of batches and the coverage of their bars."""
    sample = samples[_moment_case(settings).id].isel(oversampling=0)
    time = np.array(settings["time"], dtype=float)
    mean, square = sample["mean"].values, sample["mean_square"].values
    n_draws, n_batches = settings["n_draws"], settings["n_replicates"]
    error = np.sqrt(np.maximum(1e-300, square - mean**2) / n_draws)
    z = (mean - 1.0) / error
    covered = (np.abs(z) < 1.0).mean(axis=-1)
    described, one, two = store.described, ("time",), ("time", "batch")
    return xr.Dataset(
        {
            "second_moment": described(square.mean(axis=-1), one, "mean of (F / M)**2"),
            "second_moment_error": described(
                square.std(axis=-1, ddof=1) / np.sqrt(n_batches), one, "standard error"
            ),
            "second_moment_exact": described(bkw.second_moment(time), one, "G(t)"),
            "hill": described([_hill(row) for row in sample["top"].values], one, "Hill's index"),
            "hill_exact": described([bkw.tail_index(t) for t in time], one, "index of the tail"),
            "batch_mean": described(mean, two, "mean of a batch"),
            "batch_z": described(z, two, "(mean - 1) / estimated standard error"),
            "coverage": described(covered, one, "share of bars of one sigma that cover the mean"),
            "coverage_error": described(
                np.sqrt(covered * (1.0 - covered) / n_batches), one, "standard error"
            ),
            "critical_time": described(bkw.critical_time(), (), "time of infinite variance"),
        },
        coords={"time": settings["time"]},
    )


def _hill(top):
    """Return Hill's estimate of the tail index from the largest values, in descending order."""
    k = max(2, int(HILL_SHARE * top.size))
    logs = np.log(np.maximum(top[: k + 1], 1e-300))
    return 1.0 / (logs[:k] - logs[k]).mean()


def claims(dataset):
    """Test the second moment where its own variance is finite, and what a leaf adds to it."""
    early = dataset.isel(time=0)
    degrees = dataset.attrs["settings"]["n_replicates"] - 1
    moment = estimate.Mean(float(early.second_moment), float(early.second_moment_error), degrees)
    each = estimate.Exact(bkw.INITIAL_SECOND_MOMENT - 1.0)
    return [
        verdict.finding(
            "boltzmann_variance_moment",
            moment,
            f"At t = {float(early.time):g}.",
            printed=float(early.second_moment_exact),
        ),
        verdict.finding(
            "boltzmann_leaves_variance",
            each,
            "The leaves of a tree are independent Maxwellians if the probe is one: the second "
            "moment of a product over n leaves is the n-th power of that of one.",
        ),
    ]


def draw(dataset):
    """Draw the second moment, the distribution of batch means, and coverage with tail index."""
    figure, axes = plotting.panels(2, 2)
    time = dataset.time.values
    grid = np.linspace(0.0, float(dataset.critical_time) - 0.01, 200)
    axes[0].plot(grid, bkw.second_moment(grid), color="black", lw=1, label="$G(t)$")
    style = {"line": False}
    plotting.points(
        axes[0], time, dataset.second_moment, dataset.second_moment_error, 0, "measured", **style
    )
    axes[0].axvline(float(dataset.critical_time), color="0.4", ls=":", label="$t^*$")
    axes[0].set_yscale("log")
    axes[0].set_ylabel("E[$(F/M)^2$]")
    axes[0].legend()
    bins = np.linspace(-6, 6, 49)
    for k, place in enumerate((0, -1)):
        here = dataset.isel(time=place)
        label = f"$t$ = {float(here.time):g}"
        axes[1].hist(
            np.clip(here.batch_z, -6, 6),
            bins,
            density=True,
            histtype="step",
            color=plotting.COLOURS[k],
            label=label,
        )
    axes[1].plot(bins, np.exp(-(bins**2) / 2) / np.sqrt(2 * np.pi), color="black", lw=1)
    axes[1].set_xlabel("(batch mean $-$ 1) / its error")
    axes[1].set_ylabel("density")
    axes[1].legend()
    plotting.points(
        axes[2], time, dataset.coverage, dataset.coverage_error, 0, "coverage of $\\pm\\sigma$"
    )
    axes[2].axhline(math.erf(math.sqrt(0.5)), color=plotting.COLOURS[0], ls=":", lw=1)
    axes[2].set_ylim(0, 1)
    axes[2].set_ylabel("coverage of the bars")
    axes[3].plot(time, dataset.hill, "s", color=plotting.COLOURS[1], ms=4, label="Hill's index")
    axes[3].plot(time, dataset.hill_exact, color="black", lw=1, label="predicted index")
    axes[3].axhline(2.0, color="0.4", ls=":", lw=1, label="variance infinite below")
    axes[3].set_ylabel("index of the tail")
    axes[3].legend()
    for axis in (axes[0], axes[2], axes[3]):
        axis.set_xlabel("time $t$ in mean collision times")
    return figure
