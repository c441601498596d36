"""Study: coupling from the past, by doubling and forward on the same inputs (section 5.1)."""

import math

from kacsim.cases import make_case
from kacsim.items._lazy import estimate, exact, histogram, np, plotting, store, verdict, xr
from kacsim.kac.constants import MEAN_ENERGY

WAYS = ("backward", "forward")
LABELS = ("from the past", "forward")
BINS = 20  # of the figure, over the radius


def cases(settings):
    """Return the case of draws coupled both ways."""
    keys = ("n_particles", "tolerance", "n_draws", "n_replicates", "seed")
    return [make_case("kac_forward", **{key: settings[key] for key in keys})]


def reduce(samples, settings):
    """Return fourth moments and laws of both ways, and errors in units of epsilon."""
    (case,) = cases(settings)
    sample, described, n = samples[case.id], store.described, settings["n_particles"]
    n_draws = case.n_draws * case.n_replicates
    fourth, square = (sample[name].mean("replicate").values for name in ("fourth", "fourth_square"))
    error = np.sqrt(np.maximum(0.0, square - fourth**2) / n_draws)
    other = settings["other_n_particles"]
    moments = {
        "moment_exact": (exact.equilibrium_fourth_moment(n), "exact E v**4 of N particles"),
        "moment_limit": (exact.shape_moment(4, exact.shape(math.inf)), "E v**4 of eq. (9)"),
        "moment_other": (exact.drawn_fourth_moment(other), "E v**4, other N, energy drawn"),
        "moment_other_fixed": (exact.equilibrium_fourth_moment(other), "E v**4, other N"),
    }
    edges, density = _density(sample["counts"].sum("replicate").values, n)
    way, kind = ("way",), ("kind",)
    return xr.Dataset(
        {
            "moment": described(fourth, way, "mean of v**4 over particles and draws"),
            "moment_error": described(error, way, "standard error of the mean of v**4"),
            "steps": described(sample["steps"].mean("replicate"), way, "mean steps", "steps"),
            "density": described(density, (*way, "bin"), "density of the coordinates, no signs"),
            "density_exact": described(_exact(edges, n), ("bin",), "exact law of N particles"),
            "n_far": described(
                sample["n_far"].sum("replicate"), kind, "draws an epsilon away or more"
            ),
            "largest_error": described(
                sample["largest_error"].max("replicate"), kind, "largest distance over epsilon"
            ),
            "n_draws": described(n_draws, (), "draws of each way"),
        }
        | {name: described(value, (), text) for name, (value, text) in moments.items()},
        coords={"way": list(WAYS), "kind": ["doubled", "limit"], "edge": ("edge", edges)},
    )


def _density(counts, n):
    """Return (edges, density[way, bin]) of coordinates from 0 to the radius, by fine bins."""
    fine = histogram.fine_edges()
    low = int(np.argmin(np.abs(fine)))
    high = int(np.searchsorted(fine, math.sqrt(MEAN_ENERGY * n)))
    edges = fine[low : high + 1]
    inside = counts[:, low + 1 : high + 1]
    stride = max(1, (high - low) // BINS)
    kept = (high - low) // stride * stride
    wide = inside[:, :kept].reshape(len(WAYS), -1, stride).sum(axis=-1)
    edges = edges[: kept + 1 : stride]
    return edges, wide / counts.sum(axis=1, keepdims=True) / np.diff(edges)


def _exact(edges, n):
    """Return the mean density of |v_1| at the equilibrium of N particles over bins."""
    return 2.0 * np.diff(exact.equilibrium_cumulative(edges, n)) / np.diff(edges)


def claims(dataset):
    """Compare both ways with the law of N particles, and draws with their limits."""
    settings = dataset.attrs["settings"]
    n, other = settings["n_particles"], settings["other_n_particles"]
    past, forward = (_moment(dataset, way) for way in WAYS)
    values = {name: float(dataset[f"moment_{name}"]) for name in ("exact", "limit", "other")}
    departure = forward.minus(estimate.Mean(values["exact"], 0.0)).over(values["exact"])
    size = f"N = {n}, ε = {settings['tolerance']:g}, {int(dataset.n_draws)} draws"
    z = past.z(values["exact"])
    limit = {"printed": values["limit"]}
    found = [
        verdict.finding(
            "kac_51_forward",
            departure,
            f"{size}, all particles; coupled from the past on the same inputs z = {z:.1f}.",
        ),
        verdict.finding("kac_51_perfect", past, f"{size}.", printed=values["exact"]),
        verdict.Finding(
            "kac_5_limit",
            (
                verdict.Part(past, f"N = {n}, drawn", corrected=values["exact"], **limit),
                verdict.Part(
                    estimate.Exact(values["other"]),
                    f"N = {other}, exact",
                    corrected=values["other"],
                    **limit,
                ),
            ),
            f"With energy 3N/2 in place of the drawn one: "
            f"{float(dataset.moment_other_fixed):.3f} at N = {other}.",
        ),
    ]
    for claim, kind in (("kac_52_doubling", "doubled"), ("kac_5_accuracy", "limit")):
        here = dataset.sel(kind=kind)
        share = estimate.Share(int(here.n_far), int(dataset.n_draws))
        evidence = f"{size}; the largest distance is {float(here.largest_error):.2f} ε."
        found.append(verdict.finding(claim, share, evidence))
    return found


def _moment(dataset, way):
    here = dataset.sel(way=way)
    return estimate.Mean(float(here.moment), float(here.moment_error))


def draw(dataset):
    """Draw the law of a coordinate, coupled both ways, with the exact one."""
    figure, (axis,) = plotting.panels(1, 1, height=2.8)
    edges = dataset.edge.values
    for k, way in enumerate(WAYS):
        label = f"{LABELS[k]}: E $v^4$ = {plotting.with_error(_moment(dataset, way))}"
        plotting.bars(axis, edges, dataset.density.sel(way=way), k, label, fill=k == 0)
    n = dataset.attrs["settings"]["n_particles"]
    axis.stairs(
        dataset.density_exact, edges, baseline=None, color="black", lw=1, label=f"exact, $N$ = {n}"
    )
    axis.set_xlabel("$|v_1|$")
    axis.set_ylim(bottom=0.0)
    plotting.density_axis(axis)
    plotting.legend_on_top(axis, ncols=1)
    return figure
