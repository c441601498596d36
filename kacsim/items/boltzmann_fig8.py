"""Fig. 8 of the Boltzmann paper: the breathing state, density along an axis and energies."""

from kacsim.items._lazy import estimate, np, plotting, store, trap, verdict, xr

N_TIMES, N_FINE = 181, 161
# Where the transport of eq. (31) is tested: radii, radial and tangential velocities, phases.
PLACES, VELOCITIES, TANGENTIAL, N_PHASES = (
    (0.0, 0.7, 2.0, 4.0),
    (-2.0, 0.0, 0.5, 3.0),
    (0.0, 1.5),
    25,
)
LEVELS = (1e-8, 1e-6, 1e-4, 1e-2, 0.5, 1.0)  # a factor of 2 or 100 apart, as in the text


def cases(settings):
    """Return nothing: the figure shows eq. (31) itself."""
    return []


def reduce(samples, settings):
    """Return density and energies over one period of the trap."""
    turns = np.linspace(0.0, 1.0, N_TIMES)
    phase = 2.0 * np.pi * turns
    radius = np.linspace(-settings["largest_radius"], settings["largest_radius"], N_FINE)
    state = settings["breathing"], settings["start_phase"]
    described = store.described
    names = ("thermal", "potential", "flow")
    parts = dict(zip(names, trap.energies(phase, *state), strict=True))
    peak = (2.0 * np.pi) ** 1.5
    return xr.Dataset(
        {
            "density": described(
                peak * trap.cloud(radius[:, None], phase, *state),
                ("radius", "turn"),
                "density of matter over its value at the centre at equilibrium",
            )
        }
        | {
            name: described(part / 3.0, ("turn",), f"{name} energy over the total")
            for name, part in parts.items()
        },
        coords={"turn": ("turn", turns), "radius": ("radius", radius)},
    )


def claims(dataset):
    """Test the breathing state of eq. (31): its transport, its energy and its amplitude."""
    settings = dataset.attrs["settings"]
    state = settings["breathing"], settings["start_phase"]
    total = (dataset.thermal + dataset.potential + dataset.flow).values
    square = trap.thermal_speed(2.0 * np.pi * dataset.turn.values, *state) ** 2
    amplitude = float(square.max() - square.min()) / 2.0
    ratios = _transported(*state)
    evidence = f"{ratios.size} places, velocities and times."
    worst = estimate.Exact(float(ratios.flat[np.abs(ratios - 1.0).argmax()]))
    energy = estimate.Exact(float(total[np.abs(total - 1.0).argmax()]))
    return [
        verdict.finding("boltzmann_31_transport", worst, evidence, printed=1.0),
        verdict.finding("boltzmann_31_energy", energy, printed=1.0),
        verdict.finding(
            "boltzmann_31_amplitude", estimate.Exact(amplitude), printed=settings["breathing"]
        ),
    ]


def _transported(*state):
    """Return f of eq. (31) over its value at the start of the free trajectory, on a grid."""
    axes = PLACES, VELOCITIES, TANGENTIAL, np.linspace(0.0, 2.0 * np.pi, N_PHASES)
    radius, radial, tangential, phase = np.meshgrid(*axes, indexing="ij")
    now = trap.breathing_density(radius, radial, tangential, phase, *state)
    start = trap.ballistic(radius, radial, tangential, phase)
    return now / trap.breathing_density(*start, 0.0, *state)


def draw(dataset):
    """Draw the density as a map with labelled level lines, and the energies."""
    figure, axes = plotting.panels(1, 2, height=3.1)
    _draw_density(figure, axes[0], dataset)
    turn = dataset.turn.values
    for k, (name, factor) in enumerate((("potential", 1), ("thermal", 1), ("flow", 10))):
        label = f"{name} energy" + (" × 10" if factor > 1 else "")
        dash = ("-", "--", "-.")[k]
        axes[1].plot(turn, factor * dataset[name], dash, color=plotting.COLOURS[k], label=label)
    axes[1].set_ylabel("share of the total energy")
    axes[1].set_ylim(0.0, 1.0)
    axes[1].set_yticks(np.arange(6) / 5)
    axes[1].legend(loc="upper center", frameon=False)
    for axis in axes:
        axis.set_xlim(0.0, 1.0)
        axis.set_xticks(np.arange(5) / 4)
        axis.set_xlabel("$\\omega t/(2\\pi)$")
    return figure


def _draw_density(figure, axis, dataset):
    """Draw the density along an axis against time, with its levels named on their lines."""
    logarithm = np.log10(dataset.density.values)
    place = dataset.turn, dataset.radius, logarithm
    style = {"cmap": "cividis", "vmin": -8, "vmax": 0, "shading": "auto", "rasterized": True}
    image = axis.pcolormesh(*place, **style)
    colours = ["black" if level > 0.1 else "white" for level in LEVELS]  # on light or dark
    lines = axis.contour(
        *place, levels=np.log10(LEVELS), colors=colours, linewidths=0.7, linestyles="--"
    )
    names = {np.log10(x): plotting.power_of_ten(x) if x < 0.1 else f"{x:g}" for x in LEVELS}
    axis.clabel(lines, fmt=names, fontsize=6.5, manual=_label_places(dataset))
    bar = figure.colorbar(image, ax=axis, extend="both", ticks=np.arange(-8, 1, 2))
    bar.ax.set_yticklabels([f"$10^{{{k}}}$" for k in range(-8, 1, 2)])
    bar.set_label("$\\eta(r_x)\\,(\\sqrt{2\\pi}\\,c_{q,eq}/\\omega)^3/n$")
    axis.set_yticks(np.arange(-4, 5, 2))
    axis.set_ylabel("$r_x\\,\\omega/c_{q,eq}$")


def _label_places(dataset):
    """Return (turn, radius) of each level's label: where the cloud is smallest, and all are met."""
    outward = dataset.isel(radius=dataset.radius >= 0.0)
    k = int(outward.density.values[0].argmax())
    column = outward.density.values[:, k]
    levels = [level for level in LEVELS if column[-1] < level < column[0]]
    radii = np.interp(-np.log(levels), -np.log(column), outward.radius.values)
    return [(float(dataset.turn[k]), radius) for radius in radii]
