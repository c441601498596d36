"""The claims of `kac_statements`: exact values against what sections 2 to 4 of the text state."""

import math

from kacsim.items import _kac
from kacsim.items._lazy import estimate, statements, verdict
from kacsim.kac.samplers import TITLES

CURVES = ("first", "population", "nanbu_synchronous", "nanbu_babovsky")
NAMES = {"first": "updated in place, particle 1", "population": "updated in place, all particles"}
ORDERS = (4, 6, 8)  # of the moments that eq. (8) is tested by
DEGREE = 4  # of the polynomials that Q_N is tested by


def claims(dataset):
    """Test the statements of sections 2 to 4 that need no draws."""
    return [*_of_the_walk(dataset), *_of_the_equation(dataset), *_of_the_algorithms(dataset)]


def _of_the_walk(dataset):
    failed, tested = (int(n) for n in dataset.unequal)
    others = int(dataset.unequal_one_sided[0])
    changed, all_of_them = (int(n) for n in dataset.energy_changed)
    n = dataset.attrs["settings"]["few_particles"]
    return [
        verdict.finding(
            "kac_21_self_adjoint",
            estimate.Exact(failed / tested),
            f"Pairs of monomials up to degree {DEGREE} for which the two sides differ: {failed} of "
            f"{tested}, N = {n}, in fractions, with angles that are symmetric about 0 and not "
            f"uniform; with angles that are not symmetric, {others}. For all functions: to turn "
            "the sphere back by the angle changes no integral, and both signs are equally likely.",
        ),
        verdict.finding(
            "kac_21_energy",
            estimate.Exact(changed / all_of_them),
            f"Collisions whose matrix is not orthogonal: {changed} of {all_of_them}, N = {n}.",
        ),
        verdict.finding(
            "kac_21_momentum",
            estimate.Exact(float(dataset.momentum_change)),
            "Mean square change of the momentum of a pair in one collision, over its mean square.",
        ),
    ]


def _of_the_equation(dataset):
    numbers = dataset.n_particles.values
    few, many = dataset.isel(n_particles=0), dataset.isel(n_particles=-1)
    orders = [
        verdict.Part(
            estimate.Exact(float(dataset.change.sel(order=order))),
            f"order {order}",
            printed=float(dataset.change_solution.sel(order=order)),
        )
        for order in ORDERS
    ]
    late = [
        verdict.Part(estimate.Exact(float(ratio)), f"v = {float(v):g}", printed=1.0)
        for v, ratio in zip(dataset.speed, dataset.late, strict=True)
    ]
    series = [
        verdict.Part(
            estimate.Exact(float(here.process)),
            f"N = {n}",
            printed=float(here.series),
            rival=float(here.bird),
        )
        for n, here in zip(numbers[[0, -1]], (few, many), strict=True)
    ]
    return [
        verdict.Finding(
            "kac_22_solution",
            tuple(series),
            "E v₁⁴ from the equation of moments, against the sum over the number of collisions.",
        ),
        verdict.finding(
            "kac_5_marginal",
            estimate.Exact(1.0),
            f"Mass of the marginal of the uniform density, N = {numbers[0]}: "
            f"{float(few.marginal):.4f} by eq. (5), {float(few.mended):.4f} with the factor "
            f"√(E/(E − v₁²)); at N = {numbers[-1]} {float(many.marginal):.4f} and "
            f"{float(many.mended):.4f}. Nothing in the paper is computed from eq. (5).",
            printed=float(few.marginal),
            corrected=float(few.mended),
        ),
        verdict.finding(
            "kac_3_limit",
            estimate.Exact(float(many.process)),
            f"E v₁⁴ of Kac’s process at N = {numbers[-1]}; N = {numbers[0]}: "
            f"{float(few.process):.4f}.",
            printed=float(dataset.limit),
        ),
        verdict.Finding(
            "kac_8_solution",
            tuple(orders),
            "Rates at which moments of the density (8) change: by eq. (6), and by the formula.",
        ),
        verdict.Finding("kac_9_limit", tuple(late), "Eq. (8) at infinite time over eq. (9)."),
        verdict.finding(
            "kac_44_norm",
            estimate.Exact(float(dataset.supremum)),
            "Largest difference of probability of a set, between the laws at the start and at the "
            "time of the figures, against twice the printed formula for discrete laws, eq. (11).",
            printed=2.0 * float(dataset.half_sum),
            corrected=float(dataset.half_sum),
        ),
    ]


