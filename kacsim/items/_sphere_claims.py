"""What Fig. 11.4 of the chapter and its text state, tested: powers of N, volumes, generators."""

import math

from kacsim.items import _techniques
from kacsim.items._lazy import estimate, techniques_exact, verdict
from kacsim.items._spheres import BEYOND, PSEUDORANDOM

HALF = -0.5  # power of N of independent points: the number of hits is binomial


def findings(dataset):
    """Return the findings on a reduced dataset of Fig. 11.4."""
    return [
        *_shown(dataset),
        *_generators(dataset),
        *_dimensions(dataset),
    ]


def _shown(dataset):
    """Return the findings in the published dimension, at the published M."""
    lattice, upper = float(dataset.shown_slope[0]), float(dataset.upper_slope)
    random = _techniques.mean_of(dataset.isel(line=1), "shown_slope")
    settings = dataset.attrs["settings"]
    most, first = settings["largest_edge"], settings["fit_from_edge"]
    sphere = math.pi**2 / 32.0
    return [
        verdict.Finding(
            "techniques_fig4_volume",
            (
                verdict.Part(
                    estimate.Exact(float(dataset.lattice_volume)),
                    f"lattice, M = {most}",
                    printed=sphere,
                ),
                verdict.Part(_techniques.mean_of(dataset, "volume"), "Monte Carlo", printed=sphere),
            ),
            f"N = {float(dataset.n_points[-1]):.0e}.",
        ),
        verdict.finding(
            "techniques_fig4_one",
            estimate.Exact(float(dataset.line_power)),
            "Root mean square over all places of a step from 1 to 0, midpoint sum.",
            printed=-1.0,
            rival=-2.0,
        ),
        verdict.Finding(
            "techniques_fig4_lattice",
            (
                verdict.Part(estimate.Exact(lattice), f"M = 1 to {most}"),
                verdict.Part(estimate.Exact(upper), f"M = {first} to {most}"),
            ),
            "A lattice has no chance in it: these are the powers of the published points.",
        ),
        verdict.finding(
            "techniques_fig4_random",
            random,
            f"M = 1 to {most}, over {settings['n_replicates']} seeds. Independent points have the "
            "power −1/2 exactly.",
        ),
        verdict.finding(
            "techniques_fig4_difference",
            estimate.Mean(random.value - lattice, random.standard_error, random.degrees),
            f"M = 1 to {most}.",
        ),
        verdict.finding(
            "techniques_fig4_as_well",
            estimate.Exact(float(dataset.advantage)),
            "Lattice counted, Monte Carlo by the binomial law, over the larger half of M.",
        ),
    ]


def _generators(dataset):
    """Return the finding on a generator whose numbers run out."""
    last = dataset.isel(edge=-1)
    n, dimension = float(last.n_points), dataset.attrs["settings"]["shown_dimension"]
    bad, full = (last.sel(generator=name) for name in PSEUDORANDOM[1:])
    good = techniques_exact.point_error(dimension) / math.sqrt(n)
    error = float(bad.rms_error / bad.rms) / math.log(10.0)
    degrees = dataset.attrs["settings"]["bad_n_replicates"] - 1
    return [
        verdict.finding(
            "techniques_fig4_bad",
            estimate.Mean(math.log10(float(bad.rms) / good), error, degrees),
            f"N = {n:.0e}: error {float(bad.rms):.1e} with 2^20 numbers, {good:.1e} with "
            f"independent ones. A congruential generator that runs out as early errs by "
            f"{float(full.rms):.1e}: it passes evenly through all its values, and this "
            "experiment does not detect it.",
        )
    ]


def _dimensions(dataset):
    """Return the findings on the power of N by dimension."""
    dimensions = [int(d) for d in dataset.dimension.values]
    power = {}
    for d in dimensions:
        here = dataset.sel(dimension=d, way="lattice")
        power[d] = _techniques.mean_of(here, "slope", float(here.slope_degrees))

    def parts(chosen, sign):
        """Return components of sign * (power of the lattice - that of Monte Carlo)."""
        return tuple(
            verdict.Part(
                estimate.Mean(
                    sign * (power[d].value - HALF), power[d].standard_error, power[d].degrees
                ),
                f"d = {d}",
            )
            for d in chosen
        )

    random = dataset.sel(way="random")
    law = (
        f"Monte Carlo: −1/2 by the binomial law; measured {float(random.slope.min()):.3f} to "
        f"{float(random.slope.max()):.3f}, each ± {float(random.slope_error.max()):.3f} or less."
    )
    crossings = [
        f"{float(dataset.crossing.sel(dimension=d)):.0f} at d = {d}"
        for d in dimensions
        if d > BEYOND
    ]
    return [
        verdict.Finding(
            "techniques_fig4_powers",
            tuple(verdict.Part(power[d].over(1.0 / d), f"d = {d}") for d in dimensions if d > 2),
            f"Lattices counted to M = {dataset.attrs['settings']['power_largest_edge']}, blocks of "
            "neighbouring M.",
        ),
        verdict.finding(
            "techniques_fig4_circle",
            _techniques.mean_of(dataset, "circle_slope", float(dataset.circle_slope_degrees)),
            "Circles counted to M = "
            f"{dataset.attrs['settings']['largest_circle']:.0e}. The count departs from the area "
            "by the root of the radius, in root mean square.",
            printed=-1.0,
            rival=HALF,
            corrected=-0.75,
        ),
        verdict.Finding(
            "techniques_fig4_higher",
            parts([d for d in dimensions if d > BEYOND], 1.0),
            f"{law} It is ahead from N = {', '.join(crossings)} on.",
        ),
        verdict.Finding(
            "techniques_fig4_only",
            parts([d for d in dimensions if d < BEYOND], -1.0),
            "Power of Monte Carlo less that of the lattice.",
        ),
    ]
