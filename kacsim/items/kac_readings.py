"""Study: readings of the epsilon-perfect algorithm that could explain the published times."""

import math

from kacsim import items
from kacsim.cases import make_case
from kacsim.items import _readings, kac_coupling
from kacsim.items._lazy import np, plotting, store, xr
from kacsim.kac.constants import LIMIT_STEPS, MEAN_ENERGY, RULES, SINGLE, WALKS

TOLERANCES = {  # of a tolerance e on a sphere of radius R with N particles, over the radius
    "ε, E = 3N/2": lambda e, n: e / math.sqrt(MEAN_ENERGY * n),
    "ε, E = N": lambda e, n: e / math.sqrt(n),
    "ε, E = 1": lambda e, n: e,
    "D² < ε, E = 3N/2": lambda e, n: math.sqrt(e / (MEAN_ENERGY * n)),
    "D² < ε, E = N": lambda e, n: math.sqrt(e / n),
    "D² < ε, E = 1": lambda e, n: math.sqrt(e),
    "0.1": lambda e, n: 0.1 / math.sqrt(MEAN_ENERGY * n),
    "0.5": lambda e, n: 0.5 / math.sqrt(MEAN_ENERGY * n),
}
COUNTS = {  # what a coupling time t of N particles may be counted in
    "power of two that suffices": lambda t, n: 2.0 ** np.ceil(np.log2(t)),
    "steps left from there, b in Fig. 6": lambda t, n: 2.0 ** np.ceil(np.log2(t)) - t,
    "collisions of one particle": lambda t, n: 2.0 * t / n,
    "sweeps of N/2 pairs": lambda t, n: t / (n / 2.0),
    "sweeps of N pairs": lambda t, n: t / n,
    "every other step": lambda t, n: t / 2.0,
}


def problems(settings):
    """Yield (key, sentence) of particles named twice."""
    if settings["n_particles"] in settings["other_n_particles"]:
        yield "other_n_particles", f"must not hold n_particles = {settings['n_particles']}"


def _named(settings, n_particles):
    """Return name -> tolerance over the radius."""
    e = settings["tolerance"]
    return {name: float(f"{of(e, n_particles):.6g}") for name, of in TOLERANCES.items()}


def _free(settings, n_particles):
    """Return the tolerances of the grid that are reached in about so many steps."""
    radius = math.sqrt(MEAN_ENERGY * n_particles)
    steps = (
        (e, kac_coupling.predicted_steps(n_particles, e * radius))
        for e in settings["free_tolerance"]
    )
    return [e for e, predicted in steps if predicted <= settings["most_steps"]]


def _case(settings, walk, n_particles):
    fewer = "few_n_draws" if n_particles < settings["n_particles"] else "n_draws"
    n_draws = settings["single_n_draws" if walk == SINGLE else fewer]
    named = _named(settings, n_particles).values()
    free = [] if walk == SINGLE else _free(settings, n_particles)
    # Of many particles only the few steps of large tolerances are affordable.
    wanted = free if n_particles > settings["n_particles"] else [*named, *free]
    return make_case(
        "kac_readings",
        walk=walk,
        n_particles=n_particles,
        tolerance=sorted(set(wanted), reverse=True),
        n_draws=n_draws,
        n_replicates=settings["n_replicates"],
        seed=settings["seed"],
    )


def _families(settings):
    """Return (walk, N) -> case: every walk at the published N, the printed one at others too."""
    n = settings["n_particles"]
    keys = [(walk, n) for walk in WALKS]
    keys += [("printed", other) for other in settings["other_n_particles"]]
    return {key: _case(settings, *key) for key in keys}


def _counted(settings):
    """Return the case of the algorithm as printed, whose draws are kept."""
    size = {
        "n_draws": settings["counted_n_draws"],
        "n_replicates": settings["counted_n_replicates"],
    }
    keys = ("n_particles", "tolerance", "seed")
    return make_case("kac_equilibrium", **{key: settings[key] for key in keys}, **size)


def cases(settings):
    """Return the walks at the published N and at others, in single precision, and as printed."""
    single = _case(settings, SINGLE, settings["n_particles"])
    return [*_families(settings).values(), single, _counted(settings)]


def reduce(samples, settings):
    """Return a row per reading, curves with a free tolerance, and what the text's numbers imply."""
    families, published = _families(settings), _published()
    rows, curves, free = [], [], []
    for (walk, n), case in families.items():
        sample = samples[case.id]
        named = _named(settings, n)
        for r, rule in enumerate(RULES):
            table = [
                _readings.moments(sample, case, r, k) for k in range(sample.sizes["tolerance"])
            ]
            places = {float(f"{e:.6g}"): k for k, e in enumerate(sample["tolerance"].values)}
            rows += [
                ((walk, n, rule, name), table[places[e]])
                for name, e in named.items()
                if e in places
            ]
            curves.append(table)
            free.append(_readings.at_mean(table, published[0]))
    single = _case(settings, SINGLE, settings["n_particles"])
    sample = samples[single.id]
    for name, e in _named(settings, settings["n_particles"]).items():
        k = int(np.argmin(np.abs(sample["tolerance"].values - e)))
        key = (SINGLE, settings["n_particles"], RULES[0], name)
        rows.append((key, _readings.moments(sample, single, 0, k)))
    times = samples[_counted(settings).id]["coupling_time"].values.astype(float)
    for name, count in COUNTS.items():
        key = ("printed", settings["n_particles"], name, "ε, E = 3N/2")
        rows.append((key, _readings.of_draws(count(times, settings["n_particles"]))))
    return xr.Dataset(
        _reading_variables(rows, published)
        | _curve_variables(families, curves, free, published)
        | _implied(times, settings, published)
    )


