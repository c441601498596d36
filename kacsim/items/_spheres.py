"""What Fig. 11.4 of the chapter is made of: cases, fractional errors, powers of N."""

import math

from kacsim.cases import make_case
from kacsim.items._lazy import estimate, np, slope, techniques_exact

LATTICE_BLOCK = 10  # neighbouring M; even, since odd M err otherwise than even ones
CIRCLE_BLOCKS = 100  # of neighbouring circles
FEW_CELLS, MANY_CELLS = 16, 64  # along the line, between which the power of M is taken
BEYOND = 4  # dimension above which Monte Carlo is said to have the advantage
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
    fitted = list(range(1, settings["power_largest_edge"] + 1))
    size = [settings[f"{name}n_replicates"] for name in ("", "bad_", "congruential_")]
    found = {
        "lattice": make_case(
            "sphere_lattice",
            dimension=sorted({*settings["dimension"], settings["shown_dimension"]}),
            edge=fitted,
            n_draws=1,
            n_replicates=1,
            seed=settings["seed"],
        ),
        "circles": make_case(
            "circle_lattice",
            smallest=settings["smallest_circle"],
            largest=settings["largest_circle"],
            n_edges=settings["n_circles"],
            n_draws=1,
            n_replicates=1,
            seed=settings["seed"],
        ),
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
    if settings["power_largest_edge"] < settings["largest_edge"]:
        yield "power_largest_edge", f"must be at least largest_edge = {settings['largest_edge']}"
    if settings["fit_from_edge"] + 2 * LATTICE_BLOCK > settings["power_largest_edge"]:
        least = settings["fit_from_edge"] + 2 * LATTICE_BLOCK
        yield "power_largest_edge", f"must leave two blocks: be at least {least}"
    if not {2, BEYOND - 1, BEYOND, BEYOND + 1} <= {*settings["dimension"]}:
        yield "dimension", f"must hold 2, {BEYOND - 1}, {BEYOND} and {BEYOND + 1}"
    if settings["first_power"] >= settings["last_power"]:
        yield "first_power", f"must be below last_power = {settings['last_power']}"


def errors_of(sample, dimension):
    """Return fractional errors of points, float64[replicate, points], and the numbers of points."""
    place = list(sample["dimension"].values).index(dimension)
    n = sample["points"].values
    share = sample["inside"].values[place] / n
    return share / techniques_exact.ball_volume(dimension) - 1.0, n


def volumes(sample, dimension):
    """Return the volume that every replicate found with the most points."""
    place = list(sample["dimension"].values).index(dimension)
    return sample["inside"].values[place, :, -1] / sample["points"].values[-1]


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


def lattice_errors(sample, dimension, largest):
    """Return the fractional errors of the lattice and the edges, up to the largest one."""
    place = list(sample["dimension"].values).index(dimension)
    edge = sample["edge"].values.astype(float)
    edge = edge[edge <= largest]
    share = sample["inside"].values[place, : edge.size] / edge**dimension
    return share / techniques_exact.ball_volume(dimension) - 1.0, edge


def fit_lattice(sample, dimension, settings, largest):
    """Return the slope of the errors of the lattice up to an edge, and its level."""
    error, edge = lattice_errors(sample, dimension, largest)
    keep = edge >= settings["fit_from_edge"]
    groups = np.arange(keep.sum()) // LATTICE_BLOCK
    return slope.of_squares(edge[keep] ** dimension, error[keep] ** 2, groups)


def fit_circles(sample):
    """Return the slope of the errors of the lattice over circles of many sizes."""
    edge = sample["edge"].values.astype(float)
    error = sample["inside"].values / edge**2 / techniques_exact.ball_volume(2) - 1.0
    groups = np.arange(edge.size) * CIRCLE_BLOCKS // edge.size
    return slope.of_squares(edge**2, error**2, groups)[0]


def line_power():
    """Return the power of M of the midpoint sum's error on a line, over all places of a step."""
    few, many = (techniques_exact.step_error(cells) for cells in (FEW_CELLS, MANY_CELLS))
    return math.log(many / few) / math.log(MANY_CELLS / FEW_CELLS)


def advantage(error, edge, dimension, settings):
    """Return the exact rms error of Monte Carlo over the lattice's, larger half of the edges."""
    top = edge >= max(settings["fit_from_edge"], settings["largest_edge"] // 2)
    squares = error[top] ** 2 * edge[top] ** dimension  # N times: every N counts alike
    return techniques_exact.point_error(dimension) / math.sqrt(squares.mean())


def crossing(one, level, power):
    """Return the N at which the lattice's fitted error equals that of random points."""
    gap = power + 0.5
    # a lattice that falls as fast never falls behind
    return float((one / level) ** (1.0 / gap)) if gap > 0.02 else math.inf
