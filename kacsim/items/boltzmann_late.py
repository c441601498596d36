"""Study: f and fractions of the BKW mode at any time and speed, by McKean's trees.

Beside Algorithms 2 and 3, whose exact deviation is known up to the time where it is infinite, and
beside these with oversampling, whose deviation at one speed is measured.
"""

from kacsim import costs as kept
from kacsim.cases import make_case
from kacsim.items import _late
from kacsim.items._lazy import bkw, np, plotting, second_moment, store

FARTHEST = {"density": 7.0, "tail": 6.0}  # speeds to which the exact deviation is known
NEAR = 0.99  # of the critical time: the last exact deviation
HALVINGS = 20  # of the time between two where the work of two methods crosses


def _exact(quantity, speed, time):
    function = bkw.relative_density if quantity == "density" else bkw.fraction
    return function(speed, time)


def _unit(quantity, speed):
    return bkw.maxwellian(speed) if quantity == "density" else np.ones_like(speed)


FAMILY = _late.Family(
    {
        "density": ("bkw_ancestral", "speed"),
        "tail": ("bkw_fraction_ancestral", "threshold"),
    },
    {},
    _exact,
    _unit,
)
BRANCHING = {"density": "bkw", "tail": "bkw_fraction"}


def problems(settings):
    """Return (key, sentence) of each setting that does not fit another."""
    if not set(settings["oversampled_time"]) <= set(settings["time"]):
        return [("oversampled_time", "must be among the values of time")]
    return _late.problems(settings)


def _oversampled(settings):
    """Return quantity -> case: Algorithms 2 and 3 with oversampling, at the speed that is drawn."""
    return {
        quantity: make_case(
            sampler,
            **{FAMILY.samplers[quantity][1]: [settings["shown_speed"]]},
            time=settings["oversampled_time"],
            oversampling=settings["oversampling"],
            max_nodes=settings["max_nodes"],
            n_draws=settings["oversampled_n_draws"],
            n_replicates=settings["n_replicates"],
            seed=settings["seed"],
        )
        for quantity, sampler in BRANCHING.items()
    }


def cases(settings):
    """Return trees by three methods, short runs whose bars are counted, and oversampling."""
    return [*_late.cases(FAMILY, settings), *_oversampled(settings).values()]


def costs():
    """Return what the plan adds to the settings: the measured times of both kinds of trees."""
    found = _late.costs(FAMILY)
    more = {kind: kept.nanoseconds(kind) for kind in BRANCHING.values()}
    return found | {"nanoseconds": found["nanoseconds"] | more}


def reduce(samples, settings):
    """Return what the trees do, and how much more work the papers' trees take for an error."""
    dataset = _late.reduce(FAMILY, samples, settings)
    early = [t for t in dataset.time.values if t < NEAR * bkw.critical_time()]
    shape = (len(_late.QUANTITIES), dataset.sizes["speed"], len(early))
    deviation, seconds = np.full(shape, np.nan), np.full(shape, np.nan)
    for i, j, k in np.ndindex(shape):
        quantity, speed = _late.QUANTITIES[i], settings["speed"][j]
        if speed <= FARTHEST[quantity] and (quantity == "density" or speed > 0.0):
            deviation[i, j, k], seconds[i, j, k] = branching(settings, quantity, speed, early[k])
    dims, described = ("quantity", "speed", "early"), store.described
    dataset = dataset.assign(
        branching=described(deviation, dims, "exact relative deviation of Algorithms 2 and 3"),
        critical_time=described(bkw.critical_time(), (), "time of infinite variance of branching"),
    ).assign_coords(early=early)
    work = dataset.seconds * dataset.deviation**2
    gain = (seconds * deviation**2)[:, None] / work.sel(time=early).values
    dims = ("quantity", "estimator", "speed", "early")
    text = "seconds times variance, branching over the estimator"
    dataset = dataset.assign(gain=described(gain, dims, text)).assign(
        _crossings(dataset, gain, settings)
    )
    return with_oversampling(dataset, samples, settings)


def with_oversampling(dataset, samples, settings):
    """Return the dataset with what oversampling does at the speed that is drawn."""
    times, speed = np.array(settings["oversampled_time"], float), settings["shown_speed"]
    found = {name: [] for name in ("deviation", "deviation_error", "gain")}
    for quantity, case in _oversampled(settings).items():
        here = _late.measured(samples[case.id], case, _exact(quantity, speed, times)[None])
        each = settings["costs"]["nanoseconds"][BRANCHING[quantity]]
        seconds = 1e-9 * (each.get("draw", 0.0) + each["node"] * here["leaves"])
        trees = dataset.sel(quantity=quantity, estimator=_late.METHODS[0], speed=speed, time=times)
        work = (trees.seconds * trees.deviation**2).values
        here["gain"] = seconds * here["deviation"] ** 2 / work
        for name, rows in found.items():
            rows.append(here[name][0])
    dims, texts = (
        ("quantity", "oversampled_time"),
        {
            "deviation": "relative deviation of one realization with oversampling",
            "deviation_error": "standard error, replicates left out in turn",
            "gain": "seconds times variance, oversampling over trees of no leaf values",
        },
    )
    variables = {
        f"oversampled_{name}": store.described(rows, dims, texts[name])
        for name, rows in found.items()
    }
    return dataset.assign(variables).assign_coords(oversampled_time=times)


