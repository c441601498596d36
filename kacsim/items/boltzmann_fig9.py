"""Fig. 9 of the Boltzmann paper: f in the trap against time, at two places, by Algorithm 6."""

from kacsim.items import _probes, _trap
from kacsim.items._lazy import np, plotting, store, trap

N_FINE = 301
LINES = {
    "breathing_curve": {"color": "black", "label": "breathing state"},
    "ballistic_curve": {"color": "0.5", "ls": "--", "label": "no collisions"},
}


problems = _trap.problems


def cases(settings):
    """Return both places at every time, at the published and the large number of realizations."""
    return list(_trap.cases_by_size("trap", settings).values())


def reduce(samples, settings):
    """Return estimates with errors, the two limiting predictions, and measures of reliability."""
    found = _trap.cases_by_size("trap", settings)
    radius = np.array(settings["radius"], dtype=float)[:, None]
    phase = 2.0 * np.pi * np.array(settings["turn"], dtype=float)
    state = settings["breathing"], settings["start_phase"]
    speed = trap.flow(radius, 0.0, *state)
    breathing = trap.breathing_density(radius, speed, 0.0, phase, *state)
    free = trap.ballistic_density(radius, speed, 0.0, phase, *state)
    axes = {"radius": settings["radius"], "turn": settings["turn"]}
    places = _trap.places(settings)
    table = _probes.table(samples, found, axes, breathing, breathing, places)
    described, dims = store.described, ("radius", "turn")
    turns = np.linspace(0.0, max(settings["turn"]), N_FINE)
    fine = 2.0 * np.pi * turns
    return table.drop_vars("actual_error").assign(
        breathing_curve=described(
            trap.breathing_density(radius, speed, 0.0, fine, *state),
            ("radius", "fine_turn"),
            "f of the breathing state",
        ),
        ballistic_curve=described(
            trap.ballistic_density(radius, speed, 0.0, fine, *state),
            ("radius", "fine_turn"),
            "f without collisions, at all times",
        ),
        fine_turn=("fine_turn", turns, {"long_name": "omega t / 2 pi", "units": "1"}),
        ballistic=described(free, dims, "f without collisions"),
        batch=described(
            _trap.batches(samples, found, places, breathing.shape),
            ("size", *dims),
            "largest |z| of the replicates' means",
        ),
    )


def draw(dataset):
    """Draw value, relative standard deviation and recursion, one column per place."""
    count = dataset.sizes["radius"]
    figure, axes = plotting.panels(3, count, height=2.1)
    for k, radius in enumerate(dataset.radius.values):
        here = dataset.sel(radius=radius)
        turn, column = here.turn.values, axes[k::count]
        _probes.draw_sizes(column[0], here, turn, "value", "error")
        for name, style in LINES.items():
            column[0].plot(here.fine_turn, here[name], lw=1, **style)
        relative = here.assign(relative=here.error / here.value)
        _probes.draw_sizes(column[1], relative, turn, "relative")
        _probes.draw_sizes(column[2], here, turn, "recursion")
        for axis in column[1:]:
            axis.set_yscale("log")
        column[0].set_title(f"$r$ = {radius:g} $c_{{q,eq}}/\\omega$")
        column[0].set_ylabel("$f\\,c_{q,eq}^6/(n\\omega^3)$")
        column[1].set_ylabel("standard error / value")
        column[2].set_ylabel("mean recursion")
        column[2].set_xlabel("$\\omega t/2\\pi$")
    plotting.legends_above(axes[:1])
    return figure
