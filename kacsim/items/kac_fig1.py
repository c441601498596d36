"""Fig. 1 of the Kac paper: histograms of v_1 under Nanbu's algorithm, small and large step."""

from kacsim.items import _kac
from kacsim.items._lazy import np, plotting, store, verdict
from kacsim.kac.samplers import TITLES

LAST_TICKS = (6, 4)  # of the published panels: small steps reach further out


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
    """Compare the two published TVN values with the mean TVN of each reading."""
    sequential, synchronous = _kac.READINGS
    small, large = (float(step) for step in dataset.time_step)
    rows = {
        "kac_fig1_small_step": (sequential, synchronous, small),
        "kac_fig1_large_step": (sequential, synchronous, large),
        "kac_41_reading": (synchronous, sequential, large),
    }
    found = []
    for claim, (reading, other, step) in rows.items():
        mean = _kac.tvn_of(dataset, reading=reading, time_step=step)
        beside = _kac.tvn_of(dataset, reading=other, time_step=step)
        spread = float(dataset.isel(bin_width=0).sel(reading=reading, time_step=step).tvn_spread)
        evidence = (
            f"{TITLES[reading]}; one TVN varies by {spread:.4f}. "
            f"{TITLES[other]}: {beside.value:.4f} ± {beside.standard_error:.4f}."
        )
        found.append(verdict.finding(claim, mean, evidence))
    return found


def draw(dataset):
    """Draw one column per step: both readings and eq. (8), as published and logarithmic."""
    count = dataset.sizes["time_step"]
    figure, axes = plotting.panels(2, count, share_y="row", height=2.5)
    for column, step in enumerate(dataset.time_step.values):
        here = dataset.sel(time_step=step)
        linear, logarithmic = axes[column], axes[count + column]
        for r, reading in enumerate(_kac.READINGS):
            mean = _kac.tvn_of(dataset, reading=reading, time_step=step)
            label = f"{TITLES[reading]}: TVN {plotting.with_error(mean)}"
            density = here.density.sel(reading=reading)
            for axis in (linear, logarithmic):
                plotting.bars(axis, here.edge, density, r, label, fill=r == 0)
        for axis in (linear, logarithmic):
            plotting.solution(axis, dataset.attrs["settings"]["time"])
            plotting.velocity_axis(axis, LAST_TICKS[min(column, 1)])
        title = f"$\\Delta t$ = {step:g}"
        plotting.legend_on_top(linear, ncols=1, title=title)
        linear.set_yticks(np.arange(7) / 20)
        logarithmic.set_yscale("log")
        logarithmic.set_ylim(bottom=3e-5)
    for axis in axes[::count]:
        plotting.density_axis(axis)
    return figure
