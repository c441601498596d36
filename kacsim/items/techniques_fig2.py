"""Fig. 11.2 of the chapter: rejection under a constant and a closer envelope, and its cost."""

import math

from kacsim.items import _techniques
from kacsim.items._lazy import estimate, np, plotting, store, techniques_exact, verdict, xr
from kacsim.techniques.constants import SUPPORT

REJECTIONS = (("kac_initial", "constant"), ("kac_initial", "closer"), ("triangle", "constant"))
# Elementary functions of one trial: the closer envelope takes a logarithm, a root and an
# exponential, f0 another exponential.
FUNCTIONS = (1, 4, 0)
LABELS = ("$f_0$, constant", "$f_0$, closer", "triangle, constant")


def _cases(settings):
    found = [
        _techniques.case(settings, "rejection", law=law, envelope=name) for law, name in REJECTIONS
    ]
    table = _techniques.case(
        settings, "inverse_transform", law="kac_initial", n_table=list(settings["n_table"])
    )
    return found, table


def cases(settings):
    """Return draws by rejection, and those through tables that they are compared with."""
    found, table = _cases(settings)
    return [*found, table]


def reduce(samples, settings):
    """Return uniforms per accepted value with errors and predictions, and recorded trials."""
    found, table = _cases(settings)
    n = settings["n_draws"] * settings["n_replicates"]
    drawn = [samples[case.id] for case in found]
    means = [estimate.of_replicates(sample["uniforms"].values) for sample in drawn]
    trials = [estimate.of_replicates(sample["trials"].values) for sample in drawn]
    predicted = [2.0 * techniques_exact.envelope_area(*method) for method in REJECTIONS]
    distances = [_techniques.distance(sample["counts"].values.sum(axis=0)) for sample in drawn]
    through = estimate.of_replicates(samples[table.id]["uniforms"].values.ravel())
    described, one = store.described, ("way",)
    return xr.Dataset(
        {
            "uniforms": described([m.value for m in means], one, "uniforms per accepted value"),
            "uniforms_error": described([m.standard_error for m in means], one, "standard error"),
            "trials": described([m.value for m in trials], one, "choices per accepted value"),
            "trials_error": described([m.standard_error for m in trials], one, "standard error"),
            "functions": described(FUNCTIONS, one, "elementary functions of one choice"),
            "predicted": described(predicted, one, "twice the area under the envelope"),
            "distance": described(distances, one, "Kolmogorov-Smirnov distance from the law"),
            "p_value": described(
                [_techniques.p_of_distance(d, n) for d in distances], one, "its p-value"
            ),
            "table_uniforms": described(through.value, (), "uniforms per value through a table"),
            "point": described(
                np.stack([sample["point"].values for sample in drawn]),
                ("way", "trial", "part"),
                "value, height and acceptance of trials",
            ),
        },
        coords={"way": [" ".join(method) for method in REJECTIONS]},
    )


def claims(dataset):
    """Test the cost at half the area, and that of a closer envelope against both others."""
    constant, closer, half = (dataset.isel(way=k) for k in range(len(REJECTIONS)))
    trials, numbers = (_techniques.mean_of(half, name) for name in ("trials", "uniforms"))
    cheaper, dearer = (_techniques.mean_of(way, "uniforms") for way in (closer, constant))
    ratio = cheaper.value / dearer.value
    error = math.hypot(*(one.standard_error / one.value for one in (cheaper, dearer)))
    table, functions = float(dataset.table_uniforms), float(closer.functions)
    excess = cheaper.over(table)
    choices = _techniques.mean_of(closer, "trials")
    return [
        verdict.Finding(
            "techniques_fig2_half",
            (
                verdict.Part(trials, "choices", printed=2.0),
                verdict.Part(numbers, "random numbers", printed=4.0),
            ),
            "Density 2v on [0, 1] under the constant 2; numbers are counted on the stream.",
        ),
        verdict.finding(
            "techniques_fig2_closer",
            estimate.Mean(1.0 - ratio, ratio * error, numbers.degrees),
            f"f0 of the Kac paper: {cheaper.value:.3f} random numbers per value under the closer "
            f"envelope, {dearer.value:.3f} under a constant.",
        ),
        verdict.Finding(
            "techniques_fig2_table",
            (
                verdict.Part(
                    estimate.Mean(excess.value - 1.0, excess.standard_error, excess.degrees),
                    "random numbers",
                ),
                verdict.Part(choices.over(1.0 / functions), "elementary functions"),
            ),
            f"f0 of the Kac paper under the closer envelope, per value: {cheaper.value:.3f} random "
            f"numbers against {table:g}, and {functions * choices.value:.3f} logarithms, roots and "
            "exponentials against none, so that a generator without cost does not turn it round. "
            "Times are in docs/performance.md.",
        ),
    ]


def draw(dataset):
    """Draw accepted and rejected points under each envelope, and uniforms per accepted value."""
    figure, axes = plotting.panels(1, 3)
    grid = np.linspace(*SUPPORT["kac_initial"], 401)
    envelopes = (
        np.full_like(grid, techniques_exact.TOPS["kac_initial"]),
        techniques_exact.closer_envelope(grid),
    )
    for k, axis in enumerate(axes[:2]):
        v, height, accepted = dataset.point.values[k].T
        inside = accepted > 0.5
        axis.plot(
            v[~inside], height[~inside], "x", ms=3, color=plotting.COLOURS[1], label="rejected"
        )
        axis.plot(v[inside], height[inside], "o", ms=2, color=plotting.COLOURS[0], label="accepted")
        axis.plot(grid, techniques_exact.DENSITIES["kac_initial"](grid), color="black", lw=1)
        axis.plot(grid, envelopes[k], color="black", lw=1, ls="--")
        axis.set_xlim(SUPPORT["kac_initial"])
        axis.set_title(("constant envelope", "closer envelope")[k])
        axis.set_xlabel("velocity $v$")
        axis.set_ylabel("height of the trial point")
        axis.set_ylim(0.0, 0.62)
        axis.legend(loc="upper center", ncols=2, frameon=False)
    place = np.arange(len(REJECTIONS))
    plotting.points(
        axes[2], place, dataset.uniforms, dataset.uniforms_error, 0, "measured", line=False
    )
    axes[2].plot(
        place,
        dataset.predicted,
        "_",
        ms=22,
        color="black",
        label="predicted, 2 × area",
    )
    axes[2].axhline(
        float(dataset.table_uniforms), color=plotting.COLOURS[2], ls="--", label="through a table"
    )
    axes[2].set_xticks(place, LABELS, fontsize=7.5)
    axes[2].set_xlim(-0.5, len(REJECTIONS) - 0.5)
    axes[2].set_ylim(0.0, 1.2 * float(dataset.uniforms.max()))
    axes[2].set_ylabel("uniforms per accepted value")
    axes[2].legend(loc="upper right", markerscale=0.6)
    return figure
