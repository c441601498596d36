"""Study: velocities of a law that is not separable, by the steps of the chapter, section 11.3."""

from kacsim.items import _techniques
from kacsim.items._lazy import estimate, flux, np, pair_laws, plotting, store, verdict, xr
from kacsim.techniques.samplers import WAYS

LABELS = ("straight flight", "steps as printed", "steps with ∂P/∂v")
PLACES = (0.5, 1.0, 2.5)  # normal velocities where eq. (11.16) is looked at
DRIFT = 0.46  # of the gas there
ALONG = -0.3  # mean velocity along the face of the separable law


def _cases(settings):
    return {
        way: _techniques.case(
            settings, "entering_pairs", way=way, correlation=settings["correlation"]
        )
        for way in WAYS
    }


def cases(settings):
    """Return pairs that fly in, pairs by the printed steps, and by those with a derivative."""
    return list(_cases(settings).values())


def reduce(samples, settings):
    """Return means and densities of the velocity along the face, beside quadratures."""
    drawn = [samples[case.id] for case in _cases(settings).values()]
    correlation = settings["correlation"]
    along = [estimate.of_replicates(sample["mean"].values[:, 1]) for sample in drawn]
    normal = [estimate.of_replicates(sample["mean"].values[:, 0]) for sample in drawn]
    edges = drawn[0]["edge"].values
    counts = np.stack([sample["counts"].values.sum(axis=0) for sample in drawn])
    density = counts[:, 1:-1] / counts.sum(axis=1, keepdims=True) / np.diff(edges)
    lines = np.array([pair_laws.flux_lines(place, DRIFT) for place in PLACES])
    shares = [pair_laws.flux_cumulative(place, DRIFT) for place in PLACES]
    middle = 0.5 * (edges[1:] + edges[:-1])
    described, one, at = store.described, ("way",), ("place",)
    text = "mean velocity along the face"
    return xr.Dataset(
        {
            "along": described([m.value for m in along], one, text),
            "along_error": described([m.standard_error for m in along], one, "standard error"),
            "normal": described([m.value for m in normal], one, "mean normal velocity"),
            "normal_error": described([m.standard_error for m in normal], one, "standard error"),
            "along_exact": described(pair_laws.exact_mean(correlation), (), f"{text}, closed form"),
            "along_summed": described(pair_laws.entering_mean(correlation), (), f"{text}, summed"),
            "along_printed": described(pair_laws.printed_mean(correlation), (), f"{text}, steps"),
            "separable": described(pair_laws.entering_mean(0.0, ALONG), (), f"{text}, separable"),
            "density": described(density, ("way", "bin"), "draws by the velocity along the face"),
            "density_exact": described(
                pair_laws.entering_density(middle, correlation), ("bin",), "entering particles"
            ),
            "density_printed": described(
                pair_laws.printed_density(middle, correlation), ("bin",), "printed steps"
            ),
            "lines": described(lines[:, 1] / lines[:, 0], at, "second line of (11.16) over first"),
            "flux": described(shares, at, "F over F at the largest velocity"),
            "flux_exact": described(flux.cumulative(np.array(PLACES), DRIFT, 1.0), at, "v f(v)"),
        },
        coords={"way": list(WAYS), "place": list(PLACES), "edge": ("edge", edges)},
    )


def claims(dataset):
    """Test eq. (11.16), the separable case, and the steps for a law that is not separable."""
    flight, steps, derivative = (_techniques.mean_of(dataset.sel(way=way), "along") for way in WAYS)
    parts = []
    for place in dataset.place.values:
        here = dataset.sel(place=place)
        lines, share = (estimate.Exact(float(here[name])) for name in ("lines", "flux"))
        parts += [
            verdict.Part(lines, f"second line over first, v = {place:g}", printed=1.0),
            verdict.Part(share, f"F, v = {place:g}", printed=float(here.flux_exact)),
        ]
    rho = dataset.attrs["settings"]["correlation"]
    fixed = {"printed": float(dataset.along_printed), "corrected": float(dataset.along_exact)}
    return [
        verdict.Finding(
            "techniques_steps_flux", tuple(parts), f"Normal law with mean {DRIFT:g}, by quadrature."
        ),
        verdict.finding(
            "techniques_steps_separable",
            estimate.Exact(float(dataset.separable)),
            "Mean over the flux v f(v, w), by quadrature, against that of f.",
            printed=ALONG,
        ),
        verdict.Finding(
            "techniques_steps_velocity",
            (
                verdict.Part(
                    estimate.Exact(float(dataset.along_summed)), "summed over the flux", **fixed
                ),
                verdict.Part(flight, "straight flight", **fixed),
            ),
            f"Bivariate normal law, correlation {rho:g}. Run by the printed steps: "
            f"{steps.value:.4f} ± {steps.standard_error:.4f}; with ∂P/∂v_x in the place of P: "
            f"{derivative.value:.4f} ± {derivative.standard_error:.4f}.",
        ),
    ]


def draw(dataset):
    """Draw the velocity along the face: particles that fly in, and both kinds of steps."""
    figure, axes = plotting.panels(1, 2, share_y=True)
    edges = dataset.edge.values
    middle = 0.5 * (edges[1:] + edges[:-1])
    shown = ((("flight", "derivative"), "density_exact"), (("steps",), "density_printed"))
    for axis, (ways, line) in zip(axes, shown, strict=True):
        for way in ways:
            k = WAYS.index(way)
            density = dataset.density.sel(way=way)
            plotting.bars(axis, edges, density, k, LABELS[k], fill=way != "derivative")
        axis.plot(middle, dataset[line], color="black", lw=1, label="quadrature")
        mean = dataset.along_exact if line == "density_exact" else dataset.along_printed
        label = f"mean {float(mean):.3f}".replace("-", "−")
        ends = [0.0, float(dataset[line].max())]
        axis.plot([float(mean)] * 2, ends, color="0.4", ls=":", lw=1.2, label=label)
        axis.set_xlim(-4.0, 5.0)
        axis.set_xlabel("velocity along the face")
    plotting.legends_above(axes)
    axes[0].set_ylabel("density")
    return figure
