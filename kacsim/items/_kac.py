"""What the items of the Kac paper share: their cases, and the reduction of velocity samples.

The same functions serve another gas that its algorithms simulate (`kacsim.items._maxwell`).
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from kacsim.cases import make_case
from kacsim.items._lazy import estimate, exact, histogram, kac, np, store, xr
from kacsim.kac.constants import MEAN_ENERGY, RATE
from kacsim.kac.samplers import STEPPED, step_problems

READINGS = ("nanbu_sequential", "nanbu_synchronous")  # of what the text says of Nanbu's partners
FOLLOWED = ("engine", "keep_above")  # how a case follows its process, and what it keeps


@dataclass(frozen=True)
class Gas:
    """What tells one gas from another.

    Attributes
    ----------
    sampler : str, draws its velocities
    cumulative : callable(v, time), the law for infinitely many particles
    fourth_moment : callable(**process), exact E v_1**4 of an algorithm, of the limit without any
    square : float, E v_1**2
    """

    sampler: str
    cumulative: Callable
    fourth_moment: Callable
    square: float


KAC = Gas(
    "kac",
    lambda v, time: exact.cumulative(v, time),
    lambda time, **process: kac.fourth_moment(time, **process),
    MEAN_ENERGY,
)


def problems_of_step(settings):
    """Return (key, sentence) of a step that no case of an item checks, where all is exact."""
    found = step_problems("Nanbu", settings["time"], settings["time_step"], RATE)
    return [(problem.name, problem.allowed) for problem in found]


def velocity_case(settings, algorithm, n_particles, time_step=None, *, gas=KAC, **others):
    """Return the case of one algorithm with the item's time, engine and size."""
    step = time_step if algorithm in STEPPED else None
    size = {key: settings[key] for key in ("n_draws", "n_replicates", "seed")}
    engine = settings.get("engine", "ancestral")
    common = {"engine": engine, "time": settings["time"], "time_step": step}
    return make_case(
        gas.sampler, algorithm=algorithm, n_particles=n_particles, **(common | size | others)
    )


def subset(settings, key, of):
    """Return the problem of a list of settings that is no part of another one (for `problems`)."""
    strangers = [str(value) for value in settings[key] if value not in settings[of]]
    return [(key, f"must be among {of}; {', '.join(strangers)} is not")] if strangers else []


def widths(settings):
    """Return all bin widths, the one of the published figures first."""
    return [settings["bin_width"], *settings["other_bin_widths"]]


def target(settings, bin_width, time=None, gas=KAC):
    """Return (probabilities, edges) of eq. (8), or its like, over the bins of a width."""
    when = settings["time"] if time is None else time
    empty = np.zeros(histogram.FINE_BINS + 2, int)
    edges = histogram.coarsen(empty, bin_width)[1]
    return histogram.probabilities(lambda v: gas.cumulative(v, when), edges), edges


def tvn(sample, settings, bin_width, time=None, gas=KAC):
    """Return the TVN of each replicate against eq. (8), float64[n_replicates]."""
    expected, _ = target(settings, bin_width, time, gas)
    counts, _ = histogram.coarsen(sample["counts"].values, bin_width)
    return histogram.total_variation(counts, expected)


def noise_floor(settings, bin_width, n_draws, time=None, gas=KAC):
    """Return the mean TVN of exact draws from eq. (8)."""
    return histogram.noise_floor(target(settings, bin_width, time, gas)[0], n_draws)


