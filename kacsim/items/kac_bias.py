"""Study: E v_1**4 of every algorithm against N and the step, measured and exact."""

import math

from kacsim.cases import make_case
from kacsim.items import _kac
from kacsim.items._lazy import (
    distinct_pairs,
    estimate,
    nanbu_babovsky,
    np,
    plotting,
    statements,
    store,
    verdict,
    xr,
)
from kacsim.kac.samplers import ALGORITHMS, STEPPED, TITLES

# Drawn for the published figures too.
SHOWN = ("nanbu_sequential", "bird", "poisson", "poisson_printed")


def _case(settings, algorithm, n_particles, time_step):
    """Return a case of a figure where one has it, else one of fewer replicates."""
    many = "n_replicates" if algorithm in SHOWN else "other_n_replicates"
    size = {"n_replicates": settings[many]}
    return _kac.velocity_case(settings, algorithm, n_particles, time_step, **size)


def particle_grid(settings):
    """Return place -> case: every algorithm at every N, those with a step at one."""
    return {
        (a, n): _case(settings, algorithm, n_particles, settings["fixed_time_step"])
        for a, algorithm in enumerate(ALGORITHMS)
        for n, n_particles in enumerate(settings["n_particles"])
    }


def step_grid(settings):
    """Return place -> case: the algorithms with a step at each of them, at one N."""
    n_particles = settings["fixed_n_particles"]
    return {
        (a, s): _case(settings, algorithm, n_particles, step)
        for a, algorithm in enumerate(STEPPED)
        for s, step in enumerate(settings["time_step"])
    }


def _forward_case(settings):
    """Return forward draws of the exact Poisson algorithm: they count what it spares."""
    return make_case(
        "kac",
        algorithm="poisson",
        engine="forward",
        n_particles=settings["fixed_n_particles"],
        time=settings["time"],
        n_draws=settings["n_draws"],
        n_replicates=settings["n_replicates"],
        seed=settings["seed"],
    )


def cases(settings):
    """Return all algorithms against N, those with a step against it, and one forward count."""
    grids = particle_grid(settings), step_grid(settings)
    return [*(case for grid in grids for case in grid.values()), _forward_case(settings)]


def reduce(samples, settings):
    """Return measured and exact fourth moments, and the collisions that Poisson spares."""
    shape = len(ALGORITHMS), len(settings["n_particles"])
    by_n = _kac.moment_table(samples, particle_grid(settings), shape)
    shape = len(STEPPED), len(settings["time_step"])
    by_step = _kac.moment_table(samples, step_grid(settings), shape)
    described, variables = store.described, {}
    names = ("moment", "moment_error", "moment_exact")
    texts = ("mean of v_1**4", "standard error of the mean of v_1**4", "exact mean of v_1**4")
    for k, (name, text) in enumerate(zip(names, texts, strict=True)):
        variables[name] = described(by_n[k], ("algorithm", "n_particles"), text)
        variables[f"step_{name}"] = described(by_step[k], ("stepped", "time_step"), text)
    variables |= _step_tvn(samples, settings)
    case = _forward_case(settings)
    variables |= _forward(samples[case.id], case)
    variables |= _pairs(case, settings["time_step"][0])
    n, step = settings["fixed_n_particles"], settings["fixed_time_step"]
    few = [_kac.exact_moment(_kac.velocity_case(settings, name, n, step)) for name in ALGORITHMS]
    text = "exact mean of v_1**4 at the fixed N and step"
    variables["few_moment"] = described(few, ("algorithm",), text)
    limit = _kac.limit_moment(settings["time"])
    variables["limit"] = described(limit, (), "E v**4 of the Kac equation")
    coords = {
        "algorithm": list(ALGORITHMS),
        "stepped": list(STEPPED),
        "n_particles": settings["n_particles"],
        "time_step": settings["time_step"],
    }
    return xr.Dataset(variables, coords={key: (key, values) for key, values in coords.items()})


