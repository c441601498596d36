"""Fig. 4 of the Kac paper: histograms of v_1 under Bird's and the Poisson algorithm."""

from kacsim.items import _kac
from kacsim.items._lazy import plotting, store, verdict
from kacsim.kac.samplers import TITLES

COMPARED = ("bird", "poisson")


def cases(settings):
    """Return both algorithms."""
    return [_kac.velocity_case(settings, name, settings["n_particles"]) for name in COMPARED]


def reduce(samples, settings):
    """Return the histogram of the first replicate, and TVN over all of them."""
    grid = {(a,): case for a, case in enumerate(cases(settings))}
    table = _kac.tvn_table(samples, grid, ("algorithm",), {"algorithm": COMPARED}, settings)
    width = settings["bin_width"]
    bars = [_kac.histogram_of(samples[case.id], width)[0] for case in grid.values()]
    edges = _kac.target(settings, width)[1]
    return table.assign(
        density=store.described(bars, ("algorithm", "bin"), "histogram of the first replicate"),
    ).assign_coords(edge=("edge", edges))


def claims(dataset):
    """Test that the two algorithms are similar by the TVN."""
    bird, poisson = (_kac.tvn_of(dataset, algorithm=name) for name in COMPARED)
    evidence = (
        f"Mean TVN of Bird less that of Poisson. Bird {bird.value:.5f}, "
        f"Poisson {poisson.value:.5f}, exact draws {float(dataset.floor[0]):.5f}."
    )
    return [verdict.finding("kac_fig4_similar", bird.minus(poisson), evidence)]


def draw(dataset):
    """Draw one panel per algorithm with eq. (8)."""
    figure, axes = plotting.panels(1, len(COMPARED), share_y=True)
    for k, (axis, algorithm) in enumerate(zip(axes, COMPARED, strict=True)):
        here = dataset.sel(algorithm=algorithm)
        mean = _kac.tvn_of(dataset, algorithm=algorithm)
        plotting.bars(axis, here.edge, here.density, k, f"TVN {plotting.with_error(mean)}")
        plotting.solution(axis, dataset.attrs["settings"]["time"])
        axis.set_title(TITLES[algorithm])
        plotting.velocity_axis(axis)
    plotting.legends_above(axes, share=0.25)
    plotting.density_axis(axes[0])
    return figure
