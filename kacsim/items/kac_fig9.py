"""Fig. 9 of the Kac paper: histogram of epsilon-perfect draws with the limit law, eq. (9)."""

import math

from kacsim.cases import make_case
from kacsim.items import _kac
from kacsim.items._lazy import exact, histogram, np, plotting, store, verdict, xr

ENERGIES = ("three_halves", "printed")


def cases(settings):
    """Return the draws with energy 3N/2, and with the energy N that the text assumes."""
    keys = ("n_particles", "tolerance", "n_draws", "n_replicates", "seed")
    common = {key: settings[key] for key in keys}
    printed = float(settings["n_particles"])
    return [make_case("kac_equilibrium", energy=energy, **common) for energy in (None, printed)]


def reduce(samples, settings):
    """Return histograms, TVN and fourth moments for both energies, and the coupling times."""
    width, n = settings["bin_width"], settings["n_particles"]
    expected, edges = _kac.target(settings, width, math.inf)
    table = [_energy(samples[case.id], case, expected, width) for case in cases(settings)]
    finite = histogram.probabilities(lambda v: exact.equilibrium_cumulative(v, n), edges)
    sample, described = samples[cases(settings)[0].id], store.described
    dims = ("energy",)
    variables = {
        name: described([row[name] for row in table], dims, text)
        for name, text in {
            "tvn": "TVN of all draws against eq. (9)",
            "moment": "mean of v_1**4",
            "moment_error": "standard error of the mean of v_1**4",
            "moment_exact": "exact mean of v_1**4 at this N and energy",
        }.items()
    }
    n_draws = _kac.n_draws_of(cases(settings)[0])
    variables |= {
        name: described([row[name] for row in table], ("energy", "bin"), text)
        for name, text in {
            "density": "histogram of all draws",
            "finite_density": "exact law of N particles at this energy, mean over a bin",
        }.items()
    }
    excess, wide = _excess(samples[cases(settings)[0].id], settings)
    variables |= excess
    variables |= {
        "floor": described(histogram.noise_floor(expected, n_draws), (), "TVN of exact draws"),
        "floor_spread": described(
            histogram.noise_spread(expected, n_draws), (), "standard deviation of that TVN"
        ),
        "tvn_predicted": described(
            0.5 * np.abs(finite - expected).sum(), (), "TVN of the exact N-particle law"
        ),
        "coupling_time": sample["coupling_time"],
    }
    variables |= _coupling(sample, n_draws)
    coords = {"energy": list(ENERGIES), "edge": ("edge", edges), "wide_edge": ("wide_edge", wide)}
    return xr.Dataset(variables, coords=coords)


def _excess(sample, settings):
    """Return (what the draws and the law of N particles have over eq. (9), edges of wide bins)."""
    width, n = max(_kac.widths(settings)), settings["n_particles"]
    counts, edges = histogram.coarsen(sample["counts"].values.sum(axis=0), width)
    limit, _ = _kac.target(settings, width, math.inf)
    law = histogram.probabilities(lambda v: exact.equilibrium_cumulative(v, n), edges)
    n_draws = counts.sum()
    found = {
        "excess": (counts / n_draws - limit, "density of all draws less eq. (9)"),
        "excess_error": (np.sqrt(law * (1.0 - law) / n_draws), "its standard deviation"),
        "finite_excess": (law - limit, "density of the exact N-particle law less eq. (9)"),
    }
    variables = {
        name: store.described(part[1:-1] / width, ("wide_bin",), text)
        for name, (part, text) in found.items()
    }
    return variables, edges


def _energy(sample, case, expected, width):
    counts, edges = histogram.coarsen(sample["counts"].values.sum(axis=0), width)
    moment = _kac.fourth_moment_of(sample, case)
    p = case.parameters
    law = histogram.probabilities(
        lambda v: exact.equilibrium_cumulative(v, p["n_particles"], p["energy"]), edges
    )
    return {
        "tvn": float(histogram.total_variation(counts, expected)),
        "moment": moment.value,
        "moment_error": moment.standard_error,
        "moment_exact": exact.equilibrium_fourth_moment(p["n_particles"], p["energy"]),
        "density": counts[1:-1] / counts.sum() / np.diff(edges),
        "finite_density": law[1:-1] / np.diff(edges),
    }


def _coupling(sample, n_draws):
    """Return mean, spread and range of the coupling time, and how far the range varies."""
    described = store.described
    variance = sample["coupling_variance"].mean() + sample["coupling_mean"].var()
    low, high = sample["coupling_min"].values, sample["coupling_max"].values
    numbers = {
        "coupling_mean": (sample["coupling_mean"].mean(), "mean coupling time"),
        "coupling_error": (np.sqrt(variance / n_draws), "standard error of the mean"),
        "coupling_spread": (np.sqrt(variance), "standard deviation of the coupling time"),
        "coupling_min": (low.min(), "smallest coupling time"),
        "coupling_max": (high.max(), "largest coupling time"),
        "coupling_min_spread": (low.std(ddof=min(1, low.size - 1)), "spread of replicates' minima"),
        "coupling_max_spread": (
            high.std(ddof=min(1, low.size - 1)),
            "spread of replicates' maxima",
        ),
    }
    return {name: described(value, (), text, "steps") for name, (value, text) in numbers.items()}