def _of_the_algorithms(dataset):
    settings = dataset.attrs["settings"]
    n, many = (int(dataset.n_particles[k]) for k in (1, -1))
    fixed, limit = dataset.sel(n_particles=n), dataset.sel(n_particles=many)
    pairs = float(fixed.expected) * settings["time_step"] / settings["time"]
    printed = float(dataset.discretized)
    moments = {name: float(limit.moment.sel(curve=name)) for name in CURVES}
    at_old = [
        verdict.Part(
            estimate.Exact(moments[name]),
            TITLES[name],
            printed=printed,
            rival=moments["population"],
        )
        for name in CURVES[2:]
    ]
    in_place = [
        verdict.Part(
            estimate.Exact(moments[name]),
            NAMES[name],
            printed=printed,
            corrected=float(dataset.in_place[k]),
        )
        for k, name in enumerate(CURVES[:2])
    ]
    growth = [
        verdict.Part(estimate.Exact(float(fixed.growth.sel(reading=name))), TITLES[name])
        for name in _kac.READINGS
    ]
    counts = [
        verdict.Part(
            estimate.Exact(float(here["count"])),
            f"N = {int(here.n_particles)}",
            printed=float(here.expected),
            corrected=float(math.ceil(here.expected)),
        )
        for here in (fixed, dataset.isel(n_particles=2))
    ]
    step = settings["time_step"]
    return [
        verdict.finding(
            "kac_41_round",
            estimate.Exact(statements.mean_rounded(pairs)),
            f"Mean of Round[x] at x = {pairs:.4f}, from the two chances.",
            printed=pairs,
        ),
        verdict.Finding(
            "kac_41_energy",
            tuple(growth),
            f"Growth of E (Σ v²)² until t = {settings['time']:g}, N = {n}, step {step:g}; none if "
            "Σ v² were conserved. Its mean is, exactly: v_i² becomes half of v_i² + v_j² on the "
            "average over angles.",
        ),
        verdict.finding(
            "kac_41_loop",
            estimate.Exact(pairs),
            f"Pairs that should collide in a step, λNΔt/2, N = {n}, step {step:g}; step 2 as "
            "printed draws and collides that many for each i from 1 to N.",
            printed=n * pairs,
            corrected=statements.mean_rounded(pairs),
        ),
        verdict.Finding(
            "kac_41_limit",
            tuple(at_old),
            f"E v⁴ at N = {many}, step {step:g}; eq. (10) gives {printed:.4f}.",
        ),
        verdict.Finding(
            "kac_41_limit_in_place",
            tuple(in_place),
            f"E v⁴ at N = {many}, step {step:g}. Eq. (10) gives {printed:.4f}; the limits are "
            f"{float(dataset.in_place[0]):.4f} and {float(dataset.in_place[1]):.4f}: partners of "
            "lower index have collided already in the same step. As the step falls all tend to "
            "eq. (8).",
        ),
        verdict.finding(
            "kac_42_limit",
            estimate.Exact(float(limit.bird)),
            f"E v₁⁴ of Bird’s algorithm at N = {many}.",
            printed=float(dataset.limit),
        ),
        verdict.Finding(
            "kac_42_count",
            tuple(counts),
            f"Collisions until t = {settings['time']:g}: the clock passes the time by part of a "
            "collision. The surplus shows in the TVN where N is small.",
        ),
        verdict.finding(
            "kac_42_replacement",
            estimate.Exact(float(fixed.replaced)),
            f"E v₁⁴ at N = {n}: Nanbu–Babovsky with replacement, step {step:g}, against Bird.",
            printed=float(fixed.bird),
        ),
    ]
