"""The eight figures of the BKW mode: Algorithm 2 or 3, against time or along an axis."""

from kacsim.items import _probes
from kacsim.items._lazy import bkw, np, store

EXACT = {"bkw": "density", "bkw_fraction": "fraction"}
FIRST = {"bkw": "speed", "bkw_fraction": "threshold"}
N_FINE = 200
SYMBOL = {"speed": "c", "threshold": "c_0"}


def cases_by_size(sampler, settings):
    """Return size -> case, the probes being a grid of the first axis by time."""
    axis = FIRST[sampler]
    grid = {axis: settings[axis], "time": settings["time"]}
    common = {"oversampling": settings["oversampling"], "max_nodes": settings["max_nodes"]}
    return {size: _probes.case(settings, sampler, size, **grid, **common) for size in _probes.SIZES}


def reduce(sampler, samples, settings):
    """Return the estimates at all probes beside the exact values."""
    axis = FIRST[sampler]
    first, time = np.array(settings[axis], float)[:, None], np.array(settings["time"], float)
    factor = np.broadcast_to(
        bkw.maxwellian(first) if sampler == "bkw" else 1.0, (first.size, time.size)
    )
    exact = getattr(bkw, EXACT[sampler])(first, time)
    axes = {axis: settings[axis], "time": settings["time"]}
    table = _probes.table(samples, cases_by_size(sampler, settings), axes, factor, exact)
    law, described = getattr(bkw, EXACT[sampler]), store.described
    fine_first = np.linspace(min(settings[axis]), max(settings[axis]), N_FINE)
    fine_time = np.linspace(min(settings["time"]), max(settings["time"]), N_FINE)
    return table.assign(
        curve_time=described(law(first, fine_time), (axis, "fine_time"), "exact, all times"),
        **{
            f"curve_{axis}": described(
                law(fine_first[:, None], time), (f"fine_{axis}", "time"), "exact, along the axis"
            )
        },
    ).assign_coords(
        {"fine_time": ("fine_time", fine_time), f"fine_{axis}": (f"fine_{axis}", fine_first)}
    )


def draw(sampler, dataset, along):
    """Draw values and relative errors, one panel per value of the other axis."""
    settings = dataset.attrs["settings"]
    axis = FIRST[sampler]
    plain = settings["oversampling"] == 1.0
    critical = bkw.critical_time() if plain else None
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
