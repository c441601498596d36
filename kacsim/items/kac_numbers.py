"""Every number and every checkable claim of the Kac paper: published, measured, verdict."""

import textwrap

from kacsim import items
from kacsim.items._lazy import np, plotting, store, verdict, xr

USES = (
    "kac_fig1",
    "kac_fig2",
    "kac_fig3",
    "kac_fig5",
    "kac_fig6",
    "kac_fig9",
    "kac_bias",
    "kac_tails",
)
TEXTS = ("claim", "text", "kind", "verdict", "evidence")
NUMBERS = {
    "reference": "published or printed value",
    "measured": "measured value",
    "standard_error": "standard error of the measured value",
    "published_error": "standard error of the published value",
    "corrected": "corrected value",
    "z": "(measured - reference) / error",
    "p_value": "p-value",
    "adjusted_p_value": "p-value adjusted by Holm",
}


def cases(settings):
    """Return the cases of all items that the claims are about."""
    found = []
    for name in USES:
        found += items.load(name).cases(settings["items"][name])
    return found


def reduce(samples, settings):
    """Return one row per claim with its statistic and verdict."""
    published = items.published()
    findings = []
    for name in USES:
        dataset = items.reduced(name, samples, settings["items"][name])
        findings += items.load(name).claims(dataset)
    rows = verdict.judge(findings, published)
    table = {key: [] for key in (*TEXTS, *NUMBERS)}
    for finding, row in zip(findings, rows, strict=True):
        for key in (
            "claim",
            "evidence",
            "measured",
            "standard_error",
            "published_error",
            "corrected",
        ):
            table[key].append(getattr(finding, key))
        for key in ("kind", "verdict", "z", "p_value", "adjusted_p_value"):
            table[key].append(row[key])
        table["text"].append(published[finding.claim]["text"])
        table["reference"].append(verdict.reference(finding, published[finding.claim]))
    described, dims = store.described, ("row",)
    variables = {
        key: described(np.array(table[key], dtype=float), dims, text)
        for key, text in NUMBERS.items()
    }
    variables |= {key: described(np.array(table[key], dtype=object), dims, key) for key in TEXTS}
    return xr.Dataset(variables, attrs={"family_error": verdict.FAMILY_ERROR})


def draw(dataset):
    """Draw the statistic of every claim, symbols by verdict."""
    figure, (axis,) = plotting.panels(1, 1, width=8.0, height=0.22 * dataset.sizes["row"] + 1)
    limit = 30.0
    row = np.arange(dataset.sizes["row"])
    z = np.clip(np.nan_to_num(dataset.z.values, posinf=limit, neginf=-limit), -limit, limit)
    for k, name in enumerate(
        (verdict.REPRODUCED, verdict.CORRECTED, verdict.NOT_REPRODUCED, verdict.UNDECIDED)
    ):
        here = dataset.verdict.values == name
        colour, marker = plotting.COLOURS[(2, 0, 1, 3)[k]], plotting.MARKERS[k]
        axis.plot(z[here], row[here], marker, color=colour, ls="", label=name)
    axis.axvline(0, color="0.7", lw=0.8, zorder=0)
    axis.grid(axis="y", color="0.92", zorder=0)
    axis.set_yticks(row, [textwrap.shorten(str(text), 62) for text in dataset.text.values])
    axis.tick_params(axis="y", labelsize=7)
    axis.invert_yaxis()
    axis.set_xlim(-limit - 1, limit + 1)
    axis.set_xlabel(f"z = (measured $-$ published) / error, cut at $\\pm${limit:g}")
    figure.legend(loc="outside upper center", ncols=4, frameon=False)
    return figure
