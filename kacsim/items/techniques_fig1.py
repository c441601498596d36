"""Fig. 11.1 of the chapter: inverse transform by a table equally spaced in u, and its error."""

import math

from kacsim.items import _techniques
from kacsim.items._lazy import (
    estimate,
    inverse_transform,
    np,
    plotting,
    slope,
    store,
    techniques_exact,
    verdict,
    xr,
)
from kacsim.techniques.constants import SUPPORT

TABULATED = ("kac_initial", "exponential", "ramp")
SHOWN, COARSE = TABULATED[0], 2  # the law and the place of the table that are drawn in full
N_FINE = 20_001  # places in v where the error of a table is looked for
BINS = 60


def _cases(settings):
    tables = list(settings["n_table"])
    return {
        law: _techniques.case(settings, "inverse_transform", law=law, n_table=tables)
        for law in TABULATED
    }


def cases(settings):
    """Return draws of three laws through tables of all sizes."""
    return list(_cases(settings).values())


def _worst(law, n_table):
    """Return (largest error in P of a table's law, P where it is)."""
    table = inverse_transform.law_table(law, n_table)
    between = np.linspace(0.0, 1.0, max(3, N_FINE // n_table))[:-1]
    places = (table[:-1, None] + np.diff(table)[:, None] * between).ravel()
    error = inverse_transform.table_error(law, table, places)
    k = int(np.argmax(np.abs(error)))
    return abs(float(error[k])), float(techniques_exact.CUMULATIVES[law](places[k]))


def _error_at(law, n_table, u):
    """Return the error in P of a table's law where the exact cumulative probability is u."""
    table = inverse_transform.law_table(law, n_table)
    low, high = table[0], table[-1]
    for _ in range(80):
        middle = 0.5 * (low + high)
        below = techniques_exact.CUMULATIVES[law](middle) < u
        low, high = (middle, high) if below else (low, middle)
    return float(inverse_transform.table_error(law, table, np.array([low]))[0])


def _bisections(law, error):
    """Return the halvings of a law's support after which P is known to an error."""
    low, high = SUPPORT[law]
    return math.ceil(math.log2((high - low) * techniques_exact.TOPS[law] / error))


def reduce(samples, settings):
    """Return distances of the drawn laws, exact errors of the tables, and the powers of N_t.

    The deviation is the share of draws below the place where the table's error is largest, less the
    exact probability there: its mean is known, and its error binomial.
    """
    sizes, n = settings["n_table"], settings["n_draws"] * settings["n_replicates"]
    shape = (len(TABULATED), len(sizes))
    keys = ("distance", "exact", "deviation", "deviation_error", "deviation_exact")
    table = {key: np.empty(shape) for key in keys}
    power = np.empty((3, len(TABULATED)))
    for i, case in enumerate(_cases(settings).values()):
        sample = samples[case.id]
        counts = sample["counts"].values.sum(axis=1)
        cells = counts.shape[-1]
        for j, size in enumerate(sizes):
            table["exact"][i, j], u = _worst(TABULATED[i], size)
            edge = min(max(1, round(u * cells)), cells - 1)
            below = int(counts[j, :edge].sum())
            mean = estimate.of_share(below, n)
            table["distance"][i, j] = _techniques.distance(counts[j])
            table["deviation"][i, j] = mean.value - edge / cells
            table["deviation_error"][i, j] = mean.standard_error
            table["deviation_exact"][i, j] = _error_at(TABULATED[i], size, edge / cells)
        clear = table["exact"][i] > 10.0 * table["deviation_error"][i]
        clear[:2] = True
        squares = (table["deviation"][i] ** 2)[clear]
        many = np.array(sizes)[clear]
        noise = (table["deviation_error"][i] / np.abs(table["deviation"][i]))[clear]
        power[:, i] = (
            *_line(many, squares, noise),
            slope.of_squares(many, (table["exact"][i] ** 2)[clear], np.arange(many.size))[0].value,
        )
    first = samples[_cases(settings)[SHOWN].id]
    coarse = min(COARSE, len(sizes) - 1)
    share, edges = _techniques.binned(first["counts"].values[coarse].sum(axis=0), BINS)
    fine = np.linspace(*SUPPORT[SHOWN], N_FINE)
    last = estimate.of_share(round(float(first["last"].values[0].mean()) * n), n)
    described, dims = store.described, ("law", "n_table")
    texts = {
        "distance": "Kolmogorov-Smirnov distance of the draws from the law",
        "exact": "largest error in P of the table's own law",
        "deviation": "share of draws below the place of that error, less P",
        "deviation_error": "standard error",
        "deviation_exact": "error in P of the table's own law there",
    }
    variables = {key: described(table[key], dims, text) for key, text in texts.items()}
    variables |= {
        "power": described(power[0], ("law",), "power of N_t of the measured deviation"),
        "power_error": described(power[1], ("law",), "standard error"),
        "power_exact": described(power[2], ("law",), "power of N_t of the exact error, same N_t"),
        "share": described(share, ("bin",), f"share of draws, N_t = {sizes[coarse]}, {SHOWN}"),
        "probability": described(edges, ("edge",), "cumulative probability of the bins' edges"),
        "node": described(
            inverse_transform.law_table(SHOWN, sizes[coarse]), ("node",), "nodes of that table"
        ),
        "value_edge": described(
            np.interp(edges, techniques_exact.CUMULATIVES[SHOWN](fine), fine),
            ("edge",),
            "edges of the bins",
        ),
        "bisections": described(
            [_bisections(law, table["exact"][i, -1]) for i, law in enumerate(TABULATED)],
            ("law",),
            "halvings that find P as well as the largest table does",
        ),
        "floor": described(_techniques.median_distance(n), (), "median distance of exact draws"),
        "last": described(last.value, (), "share of draws in the last interval, first table"),
        "last_error": described(last.standard_error, (), "standard error"),
    }
    return xr.Dataset(variables, coords={"law": list(TABULATED), "n_table": sizes})


def _line(n, squares, noise):
    """Return the power of N_t of deviations with known relative errors: weighted least squares."""
    x, y, weight = np.log(n), 0.5 * np.log(squares), 1.0 / noise**2
    centre = (weight * x).sum() / weight.sum()
    spread = (weight * (x - centre) ** 2).sum()
    return float((weight * (x - centre) * y).sum() / spread), float(1.0 / np.sqrt(spread))


def claims(dataset):
    """Test whether N_t values serve every u, and what a table spares against bisection."""
    size, most = int(dataset.n_table[0]), int(dataset.n_table[-1])
    spared = [
        verdict.Part(estimate.Exact(float(dataset.bisections.sel(law=law))), law)
        for law in TABULATED
    ]
    return [
        verdict.finding(
            "techniques_fig1_values",
            estimate.Exact(1.0 / size),
            f"The index of u from 1 − 1/N_t on is the last: a share 1/{size} of all u at N_t = "
            f"{size} ({float(dataset['last']):.4f} of this run's draws). Footnote 72, which stands "
            "there, is not in the copy used.",
        ),
        verdict.Finding(
            "techniques_fig1_quick",
            tuple(spared),
            f"Halvings of the law's support, each with one P, until P is known as well as by "
            f"N_t = {most}; a table takes none after it is made.",
        ),
    ]


def draw(dataset):
    """Draw the table's use, draws through a coarse table, and the error against N_t."""
    figure, axes = plotting.panels(1, 3)
    grid = np.linspace(-3.0, 3.0, 301)
    _use(axes[0], dataset, grid)
    edges = dataset.value_edge.values
    height = dataset.share.values / np.diff(edges)
    plotting.bars(axes[1], edges, height, 1, f"draws, $N_t$ = {dataset.sizes['node'] - 1}")
    axes[1].plot(grid, techniques_exact.DENSITIES[SHOWN](grid), color="black", lw=1, label="$f_0$")
    axes[1].set_ylabel("density")
    plotting.legends_above([axes[1]], share=0.25)
    for axis in axes[:2]:
        axis.set_xlim(-3.0, 3.0)
        axis.set_xlabel("velocity $v$")
    _errors(axes[2], dataset)
    return figure


def _use(axis, dataset, grid, u=0.62):
    """Draw how a uniform u becomes a value."""
    nodes, steps = dataset.node.values, np.linspace(0.0, 1.0, dataset.sizes["node"])
    orange, blue = plotting.COLOURS[1], plotting.COLOURS[0]
    axis.plot(grid, techniques_exact.CUMULATIVES[SHOWN](grid), color="black", lw=1, label="$P(v)$")
    label = f"table, $N_t$ = {nodes.size - 1}"
    axis.plot(nodes, steps, "o-", ms=4, lw=0.8, color=orange, label=label)
    value = float(np.interp(u, steps, nodes))
    arrow = {"arrowstyle": "->", "color": blue}
    axis.annotate("", (value, 0.0), (value, u), arrowprops=arrow)
    axis.plot([grid[0], value], [u, u], color=blue, lw=1)
    axis.text(grid[0] + 0.1, u + 0.02, "uniform $u$", color=blue, fontsize=8)
    axis.text(value + 0.1, 0.03, "drawn $v$", color=blue, fontsize=8)
    axis.set_ylim(0.0, 1.05)
    axis.set_ylabel("cumulative probability $P(v)$")
    axis.legend(loc="upper left")


def _errors(axis, dataset):
    """Draw distances of the draws, and the exact errors of the tables, against N_t."""
    for k, law in enumerate(TABULATED):
        here, colour = dataset.sel(law=law), plotting.COLOURS[k]
        axis.plot(dataset.n_table, here.distance, plotting.MARKERS[k], ms=4, color=colour)
        power = plotting.with_error(estimate.Mean(float(here.power), float(here.power_error)))
        label = f"{_techniques.LAW_TITLES[law]}: {power}".replace("-", "−")
        axis.plot(dataset.n_table, here.exact, color=colour, lw=1, label=label)
    axis.axhline(float(dataset.floor), color="0.5", ls=":", lw=1.2, label="exact draws, median")
    axis.set_xscale("log", base=2)
    axis.set_yscale("log")
    axis.set_ylim(1e-4, 20.0)
    axis.set_xlabel("intervals of the table $N_t$")
    axis.set_ylabel("distance from the law")
    axis.legend(title="power of $N_t$", loc="upper right", frameon=False)
