"""Study: cost times variance against oversampling, everywhere or only early in the tree."""

import math

from kacsim.cases import make_case
from kacsim.items._lazy import bkw, estimate, np, plotting, store, verdict, xr

N_FINE = 41
SCHEMES = ("everywhere", "early")


def _case(settings, time, oversampling, onset):
    """Return realizations at about the same cost, whatever the tree: a number of nodes."""
    growth = (2.0 * oversampling - 1.0) * max(0.0, time - onset) + min(time, onset)
    n_draws = max(settings["min_draws"], round(settings["n_nodes"] * math.exp(-growth)))
    return make_case(
        "bkw_moment",
        oversampling=[oversampling],
        time=[time],
        onset=onset,
        n_draws=n_draws,
        n_replicates=settings["n_replicates"],
        seed=settings["seed"],
        max_nodes=settings["max_nodes"],
    )


def _grid(settings):
    """Return place -> case: every oversampling at every time, everywhere and early."""
    onsets = (0.0, settings["onset"])
    return {
        (i, j, k): _case(settings, time, m, onset)
        for i, onset in enumerate(onsets)
        for j, time in enumerate(settings["time"])
        for k, m in enumerate(settings["oversampling"])
    }


def cases(settings):
    """Return both schemes at every time and every oversampling."""
    return list(_grid(settings).values())


def predicted(time, oversampling, onset=0.0):
    """Return nodes times excess variance G - H, by the differential equations of both."""
    excess = bkw.second_moment_oversampled(time, oversampling, onset) - float(bkw.mean_square(time))
    return excess * float(bkw.mean_recursion(time, oversampling, onset))


def _product(sample, time):
    """Return the measured nodes times excess variance, over replicates."""
    excess = sample["mean_square"].values.ravel() - float(bkw.mean_square(time))
    return estimate.of_replicates(excess * sample["nodes"].values.mean())


def reduce(samples, settings):
    """Return measured and predicted products of cost and excess variance."""
    times, ms = settings["time"], settings["oversampling"]
    onsets = (0.0, settings["onset"])
    shape = (len(SCHEMES), len(times), len(ms))
    product, error, exact = np.full(shape, np.nan), np.full(shape, np.nan), np.full(shape, np.nan)
    for place, case in _grid(settings).items():
        i, j, k = place
        found = _product(samples[case.id], times[j])
        product[place], error[place] = found.value, found.standard_error
        exact[place] = predicted(times[j], ms[k], onsets[i])
    fine = np.linspace(1.0, settings["largest_oversampling"], N_FINE)
    curve = np.array([[[predicted(t, m, onset) for m in fine] for t in times] for onset in onsets])
    described, three, two = store.described, ("scheme", "time", "oversampling"), ("scheme", "time")
    return xr.Dataset(
        {
            "product": described(product, three, "measured cost times excess variance"),
            "product_error": described(error, three, "standard error"),
            "product_exact": described(exact, three, "predicted cost times excess variance"),
            "curve": described(curve, (*two, "fine"), "predicted cost times excess variance"),
            "best": described(fine[np.argmin(curve, axis=-1)], two, "best oversampling"),
            "best_product": described(curve.min(axis=-1), two, "its cost times variance"),
        },
        coords={"scheme": list(SCHEMES), "time": times, "oversampling": ms, "fine": fine},
    )


def claims(dataset):
    """Return by how much the time of infinite variance moves, and the rest that leaves do."""
    m = dataset.attrs["settings"]["claim_oversampling"]
    end = bkw.critical_time_oversampled(m)
    gain = estimate.Exact(end - bkw.critical_time())
    evidence = (
        f"Oversampling by m = {m:g} moves the time of infinite variance from "
        f"{bkw.critical_time():.3f} to {end:.3f} mean collision times."
    )
    return [verdict.finding("boltzmann_oversampling_gain", gain, evidence)]


def draw(dataset):
    """Draw cost times variance against oversampling, a colour per time."""
    figure, (axis,) = plotting.panels(1, 1)
    for k, time in enumerate(dataset.time.values):
        colour = plotting.COLOURS[k]
        for scheme, dash, fill in zip(SCHEMES, ("-", "--"), (colour, "white"), strict=True):
            here = dataset.sel(time=time, scheme=scheme)
            label = f"$t$ = {time:g}" if scheme == SCHEMES[0] else None
            seen = np.isfinite(here.curve.values)
            axis.plot(dataset.fine[seen], here.curve[seen], dash, color=colour, lw=1, label=label)
            seen = np.isfinite(here.product_exact.values)
            axis.errorbar(
                dataset.oversampling[seen],
                here["product"][seen],
                here.product_error[seen],
                fmt=plotting.MARKERS[k],
                color=colour,
                mfc=fill,
                ms=4,
                elinewidth=0.8,
            )
    settings = dataset.attrs["settings"]
    axis.plot([], [], "k--", lw=1, label=f"only for $t' >$ {settings['onset']:g} (open)")
    axis.set_yscale("log")
    axis.set_xlabel("oversampling $m$")
    axis.set_ylabel("nodes × excess variance")
    axis.legend()
    return figure