def _published():
    """Return the published mean, smallest and largest coupling time."""
    entries = items.published_of(("kac_readings",))
    return [float(entries[f"kac_fig9_coupling_{key}"]["printed"]) for key in ("mean", "min", "max")]


def _reading_variables(rows, published):
    """Return the variables of the readings, and how many there are that fit."""
    described = store.described
    keys, table = zip(*rows, strict=True)
    walks, particles, rules, tolerances = zip(*keys, strict=True)
    found = _readings.fits(table, published)
    dims = ("reading",)
    words = {"walk": walks, "rule": rules, "tolerance_name": tolerances}
    variables = {
        name: described(np.array(values, dtype=object), dims, name.replace("_", " "))
        for name, values in words.items()
    }
    return variables | {
        "n_particles": described(np.array(particles), dims, "particles"),
        "number": described(
            np.array(table), (*dims, "which"), "; ".join(_readings.NUMBERS.values())
        ),
        "fits": described(found.astype(np.int8), (*dims, "part"), "1 if mean, least, most fit"),
        "n_readings": described(len(rows), (), "readings tried"),
        "n_mean": described(found[:, 0].sum(), (), "readings whose mean fits"),
        "n_range": described(found[:, 1:].all(axis=1).sum(), (), "readings whose range fits"),
        "n_all": described(found.all(axis=1).sum(), (), "readings of which all three fit"),
        "which": described(np.array(list(_readings.NUMBERS), dtype=object), ("which",), "number"),
    }


def _curve_variables(families, curves, free, published):
    """Return mean and deviation along all tolerances, and where the mean is the published one."""
    described = store.described
    longest = max(len(table) for table in curves)
    lines = np.full((len(curves), longest, 2), np.nan)
    for k, table in enumerate(curves):
        lines[k, : len(table)] = np.array(table)[:, [0, 2]]
    shape = (len(families), len(RULES))
    free = np.array(free).reshape(*shape, len(_readings.NUMBERS))
    there = np.isfinite(free[..., 0])
    found = _readings.fits(np.nan_to_num(free), published)[..., 1:].all(axis=-1) & there
    dims = ("family", "rule_place")
    texts = {"family_walk": [w for w, _ in families], "rule_name": list(RULES)}
    variables = {
        name: described(np.array(values, dtype=object), (dim,), name)
        for (name, values), dim in zip(texts.items(), dims, strict=True)
    }
    return variables | {
        "family_n": described([n for _, n in families], dims[:1], "particles"),
        "line": described(
            lines.reshape(*shape, longest, 2), (*dims, "point", "two"), "mean, deviation"
        ),
        "free": described(free, (*dims, "which"), "numbers where the mean is the published one"),
        "n_free": described(there.sum(), (), "rules with a tolerance that gives the mean"),
        "n_free_fit": described(found.sum(), (), "those whose range fits then"),
    }


def _implied(times, settings, published):
    """Return the deviation that the published range implies, and a law that has all three."""
    described, ours = store.described, _readings.of_draws(times)
    shape = (times.mean() - times.min(), times.max() - times.mean())
    mean, least, most = published
    spreads = [
        gap * ours[2] / own for gap, own in zip((mean - least, most - mean), shape, strict=True)
    ]
    chance = 2.0 / settings["n_particles"]  # that a step has one given particle
    n_events = round(mean * chance)
    deviation = math.sqrt(n_events * (1.0 - chance)) / chance
    skewness = (2.0 - chance) / math.sqrt(n_events * (1.0 - chance))
    return {
        "implied_spread": described(spreads, ("end",), "deviation that the range implies"),
        "own_spread": described(ours[2], (), "deviation of the algorithm as printed"),
        "own_mean": described(ours[0], (), "mean of the algorithm as printed"),
        "n_events": described(n_events, (), "collisions of one particle in the published mean"),
        "event_mean": described(n_events / chance, (), "mean steps until so many"),
        "event_spread": described(deviation, (), "their standard deviation"),
        "event_ends": described(
            _readings.ends(n_events / chance, deviation, skewness),
            ("four",),
            "their extremes' intervals",
        ),
        "limit_steps": described(LIMIT_STEPS, (), "steps after which single precision ends"),
    }


