"""Fig. 11.3 of the chapter: injection through the faces of a cuboid, against the gas outside it."""

import math

from kacsim.items import _entering, _techniques
from kacsim.items._lazy import estimate, flux, np, plotting, store, verdict, xr
from kacsim.techniques.constants import FACE, FACES, POSITION, VELOCITY

SOURCES = ("injection", "outer_gas")
LABELS = ("injected", "gas outside, moved")
AGAINST = ("+x", "-y")  # faces against the drift: many steps bring no particle
SMALLEST = 5e-324  # of the positive numbers in double precision
N_BARS = 12  # numbers of particles with a bar


def _cases(settings):
    found = {name: _techniques.gas_case(settings, name) for name in SOURCES}
    found["weighted_particles"] = _techniques.case(
        settings,
        "weighted_particles",
        n_representatives=settings["n_representatives"],
        temperature=settings["temperature"],
        drift=settings["drift"],
    )
    return found


def cases(settings):
    """Return particles injected, those that enter from a gas, and a choice of weighted ones."""
    return list(_cases(settings).values())


def _normal(settings, face):
    """Return the drift along the inward normal of a face."""
    return (1.0 - 2.0 * (face % 2)) * settings["drift"][face // 2]


def reduce(samples, settings):
    """Return rates, moments and laws by face, from both sources, beside the closed forms."""
    found, faces = _cases(settings), range(len(FACES))
    results = [_entering.of_source(samples[found[name].id], settings) for name in SOURCES]
    described, dims = store.described, ("source", "face")

    def both(key):
        return np.array([result[key] for result in results])

    texts = {
        "rate": "particles per step",
        "speed": "mean normal velocity",
        "square": "mean squared normal velocity",
        "fano": "variance over mean of the number per step",
        "place": "mean of both positions on the face squared, in half widths",
        "none": "share of steps without a particle",
    }
    variables = {}
    for key, text in texts.items():
        values = [[mean.value for mean in result["means"][key]] for result in results]
        errors = [[mean.standard_error for mean in result["means"][key]] for result in results]
        variables[key] = described(values, dims, text)
        variables[f"{key}_error"] = described(errors, dims, "standard error")
    temperature = settings["temperature"]
    normal = [_normal(settings, face) for face in faces]
    halves = [flux.half_moments(u, temperature, 2) for u in normal]
    gas = samples[found["outer_gas"].id]
    edges = gas["speed_edge"].values
    weighted = _entering.weighted(samples[found["weighted_particles"].id])
    many = {
        "rate_exact": (_techniques.numbers_per_step(settings), "eq. (11.14) with its limits right"),
        "speed_exact": ([flux.moment(1, u, temperature) for u in normal], "mean under v f(v)"),
        "speed_unweighted": ([h[1] / h[0] for h in halves], "mean under f(v), v > 0"),
        "square_exact": ([flux.moment(2, u, temperature) for u in normal], "mean under v f(v)"),
    }
    variables |= {key: described(v, ("face",), text) for key, (v, text) in many.items()}
    variables |= {
        "p_speed": described(both("p_speed"), dims, "p-value of the normal velocities"),
        "p_number": described(both("p_number"), dims, "p-value of the numbers per step"),
        "share": described(both("share"), (*dims, "number"), "steps by number of particles"),
        "share_exact": described(
            [_entering.poisson(m, gas["steps"].shape[-1]) for m in many["rate_exact"][0]],
            ("face", "number"),
            "eq. (11.15)",
        ),
        "speeds": described(both("speeds"), (*dims, "bin"), "particles by v_n"),
        "speed_edge": described(edges, ("bin",), "lower edge of the bin"),
        "kept": described(samples[found["injection"].id]["kept"].values, ("kept", "part"), "first"),
    }
    variables |= {key: described(v, (), key.replace("_", " ")) for key, v in weighted.items()}
    return xr.Dataset(variables, coords={"source": list(SOURCES), "face": list(FACES)})


def claims(dataset):
    """Test eqs. (11.14) and (11.15), the weight v of the velocities, and weighted particles."""
    s = dataset.attrs["settings"]
    gas = dataset.sel(source="outer_gas")
    first = gas.isel(face=0)
    rate, (_, width, height) = float(first.rate_exact), s["half_width"]
    number, speed = [], []
    for face in AGAINST:
        here = gas.sel(face=face)
        mean = float(here.rate_exact)
        number.append(
            verdict.Part(
                _techniques.mean_of(here, "none"),
                f"no particle, face {face}",
                printed=math.exp(-mean),
                rival=math.exp(-mean / s["step"]),
            )
        )
    for face in FACES[:2]:
        here = gas.sel(face=face)
        speed.append(
            verdict.Part(
                _techniques.mean_of(here, "speed"),
                f"face {face}",
                printed=float(here.speed_exact),
                rival=float(here.speed_unweighted),
            )
        )
    chosen = _techniques.mean_of(dataset, "weighted_speed")
    expected = float(dataset.weighted_speed_exact)
    lost = _entering.LARGE
    return [
        verdict.finding(
            "techniques_fig3_limits",
            _techniques.mean_of(first, "rate"),
            f"Through the face at −x of a gas that is moved without knowing fluxes, L_y = "
            f"{width:g}, L_z = {height:g}.",
            printed=rate * width / height,
            corrected=rate,
        ),
        verdict.Finding(
            "techniques_fig3_rate",
            tuple(number),
            f"Share of steps without a particle, moved gas, step {s['step']:g}. It tests the law "
            "on a gas, and is no evidence about what the authors ran.",
        ),
        verdict.Finding("techniques_fig3_variance", _entering.sums(), "Sums over eq. (11.15)."),
        verdict.Finding(
            "techniques_fig3_fixed",
            _entering.lost_spread(),
            "Standard deviation over mean of eq. (11.15), 1/√r; the mean alone has none.",
        ),
        verdict.Finding(
            "techniques_fig3_recipe",
            _entering.found_numbers(),
            "Mean of the numbers found in the cumulative steps for equally spaced u. The "
            "probabilities are taken from their logarithms: in double precision exp(−r) is zero "
            f"from r = {math.ceil(-math.log(SMALLEST)) + 1} on.",
        ),
        verdict.finding(
            "techniques_fig3_position",
            _techniques.mean_of(first, "place"),
            "Mean of (y/L_y)² + (z/L_z)² over the particles of the moved gas that enter at −x.",
            printed=2.0 / 3.0,
        ),
        verdict.Finding(
            "techniques_fig3_weight",
            tuple(speed),
            "Mean normal velocity of the particles of the moved gas that enter; the rival is the "
            "mean over f restricted to inward velocities.",
        ),
        verdict.finding(
            "techniques_fig3_particles",
            chosen.over(expected),
            f"Mean normal velocity of particles chosen among {s['n_representatives']} of three "
            "weights, over that of the same particles in closed form; the rival takes the weights "
            "alone. It tests this project's choice, whose lengths are the weights by construction.",
            printed=1.0,
            rival=float(dataset.weighted_speed_bare) / expected,
        ),
        verdict.finding(
            "techniques_fig3_discrete",
            estimate.Exact(flux.representative_error(s["drift"][0], s["temperature"], lost)),
            f"Relative standard deviation of the mean normal velocity over {lost:.0e} "
            "representatives, to first order in 1/N, in closed form.",
        ),
    ]


def draw(dataset):
    """Draw the cuboid with injected particles, rates by face, numbers and normal velocities."""
    s = dataset.attrs["settings"]
    figure, axes = plotting.panels(2, 2)
    _geometry(axes[0], dataset, s)
    place = np.arange(len(FACES))
    for k, source in enumerate(SOURCES):
        here = dataset.sel(source=source)
        shift = 0.16 * (2 * k - 1)
        relative, error = here.rate / dataset.rate_exact, here.rate_error / dataset.rate_exact
        plotting.points(axes[1], place + shift, relative, error, k, LABELS[k], line=False)
        face = here.isel(face=0)
        number = np.arange(N_BARS)
        axes[2].plot(
            number + shift,
            face.share.values[:N_BARS],
            plotting.MARKERS[k],
            ms=4,
            color=plotting.COLOURS[k],
            label=LABELS[k],
        )
        edges = dataset.speed_edge.values
        height = face.speeds.values[:-1] / face.speeds.values.sum() / np.diff(edges)
        plotting.bars(axes[3], edges, height, k, LABELS[k], fill=k == 0)
    axes[1].axhline(1.0, color="black", lw=1, label="eq. (11.14), limits right")
    axes[1].set_xticks(place, [face.replace("-", "−") for face in FACES])
    axes[1].set_xlabel("face")
    axes[1].set_ylabel("particles per step / exact")
    plotting.legends_above([axes[1]], share=0.35)
    axes[2].plot(
        np.arange(N_BARS),
        dataset.share_exact.values[0, :N_BARS],
        "_",
        ms=14,
        color="black",
        label="Poisson",
    )
    axes[2].set_xlabel("particles in one step, face −x")
    axes[2].set_ylabel("share of the steps")
    _speeds(axes[3], dataset, s)
    for axis in axes[2:]:
        axis.legend()
    return figure


def _speeds(axis, dataset, s):
    grid = np.linspace(0.0, float(dataset.speed_edge[-1]) * 0.75, 200)
    u, temperature = s["drift"][0], s["temperature"]
    bell = np.exp(-((grid - u) ** 2) / (2.0 * temperature)) / np.sqrt(2.0 * np.pi * temperature)
    halves = flux.half_moments(u, temperature, 1)
    axis.plot(grid, grid * bell / halves[1], color="black", lw=1, label="$v f(v)$")
    axis.plot(grid, bell / halves[0], color="black", lw=1, ls="--", label="$f(v)$, $v$ > 0")
    axis.set_xlim(0.0, grid[-1])
    axis.set_xlabel("normal velocity $v_n$, face −x")
    axis.set_ylabel("density")


def _geometry(axis, dataset, s):
    """Draw the cuboid seen along z, with the first injected particles as arrows."""
    width, height = s["half_width"][:2]
    axis.plot(
        [-width, width, width, -width, -width],
        [-height, -height, height, height, -height],
        color="black",
        lw=1,
    )
    kept = dataset.kept.values
    kept = kept[kept[:, FACE] < 4][:80]  # through the faces that are seen
    for k in range(2):
        here = kept[(kept[:, FACE].astype(int) // 2) == k]
        axis.quiver(
            here[:, POSITION],
            here[:, POSITION + 1],
            here[:, VELOCITY],
            here[:, VELOCITY + 1],
            color=plotting.COLOURS[k],
            angles="xy",
            scale_units="xy",
            scale=6.0,
            width=0.004,
            label=("faces −x, +x", "faces −y, +y")[k],
        )
    axis.set_aspect("equal")
    axis.set_xlim(-1.7 * max(width, height), 1.7 * max(width, height))
    axis.set_ylim(-1.25 * height, 1.75 * height)
    axis.set_xlabel("position $x$")
    axis.set_ylabel("position $y$")
    axis.legend(loc="upper center", ncols=2, frameon=False)
