"""Fig. 3 of the Kac paper: mean TVN of Nanbu, Bird and Poisson against the number of particles."""

from kacsim.items import _kac
from kacsim.items._lazy import estimate, np, plotting, poisson_printed, store, verdict
from kacsim.kac.samplers import TITLES

COMPARED = ("nanbu_sequential", "bird", "poisson", "poisson_printed")
DIMS = ("algorithm", "n_particles")


def _grid(settings):
    return {
        (a, n): _kac.velocity_case(settings, algorithm, n_particles, settings["time_step"])
        for a, algorithm in enumerate(COMPARED)
        for n, n_particles in enumerate(settings["n_particles"])
    }


def cases(settings):
    """Return the four algorithms at every N."""
    return list(_grid(settings).values())


def reduce(samples, settings):
    """Return mean TVN and fourth moments with their errors."""
    grid, numbers = _grid(settings), settings["n_particles"]
    coords = {"algorithm": COMPARED, "n_particles": numbers}
    row = COMPARED.index("poisson_printed")
    mended = [
        poisson_printed.fourth_moment(
            n_particles=n,
            time=settings["time"],
            collision_rate=grid[row, k].parameters["collision_rate"],
            pair_rate=1.0 / (n - 1.0),
        )
        for k, n in enumerate(numbers)
    ]
    text = "exact mean of v_1**4 of the printed algorithm at the rate (N - 2) / 2"
    table = _kac.tvn_table(samples, grid, DIMS, coords, settings)
    return table.assign(moment_mended=store.described(mended, ("n_particles",), text))


def _advantage(dataset, algorithm, rival, n):
    """Return by how much the mean TVN is below the rival's at one N."""
    ours, theirs = (
        _kac.tvn_of(dataset, algorithm=name, n_particles=n) for name in (algorithm, rival)
    )
    return theirs.minus(ours)


def _where_better(dataset, algorithm, rival):
    """Return at which N the mean TVN is clearly below or above the rival's."""
    here = dataset.isel(bin_width=0)
    gap = here.tvn.sel(algorithm=rival) - here.tvn.sel(algorithm=algorithm)
    error = np.hypot(*(here.tvn_error.sel(algorithm=name) for name in (rival, algorithm)))
    z = (gap / error).values
    names = [", ".join(map(str, here.n_particles.values[chosen])) for chosen in (z > 4, z < -4)]
    nearer, farther = (f"at N = {name}" if name else "at no N" for name in names)
    return f"Of all N drawn, nearer by four errors {nearer}; farther {farther}."


def claims(dataset):
    """Test the advantage of Poisson at every small N, and what the printed rate does."""
    few = dataset.attrs["settings"]["few_particles"]
    numbers = [int(n) for n in dataset.n_particles if n <= few]
    found = []
    for variant in ("poisson", "poisson_printed"):
        for rival in ("bird", "nanbu_sequential"):
            gaps = [_advantage(dataset, variant, rival, n) for n in numbers]
            parts = [verdict.Part(gap, f"N = {n}") for n, gap in zip(numbers, gaps, strict=True)]
            claim = f"kac_fig3_{variant}_{rival.split('_')[0]}"
            evidence = _where_better(dataset, variant, rival)
            found.append(verdict.Finding(claim, tuple(parts), evidence))
    return [*found, _printed_rate(dataset)]


def _printed_rate(dataset):
    """Test the printed rate of the other particles: is f_N what the printed algorithm draws?"""
    several = dataset.sel(n_particles=dataset.n_particles > 2)
    parts = []
    for n in several.n_particles.values[[0, -1]]:
        here = several.sel(n_particles=n)
        process, printed = (
            float(here.moment_exact.sel(algorithm=name)) for name in ("poisson", "poisson_printed")
        )
        parts.append(
            verdict.Part(
                estimate.Exact(process),
                f"N = {n}",
                printed=printed,
                corrected=float(here.moment_mended),
            )
        )
    n = int(several.n_particles[0])
    drawn = _kac.mean_of(several, "moment", algorithm="poisson_printed", n_particles=n)
    evidence = (
        f"Exact for f_N and for both algorithms. Draws of the printed one at N = {n}: "
        f"{drawn.value:.4f} ± {drawn.standard_error:.4f}."
    )
    return verdict.Finding("kac_43_rate", tuple(parts), evidence)


def draw(dataset):
    """Draw TVN against N with the noise floor."""
    figure, (axis,) = plotting.panels(1, 1)
    here = dataset.isel(bin_width=0)
    for k, algorithm in enumerate(COMPARED):
        line = here.sel(algorithm=algorithm)
        label = TITLES[algorithm]
        plotting.points(axis, line.n_particles, line.tvn, line.tvn_error, k, label)
    plotting.floor(axis, float(here.floor))
    axis.set_xscale("log")
    axis.set_yscale("log")
    plotting.plain_log(axis.xaxis)
    plotting.plain_log(axis.yaxis)
    axis.set_xlabel("number of particles $N$")
    axis.set_ylabel("mean TVN against eq. (8)")
    axis.legend()
    return figure
