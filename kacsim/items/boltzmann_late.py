"""Study: f and fractions of the BKW mode at any time and speed, by McKean's trees.

Beside Algorithms 2 and 3, whose exact deviation is known up to the time where it is infinite.
"""

import functools

from kacsim import costs as kept
from kacsim.items import _late
from kacsim.items._lazy import bkw, np, plotting, second_moment, store

FARTHEST = {"density": 7.0, "tail": 6.0}  # speeds to which the exact deviation is known
NEAR = 0.99  # of the critical time: the last exact deviation


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
cases = functools.partial(_late.cases, FAMILY)


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
    for i, quantity in enumerate(_late.QUANTITIES):
        each = settings["costs"]["nanoseconds"][BRANCHING[quantity]]
        for j, speed in enumerate(settings["speed"]):
            if speed > FARTHEST[quantity] or (quantity == "tail" and speed == 0.0):
                continue
            for k, time in enumerate(early):
                function = second_moment.relative_deviation
                if quantity == "tail":
                    function = second_moment.fraction_deviation
                deviation[i, j, k] = float(function(speed, time))
                nodes = float(bkw.mean_recursion(time))
                seconds[i, j, k] = 1e-9 * (each.get("draw", 0.0) + each["node"] * nodes)
    here = dataset.sel(estimator="ancestral", time=early)
    work = here.seconds.values * here.deviation.values**2
    dims, described = ("quantity", "speed", "early"), store.described
    return dataset.assign(
        branching=described(deviation, dims, "exact relative deviation of Algorithms 2 and 3"),
        gain=described(
            seconds * deviation**2 / work, dims, "seconds times variance, branching over ancestral"
        ),
        critical_time=described(bkw.critical_time(), (), "time of infinite variance of branching"),
    ).assign_coords(early=early)


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
        axis.set_ylim(top=2.0 * float(exact.max()))
        axis.axvline(float(dataset.critical_time), color="0.4", lw=1, ls=":", label="$t^*$")
        axis.set_title(f"{what} {speed:g} $c_q$")
    axes[2].legend(fontsize=7, loc="lower right")
    for axis, quantity, what in ((axes[3], "tail", "fraction"), (axes[4], "density", "density")):
        for k, speed in enumerate(settings["speed"]):
            gain = dataset.gain.sel(quantity=quantity, speed=speed)
            if np.isfinite(gain).any():
                plotting.points(axis, dataset.early.values, gain, None, k, f"$c$ = {speed:g} $c_q$")
        axis.axhline(1.0, color="0.4", lw=1)
        axis.set_yscale("log")
        axis.set_xlim(right=3.0)  # room for a legend
        axis.set_xlabel("mean collision times")
        axis.set_ylabel(f"work of branching / ancestral\n{what}")
        axis.legend(fontsize=7, loc="lower right")
    labels = {"density": "density", "tail": "fraction"}
    _late.draw_coverage(axes[5], dataset, labels)
    return figure