def tvn_table(samples, grid, dims, coords, settings, gas=KAC):
    """Reduce a grid of velocity cases to TVN and fourth moments.

    Parameters
    ----------
    samples : case id -> dataset
    grid : dict, tuple of places along `dims` -> Case (missing places become nan)
    dims, coords : names and values of the grid's axes
    settings : the item's settings

    Returns
    -------
    xarray.Dataset: tvn, tvn_error, tvn_spread[*dims, bin_width], floor[bin_width],
    moment, moment_error, moment_exact[*dims], all of v_1**4
    """
    shape = tuple(len(coords[dim]) for dim in dims)
    all_widths = widths(settings)
    tables = {key: np.full((*shape, len(all_widths)), np.nan) for key in ("mean", "se", "sd")}
    fourth = {key: np.full(shape, np.nan) for key in ("mean", "se", "exact")}
    for place, case in grid.items():
        sample = samples[case.id]
        for w, width in enumerate(all_widths):
            values = tvn(sample, settings, width, gas=gas)
            mean = estimate.of_replicates(values)
            tables["mean"][(*place, w)] = mean.value
            tables["se"][(*place, w)] = mean.standard_error
            tables["sd"][(*place, w)] = values.std(ddof=1) if values.size > 1 else np.nan
        moment = fourth_moment_of(sample, case, gas)
        fourth["mean"][place], fourth["se"][place] = moment.value, moment.standard_error
        fourth["exact"][place] = exact_moment(case, gas=gas)
    floors = [noise_floor(settings, width, settings["n_draws"], gas=gas) for width in all_widths]
    described, with_width = store.described, (*dims, "bin_width")
    variables = {
        "tvn": described(tables["mean"], with_width, "mean TVN"),
        "tvn_error": described(tables["se"], with_width, "standard error of the mean TVN"),
        "tvn_spread": described(tables["sd"], with_width, "standard deviation of one TVN"),
        "floor": described(floors, ("bin_width",), "mean TVN of exact draws"),
        "moment": described(fourth["mean"], dims, "mean of v_1**4"),
        "moment_error": described(fourth["se"], dims, "standard error of the mean of v_1**4"),
        "moment_exact": described(fourth["exact"], dims, "exact mean of v_1**4"),
    }
    axes = {dim: (dim, list(values)) for dim, values in coords.items()}
    return xr.Dataset(variables, coords=axes | {"bin_width": ("bin_width", all_widths)})


def n_draws_of(case):
    """Return the draws of a case, all replicates together."""
    return case.n_draws * case.n_replicates


def fourth_moment_of(sample, case, gas=KAC):
    """Return the measured E v_1**4 of a velocity sample, with its standard error.

    E v_1**2 is known, for collisions keep it, and serves as a control variate.
    """
    means = sample["moment"].mean("replicate").to_series()
    energy = case.parameters.get("energy")  # of a whole ensemble; None for 3N/2
    square = gas.square if energy is None else energy / case.parameters["n_particles"]
    return estimate.of_power(means, 4, n_draws_of(case), square)


def exact_moment(case, time=None, gas=KAC):
    """Return the exact E v_1**4 of the case's own process: finite N, finite step."""
    process = {key: value for key, value in case.parameters.items() if key not in FOLLOWED}
    return gas.fourth_moment(**process if time is None else process | {"time": time})


def moment_table(samples, grid, shape, gas=KAC):
    """Return (measured, error, exact) E v_1**4 of a grid of cases, each float64[shape]."""
    table = np.full((3, *shape), np.nan)
    for place, case in grid.items():
        mean = fourth_moment_of(samples[case.id], case, gas)
        table[(slice(None), *place)] = mean.value, mean.standard_error, exact_moment(case, gas=gas)
    return table


def count_table(samples, grid, shape):
    """Return (mean collisions per draw, standard error) of a grid of cases, each float64[shape]."""
    table = np.full((2, *shape), np.nan)
    for place, case in grid.items():
        mean = estimate.of_replicates(samples[case.id]["collisions"].values)
        table[(slice(None), *place)] = mean.value, mean.standard_error
    return table


def limit_moment(time, gas=KAC):
    """Return E v**4 of the Kac equation, or of the gas's own for infinitely many particles."""
    return gas.fourth_moment(time=time, n_particles=math.inf)


def histogram_of(sample, bin_width, replicate=0):
    """Return (density, edges) of one replicate, its tails left out of the bars."""
    counts, edges = histogram.coarsen(sample["counts"].values[replicate], bin_width)
    return counts[1:-1] / counts.sum() / np.diff(edges), edges


def mean_of(dataset, variable, degrees=math.inf, **place):
    """Return an estimate from a reduced dataset: `variable` and `variable`_error at a place.

    Without degrees of freedom the error is that of all draws, and counts as known.
    """
    here = dataset.sel(**place)
    return estimate.Mean(float(here[variable]), float(here[variable + "_error"]), degrees)


def tvn_of(dataset, **place):
    """Return the mean TVN at a place and the published bin width; its replicates give its error."""
    here = dataset.isel(bin_width=0).sel(**place)
    degrees = dataset.attrs["settings"]["n_replicates"] - 1
    return estimate.Mean(float(here.tvn), float(here.tvn_error), degrees)