def _step_tvn(samples, settings):
    """Return the mean TVN against the step, with its errors."""
    table = np.full((2, len(STEPPED), len(settings["time_step"])), np.nan)
    for place, case in step_grid(settings).items():
        values = _kac.tvn(samples[case.id], settings, settings["bin_width"])
        mean = estimate.of_replicates(values)
        table[(slice(None), *place)] = mean.value, mean.standard_error
    dims = ("stepped", "time_step")
    return {
        "step_tvn": store.described(table[0], dims, "mean TVN against eq. (8)"),
        "step_tvn_error": store.described(table[1], dims, "its standard error"),
    }


def _forward(sample, case):
    """Return what forward draws of the exact Poisson algorithm count, and what they should."""
    described = store.described
    own_error = math.sqrt(float(sample["own_variance"].mean()) / _kac.n_draws_of(case))
    simulated = estimate.of_replicates(sample["collisions"].values)
    rate, n, time = (case.parameters[k] for k in ("collision_rate", "n_particles", "time"))
    whole, spared = rate * n * time / 2, statements.spared_time(time, rate)
    return {
        "own_collisions": described(
            float(sample["own_collisions"].mean()), (), "mean collisions of particle 1"
        ),
        "own_collisions_error": described(own_error, (), "its standard error"),
        "rate_time": described(rate * time, (), "rate times t"),
        "spared": described(whole - simulated.value, (), "collisions spared, from forward draws"),
        "spared_error": described(simulated.standard_error, (), "its standard error"),
        "spared_exact": described(
            0.5 * rate * (n - 2) * spared, (), "rate (N - 2)/2 times the mean time spared"
        ),
    }


def _pairs(case, time_step):
    """Return exact E v_1**4 of Nanbu-Babovsky, for other readings of how pairs are drawn."""
    names = ("n_particles", "time", "collision_rate")
    process = {name: case.parameters[name] for name in names} | {"time_step": time_step}
    text = "exact mean of v_1**4 of Nanbu-Babovsky at the first step, "
    return {
        "replacement": store.described(
            nanbu_babovsky.fourth_moment_with_replacement(**process),
            (),
            text + "pairs with replacement",
        ),
        "distinct": store.described(
            distinct_pairs.fourth_moment(**process), (), text + "distinct pairs one after another"
        ),
    }


def claims(dataset):
    """Test the statements on rates, pairs and accuracy, and the samplers themselves."""
    return [*_rates(dataset), _replacement(dataset), *_accuracy(dataset), *_checks(dataset)]


def _rates(dataset):
    """Test the times between collisions of particle 1, and the collisions spared, exactly."""
    settings = dataset.attrs["settings"]
    n, time = settings["fixed_n_particles"], settings["time"]
    mean_own = float(dataset.rate_time)
    never = -math.expm1(-mean_own)
    drawn = [_kac.mean_of(dataset, name) for name in ("own_collisions", "spared")]
    counted = [f"{mean.value:.4f} ± {mean.standard_error:.4f}" for mean in drawn]
    own = "Own forward draws, which tell nothing of what the authors ran: "
    return [
        verdict.finding(
            "kac_43_exponential",
            estimate.Exact(mean_own),
            f"Mean number of collisions of particle 1 until t = {time:g}, from the rate of the "
            f"thinned process. {own}{counted[0]}.",
            printed=mean_own * time,
            corrected=mean_own,
        ),
        verdict.finding(
            "kac_43_saving",
            estimate.Exact(float(dataset.spared_exact)),
            f"N = {n}: mean time after the last collision of particle 1, a sum over their number, "
            f"times the rate of the others. {own}{counted[1]}.",
            printed=0.5 * n * never,
            corrected=0.5 * (n - 2) * never,
        ),
    ]


def _replacement(dataset):
    """Test what section 4.4 says of the pairs of Nanbu-Babovsky against section 4.1."""
    settings = dataset.attrs["settings"]
    step = settings["time_step"][0]
    disjoint = float(dataset.step_moment_exact.sel(stepped="nanbu_babovsky", time_step=step))
    with_replacement, distinct = float(dataset.replacement), float(dataset.distinct)
    return verdict.finding(
        "kac_44_replacement",
        estimate.Exact(disjoint),
        f"Exact, at N = {settings['fixed_n_particles']} and step {step:g}: {disjoint:.4f} for "
        f"disjoint pairs, {distinct:.4f} for distinct pairs that may share particles, one after "
        f"another, {with_replacement:.4f} with replacement. Which of them the authors ran these "
        "values do not tell.",
        printed=with_replacement,
        corrected=disjoint,
    )


