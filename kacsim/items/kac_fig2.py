"""Fig. 2 of the Kac paper: mean TVN of Nanbu's algorithm against k, step = 2 / 2**k."""

from kacsim.items import _kac
from kacsim.items._lazy import dealing, estimate, histogram, np, plotting, store, verdict, xr
from kacsim.kac.samplers import TITLES

REFERENCES = ("bird", "poisson")
MORE = 100  # times as many draws, to tell noise from what the bins do
DIMS = ("reading", "n_particles", "time_step")


def _grid(settings):
    # No published number has the synchronous reading.
    many = settings["n_replicates"], settings["other_n_replicates"]
    return {
        (r, n, s): _kac.velocity_case(settings, reading, n_particles, step, n_replicates=many[r])
        for r, reading in enumerate(_kac.READINGS)
        for n, n_particles in enumerate(settings["n_particles"])
        for s, step in enumerate(settings["time_step"])
    }


def _reference_grid(settings):
    # All but the line are drawn for Fig. 3 too.
    line, others = ({"n_replicates": settings[f"{key}n_replicates"]} for key in ("line_", ""))
    return {
        (a, n): _kac.velocity_case(
            settings, algorithm, n_particles, **(line if a + n == 0 else others)
        )
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
    widths, n = _kac.widths(settings), settings["n_draws"]
    described, dims = store.described, ("bin_width",)
    return xr.merge([table, _references(samples, settings)]).assign(
        normal_floor=described(
            [_normal_floor(width, n) for width in widths],
            dims,
            "mean TVN of exact standard normal draws against the standard normal",
        ),
        large_floor=described(
            [_kac.noise_floor(settings, width, MORE * n) for width in widths],
            dims,
            f"mean TVN of {MORE} times as many exact draws",
        ),
    )


def _references(samples, settings):
    """Return the mean TVN of the algorithms without a step, of all ways to deal their draws."""
    widths, grid = _kac.widths(settings), _reference_grid(settings)
    numbers = settings["reference_n_particles"]
    table = np.empty((2, len(REFERENCES), len(numbers), len(widths)))
    for place, case in grid.items():
        for w, width in enumerate(widths):
            expected, _ = _kac.target(settings, width)
            counts, _ = histogram.coarsen(samples[case.id]["counts"].values, width)
            mean = dealing.mean_variation(counts, expected)
            table[(slice(None), *place, w)] = mean.value, mean.standard_error
    dims, described = ("algorithm", "reference_n", "bin_width"), store.described
    variables = {
        "reference_tvn": described(table[0], dims, "mean TVN, over all ways to deal the draws"),
        "reference_tvn_error": described(table[1], dims, "its standard error"),
    }
    axes = {"algorithm": list(REFERENCES), "reference_n": numbers, "bin_width": widths}
    return xr.Dataset(variables, coords=axes)


def _normal_floor(bin_width, n_draws):
    from scipy.special import ndtr

    empty = np.zeros(histogram.FINE_BINS + 2, int)
    edges = histogram.coarsen(empty, bin_width)[1]
    return histogram.noise_floor(histogram.probabilities(ndtr, edges), n_draws)


def _reference(dataset, algorithm, n):
    """Return the mean TVN of an algorithm without a step; its replicates give its error."""
    here = dataset.isel(bin_width=0).sel(algorithm=algorithm, reference_n=n)
    line = algorithm == REFERENCES[0] and n == dataset.reference_n[0]
    degrees = dataset.attrs["settings"]["line_n_replicates" if line else "n_replicates"] - 1
    return estimate.Mean(float(here.reference_tvn), float(here.reference_tvn_error), degrees)


def claims(dataset):
    """Test what the text says of the step, of the line, and of what it cannot tell apart."""
    numbers = [int(n) for n in dataset.reference_n]
    floor, normal = float(dataset.floor[0]), float(dataset.normal_floor[0])
    line, endless = _reference(dataset, "bird", numbers[0]), estimate.Exact(floor)
    means = {name: [_reference(dataset, name, n) for n in numbers] for name in REFERENCES}
    levels = [
        verdict.Part(mean, f"{TITLES[name]}, N = {n}")
        for name in REFERENCES
        for n, mean in zip(numbers, means[name], strict=True)
    ]
    larger = _gaps(line, dict(zip(numbers[1:], means["bird"][1:], strict=True)), floor)
    poisson = _gaps(line, dict(zip(numbers, means["poisson"], strict=True)), floor)
    least = f"Bird at N = {numbers[0]}: {line.value:.5f}; "
    return [
        verdict.Finding(
            "kac_fig2_line",
            (*levels, verdict.Part(endless, "exact draws, N = ∞")),
            "The noise of the sample size is nearly all of it.",
        ),
        verdict.Finding("kac_fig2_bird_larger_n", larger, least + f"exact draws: {floor:.5f}."),
        verdict.Finding("kac_fig2_poisson", poisson, least + f"exact draws: {floor:.5f}."),
        verdict.finding(
            "kac_fig2_normal",
            _less(line, normal),
            least + f"standard normal draws: {normal:.5f}, exact draws from eq. (8): {floor:.5f}.",
        ),
        _step(dataset),
        _discretization(dataset),
    ]


def _gaps(line, others, floor):
    """Return the parts of the line less the means of other N, and less that of exact draws."""
    parts = [verdict.Part(line.minus(mean), f"N = {n}") for n, mean in others.items()]
    return *parts, verdict.Part(_less(line, floor), "N = ∞, exact draws")


def _less(mean, known):
    """Return an estimate less a known value."""
    return estimate.Mean(mean.value - known, mean.standard_error, mean.degrees)


def _step(dataset):
    """Test the fall of the mean TVN from the largest step to the smallest, at every N."""
    steps = float(dataset.time_step.max()), float(dataset.time_step.min())
    parts = []
    for n in dataset.n_particles.values:
        large, small = (
            _kac.tvn_of(dataset, reading=_kac.READINGS[0], n_particles=n, time_step=step)
            for step in steps
        )
        parts.append(verdict.Part(large.minus(small), f"N = {n}"))
    evidence = f"From step {steps[0]:g} to {steps[1]:g}, velocities updated in place."
    return verdict.Finding("kac_fig2_step", tuple(parts), evidence)


def _discretization(dataset):
    """Test whether it is the bins that keep the TVN of exact draws from zero."""
    ratio = float(dataset.large_floor[0] / dataset.floor[0])
    by_width = ", ".join(
        f"{float(w):g}: {float(dataset.floor.sel(bin_width=w)):.4f}"
        for w in np.sort(dataset.bin_width.values)
    )
    return verdict.finding(
        "kac_44_discretization",
        estimate.Exact(ratio),
        f"Mean TVN of {MORE} times as many exact draws in the same bins, over that of as many as "
        f"the text has. Of as many as the text has, by bin width: {by_width}.",
        printed=1.0,
        corrected=MORE**-0.5,
    )


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
