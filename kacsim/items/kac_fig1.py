"""Fig. 1 of the Kac paper: histograms of v_1 under Nanbu's algorithm, small and large step."""

import math

from kacsim.items import _kac
from kacsim.items._lazy import estimate, np, plotting, store, verdict
from kacsim.kac.constants import THERMAL
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
    scott = (24.0 * math.sqrt(math.pi) / settings["n_draws"]) ** (1.0 / 3.0) * THERMAL
    return table.assign(
        density=store.described(bars, (*dims, "bin"), "histogram of the first replicate"),
        scott=store.described(scott, (), "bin width by Scott's rule"),
    ).assign_coords(edge=("edge", edges))


def claims(dataset):
    """Compare the two published TVN values with the mean TVN of each reading."""
    return [*_levels(dataset), _step(dataset), _bins(dataset)]


def _levels(dataset):
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
        levels = dataset.tvn.sel(reading=reading, time_step=step)
        by_width = ", ".join(
            f"{float(w):g}: {float(levels.sel(bin_width=w)):.4f}" for w in _widths(dataset)
        )
        evidence = (
            f"{TITLES[reading]}; one TVN varies by {spread:.4f}. "
            f"{TITLES[other]}: {beside.value:.4f} ± {beside.standard_error:.4f}. "
            f"By bin width, {by_width}."
        )
        found.append(verdict.finding(claim, mean, evidence))
    return found


def _widths(dataset):
    return np.sort(dataset.bin_width.values)


def _step(dataset):
    """Test that the smaller step gives the smaller TVN, in both readings."""
    small, large = (float(step) for step in dataset.time_step)
    parts = []
    for reading in _kac.READINGS:
        means = [_kac.tvn_of(dataset, reading=reading, time_step=step) for step in (large, small)]
        parts.append(verdict.Part(means[0].minus(means[1]), TITLES[reading]))
    evidence = f"Mean TVN at step {large:g} less that at {small:g}."
    return verdict.Finding("kac_fig1_step", tuple(parts), evidence)


def _bins(dataset):
    """Test the level of exact draws in the chosen bins, and say what speaks for other widths."""
    chosen, published = float(dataset.bin_width[0]), dataset.attrs["published"]
    claimed = ("kac_fig1_small_step", "kac_fig1_large_step")
    words = []
    for width in _widths(dataset):
        here = dataset.sel(bin_width=width, reading=_kac.READINGS[0])
        gaps = [
            (published[claim] - float(here.tvn[k])) / float(here.tvn_spread[k])
            for k, claim in enumerate(claimed)
        ]
        words.append(f"{float(width):g}: {float(here.floor):.4f}, {math.hypot(*gaps):.1f}")
    evidence = (
        f"The width {chosen:g} is inferred, not published. By width: mean TVN of exact draws, and "
        f"how far the two published values of Fig. 1 are from the means of the sequential reading, "
        f"in standard deviations of one TVN: {'; '.join(words)}. The pair alone would not choose "
        f"{chosen:g}; the level does. Scott’s rule gives {float(dataset.scott):.3f} here."
    )
    level = estimate.Exact(float(dataset.floor.sel(bin_width=chosen)))
    return verdict.finding("kac_44_bins", level, evidence)


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
