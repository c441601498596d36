"""Study: sample means of the chapter, their spread and their law, from binomial sums."""

import itertools
import math

from kacsim.items._lazy import estimate, plotting, store, techniques_exact, verdict, xr

WIDTHS = (1, 2, 3)  # standard errors
SHARE = math.pi**2 / 32.0  # of the values 1: the 4-sphere's part of the unit cube
FEW, MANY = 64, 4096  # points between which the power of N is taken


def problems(settings):
    """Yield (key, sentence) of sizes that do not grow."""
    sizes = settings["n_samples"]
    if any(b <= a for a, b in itertools.pairwise(sizes)):
        yield "n_samples", "must grow from each value to the next"


def cases(settings):
    """Return nothing: sums over the binomial law are exact."""
    return []


def reduce(samples, settings):
    """Return how often means are near, and the mean of the sample variance, against N."""
    sizes = settings["n_samples"]
    near = [[techniques_exact.coverage(n, SHARE, width) for width in WIDTHS] for n in sizes]
    variance = [techniques_exact.sample_variance(n, SHARE) for n in sizes]
    error = [techniques_exact.share_error(n, SHARE) for n in sizes]
    ends = [techniques_exact.share_error(n, SHARE) for n in (FEW, MANY)]
    described = store.described
    return xr.Dataset(
        {
            "near": described(
                near, ("n_samples", "width"), "probability of a mean so many standard errors near"
            ),
            "normal": described(
                [math.erf(width / math.sqrt(2.0)) for width in WIDTHS], ("width",), "normal law"
            ),
            "variance": described(variance, ("n_samples",), "mean of S_N^2 over S^2"),
            "error": described(error, ("n_samples",), "rms relative error of the share"),
            "power": described(
                math.log(ends[1] / ends[0]) / math.log(MANY / FEW), (), "power of N of that error"
            ),
        },
        coords={"n_samples": sizes, "width": list(WIDTHS)},
    )


def claims(dataset):
    """Test the sample variance, the law of a mean and the error of a share, all exact."""
    least, most = (dataset.isel(n_samples=k) for k in (0, -1))
    n = int(most.n_samples)
    unbiased = [
        verdict.Part(
            estimate.Exact(float(here.variance)),
            f"N = {int(here.n_samples)}",
            printed=1.0,
            rival=1.0 - 1.0 / int(here.n_samples),
        )
        for here in (least, dataset.isel(n_samples=1))
    ]
    near = [
        verdict.Part(
            estimate.Exact(float(most.near.sel(width=width))),
            f"within {width}",
            printed=float(most.normal.sel(width=width)),
        )
        for width in WIDTHS
    ]
    return [
        verdict.Finding("techniques_means_unbiased", tuple(unbiased), "The rival divides by N."),
        verdict.Finding(
            "techniques_means_normal",
            tuple(near),
            f"Share of points in the 4-sphere, N = {n:.0e}; a sum over the binomial law. The "
            "section speaks of laws with a variance: the mean of N values of a Lorentzian, which "
            "has none, is spread like one value at every N.",
        ),
        verdict.finding(
            "techniques_means_root",
            estimate.Exact(float(dataset.power)),
            f"Between N = {FEW} and {MANY}; a sum over the binomial law.",
            printed=-0.5,
        ),
    ]


def draw(dataset):
    """Draw how often means are near against N, and the sample variance with N and with N - 1."""
    figure, axes = plotting.panels(1, 2)
    n = dataset.n_samples.values
    for k, width in enumerate(dataset.width.values):
        near, colour = dataset.near.sel(width=width), plotting.COLOURS[k]
        axes[0].plot(n, near, plotting.MARKERS[k], ms=4, color=colour, label=f"within {width}")
        axes[0].axhline(float(dataset.normal.sel(width=width)), color=colour, lw=1)
    axes[0].set_ylabel("probability")
    axes[0].set_ylim(0.35, 1.03)
    axes[0].legend(title="standard errors", loc="lower right")
    axes[1].plot(n, dataset.variance, "o", ms=4, color=plotting.COLOURS[0], label="eq. (11.7)")
    rival = dataset.variance * (1.0 - 1.0 / dataset.n_samples)
    axes[1].plot(n, rival, "s", ms=4, color=plotting.COLOURS[1], label="$N$ for $N-1$")
    axes[1].axhline(1.0, color="black", lw=1)
    axes[1].set_ylabel("mean of $S_N^2$ over $S^2$")
    axes[1].legend(loc="lower right")
    for axis in axes:
        axis.set_xscale("log")
        axis.set_xlabel("samples behind a mean $N$")
    return figure
