"""What Fig. 11.4 of the chapter is made of: cases, fractional errors, powers of N."""

import math

from kacsim.cases import make_case
from kacsim.items._lazy import estimate, np, slope, techniques_exact

LATTICE_BLOCK = 5  # neighbouring M whose errors may depend on each other
PSEUDORANDOM = ("good", "exhausted", "congruential")
MANY = ("lattice", "random", "sobol")


def _points(settings, generator, dimension, n_points, n_replicates):
    return make_case(
        "sphere_points",
        generator=generator,
        dimension=dimension,
        n_points=n_points,
        n_draws=1,
        n_replicates=n_replicates,
        seed=settings["seed"],
    )


def cases(settings):
    """Return name -> case: lattices, and points of every generator."""
    edges = list(range(1, settings["largest_edge"] + 1))
    size = [settings[f"{name}n_replicates"] for name in ("", "bad_", "congruential_")]
    found = {
        "lattice": make_case(
            "sphere_lattice",
            dimension=sorted({*settings["dimension"], settings["shown_dimension"]}),
            edge=edges,
            n_draws=1,
            n_replicates=1,
            seed=settings["seed"],
        )
    }
    shown = [settings["shown_dimension"]], [edge ** settings["shown_dimension"] for edge in edges]
    for name, n_replicates in zip(PSEUDORANDOM, size, strict=True):
        found[name] = _points(settings, name, *shown, n_replicates)
    powers = [2**k for k in range(settings["first_power"], settings["last_power"] + 1)]
    many = settings["dimension"], powers, settings["many_n_replicates"]
    found["random"] = _points(settings, "good", *many)
    found["sobol"] = _points(settings, "sobol", *many)
    return found


def problems(settings):
    """Yield (key, sentence) of ends of ranges that leave nothing between them."""
    if settings["fit_from_edge"] > settings["largest_edge"] - 3:
        yield "fit_from_edge", f"must be at least 3 below largest_edge = {settings['largest_edge']}"
    if settings["first_power"] >= settings["last_power"]:
        yield "first_power", f"must be below last_power = {settings['last_power']}"


def errors_of(sample, dimension):
    """Return fractional errors of points, float64[replicate, points], and the numbers of points."""
    place = list(sample["dimension"].values).index(dimension)
    n = sample["points"].values
    share = sample["inside"].values[place] / n
    return share / techniques_exact.ball_volume(dimension) - 1.0, n


def rms(errors):
    """Return the root mean square over replicates and its standard error."""
    mean = [estimate.of_replicates(column) for column in (errors**2).T]
    root = np.sqrt([m.value for m in mean])
    return root, np.array([m.standard_error for m in mean]) / np.maximum(2.0 * root, 1e-300)


def fit(errors, n, first):
    """Return the slope of errors of replicates over the numbers of points from `first` on."""
    keep = n >= first
    many = np.broadcast_to(n[keep], errors[:, keep].shape)
    groups = np.broadcast_to(np.arange(errors.shape[0])[:, None], many.shape)
    squares = errors[:, keep] ** 2
    return slope.of_squares(many.ravel(), squares.ravel(), groups.ravel())


def lattice_errors(sample, dimension):
    """Return the fractional errors of the lattice and the edges."""
    place = list(sample["dimension"].values).index(dimension)
    edge = sample["edge"].values.astype(float)
    share = sample["inside"].values[place] / edge**dimension
    return share / techniques_exact.ball_volume(dimension) - 1.0, edge


def fit_lattice(sample, dimension, settings):
    """Return the slope of the errors of the lattice, and its level."""
    error, edge = lattice_errors(sample, dimension)
    keep = edge >= settings["fit_from_edge"]
    groups = np.arange(keep.sum()) // LATTICE_BLOCK
    return slope.of_squares(edge[keep] ** dimension, error[keep] ** 2, groups)


def crossing(one, level, power):
    """Return the N at which the lattice's fitted error equals that of random points."""
    gap = power + 0.5
    # a lattice that falls as fast never falls behind
    return float((one / level) ** (1.0 / gap)) if gap > 0.02 else math.inf


def ahead(found, error, edge, shown, settings):
    """Return log10 of the ratio of rms errors over the upper half of the edges, jackknifed."""
    top = edge >= max(settings["fit_from_edge"], settings["largest_edge"] // 2)
    weight = edge[top] ** shown  # N times the squared error: every N counts alike
    drawn, _ = errors_of(found["good"], shown)
    random = (drawn[:, top] ** 2 * weight).mean(axis=1)
    lattice = error[top] ** 2 * weight
    groups = np.arange(lattice.size) // LATTICE_BLOCK
    parts = np.bincount(groups, lattice) / np.bincount(groups)
    value, errors = 0.5 * math.log10(random.mean() / lattice.mean()), []
    for part in (random, parts):
        mean = estimate.of_replicates(part)
        errors.append(mean.standard_error / mean.value * 0.5 / math.log(10.0))
    return estimate.Mean(value, math.hypot(*errors))
