"""Fig. 8 of the Boltzmann paper: the breathing state, density along an axis and energies."""

from kacsim.items._lazy import np, plotting, store, trap, xr

N_TIMES, N_FINE = 181, 161


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


def draw(dataset):
    """Draw the density as a map with level lines, and the energies."""
    figure, axes = plotting.panels(1, 2)
    levels = np.log10(dataset.density.values)
    image = axes[0].pcolormesh(
        dataset.turn,
        dataset.radius,
        levels,
        cmap="cividis",
        vmin=-8,
        shading="auto",
        rasterized=True,
    )
    axes[0].contour(
        dataset.turn,
        dataset.radius,
        levels,
        levels=[-8, -6, -4, -2, -0.3],
        colors="white",
        linewidths=0.7,
        linestyles="--",
    )
    bar = figure.colorbar(image, ax=axes[0])
    bar.set_label("log$_{10}$ of the density")
    axes[0].set_ylabel("$r_x\\,\\omega/c_{q,eq}$")
    for k, (name, factor) in enumerate((("potential", 1), ("thermal", 1), ("flow", 10))):
        label = f"{name} energy" + (" × 10" if factor > 1 else "")
        dash = ("-", "--", "-.")[k]
        axes[1].plot(
            dataset.turn, factor * dataset[name], dash, color=plotting.COLOURS[k], label=label
        )
    axes[1].set_ylabel("share of the total energy")
    axes[1].set_ylim(0, 1)
    axes[1].legend()
    for axis in axes:
        axis.set_xlabel("$\\omega t / 2\\pi$")
    return figure
