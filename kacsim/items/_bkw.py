"""The figures of the BKW mode: Algorithm 2 or 3, or McKean's trees, against time or along an axis.

The published figures, those with oversampling and those by McKean's trees, whose settings have no
oversampling, differ by their settings alone.
"""

import math

from kacsim.items import _probes
from kacsim.items._lazy import bkw, np, second_moment, store

AXIS = {"bkw": "speed", "bkw_fraction": "threshold"}
SYMBOL = {"speed": "c", "threshold": "c_0"}
N_FINE = 200
N_EXACT = 60  # points of the exact deviation
FARTHEST = {"bkw": 7.0, "bkw_fraction": 6.0}  # speeds to which it is known


def cases_by_size(sampler, settings):
    """Return size -> case, the probes being a grid of the first axis by time."""
    axis = AXIS[sampler]
    grid = {axis: settings[axis], "time": settings["time"]}
    common = {key: settings[key] for key in ("oversampling", "max_nodes") if key in settings}
    if "oversampling" not in settings:
        sampler = f"{sampler}_ancestral"
    return {size: _probes.case(settings, sampler, size, **grid, **common) for size in _probes.SIZES}


def cases(sampler, settings):
    """Return the probes at the published and at the large number of realizations."""
    return list(cases_by_size(sampler, settings).values())


def reduce(sampler, samples, settings):
    """Return the estimates with errors beside the exact values, at all probes and between them."""
    axis = AXIS[sampler]
    first, time, law, factor = _exactly(sampler, settings)
    axes = {axis: settings[axis], "time": settings["time"]}
    found = cases_by_size(sampler, settings)
    table = _probes.table(samples, found, axes, factor, law(first, time))
    fine_first = np.linspace(min(settings[axis]), max(settings[axis]), N_FINE)
    fine_time = np.linspace(min(settings["time"]), max(settings["time"]), N_FINE)
    described, fine_axis = store.described, f"fine_{axis}"
    against_time = described(law(first, fine_time), (axis, "fine_time"), "exact, all times")
    along_axis = described(
        law(fine_first[:, None], time), (fine_axis, "time"), "exact, along the axis"
    )
    curves = {"curve_time": against_time, f"curve_{axis}": along_axis}
    bars = [covering(sampler, samples, settings, size) for size in found]
    curves["covered"] = described(
        bars, ("size", axis, "time"), "replicates whose own bar of one sigma covers the exact value"
    )
    curves["nominal"] = described(math.erf(math.sqrt(0.5)), (), "share of right bars that cover")
    places = {"fine_time": ("fine_time", fine_time), fine_axis: (fine_axis, fine_first)}
    if settings.get("oversampling") == 1.0:
        some_first = np.linspace(fine_first[0], fine_first[-1], N_EXACT)
        some_time = np.linspace(fine_time[0], fine_time[-1], N_EXACT)
        text = "exact relative deviation of one realization"
        curves["deviation_time"] = described(
            exact_deviation(sampler, settings[axis], some_time), (axis, "some_time"), text
        )
        curves[f"deviation_{axis}"] = described(
            exact_deviation(sampler, some_first, settings["time"]), (f"some_{axis}", "time"), text
        )
        places |= {"some_time": ("some_time", some_time)}
        places |= {f"some_{axis}": (f"some_{axis}", some_first)}
    return table.assign(curves).assign_coords(places)


def exact_deviation(sampler, firsts, times):
    """Return the exact relative deviation of one realization, float64[first, time].

    nan where it is infinite, or where the series that gives it has no digits left.
    """
    found = np.full((len(firsts), len(times)), np.nan)
    for j, time in enumerate(times):
        near = [i for i, first in enumerate(firsts) if first <= FARTHEST[sampler]]
        if time >= bkw.critical_time():
            continue
        if sampler == "bkw":
            found[near, j] = second_moment.relative_deviation(np.asarray(firsts)[near], time)
        else:
            found[near, j] = [second_moment.fraction_deviation(firsts[i], time) for i in near]
    return found


def _exactly(sampler, settings):
    """Return the two axes, float64[first, 1] and [time], the law, and the unit of realizations."""
    first = np.array(settings[AXIS[sampler]], float)[:, None]
    time = np.array(settings["time"], float)
    law, unit = (bkw.density, bkw.maxwellian) if sampler == "bkw" else (bkw.fraction, np.ones_like)
    return first, time, law, np.broadcast_to(unit(first), (first.size, time.size))


def covering(sampler, samples, settings, size):
    """Return how many replicates' own bars of one sigma cover the exact value, int[first, time]."""
    first, time, law, factor = _exactly(sampler, settings)
    case = cases_by_size(sampler, settings)[size]
    return _probes.covering(samples[case.id], case, law(first, time) / factor)


def claims(dataset):
    """Return nothing: the bars of these figures are counted elsewhere."""
    return []


def draw(sampler, along, dataset):
    """Draw values and relative errors along one axis, a panel per value of the other."""
    axis = AXIS[sampler]
    published = dataset.attrs["settings"].get("oversampling") == 1.0
    critical = bkw.critical_time() if published else None
    quantity = "$f(c;t)\\,c_q^3$" if sampler == "bkw" else "fraction $|c| > c_0$"
    symbol = SYMBOL[axis]
    if along == "time":
        titles = [f"${symbol}$ = {value:g} $c_q$" for value in dataset[axis].values]
        label, panel = "time $t$ in mean collision times", axis
    else:
        titles = [f"$t$ = {value:g}" for value in dataset.time.values]
        label, panel = f"${symbol}/c_q$", "time"
    figure = _probes.draw_rows(dataset, along, panel, titles, label, quantity, critical)
    for top in figure.axes[: dataset.sizes[panel]]:
        top.set_yscale("log" if along != "time" else "linear")
    return figure
