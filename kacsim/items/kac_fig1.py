"""Fig. 1 of the Kac paper: histograms of v_1 under Nanbu's algorithm, small and large step."""

from kacsim.items import _kac
from kacsim.items._lazy import estimate, plotting, store, verdict
from kacsim.kac.samplers import TITLES


def _grid(settings):
    return {
        (r, s): _kac.velocity_case(settings, reading, settings["n_particles"], step)
        for r, reading in enumerate(_kac.READINGS)
        for s, step in enumerate(settings["time_step"])
    }


def cases(settings):
    """Return both readings at both steps."""
    return list(_grid(settings).values())


def reduce(samples, settings):
    """Return the histogram of the first replicate, and TVN over all of them."""
    grid = _grid(settings)
    dims = ("reading", "time_step")
    coords = {"reading": _kac.READINGS, "time_step": settings["time_step"]}
    table = _kac.tvn_table(samples, grid, dims, coords, settings)
    width = settings["bin_width"]
    bars = [
        [_kac.histogram_of(samples[grid[r, s].id], width)[0] for s in range(len(coords[dims[1]]))]
        for r in range(len(_kac.READINGS))
    ]
    edges = _kac.target(settings, width)[1]
    return table.assign(
        density=store.described(bars, (*dims, "bin"), "histogram of the first replicate"),
    ).assign_coords(edge=("edge", edges))


def claims(dataset):
    """Compare the two published TVN values with their law: one TVN of the same size."""
    small, large = (float(step) for step in dataset.time_step)
    found = []
    for claim, step in (("kac_fig1_small_step", small), ("kac_fig1_large_step", large)):
        mean, spread = _tvn(dataset, _kac.READINGS[0], step)
        other, _ = _tvn(dataset, _kac.READINGS[1], step)
        found.append(
            verdict.Finding(
                claim,
                mean.value,
                mean.standard_error,
                published_error=spread,
                evidence=f"Synchronous reading: {other.value:.4f} ± {other.standard_error:.4f}.",
            )
        )
    sequential, spread = _tvn(dataset, _kac.READINGS[0], large)
    synchronous, _ = _tvn(dataset, _kac.READINGS[1], large)
    reading = verdict.Finding(
        "kac_41_reading",
        dataset.attrs["published"]["kac_fig1_large_step"],
        spread,
        printed=synchronous.value,
        corrected=sequential.value,
        evidence="The published value tested against both readings, as one TVN drawn from each.",
    )
    return [*found, reading]


def _tvn(dataset, reading, step):
    here = dataset.isel(bin_width=0).sel(reading=reading, time_step=step)
    mean = estimate.Mean(float(here.tvn), float(here.tvn_error))
    return mean, float(here.tvn_spread)


def draw(dataset):
    """Draw one panel per step: both readings and eq. (8)."""
    figure, axes = plotting.panels(1, dataset.sizes["time_step"], share_y=True)
    for axis, step in zip(axes, dataset.time_step.values, strict=True):
        here = dataset.sel(time_step=step)
        for r, reading in enumerate(_kac.READINGS):
            mean, _ = _tvn(dataset, reading, step)
            label = f"{TITLES[reading]}\nTVN {plotting.with_error(mean)}"
            density = here.density.sel(reading=reading)
            plotting.bars(axis, here.edge, density, r, label, fill=r == 0)
        plotting.solution(axis, dataset.attrs["settings"]["time"])
        axis.set_title(f"$\\Delta t$ = {step:g}")
        plotting.velocity_axis(axis)
    plotting.legends_above(axes)
    plotting.density_axis(axes[0])
    return figure
