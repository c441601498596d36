"""Fig. 1 of the Boltzmann paper: the BKW mode along an axis at several times."""

from kacsim.items._lazy import bkw, np, plotting, store, xr

N_FINE = 241


def cases(settings):
    """Return nothing: the figure shows eq. (7) itself."""
    return []


def reduce(samples, settings):
    """Return f along an axis at every time, and at equilibrium."""
    velocity = np.linspace(-settings["largest_speed"], settings["largest_speed"], N_FINE)
    times = np.array(settings["time"], dtype=float)
    described = store.described
    return xr.Dataset(
        {
            "density": described(
                bkw.density(np.abs(velocity), times[:, None]), ("time", "velocity"), "f(c; t)"
            ),
            "equilibrium": described(bkw.maxwellian(velocity), ("velocity",), "f at equilibrium"),
        },
        coords={"time": list(times), "velocity": ("velocity", velocity)},
    )


def draw(dataset):
    """Draw f along the axis."""
    figure, (axis,) = plotting.panels(1, 1)
    for k, time in enumerate(dataset.time.values):
        line = dataset.density.sel(time=time)
        dash = ("-", "--", "-.", ":")[k % 4]
        axis.plot(dataset.velocity, line, dash, color=plotting.COLOURS[k], label=f"$t$ = {time:g}")
    axis.plot(dataset.velocity, dataset.equilibrium, color="black", lw=1, label="$t\\to\\infty$")
    axis.set_xlabel("velocity $c_x/c_q$")
    axis.set_ylabel("$f(c;t)\\,c_q^3$")
    axis.legend()
    return figure
