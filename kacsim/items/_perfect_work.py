"""What a draw of the perfect sampler costs, beside one of the epsilon-perfect sampler."""

import math

from kacsim.items import _kac
from kacsim.items._lazy import estimate, plotting, store
from kacsim.kac.contraction import blocks_per_draw, chosen_block
from kacsim.kac.work import of_blocks, of_coupling

KINDS = ("kac_perfect", "kac_equilibrium")


def of_both(samples, work, settings):
    """Return steps per draw of both kinds, their ratio, and that of the times."""
    rows = [
        (_steps(samples[a.id], a), _coupling(samples[b.id], b), _seconds(settings, a, b))
        for a, b in work
    ]
    ratios = [_ratio(perfect, other) for perfect, other, _ in rows]
    described, dims = store.described, ("cost_n",)
    columns = {
        "steps": ([row[0] for row in rows], "steps per draw, epsilon = 0"),
        "other_steps": ([row[1] for row in rows], "steps per draw, epsilon-perfect"),
        "ratio": (ratios, "their ratio"),
    }
    found = {}
    for name, (means, text) in columns.items():
        found[name] = described([m.value for m in means], dims, text)
        found[name + "_error"] = described([m.standard_error for m in means], dims, "its error")
    found["time_ratio"] = described(
        [row[2] for row in rows], dims, "time of a draw over that of an epsilon-perfect one"
    )
    found["chosen"] = described(
        [chosen_block(n) for n in settings["cost_n_particles"]], dims, "random steps of a block"
    )
    return found


def against_block(samples, scan, settings):
    """Return steps per draw against the random steps of a block."""
    n = settings["fixed_n_particles"]
    means = [_steps(samples[case.id], case) for case in scan]
    described, dims = store.described, ("block",)
    return {
        "scan": described([m.value for m in means], dims, "steps per draw"),
        "scan_error": described([m.standard_error for m in means], dims, "its error"),
        "scan_fitted": described(
            [blocks_per_draw(n, block) * (block + n) for block in settings["block"]],
            dims,
            "the formula of the plan",
        ),
    }


def draw_ratios(axis, dataset):
    """Draw work and time of a perfect draw over those of an epsilon-perfect one, against N."""
    label = "steps, $\\varepsilon$ = 0 over " + plotting.power_of_ten(
        dataset.attrs["settings"]["tolerance"]
    )
    plotting.points(axis, dataset.cost_n, dataset.ratio, dataset.ratio_error, 0, label)
    plotting.points(axis, dataset.cost_n, dataset.time_ratio, None, 1, "time")
    axis.axhline(1.0, color="0.5", ls=":", lw=1)
    axis.set_xscale("log")
    plotting.plain_log(axis.xaxis)
    axis.set_ylim(bottom=0.0)
    axis.set_xlabel("number of particles $N$")
    axis.set_ylabel("ratio per draw")


def draw_scan(axis, dataset):
    """Draw steps per draw against the length of a block, with the formula of the plan."""
    n = dataset.attrs["settings"]["fixed_n_particles"]
    here = dataset.sel(cost_n=n)
    plotting.points(
        axis, dataset.block, dataset.scan, dataset.scan_error, 0, f"$N$ = {n}", line=False
    )
    axis.plot(dataset.block, dataset.scan_fitted, color="0.3", ls="--", lw=1, label="formula")
    axis.axvline(float(here.chosen), color=plotting.COLOURS[1], lw=1, label="chosen")
    tolerance = plotting.power_of_ten(dataset.attrs["settings"]["tolerance"])
    style = {"color": "black", "ls": ":", "lw": 1, "label": f"$\\varepsilon$ = {tolerance}"}
    axis.axhline(float(here.other_steps), **style)
    axis.set_xlabel("random steps of a block")
    axis.set_ylabel("steps per draw")


def _blocks(sample, case):
    """Return blocks per draw with its error: their number is geometric."""
    mean = float(sample["blocks"].mean())
    variance = max(mean * (mean - 1.0), 0.0)
    return estimate.Mean(mean, math.sqrt(variance / _kac.n_draws_of(case)))


def _steps(sample, case):
    """Return steps per perfect draw; the bounds take as long as N steps, the sweep among them."""
    n, block = (case.parameters[key] for key in ("n_particles", "block"))
    each = (chosen_block(n) if block is None else block) + n
    return _blocks(sample, case).over(1.0 / each)


def _coupling(sample, case):
    """Return the mean coupling time of epsilon-perfect draws."""
    variance = float(sample["coupling_variance"].mean() + sample["coupling_mean"].values.var())
    error = math.sqrt(variance / _kac.n_draws_of(case))
    return estimate.Mean(float(sample["coupling_mean"].mean()), error)


def _ratio(a, b):
    """Return the ratio of two independent estimates."""
    value = a.value / b.value
    relative = math.hypot(a.standard_error / a.value, b.standard_error / b.value)
    return estimate.Mean(value, value * relative)


def _seconds(settings, *pair):
    """Return the ratio of the times of a draw, by the coefficients that were measured."""
    seconds = []
    for kind, work, case in zip(KINDS, (of_blocks, of_coupling), pair, strict=True):
        each = settings["costs"]["nanoseconds"][kind]
        amounts = work(case.parameters)
        seconds.append(sum(amount * each.get(term, 0.0) for term, amount in amounts.items()))
    return seconds[0] / seconds[1] if seconds[1] > 0.0 else math.nan
