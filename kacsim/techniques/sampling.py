"""Samplers of the chapter: draws streamed into cells, moments and counts of uniforms."""

import math

import numpy as np

from kacsim.kernels.lookup import named
from kacsim.store import described
from kacsim.streams import CHUNK, new_stream
from kacsim.sums import add_powers
from kacsim.techniques import (
    circles,
    identity,
    injection,
    integration,
    inverse_transform,
    model,
    particles,
    rejection,
)
from kacsim.techniques.constants import FACES, LAWS, POWERS, SUMS

CELLS = 10007  # of equal probability; a prime, so that few edges are nodes of a table
KEPT = 600  # trials or particles shown in a figure
PAIR_LIMIT, PAIR_WIDTH = 6.0, 0.1  # of the velocity along the face, whose tails are bins too
SPEED_BINS, SPEED_WIDTH = 80, 0.1  # of the normal velocity, in units of the thermal one
MOST = 40  # particles of a face in one step that have a count of their own


def _draw_law(case, law, fill, progress):
    """Stream all replicates of a law through fill(values, row, stream); return variables."""
    counts = np.zeros((len(case.replicates), CELLS), np.int64)
    sums = np.zeros((len(case.replicates), len(POWERS)))
    uniforms = np.zeros(len(case.replicates), np.int64)
    done = 0
    for row, replicate in enumerate(case.replicates):
        stream = new_stream(case.seed, case.id, replicate)
        start = stream.copy()
        for first in range(0, case.n_draws, CHUNK):
            values = np.empty(min(CHUNK, case.n_draws - first))
            fill(values, row, stream)
            model.fill_cells(values, LAWS.index(law), counts[row], sums[row])
            done += values.size
            progress(done)
        uniforms[row] = model.uniforms_between(start, stream)
    return counts, sums / case.n_draws, uniforms / case.n_draws


def _law_variables(counts, moments, uniforms, dims=("replicate",)):
    return {
        "counts": described(counts, (*dims, "cell"), "draws by their exact cumulative probability"),
        "moment": described(moments, (*dims, "power"), "mean of v to the power"),
        "uniforms": described(uniforms, dims, "uniforms per draw"),
        "power": described(POWERS, ("power",), "power"),
    }


def sample_inverse_transform(case, progress):
    """Draw through tables of several sizes (Fig. 11.1).

    Returns
    -------
    dict of counts[table, replicate, cell], moment[table, replicate, power],
    uniforms, last[table, replicate] (share of draws in the last interval)
    """
    law, sizes = case.parameters["law"], case.parameters["n_table"]
    parts, last = [], np.zeros((len(sizes), len(case.replicates)))
    for k, n_table in enumerate(sizes):
        table = inverse_transform.law_table(law, n_table)

        def fill(values, row, stream, k=k, table=table):
            last[k, row] += inverse_transform.through_table(values, table, stream)

        parts.append(_draw_law(case, law, fill, progress))
    dims = ("n_table", "replicate")
    columns = [np.stack(part) for part in zip(*parts, strict=True)]
    return _law_variables(*columns, dims) | {
        "last": described(last / case.n_draws, dims, "share of draws in the last interval"),
        "n_table": described(np.array(sizes), ("n_table",), "intervals of the table"),
    }


def sample_inversion(case, progress):
    """Draw by a cumulative function inverted in closed form (exercise 1); values times the rate."""
    law, rate = case.parameters["law"], case.parameters["rate"]

    def fill(values, row, stream):
        inverse_transform.closed_form(values, LAWS.index(law), stream)

    counts, moments, uniforms = _draw_law(case, law, fill, progress)
    scale = np.multiply.accumulate(np.full(len(POWERS), float(rate)))
    return _law_variables(counts, moments / scale, uniforms)


def sample_rejection(case, progress):
    """Draw by rejection (Fig. 11.2).

    Returns
    -------
    dict of counts, moment, uniforms, trials[replicate] (per draw), point[trial, part]
    """
    law, envelope = case.parameters["law"], case.parameters["envelope"]
    arguments = rejection.arguments(law, envelope)
    trials = np.zeros(len(case.replicates))

    def fill(values, row, stream):
        trials[row] += rejection.draw(values, *arguments, stream)

    found = _law_variables(*_draw_law(case, law, fill, progress))
    points = np.empty((KEPT, 3))
    rejection.record(points, *arguments, new_stream(case.seed, f"{case.id} record"))
    return found | {
        "trials": described(trials / case.n_draws, ("replicate",), "trials per draw"),
        "point": described(points, ("trial", "part"), "value, height and acceptance of trials"),
    }


