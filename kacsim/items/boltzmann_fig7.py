"""Fig. 7 of the Boltzmann paper: null collisions, value, variance and recursion by Algorithm 4."""

from kacsim.items import _extinction, _probes
from kacsim.items._lazy import estimate, extinction, np, plotting, store, verdict


def problems(settings):
    """Return (key, sentence) of each setting that does not fit another."""
    if set(settings["claim_time"]) - set(settings["time"]):
        return [("claim_time", f"must be among time, {settings['time']}")]
    return []


def _cases(settings):
    grid = {key: settings[key] for key in ("majorant", "time", "max_nodes")}
    return {size: _probes.case(settings, "extinction", size, **grid) for size in _probes.SIZES}


def cases(settings):
    """Return both majorants at every time, at both numbers of realizations."""
    return list(_cases(settings).values())


def reduce(samples, settings):
    """Return values, variances and recursions beside their predictions; f0 = alpha = 1."""
    majorant, time = np.array(settings["majorant"])[:, None], np.array(settings["time"])
    exact = np.broadcast_to(extinction.density(time, 1.0, 1.0), (majorant.size, time.size))
    axes = {"majorant": settings["majorant"], "time": settings["time"]}
    found = _cases(settings)
    table = _probes.table(samples, found, axes, np.ones(exact.shape), exact)
    described, dims = store.described, ("majorant", "time")
    variance = np.stack([extinction.variance(time, 1.0, 1.0, m) for m in settings["majorant"]])
    errors = [_variance_error(samples[one.id], exact.shape) for one in found.values()]
    return table.assign(
        variance_error=described(errors, ("size", *dims), "standard error of the variance"),
        variance_exact=described(variance, dims, "variance of eq. (29)"),
        recursion_exact=described(
            extinction.mean_recursion(time, majorant), dims, "mean recursion of eq. (28)"
        ),
    )


def _variance_error(sample, shape):
    """Return the error of the variance of one realization, float64[majorant, time]."""
    return [
        [
            _probes.jackknife(
                lambda m, s: s - m**2, _probes.moments_at(sample, i, j)
            ).standard_error
            for j in range(shape[1])
        ]
        for i in range(shape[0])
    ]


def claims(dataset):
    """Test eqs. (28) and (29) by runs at the claimed times, and exactly with all that follows."""
    large = dataset.sel(size="large")
    degrees = dataset.attrs["settings"]["n_replicates"] - 1
    found = []
    for k, majorant in enumerate(dataset.majorant.values):
        recursions, variances = [], []
        for time in dataset.attrs["settings"]["claim_time"]:
            here, label = large.sel(majorant=majorant, time=time), f"t = {time:g}"
            recursion = _probes.recursion_of(here)
            printed = float(here.recursion_exact)
            recursions.append(verdict.Part(recursion, label, printed=printed))
            variance = estimate.Mean(float(here.spread) ** 2, float(here.variance_error), degrees)
            printed = float(here.variance_exact)
            variances.append(verdict.Part(variance, label, printed=printed))
        evidence = f"Raised frequency {majorant:g} αf₀, t in units of 1/(αf₀)."
        for name, parts in (("recursion", recursions), ("variance", variances)):
            claim = f"boltzmann_extinction_{name}_{k + 1}"
            found.append(verdict.Finding(claim, tuple(parts), evidence))
    return found + _extinction.claims(dataset.majorant.values, float(dataset.time.values[-1]))


def draw(dataset):
    """Draw three rows: value, relative variance and recursion; one column per majorant."""
    count = dataset.sizes["majorant"]
    figure, axes = plotting.panels(3, count, height=2.1)
    for k, majorant in enumerate(dataset.majorant.values):
        here = dataset.sel(majorant=majorant)
        here = here.assign(relative=here.spread**2 / here.exact**2)
        time, column = here.time.values, axes[k::count]
        _probes.draw_sizes(column[0], here, time, "value", "error")
        column[0].plot(time, here.exact, color="black", lw=1, label="exact")
        _probes.draw_sizes(column[1], here, time, "relative")
        column[1].plot(time, here.variance_exact / here.exact**2, color="black", lw=1)
        _probes.draw_sizes(column[2], here, time, "recursion")
        column[2].plot(time, here.recursion_exact, color="black", lw=1)
        column[2].set_yscale("log")
        column[0].set_title(f"$\\hat\\nu$ = {majorant:g} $\\alpha f_0$")
        column[2].set_xlabel("time $\\alpha f_0 t$")
        column[0].set_ylabel("$f/f_0$")
        column[1].set_ylabel("Var / $f^2$")
        column[2].set_ylabel("mean recursion")
    axes[0].legend()
    return figure