# The figure: deviation against mean, and the ranges of some readings

SHOWN = (  # walk, N is the published one (or its place among the others), rule, tolerance
    ("printed", None, "largest", "ε, E = 3N/2", "as printed"),
    ("printed", None, "largest", "ε, E = 1", "unit sphere"),
    ("printed", None, "largest", "D² < ε, E = 3N/2", "squared distance"),
    ("printed", None, "largest", "0.5", "$D < 0.5$"),
    ("printed", None, "mean_square", "ε, E = 3N/2", "root mean square distance"),
    ("printed", None, "first_two", "ε, E = 3N/2", "first two points only"),
    ("printed", None, "first_coordinate", "ε, E = 3N/2", "$v_1$ only"),
    ("printed", None, "energies", "ε, E = 3N/2", "distance of energies"),
    ("half", None, "largest", "ε, E = 3N/2", "angle of 45°"),
    ("with_first", None, "largest", "ε, E = 3N/2", "particle 1 in every pair"),
    ("single", None, "largest", "ε, E = 1", "single precision, unit sphere"),
    ("printed", 0, "largest", "ε, E = 3N/2", "$N$ = {n}"),
    ("printed", None, "steps left from there, b in Fig. 6", "ε, E = 3N/2", "steps left of $2^k$"),
)


def draw(dataset):
    """Draw deviation against mean of all readings, and the ranges of some."""
    figure, axes = plotting.panels(1, 2, height=3.6)
    _draw_plane(axes[0], dataset)
    _draw_ranges(axes[1], dataset)
    return figure


def _draw_plane(axis, dataset):
    numbers = dataset.number.values
    line = dataset.line.values
    for family in range(line.shape[0]):
        for rule in range(line.shape[1]):
            own = family == 0 and rule == 0
            style = {"color": plotting.COLOURS[0] if own else "0.8", "lw": 1.6 if own else 0.6}
            label = "as printed, any tolerance" if own else None
            axis.plot(*line[family, rule].T, zorder=3 if own else 1, label=label, **style)
    axis.plot(*numbers[:, [0, 2]].T, ".", color="0.45", ms=3, label="readings", zorder=2)
    published = dataset.attrs["published"]["kac_fig9_coupling_mean"]
    spreads = np.sort(dataset.implied_spread.values)
    axis.plot([published] * 2, spreads, color=plotting.COLOURS[1], lw=3, zorder=5)
    style = {"marker": "*", "ms": 11, "ls": "", "color": plotting.COLOURS[1], "zorder": 5}
    axis.plot(published, spreads.mean(), label="published", **style)
    axis.set(xscale="log", yscale="log", xlim=(90, 9000), ylim=(20, 1200))
    axis.set_xticks([100, 300, 1000, 3000], ["100", "300", "1000", "3000"], minor=False)
    axis.xaxis.set_minor_formatter("")
    axis.set_xlabel("mean coupling time in steps")
    axis.set_ylabel("standard deviation in steps")
    plotting.plain_log(axis.yaxis)
    plotting.legend_on_top(axis)


def _draw_ranges(axis, dataset):
    published = dataset.attrs["published"]
    mean, least, most = (published[f"kac_fig9_coupling_{key}"] for key in ("mean", "min", "max"))
    axis.axvspan(least, most, color="#f8e3d5", lw=0, zorder=0)
    axis.axvline(mean, color=plotting.COLOURS[1], lw=1, zorder=1)
    axis.plot([least, most], [0, 0], color=plotting.COLOURS[1], lw=3)
    axis.plot(mean, 0, "*", ms=10, color=plotting.COLOURS[1])
    names = ["published"]
    for place, (label, numbers) in enumerate(_shown(dataset), start=1):
        values = dict(zip(_readings.NUMBERS, numbers, strict=True))
        ends = [0.5 * (values[f"{end}_low"] + values[f"{end}_high"]) for end in ("least", "most")]
        axis.plot(np.maximum(ends, 0.0), [place] * 2, color=plotting.COLOURS[0], lw=1.5)
        axis.plot(values["mean"], place, "o", color=plotting.COLOURS[0], ms=4)
        names.append(label)
    axis.set_yticks(range(len(names)), names, fontsize=7)
    axis.set_ylim(len(names) - 0.5, -0.6)
    axis.set_xlabel("mean and range in steps")


def _shown(dataset):
    """Return (label, numbers) of the readings of SHOWN that are there."""
    settings = dataset.attrs["settings"]
    columns = (dataset.walk, dataset.n_particles, dataset.rule, dataset.tolerance_name)
    keys = [tuple(key) for key in zip(*(c.values for c in columns), strict=True)]
    found = []
    for walk, place, rule, tolerance, label in SHOWN:
        others = settings["other_n_particles"]
        n = settings["n_particles"] if place is None else others[place]
        key = (walk, n, rule, tolerance)
        if key in keys:
            found.append((label.format(n=n), dataset.number.values[keys.index(key)]))
    return found
