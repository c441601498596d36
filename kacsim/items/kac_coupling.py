"""Study: coupling time of the epsilon-perfect sampler against N and epsilon."""

import math

from kacsim.cases import make_case
from kacsim.items._lazy import np, plotting, store, xr
from kacsim.kac.contraction import contraction_rate, predicted_steps

SUMMARY = ("mean", "error", "spread", "least", "most")


def _case(settings, n_particles, tolerance):
    keys = ("n_draws", "n_replicates", "seed")
    common = {key: settings[key] for key in keys}
    return make_case("kac_equilibrium", n_particles=n_particles, tolerance=tolerance, **common)


def _grids(settings):
    by_n = [_case(settings, n, settings["fixed_tolerance"]) for n in settings["n_particles"]]
    fixed = settings["fixed_n_particles"]
    return by_n, [_case(settings, fixed, tolerance) for tolerance in settings["tolerance"]]


def cases(settings):
    """Return the cases against N and those against epsilon."""
    by_n, by_tolerance = _grids(settings)
    return [*by_n, *by_tolerance]


def reduce(samples, settings):
    """Return mean, error, spread and range of the coupling times, with predictions."""
    described, variables = store.described, {}
    for prefix, grid, dim in zip(
        ("n_", "tolerance_"), _grids(settings), ("n_particles", "tolerance"), strict=True
    ):
        table = np.array([_summary(samples[case.id], case) for case in grid])
        for k, name in enumerate(SUMMARY):
            variables[prefix + name] = described(table[:, k], (dim,), name, "steps")
        variables[prefix + "predicted"] = described(
            [predicted_steps(c.parameters["n_particles"], c.parameters["tolerance"]) for c in grid],
            (dim,),
            "steps until the mean squared distance reaches epsilon**2",
            "steps",
        )
    return xr.Dataset(
        variables | _slope(variables, settings),
        coords={"n_particles": settings["n_particles"], "tolerance": settings["tolerance"]},
    )


def _summary(sample, case):
    n_draws = case.n_draws * case.n_replicates
    variance = float(sample["coupling_variance"].mean() + sample["coupling_mean"].var())
    mean, error = float(sample["coupling_mean"].mean()), math.sqrt(variance / n_draws)
    extremes = int(sample["coupling_min"].min()), int(sample["coupling_max"].max())
    return (mean, error, math.sqrt(variance), *extremes)


def _slope(variables, settings):
    """Return variables: steps per factor e of 1/epsilon, with standard error and bound."""
    tolerances = np.array(settings["tolerance"])
    ends = np.argmin(tolerances), np.argmax(tolerances)
    log = math.log(tolerances.max() / tolerances.min())
    small, large = (variables["tolerance_mean"][1][k] for k in ends)
    errors = [variables["tolerance_error"][1][k] for k in ends]
    bound = 2.0 / -math.log1p(-contraction_rate(settings["fixed_n_particles"]))
    numbers = {
        "slope": ((small - large) / log, "steps per factor e of 1/epsilon"),
        "slope_error": (math.hypot(*errors) / log, "standard error of the slope"),
        "slope_bound": (bound, "upper bound from the contraction rate"),
    }
    return {name: store.described(value, (), text) for name, (value, text) in numbers.items()}


def draw(dataset):
    """Draw mean, spread and range against N and against epsilon, with the published mean."""
    settings = dataset.attrs["settings"]
    figure, axes = plotting.panels(1, 2, share_y=False)
    for axis, prefix, x in (
        (axes[0], "n_", dataset.n_particles),
        (axes[1], "tolerance_", dataset.tolerance),
    ):
        mean, spread = dataset[prefix + "mean"], dataset[prefix + "spread"]
        plotting.points(axis, x, mean, spread, 0, "mean and standard deviation", line=False)
        axis.fill_between(
            x,
            dataset[prefix + "least"],
            dataset[prefix + "most"],
            color=plotting.COLOURS[0],
            alpha=0.15,
            lw=0,
            label="range",
        )
        axis.plot(
            x, dataset[prefix + "predicted"], color="0.3", ls="--", lw=1, label="contraction rate"
        )
        axis.set_xscale("log")
    published = dataset.attrs["published"]["kac_fig9_coupling_mean"]
    style = {"marker": "*", "ls": "", "color": plotting.COLOURS[1], "label": "published mean"}
    axes[0].plot(settings["fixed_n_particles"], published, **style)
    axes[1].plot(settings["fixed_tolerance"], published, **style)
    axes[0].set_yscale("log")
    plotting.plain_log(axes[0].xaxis)
    axes[1].invert_xaxis()
    axes[0].set_xlabel("number of particles $N$")
    axes[1].set_xlabel("tolerance $\\varepsilon$")
    axes[0].set_ylabel("coupling time in steps")
    axes[0].set_title("$\\varepsilon$ = " + plotting.power_of_ten(settings["fixed_tolerance"]))
    axes[1].set_title(f"$N$ = {settings['fixed_n_particles']}")
    axes[0].legend()
    return figure
