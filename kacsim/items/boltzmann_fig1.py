"""Fig. 1 of the Boltzmann paper: the BKW mode along an axis at several times."""

import math

from kacsim.items._lazy import bkw, estimate, np, plotting, store, verdict, xr

N_FINE = 241
PROBES = (0.0, 0.5, 1.0, 2.0, 3.0, 4.0)  # speeds at which eq. (5) is balanced
FAR, N_SPEEDS = 12.0, 24001  # beyond, no Maxwellian is left


def cases(settings):
    """Return nothing: the figure shows eq. (7) itself."""
    return []


def reduce(samples, settings):
    """Return f along an axis at every time, at equilibrium, and the balance of eq. (5)."""
    velocity = np.linspace(-settings["largest_speed"], settings["largest_speed"], N_FINE)
    times = np.array(settings["time"], dtype=float)
    balance = [[_balance(speed, time) for speed in PROBES] for time in times]
    described = store.described
    return xr.Dataset(
        {
            "density": described(
                bkw.density(np.abs(velocity), times[:, None]), ("time", "velocity"), "f(c; t)"
            ),
            "equilibrium": described(bkw.maxwellian(velocity), ("velocity",), "f at equilibrium"),
            "balance": described(
                balance, ("time", "speed"), "gain over loss and change of eq. (5) by eq. (7)"
            ),
        },
        coords={
            "time": list(times),
            "velocity": ("velocity", velocity),
            "speed": ("speed", list(PROBES)),
        },
    )


def _balance(speed, time):
    """Return the source of eq. (5), by quadrature, over what it must be: f and its derivative."""
    return bkw.gain(speed, time) / float(bkw.density(speed, time) + bkw.change(speed, time))


def _rms_speed():
    """Return the root of the mean of c**2 over the Maxwellian, in c_q, by the trapezoid rule."""
    speed = np.linspace(0.0, FAR, N_SPEEDS)
    shell = speed**2 * bkw.maxwellian(speed)
    return math.sqrt(np.trapezoid(speed**2 * shell, speed) / np.trapezoid(shell, speed))


def claims(dataset):
    """Balance eq. (5), look for negative values, and take the RMS speed of eq. (10)."""
    parts = []
    for time in dataset.time.values:
        here = dataset.balance.sel(time=time)
        worst = float(here[int(np.abs(here.values - 1.0).argmax())])
        parts.append(verdict.Part(estimate.Exact(worst), f"t = {time:g}", printed=1.0))
    later = dataset.density.where(dataset.time > 0.0, drop=True)
    wrong = float((later <= 0.0).mean()) + float((dataset.density < 0.0).mean())
    rms = estimate.Exact(_rms_speed())
    return [
        verdict.Finding(
            "boltzmann_5_solution", tuple(parts), f"Worst of the speeds {_listed(dataset.speed)}."
        ),
        verdict.finding(
            "boltzmann_7_positive",
            estimate.Exact(wrong),
            f"Least value after the start {float(later.min()):.2g}.",
        ),
        verdict.finding("boltzmann_10_rms", rms, printed=1.0, corrected=math.sqrt(3.0)),
    ]


def _listed(values):
    return ", ".join(f"{float(value):g}" for value in values)


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