def sample_identity(case, progress):
    """Draw f0 by the Gamma identity."""
    fill = lambda values, row, stream: identity.draw(values, stream)  # noqa: E731
    return _law_variables(*_draw_law(case, "kac_initial", fill, progress))


def _entering(case, progress, run):
    """Stream steps through run(n_steps, counts, tallies, stream); return variables by face."""
    counts = np.zeros((len(case.replicates), len(FACES), MOST + 1), np.int64)
    sums = np.zeros((len(case.replicates), len(FACES), len(SUMS)))
    speeds = np.zeros((len(case.replicates), len(FACES), SPEED_BINS), np.int64)
    width = SPEED_WIDTH * math.sqrt(case.parameters["temperature"])
    kept, n_kept = np.empty((KEPT, 7)), 0
    for row, replicate in enumerate(case.replicates):
        stream = new_stream(case.seed, case.id, replicate)
        tallies = sums[row], speeds[row], width, kept[n_kept:]
        n_kept += run(case.n_draws, counts[row], tallies, stream)
        progress((row + 1) * case.n_draws)
    dims = ("replicate", "face")
    return {
        "steps": described(counts, (*dims, "number"), "steps by number of particles"),
        "sum": described(sums, (*dims, "what"), "sums over the particles: " + ", ".join(SUMS)),
        "speeds": described(speeds, (*dims, "bin"), "particles by normal velocity, last: larger"),
        "speed_edge": described(np.arange(SPEED_BINS) * width, ("edge",), "lower edge of the bin"),
        "kept": described(kept[:n_kept], ("kept", "part"), "face, position and velocity"),
    }


def sample_injection(case, progress):
    """Inject through the faces of a cuboid, step by step (Fig. 11.3).

    Returns
    -------
    dict of steps[replicate, face, number], sum[replicate, face, what], kept[kept, part],
    speeds[replicate, face, bin]
    """
    arguments = injection.injection(**case.parameters)
    run = lambda n, *sums: injection.inject_steps(n, *arguments, *sums)  # noqa: E731
    return _entering(case, progress, run)


def sample_outer_gas(case, progress):
    """Move pieces of the outer gas and look at what enters; as `sample_injection`."""
    arguments = injection.outer_gas(**case.parameters)
    run = lambda n, *sums: injection.move_gas(n, *arguments, *sums)  # noqa: E731
    return _entering(case, progress, run)


def sample_weighted_particles(case, progress):
    """Select from weighted particles through the face at -x; weights 1, 2, 3, 1, 2, 3, ...

    Returns
    -------
    dict of velocity[particle, axis], weight[particle], selected[replicate, particle]
    """
    p = case.parameters
    n = p["n_representatives"]
    velocities, weights = np.empty((n, 3)), 1.0 + np.arange(n) % 3
    stream = new_stream(case.seed, f"{case.id} representatives")
    drift = np.array(p["drift"], dtype=float)
    particles.representatives(velocities, drift, math.sqrt(p["temperature"]), stream)
    ranges = particles.index_range(velocities, weights, (1.0, 0.0, 0.0))
    selected = np.zeros((len(case.replicates), n), np.int64)
    for row, replicate in enumerate(case.replicates):
        stream = new_stream(case.seed, case.id, replicate)
        for first in range(0, case.n_draws, CHUNK):
            indices = np.empty(min(CHUNK, case.n_draws - first), np.int64)
            particles.select(indices, ranges, stream)
            selected[row] += np.bincount(indices, minlength=n)
        progress((row + 1) * case.n_draws)
    return {
        "velocity": described(velocities, ("particle", "axis"), "representative velocities"),
        "weight": described(weights, ("particle",), "weights"),
        "selected": described(selected, ("replicate", "particle"), "times a particle was chosen"),
    }