def _accuracy(dataset):
    """Test the accuracy of all algorithms with few particles, and that it depends on the step."""
    settings, limit = dataset.attrs["settings"], float(dataset.limit)
    n, step = settings["fixed_n_particles"], settings["fixed_time_step"]
    errors = [
        verdict.Part(
            estimate.Exact(abs(float(dataset.few_moment.sel(algorithm=name)) / limit - 1.0)),
            TITLES[name],
        )
        for name in ALGORITHMS
    ]
    falls = []
    for name in STEPPED:
        large, small = (_step_mean(dataset, name, end(settings["time_step"])) for end in (max, min))
        falls.append(verdict.Part(large.minus(small), TITLES[name]))
    return [
        verdict.Finding(
            "kac_44_accuracy",
            tuple(errors),
            f"Relative error of E v₁⁴ at N = {n}, step {step:g} where there is one.",
        ),
        verdict.Finding(
            "kac_44_step",
            tuple(falls),
            f"Mean TVN at the largest step less that at the smallest, N = {n}.",
        ),
    ]


def _step_mean(dataset, name, step):
    """Return the mean TVN at a step; its replicates give its error."""
    here = dataset.sel(stepped=name, time_step=step)
    many = "n_replicates" if name in SHOWN else "other_n_replicates"
    degrees = dataset.attrs["settings"][many] - 1
    return estimate.Mean(float(here.step_tvn), float(here.step_tvn_error), degrees)


def _checks(dataset):
    """Check the samplers against the exact moments and counts of their own processes."""
    n = int(dataset.n_particles[1])
    parts = []
    for name in ALGORITHMS:
        drawn = _kac.mean_of(dataset, "moment", algorithm=name, n_particles=n)
        exactly = float(dataset.moment_exact.sel(algorithm=name, n_particles=n))
        parts.append(verdict.Part(drawn, TITLES[name], printed=exactly))
    counts = (
        verdict.Part(
            _kac.mean_of(dataset, "own_collisions"),
            "collisions of particle 1",
            printed=float(dataset.rate_time),
        ),
        verdict.Part(
            _kac.mean_of(dataset, "spared", dataset.attrs["settings"]["n_replicates"] - 1),
            "collisions spared",
            printed=float(dataset.spared_exact),
        ),
    )
    return [
        verdict.Finding("kac_bias_samplers", tuple(parts), f"E v₁⁴ at N = {n}."),
        verdict.Finding("kac_bias_counts", counts, "Forward draws of the exact Poisson algorithm."),
    ]


def draw(dataset):
    """Draw E v_1**4 against N and against the step, points measured and lines exact."""
    figure, axes = plotting.panels(1, 2)
    for k, algorithm in enumerate(dataset.algorithm.values):
        here = dataset.sel(algorithm=algorithm)
        _series(axes[0], here.n_particles, here, "", k, TITLES[str(algorithm)])
    for k, algorithm in enumerate(dataset.stepped.values):
        here = dataset.sel(stepped=algorithm)
        _series(axes[1], here.time_step, here, "step_", k, TITLES[str(algorithm)])
    for axis in axes:
        axis.axhline(float(dataset.limit), color="black", ls="--", lw=1, label="$N\\to\\infty$")
        axis.set_xscale("log")
        plotting.plain_log(axis.xaxis)
    settings = dataset.attrs["settings"]
    axes[0].set_title(f"step {settings['fixed_time_step']:g}")
    axes[0].set_xlabel("number of particles $N$")
    axes[0].set_ylabel("E $v_1^4$ at $t$ = " + f"{settings['time']:g}")
    axes[1].set_title(f"$N$ = {settings['fixed_n_particles']}")
    axes[1].set_xlabel("time step $\\Delta t$")
    axes[0].legend()
    return figure


def _series(axis, x, here, prefix, k, label):
    plotting.points(
        axis, x, here[prefix + "moment"], here[prefix + "moment_error"], k, label, line=False
    )
    axis.plot(x, here[prefix + "moment_exact"], color=plotting.COLOURS[k], lw=1)
