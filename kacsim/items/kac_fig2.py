"""Fig. 2 of the Kac paper: mean TVN of Nanbu's algorithm against k, step = 2 / 2**k."""

from kacsim.items import _kac
from kacsim.items._lazy import estimate, histogram, np, plotting, store, verdict, xr
from kacsim.kac.samplers import TITLES

REFERENCES = ("bird", "poisson")
DIMS = ("reading", "n_particles", "time_step")


def _grid(settings):
    return {
        (r, n, s): _kac.velocity_case(settings, reading, n_particles, step)
        for r, reading in enumerate(_kac.READINGS)
        for n, n_particles in enumerate(settings["n_particles"])
        for s, step in enumerate(settings["time_step"])
    }


def _reference_grid(settings):
    return {
        (a, n): _kac.velocity_case(settings, algorithm, n_particles)
        for a, algorithm in enumerate(REFERENCES)
        for n, n_particles in enumerate(settings["reference_n_particles"])
    }


def cases(settings):
    """Return both readings at every N and step, and the algorithms without a step."""
    return [*_grid(settings).values(), *_reference_grid(settings).values()]


def reduce(samples, settings):
    """Return mean TVN with errors, of Nanbu, of the references and of a standard normal."""
    coords = {
        "reading": _kac.READINGS,
        "n_particles": settings["n_particles"],
        "time_step": settings["time_step"],
    }
    table = _kac.tvn_table(samples, _grid(settings), DIMS, coords, settings)
    axes = {"algorithm": REFERENCES, "reference_n": settings["reference_n_particles"]}
    grid = _reference_grid(settings)
    reference = _kac.tvn_table(samples, grid, tuple(axes), axes, settings)
    keep = ("tvn", "tvn_error", "tvn_spread")
    reference = reference[[*keep]].rename({name: f"reference_{name}" for name in keep})
    return xr.merge([table, reference]).assign(
        normal_floor=store.described(
            [_normal_floor(width, settings["n_draws"]) for width in _kac.widths(settings)],
            ("bin_width",),
            "mean TVN of exact standard normal draws against the standard normal",
        )
    )


def _normal_floor(bin_width, n_draws):
    from scipy.special import ndtr

    empty = np.zeros(histogram.FINE_BINS + 2, int)
    edges = histogram.coarsen(empty, bin_width)[1]
    return histogram.noise_floor(histogram.probabilities(ndtr, edges), n_draws)


def _reference(dataset, algorithm, n):
    here = dataset.isel(bin_width=0).sel(algorithm=algorithm, reference_n=n)
    return estimate.Mean(float(here.reference_tvn), float(here.reference_tvn_error))


def claims(dataset):
    """Test what the text says of the step, of the line, and of what it cannot tell apart."""
    least, most = (int(n) for n in dataset.reference_n.values[[0, -1]])
    line = _reference(dataset, "bird", least)
    pairs = {
        "kac_fig2_bird_larger_n": line.minus(_reference(dataset, "bird", most)),
        "kac_fig2_poisson": line.minus(_reference(dataset, "poisson", least)),
        "kac_fig2_normal": estimate.Mean(
            line.value - float(dataset.normal_floor[0]), line.standard_error
        ),
    }
    found = [
        verdict.Finding(
            "kac_fig2_line",
            line.value,
            line.standard_error,
            evidence=f"Noise floor {float(dataset.floor[0]):.5f}: the line is nearly all noise.",
        )
    ]
    against = {
        "kac_fig2_bird_larger_n": _reference(dataset, "bird", most),
        "kac_fig2_poisson": _reference(dataset, "poisson", least),
        "kac_fig2_normal": estimate.Mean(float(dataset.normal_floor[0]), 0.0),
    }
    found += [
        verdict.Finding(
            claim,
            gap.value,
            gap.standard_error,
            evidence=f"Bird at N = {least}: {line.value:.5f}; the other: {against[claim].value:.5f}"
            + (f", N = {most}." if claim == "kac_fig2_bird_larger_n" else "."),
        )
        for claim, gap in pairs.items()
    ]
    gains = [_gain(dataset, n) for n in dataset.n_particles.values]
    worst = min(gains, key=lambda gain: gain.z())
    found.append(
        verdict.Finding(
            "kac_fig2_step",
            worst.value,
            worst.standard_error,
            evidence="The N with the least gain decides; sequential reading.",
        )
    )
    return found


def _gain(dataset, n):
    """Return the fall of the mean TVN from the largest step to the smallest."""
    here = dataset.isel(bin_width=0).sel(reading=_kac.READINGS[0], n_particles=n)
    large, small = (
        _kac.mean_of(here, "tvn", time_step=step)
        for step in (float(dataset.time_step.max()), float(dataset.time_step.min()))
    )
    return large.minus(small)


def draw(dataset):
    """Draw TVN against k, one panel per reading."""
    figure, axes = plotting.panels(1, len(_kac.READINGS), share_y=True)
    here = dataset.isel(bin_width=0)
    halvings = np.log2(dataset.attrs["settings"]["time"] / dataset.time_step.values)
    for axis, reading in zip(axes, _kac.READINGS, strict=True):
        for k, n in enumerate(dataset.n_particles.values):
            line = here.sel(reading=reading, n_particles=n)
            plotting.points(axis, halvings, line.tvn, line.tvn_error, k, f"$N$ = {n}")
        least = int(dataset.reference_n[0])
        mean = _reference(dataset, "bird", least)
        band = mean.value - mean.standard_error, mean.value + mean.standard_error
        axis.axhspan(*band, color="0.8", lw=0, zorder=0)
        axis.axhline(mean.value, color="black", lw=1, label=f"Bird, $N$ = {least}")
        plotting.floor(axis, float(here.floor))
        axis.set_title(TITLES[reading])
        axis.set_xlabel("$k$, time step $\\Delta t = 2/2^k$")
    axes[0].set_ylabel("mean TVN against eq. (8)")
    axes[0].set_yscale("log")
    plotting.plain_log(axes[0].yaxis)
    low, high = axes[0].get_ylim()
    axes[0].set_ylim(low, 1.8 * high)
    axes[1].legend(loc="upper right", ncols=2)
    return figure
