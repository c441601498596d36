"""Study: f and the tail of the Kac equation at any time and speed, by McKean's trees."""

import functools

from kacsim.items import _late
from kacsim.items._lazy import exact, np, plotting, probe, store


def _exact(quantity, speed, time):
    """Return the quantity of eq. (8); time in mean collision times, the unit of the equilibrium."""
    found = _values(quantity, speed, np.asarray(time, dtype=float))
    return found / _unit(quantity, np.asarray(speed, dtype=float))


def _values(quantity, speed, times):
    function = exact.density if quantity == "density" else exact.survival
    columns = [np.ravel(function(np.ravel(speed), float(time), 1.0)) for time in np.ravel(times)]
    return np.array(columns).T


def _unit(quantity, speed):
    if quantity == "tail":
        return np.ones_like(speed)
    return np.exp(-(speed**2) / 3.0) / np.sqrt(3.0 * np.pi)


FAMILY = _late.Family(
    {"density": ("kac_ancestral", "speed"), "tail": ("kac_tail_ancestral", "threshold")},
    {"collision_rate": 1.0},
    _exact,
    _unit,
)
problems = _late.problems
cases = functools.partial(_late.cases, FAMILY)
costs = functools.partial(_late.costs, FAMILY)


def reduce(samples, settings):
    """Return what the trees do, and the time from which branching has no variance."""
    dataset = _late.reduce(FAMILY, samples, settings)
    critical = store.described(
        probe.critical_time(1.0), (), "time of infinite variance of branching"
    )
    return dataset.assign(critical_time=critical)


def claims(dataset):
    """Test that the means are exact, and how small the deviations are."""
    return [
        _late.unbiased(dataset, "kac_late_mean"),
        _late.smallness(dataset, "kac_late_tail", "tail", 1.0),
    ]


def draw(dataset):
    """Draw tails, deviations of the methods, and the coverage of bars."""
    settings = dataset.attrs["settings"]
    figure, axes = plotting.panels(2, 2, share_y=False)
    _late.draw_tails(axes[0], dataset, "tail", "$P(v_1 > v)$")
    axes[0].set_xlabel("$v$")
    for axis, quantity, what in (
        (axes[1], "tail", "tail beyond"),
        (axes[2], "density", "density at"),
    ):
        speed = settings["shown_speed"]
        _late.draw_deviations(axis, dataset, quantity, speed)
        label = "branching has no variance from here on"
        axis.axvline(float(dataset.critical_time), color="0.4", lw=1, ls=":", label=label)
        axis.set_title(f"{what} $v$ = {speed:g}")
    axes[2].legend(fontsize=7, loc="lower right")
    _late.draw_coverage(axes[3], dataset, {"density": "density", "tail": "tail"})
    return figure
