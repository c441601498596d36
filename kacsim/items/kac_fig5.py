"""Fig. 5 of the Kac paper: histograms of upper tail values of v_1, Bird and Poisson."""

from kacsim.items import _kac
from kacsim.items._lazy import estimate, exact, histogram, np, plotting, store, tail, verdict, xr
from kacsim.kac.samplers import TITLES

COMPARED = ("bird", "poisson")
VARIABLES = ("tail_share", "tail_low", "tail_high")


def cases(settings):
    """Return both algorithms, keeping values above the threshold."""
    above = settings["tail_above"]
    return [
        _kac.velocity_case(settings, name, settings["n_particles"], keep_above=above)
        for name in COMPARED
    ]


def reduce(samples, settings):
    """Return histograms of the first tail values, and tail probabilities with exact intervals."""
    found = cases(settings)
    edges = histogram.fine_edges()
    edges = edges[edges >= settings["tail_above"] - 1e-9]
    kept = [samples[case.id]["kept_velocity"].values for case in found]
    heights = [np.histogram(v, edges)[0] / v.size / np.diff(edges) for v in kept]
    thresholds = settings["tail_threshold"]
    shares = np.array([[_share(samples[c.id], c, x) for x in thresholds] for c in found])
    described, dims = store.described, ("algorithm", "threshold")
    variables = {
        "density": described(heights, ("algorithm", "bin"), "histogram of the kept tail values"),
        "n_kept": described([v.size for v in kept], ("algorithm",), "tail values kept"),
        "n_draws": described([_kac.n_draws_of(c) for c in found], ("algorithm",), "draws"),
        "tail_exact": described(
            exact.survival(thresholds, settings["time"]), ("threshold",), "P(v > x) of eq. (8)"
        ),
    }
    excess = [_excess(samples[case.id], edges) for case in found]
    law = np.diff(exact.survival(edges, settings["time"])) * -1.0
    variables |= {
        "excess": described([e.value for e in excess], ("algorithm",), "mean excess over the edge"),
        "excess_error": described(
            [e.standard_error for e in excess],
            ("algorithm",),
            "standard error, from the tail values",
        ),
        "excess_exact": described(
            np.average(_excesses(edges), weights=law), (), "mean excess of eq. (8), same bins"
        ),
        "n_beyond": described(
            [_beyond(samples[case.id], edges).sum() for case in found],
            ("algorithm",),
            "draws of |v_1| beyond the edge",
        ),
    }
    for k, name in enumerate(VARIABLES):
        variables[name] = described(shares[:, :, k], dims, name.replace("_", " ") + " of v_1 > x")
    coords = {"algorithm": list(COMPARED), "threshold": thresholds, "edge": edges}
    return xr.Dataset(variables, coords={key: (key, values) for key, values in coords.items()})


def _share(sample, case, threshold):
    count = tail.counts_beyond(sample["counts"].values.sum(axis=0), threshold)
    n = _kac.n_draws_of(case)
    return (count / n, *tail.clopper_pearson(count, n))


def _excesses(edges):
    """Return how far the middle of each fine bin lies beyond the first edge."""
    return 0.5 * (edges[1:] + edges[:-1]) - edges[0]


def _beyond(sample, edges):
    """Return the draws of |v_1| in the fine bins beyond the first edge, both tails together."""
    counts = sample["counts"].values.sum(axis=0)[1:-1]
    return (counts + counts[::-1])[-(edges.size - 1) :]


def _excess(sample, edges):
    """Return the mean excess of |v_1| over the first edge, among the draws beyond it."""
    counts, excess = _beyond(sample, edges), _excesses(edges)
    mean = np.average(excess, weights=counts)
    variance = np.average((excess - mean) ** 2, weights=counts)
    return estimate.Mean(float(mean), float(np.sqrt(variance / counts.sum())))


def claims(dataset):
    """Test the shape of the tail, and say what the intervals of the picture seem to show."""
    above = dataset.attrs["settings"]["tail_above"]
    parts = []
    for name in COMPARED:
        mean = _kac.mean_of(dataset, "excess", algorithm=name)
        exactly = float(dataset.excess_exact)
        parts.append(verdict.Part(mean, TITLES[name], printed=exactly))
    evidence = (
        f"Mean of |v₁| − {above:g} given |v₁| > {above:g}, in fine bins. {_misses(dataset)} "
        "Thresholds share their draws, and each algorithm has as many intervals as thresholds: "
        "one or two of them miss without a cause."
    )
    return [verdict.Finding("kac_fig5_shape", tuple(parts), evidence)]


def _misses(dataset):
    """Return at which thresholds the 95 % interval of a tail probability misses the exact one."""
    words = []
    for name in COMPARED:
        here = dataset.sel(algorithm=name)
        low, high = here.tail_low > here.tail_exact, here.tail_high < here.tail_exact
        places = ", ".join(f"{x:g}" for x in here.threshold.values[(low | high).values])
        words.append(
            f"{name.capitalize()} at {places}" if places else f"{name.capitalize()} nowhere"
        )
    return f"Intervals on the right of the figure that miss the exact tail: {'; '.join(words)}."


def draw(dataset):
    """Draw the tail histograms, and the tail probabilities relative to eq. (8)."""
    settings = dataset.attrs["settings"]
    figure, axes = plotting.panels(1, len(COMPARED) + 1)
    grid = np.linspace(settings["tail_above"], 6.0, 200)
    scale = exact.survival(settings["tail_above"], settings["time"])
    for k, algorithm in enumerate(COMPARED):
        axis, here = axes[k], dataset.sel(algorithm=algorithm)
        plotting.bars(axis, here.edge, here.density, k, f"{int(here.n_kept):,} values")
        curve = exact.density(grid, settings["time"]) / scale
        axis.plot(grid, curve, color="black", lw=1, label="eq. (8)")
        axis.set_yscale("log")
        axis.set_ylim(1e-4, 10)
        axis.set_xlim(settings["tail_above"], 6.0)
        axis.set_title(TITLES[algorithm])
        axis.set_xlabel("velocity $v_1$")
        axis.legend()
        _ratios(axes[-1], here, k)
    axes[0].set_ylabel(f"density of $v_1$ given $v_1$ > {settings['tail_above']:g}")
    axes[-1].axhline(1.0, color="black", lw=1)
    axes[-1].set_xlabel("threshold $x$")
    axes[-1].set_ylabel("P($v_1$ > $x$) / exact, 95 % intervals")
    axes[-1].legend()
    return figure


def _ratios(axis, here, k):
    ratio, low, high = (here[name] / here.tail_exact for name in VARIABLES)
    errors = np.maximum(0.0, [ratio - low, high - ratio])
    shifted = here.threshold + 0.03 * (k - 0.5)
    name = TITLES[str(here.algorithm.values)]
    plotting.points(axis, shifted, ratio, errors, k, name, line=False)
    axis.set_xticks(here.threshold.values)