def claims(dataset):
    """Compare the coupling times and the histogram with what the text prints."""
    settings = dataset.attrs["settings"]
    n_draws = settings["n_draws"] * settings["n_replicates"]
    spread = float(dataset.coupling_spread)
    size = f"{n_draws} draws, standard deviation {spread:.0f}"
    found = [
        verdict.Finding(
            "kac_fig9_coupling_mean",
            float(dataset.coupling_mean),
            float(dataset.coupling_error),
            published_error=float(dataset.coupling_error),
            evidence=f"{size}. The literal algorithm gives the same times, draw by draw.",
        )
    ]
    for end in ("min", "max"):
        found.append(
            verdict.Finding(
                f"kac_fig9_coupling_{end}",
                float(dataset[f"coupling_{end}"]),
                0.0,
                published_error=max(1.0, float(dataset[f"coupling_{end}_spread"])),
                evidence="Error: spread of the extreme over the replicates.",
            )
        )
    return [*found, _histogram_claim(dataset, n_draws), _energy_claim(dataset)]


def _histogram_claim(dataset, n_draws):
    """Test whether the histogram follows eq. (9): its TVN against that of exact draws."""
    return verdict.Finding(
        "kac_fig9_histogram",
        float(dataset.tvn.sel(energy="three_halves")),
        float(dataset.floor_spread),
        printed=float(dataset.floor),
        evidence=f"Noise floor {float(dataset.floor):.4f} for {n_draws} draws; the exact law of "
        f"N particles is {float(dataset.tvn_predicted):.4f} away from eq. (9).",
    )


def _energy_claim(dataset):
    """Test E = N: does it give the fourth moment that eq. (9) has at this N?"""
    moment = _kac.mean_of(dataset, "moment", energy="printed")
    return verdict.Finding(
        "kac_3_energy",
        moment.value,
        moment.standard_error,
        printed=float(dataset.moment_exact.sel(energy="three_halves")),
        corrected=float(dataset.moment_exact.sel(energy="printed")),
        evidence=f"TVN against eq. (9): {float(dataset.tvn[1]):.3f} with E = N, "
        f"{float(dataset.tvn[0]):.4f} with E = 3N/2.",
    )


def draw(dataset):
    """Draw the histogram, what it has over eq. (9), the coupling times, and energy N."""
    figure, axes = plotting.panels(2, 2)
    names = [f"draws, $E$ = {energy}" for energy in ("$3N/2$", "$N$")]
    for k, (axis, energy) in enumerate(zip(axes[::3], ENERGIES, strict=True)):
        here = dataset.sel(energy=energy)
        plotting.bars(axis, here.edge, here.density, k, names[k])
        plotting.solution(axis, math.inf, "eq. (9)")
        middle = 0.5 * (here.edge.values[1:] + here.edge.values[:-1])
        axis.plot(middle, here.finite_density, **_finite(dataset))
        plotting.density_axis(axis)
    _draw_excess(axes[2], dataset, names[0])
    for axis in (axes[0], axes[2], axes[3]):
        plotting.velocity_axis(axis)
    _draw_times(axes[1], dataset)
    for axis in axes:
        plotting.legend_on_top(axis)
    return figure


def _finite(dataset):
    """Return the style and the label of the exact law of N particles."""
    n = dataset.attrs["settings"]["n_particles"]
    return {"color": plotting.COLOURS[2], "ls": "--", "lw": 1.2, "label": f"exact, $N$ = {n}"}


def _draw_excess(axis, dataset, label):
    """Draw what the draws and the law of N particles have over eq. (9), bin by bin."""
    edge = dataset.wide_edge.values
    middle = 0.5 * (edge[1:] + edge[:-1])
    plotting.points(axis, middle, dataset.excess, dataset.excess_error, 0, label, line=False)
    axis.axhline(0.0, color="black", lw=1, label="eq. (9)")
    axis.stairs(dataset.finite_excess, edge, baseline=None, **_finite(dataset))
    axis.set_ylabel("density $-$ eq. (9)")


def _draw_times(axis, dataset):
    """Draw the histogram of coupling times with the published mean and range."""
    style = {"bins": 60, "density": True, "color": plotting.COLOURS[0], "alpha": 0.6}
    axis.hist(dataset.coupling_time.values, label="this run", **style)
    published = {
        key: dataset.attrs["published"][f"kac_fig9_coupling_{key}"]
        for key in ("mean", "min", "max")
    }
    axis.axvline(published["mean"], color=plotting.COLOURS[1], label="published mean")
    band = {"color": "#f8e3d5", "lw": 0, "zorder": 0, "label": "published range"}
    axis.axvspan(published["min"], published["max"], **band)
    axis.set_xlim(left=0.0)
    axis.set_xlabel("coupling time in steps")
    axis.set_ylabel("density")
