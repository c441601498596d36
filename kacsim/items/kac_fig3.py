"""Fig. 3 of the Kac paper: mean TVN of Nanbu, Bird and Poisson against the number of particles."""

from kacsim.items import _kac
from kacsim.items._lazy import estimate, exact, np, plotting, verdict
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
    coords = {"algorithm": COMPARED, "n_particles": settings["n_particles"]}
    return _kac.tvn_table(samples, _grid(settings), DIMS, coords, settings)


def _advantage(dataset, algorithm, rival, most):
    """Return by how much the mean TVN is below the rival's, on average over N up to `most`."""
    here = dataset.isel(bin_width=0)
    few = here.where(here.n_particles <= most, drop=True)
    gap = few.tvn.sel(algorithm=rival) - few.tvn.sel(algorithm=algorithm)
    variances = sum(few.tvn_error.sel(algorithm=name) ** 2 for name in (rival, algorithm))
    return estimate.Mean(float(gap.mean()), float(np.sqrt(variances.sum()) / gap.size))


def _where_better(dataset, algorithm, rival):
    """Return at which N the mean TVN is clearly below or above the rival's."""
    here = dataset.isel(bin_width=0)
    gap = here.tvn.sel(algorithm=rival) - here.tvn.sel(algorithm=algorithm)
    error = np.hypot(*(here.tvn_error.sel(algorithm=name) for name in (rival, algorithm)))
    z = (gap / error).values
    names = [", ".join(map(str, here.n_particles.values[chosen])) for chosen in (z > 4, z < -4)]
    nearer, farther = (f"at N = {name}" if name else "at no N" for name in names)
    return f"Nearer by four errors {nearer}; farther {farther}."


def claims(dataset):
    """Test the advantage of Poisson at small N, what the printed rate does, and C(t)."""
    few = dataset.attrs["settings"]["few_particles"]
    found = []
    for variant in ("poisson", "poisson_printed"):
        for rival in ("bird", "nanbu_sequential"):
            gap = _advantage(dataset, variant, rival, few)
            better = _where_better(dataset, variant, rival)
            found.append(
                verdict.Finding(
                    f"kac_fig3_{variant}_{rival.split('_')[0]}",
                    gap.value,
                    gap.standard_error,
                    evidence=f"Mean TVN of the rival less Poisson's, over N ≤ {few}. {better}",
                )
            )
    return [*found, _printed_rate(dataset), _printed_shape(dataset)]


def _printed_rate(dataset):
    """Test the printed sub-ensemble's rate: is E v_1**4 that of f_N?"""
    n = int(dataset.n_particles.where(dataset.n_particles > 2).min())
    moment = _kac.mean_of(dataset, "moment", algorithm="poisson_printed", n_particles=n)
    return verdict.Finding(
        "kac_43_rate",
        moment.value,
        moment.standard_error,
        printed=float(dataset.moment_exact.sel(algorithm="poisson", n_particles=n)),
        corrected=float(dataset.moment_exact.sel(algorithm="poisson_printed", n_particles=n)),
        evidence=f"E v₁⁴ of the printed algorithm at N = {n}: that of the exact process is "
        "rejected, that of a process whose other particles collide too often stands.",
    )


def _printed_shape(dataset):
    """Test C(t): does E v_1**4 at the largest N agree with either printed exponent?"""
    time = dataset.attrs["settings"]["time"]
    n = int(dataset.n_particles.max())
    moment = _kac.mean_of(dataset, "moment", algorithm="poisson", n_particles=n)
    return verdict.Finding(
        "kac_8_shape",
        moment.value,
        moment.standard_error,
        printed=exact.shape_fourth_moment(exact.printed_shape(time)),
        corrected=float(dataset.moment_exact.sel(algorithm="poisson", n_particles=n)),
        evidence=f"E v₁⁴ of exact Poisson draws at N = {n}; the corrected value is the exact one "
        "of this N.",
    )


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
