"""What the tables of numbers and claims share: gathering, judging and drawing findings."""

import textwrap

from kacsim import items
from kacsim.items._lazy import np, plotting, store, verdict, xr

TEXT_COLUMNS = ("claim", "text", "kind", "verdict", "evidence")
NUMBER_COLUMNS = {
    "reference": "published or printed value",
    "measured": "measured value",
    "standard_error": "standard error of the measured value",
    "published_error": "standard error of the published value",
    "corrected": "corrected value",
    "z": "(measured - reference) / error",
    "p_value": "p-value",
    "adjusted_p_value": "p-value adjusted by Holm",
}


def cases(uses, settings):
    """Return the cases of all items that claims are about."""
    return [case for name in uses for case in items.load(name).cases(settings["items"][name])]


def findings(uses, samples, settings):
    """Return what those items found."""
    found = []
    for name in uses:
        dataset = items.reduced(name, samples, settings["items"][name])
        found += items.load(name).claims(dataset)
    return found


def reduce(name, uses, samples, settings):
    """Return the table of an item that has no findings but those of the items that it uses."""
    return table((name, *uses), findings(uses, samples, settings))


def table(names, found):
    """Return one row per finding with its statistic and verdict, judged as one family.

    Parameters
    ----------
    names : items that the findings are of
    found : list of Finding

    Raises
    ------
    ValueError
        Names a finding whose published entry is another item's: its edits would go unseen here.
    """
    published = items.published_of(names)
    for finding in found:
        if finding.claim not in published:
            raise ValueError(
                f"claim = {finding.claim!r}: reports/published.yaml has no such entry "
                f"of {' or '.join(names)}"
            )
    rows = verdict.judge(found, published)
    columns = {key: [] for key in (*TEXT_COLUMNS, *NUMBER_COLUMNS)}
    own = ("claim", "evidence", "measured", "standard_error", "published_error", "corrected")
    for finding, row in zip(found, rows, strict=True):
        for key in own:
            columns[key].append(getattr(finding, key))
        for key in ("kind", "verdict", "z", "p_value", "adjusted_p_value"):
            columns[key].append(row[key])
        columns["text"].append(published[finding.claim]["text"])
        columns["reference"].append(verdict.reference(finding, published[finding.claim]))
    described, dims = store.described, ("row",)
    variables = {
        key: described(np.array(columns[key], dtype=float), dims, text)
        for key, text in NUMBER_COLUMNS.items()
    }
    variables |= {
        key: described(np.array(columns[key], dtype=object), dims, key) for key in TEXT_COLUMNS
    }
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
