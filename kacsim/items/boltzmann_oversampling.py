"""Study: cost times variance against oversampling, everywhere or only near the probe."""

from kacsim.cases import make_case
from kacsim.items._lazy import bkw, np, plotting, store, xr

FINE = 41


def _uniform_case(settings, time):
    return _case(settings, settings["oversampling"], time, 0.0)


def _case(settings, oversampling, time, onset):
    return make_case(
        "bkw_moment",
        oversampling=oversampling,
        time=[time],
        onset=onset,
        n_draws=settings["n_draws"],
        n_replicates=settings["n_replicates"],
        seed=settings["seed"],
        max_nodes=settings["max_nodes"],
    )


def predicted(time, oversampling, onset=0.0):
    """Return (excess variance G - H, nodes, their product) by the differential equations."""
    excess = bkw.second_moment_oversampled(time, oversampling, onset) - float(bkw.mean_square(time))
    nodes = float(bkw.mean_recursion(time, oversampling, onset))
    return excess, nodes, excess * nodes


def _late_case(settings, time):
    return _case(
        settings, [settings["late_oversampling"]], time, settings["late_onset_share"] * time
    )


def cases(settings):
    """Return uniform oversampling at every time, and the published choice of a late one."""
    times = settings["time"]
    return [f(settings, time) for time in times for f in (_uniform_case, _late_case)]


def reduce(samples, settings):
    """Return measured and predicted excess variance, nodes and their product."""
    times, ms = settings["time"], np.array(settings["oversampling"], dtype=float)
    shape = (len(times), ms.size)
    measured = {name: np.full(shape, np.nan) for name in ("excess", "nodes")}
    late = np.full((len(times), 2), np.nan)
    for i, time in enumerate(times):
        floor = float(bkw.mean_square(time))
        sample = samples[_uniform_case(settings, time).id]
        measured["excess"][i] = sample["mean_square"].mean("replicate").values[:, 0] - floor
        measured["nodes"][i] = sample["nodes"].mean("replicate").values[:, 0]
        other = samples[_late_case(settings, time).id]
        late[i] = float(other["mean_square"].mean()) - floor, float(other["nodes"].mean())
    fine = np.linspace(1.0, settings["largest_oversampling"], FINE)
    many = settings["predicted_time"]
    curve = np.array([[predicted(time, m)[2] for m in fine] for time in many])
    m, share = settings["late_oversampling"], settings["late_onset_share"]
    described, two = store.described, ("time", "oversampling")
    product = measured["excess"] * measured["nodes"]
    return xr.Dataset(
        {
            "excess": described(measured["excess"], two, "measured excess variance G - H"),
            "nodes": described(measured["nodes"], two, "measured nodes of one realization"),
            "product": described(product, two, "measured cost times variance"),
            "late_product": described(
                late[:, 0] * late[:, 1], ("time",), "cost times variance, oversampled late only"
            ),
            "late_predicted": described(
                [predicted(time, m, share * time)[2] for time in times], ("time",), "prediction"
            ),
            "curve": described(curve, ("predicted_time", "fine"), "predicted cost times variance"),
            "best": described(
                fine[np.argmin(curve, axis=1)], ("predicted_time",), "best uniform oversampling"
            ),
            "best_product": described(
                curve.min(axis=1), ("predicted_time",), "its cost times variance"
            ),
        },
        coords={"time": times, "oversampling": ms, "fine": ("fine", fine), "predicted_time": many},
    )


def draw(dataset):
    """Draw cost times variance against oversampling, a colour per time."""
    figure, (axis,) = plotting.panels(1, 1)
    settings = dataset.attrs["settings"]
    for k, time in enumerate(dataset.predicted_time.values):
        here, colour = dataset.sel(predicted_time=time), plotting.COLOURS[k]
        finite = np.isfinite(here.curve.values)
        label = f"$t$ = {time:g}, best $m$ = {float(here.best):.2f}"
        axis.plot(dataset.fine[finite], here.curve[finite], color=colour, lw=1, label=label)
        if time not in dataset.time.values:
            continue
        here = dataset.sel(time=time)
        axis.plot(dataset.oversampling, here["product"], plotting.MARKERS[k], color=colour, ms=4)
        axis.plot(
            settings["late_oversampling"], here.late_product, "*", color=colour, ms=9, mec="black"
        )
    axis.set_yscale("log")
    axis.set_xlabel("oversampling $m$ (stars: only late)")
    axis.set_ylabel("nodes × excess variance")
    axis.legend()
    return figure
