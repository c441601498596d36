"""Fig. 10 of the Boltzmann paper: matter beyond a radius in the trap, by Algorithm 7."""

from kacsim.items import _probes, _trap, _trap_claims
from kacsim.items._lazy import np, plotting, store, trap

problems = _trap.problems


def cases(settings):
    """Return every radius at both times, at both numbers of realizations."""
    return list(_trap.cases_by_size("trap_fraction", settings).values())


def reduce(samples, settings):
    """Return estimates with errors beside the fraction of the breathing state."""
    found = _trap.cases_by_size("trap_fraction", settings)
    phase = 2.0 * np.pi * np.array(settings["turn"], dtype=float)
    radius = np.array(settings["radius"], dtype=float)[:, None]
    state = settings["breathing"], settings["start_phase"]
    exact = trap.fraction(radius, phase, *state)
    axes = {"radius": settings["radius"], "turn": settings["turn"]}
    places = _trap.places(settings)
    table = _probes.table(samples, found, axes, np.ones(exact.shape), exact, places)
    rarefaction = _rarefaction(samples[found["large"].id])
    return table.assign(
        ballistic=store.described(
            trap.fraction(radius, phase, *state, trap.free_shape(phase, *state)),
            ("radius", "turn"),
            "fraction without collisions",
        ),
        rarefaction=store.described(
            rarefaction.value, (), "relative deviation at the last radius over that at the first"
        ),
        rarefaction_error=store.described(rarefaction.standard_error, (), "standard error"),
        batch=store.described(
            _trap.batches(samples, found, places, exact.shape),
            ("size", "radius", "turn"),
            "largest |z| of the replicates' means",
        ),
    )


def _rarefaction(sample):
    """Return the relative deviation of a realization beyond the last radius over the first's."""

    def ratio(mean, square, far_mean, far_square):
        near = _probes.relative_deviation(mean, square)
        return _probes.relative_deviation(far_mean, far_square) / near

    return _probes.jackknife(ratio, *(_probes.moments_at(sample, i, 0) for i in (0, -1)))


claims = _trap_claims.of_fig10


def draw(dataset):
    """Draw fractions, relative errors and recursion against the radius, a column per time."""
    count = dataset.sizes["turn"]
    figure, axes = plotting.panels(3, count, height=2.1)
    for k, turn in enumerate(dataset.turn.values):
        here = dataset.sel(turn=turn)
        here = here.assign(
            relative=here.error / here.exact, wrong=np.abs(here.actual_error) / here.exact
        )
        radius, column = here.radius.values, axes[k::count]
        _probes.draw_sizes(column[0], here, radius, "value", "error")
        column[0].plot(radius, here.exact, color="black", lw=1, label="breathing = ballistic")
        _probes.draw_sizes(column[1], here, radius, "relative")
        for j in range(here.sizes["size"]):
            wrong = here.wrong.isel(size=j)
            column[1].plot(radius, wrong, "x", color=plotting.COLOURS[j], ms=4)
        _probes.draw_sizes(column[2], here, radius, "recursion")
        for axis in column:
            axis.set_yscale("log")
        column[0].set_title(f"$\\omega t$ = {2 * turn:g}$\\pi$")
        column[0].set_ylabel("fraction $|r| > r_0$")
        column[1].set_ylabel("standard error / value\n(crosses: actual error)")
        column[2].set_ylabel("mean recursion")
        column[2].set_xlabel("$r_0\\,\\omega/c_{q,eq}$")
    axes[0].legend()
    return figure
