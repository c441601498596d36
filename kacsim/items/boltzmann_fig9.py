"""Fig. 9 of the Boltzmann paper: f in the trap against time, at two places, by Algorithm 6."""

from kacsim.items import _probes, _trap, _trap_claims
from kacsim.items._lazy import np, plotting, store, trap

N_FINE = 601
LINES = {
    "breathing_curve": {"color": "black", "ls": "--", "label": "breathing state"},
    "ballistic_curve": {"color": "0.4", "ls": ":", "label": "no collisions"},
}
SCALE = 1000.0
ZOOM = (2.4, 3.6)  # omega t around 3, where the text has points of its own


def problems(settings):
    """Return (key, sentence) of each setting that does not fit another."""
    found = _trap.problems(settings)
    if set(settings["claim_turn"]) - set(settings["turn"]):
        found.append(("claim_turn", f"must be among turn, {settings['turn']}"))
    if not found and set(settings["growth_turn"]) - set(settings["large_turn"]):
        found.append(("growth_turn", f"must be among large_turn, {settings['large_turn']}"))
    return found


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
    growth = _growth(samples[found["large"].id], breathing, places["large"], settings)
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
        growth=described(
            growth[0], ("radius",), "variance of f at the later growth_turn over before"
        ),
        growth_error=described(growth[1], ("radius",), "standard error"),
    )


def _growth(sample, factor, places, settings):
    """Return how the variance of f changes between two times, and the error, float64[2, radius]."""
    columns = [settings["large_turn"].index(turn) for turn in settings["growth_turn"]]
    found = []
    for i in range(factor.shape[0]):
        units = [factor[i, places[column]] ** 2 for column in columns]

        def ratio(mean, square, later_mean, later_square, units=units):
            later = units[1] * (later_square - later_mean**2)
            return later / (units[0] * (square - mean**2))

        moments = (_probes.moments_at(sample, i, column) for column in columns)
        one = _probes.jackknife(ratio, *moments)
        found.append((one.value, one.standard_error))
    return np.transpose(found)


claims = _trap_claims.of_fig9


def draw(dataset):
    """Draw value, its part around omega t = 3, relative error and recursion; a column per place."""
    count = dataset.sizes["radius"]
    figure, axes = plotting.panels(4, count, height=2.0)
    angle, fine = 2.0 * np.pi * dataset.turn.values, 2.0 * np.pi * dataset.fine_turn.values
    for k, radius in enumerate(dataset.radius.values):
        here = dataset.sel(radius=radius)
        column = axes[k::count]
        for axis in column[:2]:
            _probes.draw_sizes(axis, here, angle, "value", "error", SCALE)
            for name, style in LINES.items():
                axis.plot(fine, SCALE * here[name], lw=1, zorder=1, **style)
            axis.set_ylabel(f"{plotting.power_of_ten(SCALE)} $f\\,c_{{q,eq}}^6/(n\\omega^3)$")
        column[0].axvspan(*ZOOM, color="0.9", lw=0, zorder=0)
        column[1].set_xlim(*ZOOM)
        if np.isfinite(top := _zoom_top(here)):
            column[1].set_ylim(-0.05 * top, top)
        relative = here.assign(relative=here.error / here.value)
        _probes.draw_sizes(column[2], relative, angle, "relative")
        _probes.draw_sizes(column[3], here, angle, "recursion")
        for axis in (column[0], *column[2:]):
            plotting.half_turns(axis, angle.max())
        for axis in column[2:]:
            axis.set_yscale("log")
        column[0].set_title(f"$r$ = {radius:g} $c_{{q,eq}}/\\omega$")
        column[2].set_ylabel("standard error / value")
        column[3].set_ylabel("mean recursion")
        for axis in column:
            axis.set_xlabel("$\\omega t$")
    for row in (axes[2 * count : 3 * count], axes[3 * count :]):
        limits = [axis.get_ylim() for axis in row]
        for axis in row:
            axis.set_ylim(min(low for low, _ in limits), max(high for _, high in limits))
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=4, frameon=False)
    return figure


def _zoom_top(here):
    """Return the upper end of the enlarged panel, above all points and free flight, or nan."""
    angle, fine = 2.0 * np.pi * here.turn, 2.0 * np.pi * here.fine_turn
    values = here.value.where((angle > ZOOM[0]) & (angle < ZOOM[1]))
    curve = here.ballistic_curve.where((fine > ZOOM[0]) & (fine < ZOOM[1]))
    return 1.3 * SCALE * float(np.fmax(values.max(), curve.max()))
