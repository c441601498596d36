"""Fig. 9 of the Kac paper: histogram of epsilon-perfect draws with the limit law, eq. (9)."""

import math

from kacsim.cases import make_case
from kacsim.items import _kac
from kacsim.items._lazy import estimate, exact, histogram, np, plotting, store, verdict, xr
from kacsim.kac.constants import MEAN_ENERGY

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
    variables |= _coupling(sample, n_draws) | _laws(expected, edges, n)
    counts, _ = histogram.coarsen(sample["counts"].values.sum(axis=0), width)
    apart = float(histogram.total_variation(counts, finite))
    variables["tvn_finite"] = described(apart, (), "TVN of all draws against that law")
    coords = {"energy": list(ENERGIES), "edge": ("edge", edges), "wide_edge": ("wide_edge", wide)}
    return xr.Dataset(variables, coords=coords)


def _laws(expected, edges, n):
    """Return exact numbers of the law with a drawn energy, of f0 and of eq. (9)."""
    drawn = histogram.probabilities(lambda v: exact.drawn_cumulative(v, n), edges)
    v = np.linspace(-12.0, 12.0, 2401)  # beyond, the densities are below 1e-40
    numbers = {
        "tvn_drawn": (0.5 * np.abs(drawn - expected).sum(), "its TVN where energies are drawn"),
        "moment_drawn": (exact.drawn_fourth_moment(n), "its mean of v_1**4 where they are drawn"),
        "moment_limit": (np.trapezoid(v**4 * exact.density(v, math.inf), v), "E v**4 of eq. (9)"),
        "initial_energy": (np.trapezoid(v**2 * exact.density(v, 0.0), v), "E v**2 of f0"),
        "limit_energy": (np.trapezoid(v**2 * exact.density(v, math.inf), v), "E v**2 of eq. (9)"),
    }
    return {name: store.described(value, (), text) for name, (value, text) in numbers.items()}


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
    times = sample["coupling_time"].values.astype(float)
    # Steps of each corner: 1 + 2 + ... + t one at a time; 1 + 2 + 4 + ... by doubling.
    doubled = 2.0 ** (np.ceil(np.log2(times)) + 1.0) - 1.0
    ratio = 0.5 * times * (times + 1.0) / doubled
    error = ratio.std() / math.sqrt(ratio.size)
    return {
        name: described(value, (), text, "steps") for name, (value, text) in numbers.items()
    } | {
        "work_ratio": described(ratio.mean(), (), "steps one at a time over those by doubling"),
        "work_ratio_error": described(error, (), "standard error of that mean"),
    }


def claims(dataset):
    """Compare the coupling times, the law and the energy with what the text prints."""
    settings = dataset.attrs["settings"]
    n_draws = settings["n_draws"] * settings["n_replicates"]
    spread = float(dataset.coupling_spread)
    mean = estimate.Mean(float(dataset.coupling_mean), float(dataset.coupling_error))
    evidence = (
        f"{n_draws} draws, standard deviation {spread:.0f}. The literal algorithm gives the same "
        "times, draw by draw."
    )
    return [
        verdict.finding("kac_fig9_coupling_mean", mean, evidence),
        _extreme(dataset, "min", n_draws),
        _extreme(dataset, "max", n_draws),
        _histogram_claim(dataset, n_draws),
        _energy_claim(dataset),
        verdict.finding(
            "kac_52_doubling_cost",
            _kac.mean_of(dataset, "work_ratio"),
            f"Mean over {dataset.sizes['draw']} coupling times of this run.",
        ),
    ]


def _extreme(dataset, end, n_draws):
    """Return the finding on an extreme of all draws, which are as many as the published ones.

    Its deviation is that of the replicates' extremes: those of fewer draws vary more.
    """
    error = float(dataset[f"coupling_{end}_spread"])
    n_replicates = dataset.attrs["settings"]["n_replicates"]
    measured = estimate.Mean(float(dataset[f"coupling_{end}"]), error, n_replicates - 1)
    evidence = (
        f"Of {n_draws} draws. The extremes of the {n_replicates} replicates have a standard "
        f"deviation of {error:.0f}, which is more than that of all."
    )
    return verdict.finding(f"kac_fig9_coupling_{end}", measured, evidence)


def _histogram_claim(dataset, n_draws):
    """Return how far the laws of N particles are from the curve, eq. (9)."""
    moment = _kac.mean_of(dataset, "moment", energy="three_halves")
    z = moment.z(float(dataset.moment_exact.sel(energy="three_halves")))
    parts = tuple(
        verdict.Part(estimate.Exact(float(dataset[name])), label)
        for name, label in (("tvn_predicted", "E = 3N/2"), ("tvn_drawn", "E drawn"))
    )
    evidence = (
        f"TVN in bins of {dataset.attrs['settings']['bin_width']:g}; that of {n_draws} draws "
        f"against eq. (9) is {float(dataset.tvn[0]):.4f}, against the law of N particles "
        f"{float(dataset.tvn_finite):.4f}, where exact draws have {float(dataset.floor):.4f} "
        f"± {float(dataset.floor_spread):.4f}. Their E v₁⁴ is {moment.value:.2f}, z = {z:.1f} "
        "against that law."
    )
    return verdict.Finding("kac_fig9_histogram", parts, evidence)


def _energy_claim(dataset):
    """Return the mean energy of one particle under the laws that the text states."""
    parts = tuple(
        verdict.Part(
            estimate.Exact(float(dataset[name])), label, printed=1.0, corrected=MEAN_ENERGY
        )
        for name, label in (("initial_energy", "initial density"), ("limit_energy", "eq. (9)"))
    )
    exact_moment = dataset.moment_exact.values
    evidence = (
        "The text does not say that Fig. 9 took E = N, and section 5.2 takes E = Σv². E v₁⁴ at "
        f"this N is {float(dataset.moment_drawn):.3f} with that, {exact_moment[0]:.3f} with "
        f"E = 3N/2 and {exact_moment[1]:.3f} with E = N; eq. (9) has "
        f"{float(dataset.moment_limit):.2f}. TVN of draws with E = N against eq. (9): "
        f"{float(dataset.tvn[1]):.3f}."
    )
    return verdict.Finding("kac_3_energy", parts, evidence)


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