def branching(settings, quantity, speed, time):
    """Return (exact relative deviation, seconds) of one realization of Algorithm 2 or 3."""
    each = settings["costs"]["nanoseconds"][BRANCHING[quantity]]
    function = second_moment.relative_deviation
    if quantity == "tail":
        function = second_moment.fraction_deviation
    nodes = float(bkw.mean_recursion(time))
    return float(function(speed, time)), 1e-9 * (each.get("draw", 0.0) + each["node"] * nodes)


def _crossings(dataset, gain, settings):
    """Return the times from which branching takes more work, with errors; nan where it always does.

    The logarithm of the trees' work is interpolated between two times, that of branching is exact.
    """
    found = np.full((2, *gain.shape[:3]), np.nan)
    work = np.log((dataset.seconds * dataset.deviation**2).values)
    errors = (2.0 * dataset.deviation_error / dataset.deviation).values
    early = dataset.early.values
    for place in np.ndindex(gain.shape[:3]):
        behind = np.flatnonzero(gain[place] <= 1.0)
        if behind.size and behind[-1] + 1 < early.size:
            here = slice(behind[-1], behind[-1] + 2)
            probe = _late.QUANTITIES[place[0]], settings["speed"][place[2]]
            known = early[here], work[place][here], errors[place][here]
            found[(slice(None), *place)] = _crossing(settings, probe, *known)
    dims, described = ("quantity", "estimator", "speed"), store.described
    return {
        "crossing": described(found[0], dims, "time from which branching takes more work"),
        "crossing_error": described(found[1], dims, "its standard error"),
    }


def _crossing(settings, probe, span, work, errors):
    """Return (time between two at which branching takes as much work, its standard error).

    Parameters
    ----------
    probe : (quantity, speed)
    span, work, errors : float64[2], the two times, the logarithm of the trees' work there, its
        standard errors
    """

    def gain(time):
        """Return the logarithm of the gain."""
        deviation, seconds = branching(settings, *probe, time)
        return np.log(seconds * deviation**2) - np.interp(time, span, work)

    low, high = span
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if gain(middle) > 0.0 else (middle, high)
    step = 1e-3 * (span[1] - span[0])
    slope = (gain(low) - gain(low - step)) / step
    share = (low - span[0]) / (span[1] - span[0])
    return low, np.hypot((1.0 - share) * errors[0], share * errors[1]) / abs(slope)


def claims(dataset):
    """Test that the means are exact, and how small the deviations are."""
    return [
        _late.unbiased(dataset, "boltzmann_late_mean"),
        _late.smallness(dataset, "boltzmann_late_tail", "tail", 1.0),
        _late.smallness(dataset, "boltzmann_late_density", "density", 1.0),
        _late.smallness(dataset, "boltzmann_late_centre", "density", 0.0),
    ]


def draw(dataset):
    """Draw tails, deviations of the methods, the gain over branching, and the coverage of bars."""
    settings = dataset.attrs["settings"]
    figure, axes = plotting.panels(2, 3, share_y=False)
    _late.draw_tails(axes[0], dataset, "tail", "fraction $|c| > c_0$")
    axes[0].set_xlabel("$c_0/c_q$")
    for axis, quantity, what in (
        (axes[1], "tail", "fraction beyond"),
        (axes[2], "density", "density at"),
    ):
        speed = settings["shown_speed"]
        _late.draw_deviations(axis, dataset, quantity, speed)
        exact = dataset.branching.sel(quantity=quantity, speed=speed)
        axis.plot(dataset.early, exact, color="black", lw=1, label="branching, exact")
        over = dataset.sel(quantity=quantity)
        _draw_oversampled(axis, over.oversampled_deviation, over.oversampled_deviation_error)
        highest = max(float(exact.max()), float(over.oversampled_deviation.max()))
        axis.set_ylim(top=2.0 * highest)
        axis.axvline(float(dataset.critical_time), color="0.4", lw=1, ls=":", label="$t^*$")
        axis.set_title(f"{what} {speed:g} $c_q$")
    axes[2].legend(fontsize=7, loc="lower right")
    for axis, quantity, what in ((axes[3], "tail", "fraction"), (axes[4], "density", "density")):
        for k, speed in enumerate(settings["speed"]):
            gain = dataset.gain.sel(quantity=quantity, speed=speed, estimator="ancestral")
            if np.isfinite(gain).any():
                plotting.points(axis, dataset.early.values, gain, None, k, f"$c$ = {speed:g} $c_q$")
        over = dataset.oversampled_gain.sel(quantity=quantity)
        _draw_oversampled(axis, over, None, f", $c$ = {settings['shown_speed']:g} $c_q$")
        axis.axhline(1.0, color="0.4", lw=1)
        axis.set_yscale("log")
        axis.set_xlim(right=2.0 * float(dataset.oversampled_time.max()))  # room for a legend
        axis.set_xlabel("mean collision times")
        axis.set_ylabel(f"work of branching / ancestral\n{what}")
        axis.legend(fontsize=7, loc="lower right")
    labels = {"density": "density", "tail": "fraction"}
    _late.draw_coverage(axes[5], dataset, labels)
    return figure


def _draw_oversampled(axis, values, errors, more=""):
    """Draw what oversampling does against time, in black, open."""
    axis.errorbar(
        values.oversampled_time,
        values,
        yerr=errors,
        fmt="x:",
        color="black",
        ms=4,
        lw=0.8,
        elinewidth=0.8,
        label=f"oversampling{more}",
    )