def sample_entering_pairs(case, progress):
    """Draw correlated velocities that enter through a face (section 11.3).

    Returns
    -------
    dict of mean[replicate, velocity] (normal, along the face), product[replicate] (mean of both),
    counts[replicate, bin] (by the velocity along the face, the first and the last bin open), edge
    """
    p = case.parameters
    draw = named("kacsim.techniques", "pairs", f"by_{p['way']}")
    edges = np.linspace(-PAIR_LIMIT, PAIR_LIMIT, round(2.0 * PAIR_LIMIT / PAIR_WIDTH) + 1)
    n = len(case.replicates)
    sums, counts = np.zeros((n, 3)), np.zeros((n, edges.size + 1), np.int64)
    for row, replicate in enumerate(case.replicates):
        stream = new_stream(case.seed, case.id, replicate)
        for first in range(0, case.n_draws, CHUNK):
            pairs = np.empty((min(CHUNK, case.n_draws - first), 2))
            draw(pairs, float(p["correlation"]), stream)
            v, w = pairs.T.copy()
            for k, values in enumerate((v, w, v * w)):
                add_powers(values, sums[row, k : k + 1])
            places = np.searchsorted(edges, w, side="right")
            counts[row] += np.bincount(places, minlength=edges.size + 1)
        progress((row + 1) * case.n_draws)
    mean = sums / case.n_draws
    return {
        "mean": described(mean[:, :2], ("replicate", "velocity"), "normal, along the face"),
        "product": described(mean[:, 2], ("replicate",), "mean of their product"),
        "counts": described(counts, ("replicate", "bin"), "draws by the velocity along the face"),
        "edge": described(edges, ("edge",), "edges of the bins"),
    }


def sample_circle_lattice(case, progress):
    """Count lattice points inside circles: int64 inside[edge]."""
    p = case.parameters
    edges = circles.spread_edges(p["smallest"], p["largest"], p["n_edges"])
    inside = np.empty(edges.size, np.int64)
    circles.count_circles(inside, edges)
    progress(1)
    return {
        "inside": described(inside, ("edge",), "lattice points inside the circle"),
        "edge": described(edges, ("edge",), "lattice points per edge"),
    }


def sample_sphere_lattice(case, progress):
    """Count lattice points inside spheres: int64 inside[dimension, edge]."""
    dimensions, edges = case.parameters["dimension"], case.parameters["edge"]
    inside = np.empty((max(dimensions), len(edges)), np.int64)
    for k, edge in enumerate(edges):
        column = np.empty(max(dimensions), np.int64)
        integration.count_lattice(column, edge)
        inside[:, k] = column
    progress(1)
    chosen = inside[np.array(dimensions) - 1]
    return {
        "inside": described(chosen, ("dimension", "edge"), "lattice points inside the sphere"),
        "dimension": described(np.array(dimensions), ("dimension",), "dimension"),
        "edge": described(np.array(edges), ("edge",), "lattice points per edge"),
    }


def sample_sphere_points(case, progress):
    """Count points of a generator inside spheres: inside[dimension, replicate, points]."""
    p = case.parameters
    n_points = np.array(p["n_points"], dtype=np.int64)
    inside = np.empty((len(p["dimension"]), len(case.replicates), n_points.size), np.int64)
    count = named("kacsim.techniques", "integration", f"count_{p['generator']}")
    for k, dimension in enumerate(p["dimension"]):
        for row, replicate in enumerate(case.replicates):
            stream = new_stream(case.seed, f"{case.id} dimension {dimension}", replicate)
            count(inside[k, row], n_points, dimension, stream)
        progress(k + 1)
    return {
        "inside": described(inside, ("dimension", "replicate", "points"), "points in the sphere"),
        "dimension": described(np.array(p["dimension"]), ("dimension",), "dimension"),
        "points": described(n_points, ("points",), "number of points"),
    }


def sample_area(case, progress):
    """Integrate (1 - x**2)**exponent with many seeds: estimate[way, replicate, points]."""
    p = case.parameters
    n_points = np.array(p["n_points"], dtype=np.int64)
    sums = np.empty((2, len(case.replicates), n_points.size))
    for row, replicate in enumerate(case.replicates):
        part = np.empty((2, n_points.size))
        stream = new_stream(case.seed, case.id, replicate)
        integration.sum_area(part, n_points, float(p["exponent"]), stream)
        sums[:, row] = part
    progress(len(case.replicates))
    return {
        "estimate": described(2.0 * sums / n_points, ("way", "replicate", "points"), "area"),
        "points": described(n_points, ("points",), "number of points"),
    }
