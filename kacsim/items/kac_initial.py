"""Study: f0 drawn in three ways, by table, by rejection and by the Gamma identity: law and cost."""

from kacsim.items import _techniques
from kacsim.items._lazy import estimate, np, plotting, store, techniques_exact, verdict, xr
from kacsim.kac.constants import MEAN_ENERGY

WAYS = ("constant", "closer", "identity")
LABELS = ("rejection, constant", "rejection, closer", "Gamma identity")


def _cases(settings):
    law = "kac_initial"
    tables = _techniques.case(
        settings, "inverse_transform", law=law, n_table=list(settings["n_table"])
    )
    found = {
        name: _techniques.case(settings, "rejection", law=law, envelope=name)
        for name in ("constant", "closer")
    }
    found["identity"] = _techniques.case(settings, "identity")
    return tables, found


def cases(settings):
    """Return draws through tables of all sizes, by rejection and by the identity."""
    tables, found = _cases(settings)
    return [tables, *found.values()]


def reduce(samples, settings):
    """Return distances from f0, the second moment and uniforms per draw of each way."""
    tables, found = _cases(settings)
    n = settings["n_draws"] * settings["n_replicates"]
    drawn = [samples[found[name].id] for name in WAYS]
    table = samples[tables.id]
    counts = [sample["counts"].values.sum(axis=0) for sample in drawn]
    distances = [_techniques.distance(c) for c in counts]
    through = [_techniques.distance(c) for c in table["counts"].values.sum(axis=1)]
    uniforms = [estimate.of_replicates(sample["uniforms"].values) for sample in drawn]
    squares = [estimate.of_replicates(_techniques.mean_of_power(sample, 2)) for sample in drawn]
    of_tables = [estimate.of_replicates(row) for row in _techniques.mean_of_power(table, 2)]
    predicted = [2.0 * techniques_exact.envelope_area("kac_initial", name) for name in WAYS[:2]]
    described, one, many = store.described, ("way",), ("n_table",)
    return xr.Dataset(
        {
            "distance": described(distances, one, "Kolmogorov-Smirnov distance from f0"),
            "p_value": described(
                [_techniques.p_of_distance(d, n) for d in distances], one, "its p-value"
            ),
            "table_distance": described(through, many, "distance through a table"),
            "table_p_value": described(
                [_techniques.p_of_distance(d, n) for d in through], many, "its p-value"
            ),
            "uniforms": described([m.value for m in uniforms], one, "uniforms per draw"),
            "uniforms_error": described(
                [m.standard_error for m in uniforms], one, "standard error"
            ),
            "predicted": described([*predicted, np.nan], one, "twice the area of the envelope"),
            "table_uniforms": described(
                table["uniforms"].values.mean(axis=1), many, "uniforms per draw"
            ),
            "square": described([m.value for m in squares], one, "mean of v**2"),
            "square_error": described([m.standard_error for m in squares], one, "standard error"),
            "table_square": described([m.value for m in of_tables], many, "mean of v**2"),
            "table_square_error": described(
                [m.standard_error for m in of_tables], many, "standard error"
            ),
            "floor": described(_techniques.median_distance(n), (), "median distance, exact draws"),
        },
        coords={"way": list(WAYS), "n_table": settings["n_table"]},
    )


def claims(dataset):
    """Check that every exact way of drawing f0 has its second moment."""
    degrees = dataset.attrs["settings"]["n_replicates"] - 1
    parts = [
        verdict.Part(
            estimate.Mean(float(dataset.square[k]), float(dataset.square_error[k]), degrees),
            label,
            printed=MEAN_ENERGY,
        )
        for k, label in enumerate(LABELS)
    ]
    finest = dataset.isel(n_table=-1)
    evidence = (
        f"E v² of f₀. A table is no exact way: with {int(finest.n_table)} intervals it gives "
        f"{float(finest.table_square):.4f}."
    )
    return [verdict.Finding("kac_initial_square", tuple(parts), evidence)]


def draw(dataset):
    """Draw the distances from f0, and the uniforms per draw."""
    figure, axes = plotting.panels(1, 2)
    size = dataset.n_table.values
    axes[0].plot(
        size, dataset.table_distance, "o", ms=4, color=plotting.COLOURS[0], label="table of $N_t$"
    )
    for k, name in enumerate(LABELS):
        axes[0].plot(
            size[-1] * 2.0 ** (k + 1),
            dataset.distance[k],
            plotting.MARKERS[k + 1],
            ms=4,
            color=plotting.COLOURS[k + 1],
            label=name,
        )
    axes[0].axhline(float(dataset.floor), color="0.5", ls=":", lw=1.2, label="exact, median")
    axes[0].set_xscale("log", base=2)
    axes[0].set_xticks(size)
    axes[0].set_yscale("log")
    axes[0].set_xlabel("intervals of the table $N_t$ (right: no table)")
    axes[0].set_ylabel("distance of the draws from $f_0$")
    axes[0].legend()
    place = np.arange(len(WAYS) + 1)
    height = [float(dataset.table_uniforms[0]), *dataset.uniforms.values]
    axes[1].bar(place, height, color=plotting.COLOURS[:4], width=0.6)
    axes[1].plot(place[1:], dataset.predicted, "_", ms=30, color="black", label="2 × area")
    axes[1].set_xticks(place, ["table", *(name.replace(" ", "\n", 1) for name in LABELS)])
    axes[1].set_ylabel("uniforms per draw")
    axes[1].legend(markerscale=0.4)
    return figure
