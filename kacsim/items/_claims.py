"""What the tables of claims share: gathering findings, judging them, drawing every row."""

import textwrap

from kacsim import items
from kacsim.items._lazy import np, plotting, store, verdict, xr

ROW_TEXTS = ("claim", "text", "kind", "rule", "verdict", "evidence")
PART_TEXTS = {"of": "claim", "label": "component", "law": "law of the interval", "part_verdict": ""}
NUMBERS = {
    "measured": "measured value",
    "standard_error": "standard error of the measured value",
    "low": "lower end of the interval",
    "high": "upper end of the interval",
    "allowed_low": "lower end of the set that the text allows",
    "allowed_high": "upper end of the set that the text allows",
    "right_low": "lower end of the right formula's set",
    "right_high": "upper end of the right formula's set",
    "seen": "smallest departure from the set that this run sees in 95 of 100",
    "pull": "(measured - value that stands) / standard error",
    "near": "1 if within a tenth of the set's width of its edge",
}
BANDS = {
    ("two-sided", "interval"): "intervals",
    ("one-sided", "interval"): "intervals, one-sided sets",
    ("two-sided", "exact"): "exact values",
    ("one-sided", "exact"): "exact values, one-sided sets",
}
REACH = 4.0  # of a two-sided band, in half widths of the set; twice as far in a one-sided band


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
    """Return one row per finding with its verdict, and one part per component of each row.

    The chance of an error is shared by all intervals of the text. Entries that cannot be tested
    get a row without a finding.

    Parameters
    ----------
    names : items that the findings are of
    found : list of Finding

    Raises
    ------
    ValueError
        Names a finding whose published entry is another item's (its edits would go unseen here),
        an entry of these items that nothing was found on, or one that more than one finding is on
        (of an untestable entry the table makes one itself).
    """
    published = items.published_of(names)
    found = [*found, *_untestable(published)]
    known = [one.claim for one in found]
    for claim in known:
        if claim not in published:
            raise ValueError(
                f"claim = {claim!r}: reports/published has no such entry of {' or '.join(names)}"
            )
        if known.count(claim) > 1:
            raise ValueError(f"claim = {claim!r}: {known.count(claim)} findings are on it")
    own_entries = (key for key, entry in published.items() if entry["item"] in names)
    for claim in own_entries:
        if claim not in known:
            raise ValueError(f"claim = {claim!r}: {published[claim]['item']} finds nothing on it")
    many = verdict.n_intervals(found)
    rows, parts = [], []
    for one in found:
        entry = published[one.claim]
        word, judged = verdict.judge(one, entry, verdict.FAMILY_ERROR / max(1, many))
        own = {key: entry[key] for key in ("text", "kind", "rule")}
        rows.append(own | {"claim": one.claim, "verdict": word, "evidence": one.evidence})
        parts += [_part(one, *pair) for pair in zip(one.parts, judged, strict=bool(judged))]
    described = store.described
    variables = {
        key: described(np.array([row[key] for row in rows], dtype=object), ("row",), key)
        for key in ROW_TEXTS
    }
    for key, text in PART_TEXTS.items():
        values = np.array([part[key] for part in parts], dtype=object)
        variables[key] = described(values, ("part",), text or key.replace("_", " "))
    for key, text in NUMBERS.items():
        variables[key] = described(np.array([p[key] for p in parts], float), ("part",), text)
    shared = "intervals that share the chance of an error"
    variables["n_intervals"] = described(many, (), shared)
    return xr.Dataset(variables, attrs={"family_error": verdict.FAMILY_ERROR})


def _untestable(published):
    """Return a finding without parts for every entry that cannot be tested."""
    return [
        verdict.Finding(key, ())
        for key, entry in published.items()
        if entry["rule"] == "untestable"
    ]


def _part(found, part, judged):
    """Return what the table shows of one component."""
    right = judged["correction"] or (np.nan, np.nan)
    return {
        "of": found.claim,
        "label": part.label,
        "law": part.measured.law,
        "part_verdict": judged["verdict"],
        "measured": part.measured.value,
        "standard_error": part.measured.standard_error,
        "low": judged["low"],
        "high": judged["high"],
        "allowed_low": judged["allowed"][0],
        "allowed_high": judged["allowed"][1],
        "right_low": right[0],
        "right_high": right[1],
        "seen": judged["seen"],
        "pull": judged["pull"],
        "near": judged["near"],
    }


# The figure: every row in units of what its text allows


def joined(tables):
    """Return several tables as one: rows and components of one text after another's."""
    columns = [xr.Dataset({name: v for name, v in one.items() if v.dims}) for one in tables]
    rows, parts = (
        xr.concat([one[[n for n in one if one[n].dims == (dim,)]] for one in columns], dim)
        for dim in ("row", "part")
    )
    return xr.merge([rows, parts])


def draw(dataset, row_height=0.34, *, words=True):
    """Draw the interval of every row in units of its set, a band per kind of set, and the pulls.

    Parameters
    ----------
    dataset : a table
    row_height : inch
    words : whether rows have their texts beside them
    """
    bands = _bands(dataset)
    heights = [0.5 + row_height * len(rows) for rows in bands.values()]
    figure, axes = plotting.stack([*heights, 2.4], width=9.0)
    for axis, (band, rows) in zip(axes, bands.items(), strict=False):
        _band(axis, dataset, band, rows, 4.0 if words else 2.0, linked=not words)
        if words:
            texts = [textwrap.fill(str(dataset.text.values[k]), 74) for k in rows]
            axis.set_yticks(range(len(rows)), texts)
            axis.tick_params(axis="y", labelsize=6.5)
            axis.grid(axis="y", color="0.92", zorder=0)
        else:
            axis.set_yticks([])
    _pulls(axes[-1], dataset)
    there = [word for word in verdict.VERDICTS if word in dataset.part_verdict.values]
    handles = [_mark(axes[0], [], [], word, 4.0) for word in there]
    figure.legend(handles=handles, loc="outside upper center", ncols=5, frameon=False)
    return figure


def _bands(dataset):
    """Return band -> places of its rows; rows without a component are in none."""
    found = {band: [] for band in BANDS}
    for k, (claim, rule) in enumerate(zip(dataset.claim.values, dataset.rule.values, strict=True)):
        laws = dataset.law.values[dataset.of.values == claim]
        if laws.size:
            side = "one-sided" if rule == "direction" else "two-sided"
            found[side, "exact" if (laws == "exact").all() else "interval"].append(k)
    return {band: rows for band, rows in found.items() if rows}


def in_units(part):
    """Return (measured, low, high) of a component in units of its set.

    Half the width of the set from its middle, so that the set is from -1 to 1, or as it is if the
    set is a single value; for a set without an upper end multiples of its lower one, so that it
    starts at 1.
    """
    values = np.array([float(part[key]) for key in ("measured", "low", "high")])
    low, high = float(part.allowed_low), float(part.allowed_high)
    if np.isinf(high):
        return values / low
    return (values - (low + high) / 2.0) / ((high - low) / 2.0 or 1.0)


def _band(axis, dataset, band, rows, size, linked):
    one_sided = band[0] == "one-sided"
    ends = (-REACH, 2.0 * REACH) if one_sided else (-REACH, REACH)
    axis.axvspan(*((1.0, ends[1]) if one_sided else (-1.0, 1.0)), color="0.93", lw=0, zorder=0)
    for place, k in enumerate(rows):
        parts = np.flatnonzero(dataset.of.values == dataset.claim.values[k])
        shifts = np.linspace(-0.3, 0.3, parts.size) if parts.size > 1 else [0.0]
        for shift, p in zip(shifts, parts, strict=True):
            part = dataset.isel(part=p)
            value, low, high = np.clip(in_units(part), *ends)
            word = str(part.part_verdict.values)
            axis.plot([low, high], [place + shift] * 2, color=_style(word)[0], lw=0.3 * size)
            mark = _mark(axis, [value], [place + shift], word, size)
            if linked:
                mark.set_url(f"#claim-{dataset.claim.values[k]}")
    axis.set_ylim(len(rows) - 0.4, -0.6)
    axis.set_xlim(*(1.03 * end for end in ends))
    unit = "its lower end" if one_sided else "half its width, from its middle"
    what = f"{BANDS[band]}, in units of the set that the text allows ({unit})"
    axis.set_xlabel(what, fontsize=8)


def _style(word):
    k = verdict.VERDICTS.index(word)
    return plotting.COLOURS[(2, 0, 1, 3, 4)[k]], plotting.MARKERS[k]


def _mark(axis, x, y, word, size):
    colour, marker = _style(word)
    (handle,) = axis.plot(x, y, marker, color=colour, ls="", ms=size, label=word)
    return handle


def _pulls(axis, dataset):
    """Draw the histogram of all pulls with the normal law that they should have."""
    pulls = dataset.pull.values[np.isfinite(dataset.pull.values)]
    edges = np.linspace(-5.0, 5.0, 21)
    axis.hist(np.clip(pulls, *edges[[0, -1]]), edges, color=plotting.COLOURS[0], alpha=0.6)
    grid = np.linspace(-5.0, 5.0, 200)
    bell = np.exp(-(grid**2) / 2.0) / np.sqrt(2.0 * np.pi)
    axis.plot(grid, pulls.size * np.diff(edges)[0] * bell, color="black", lw=1)
    axis.set_xlabel(
        f"pull of {pulls.size} components whose value is known: (measured $-$ value) / error"
    )
    axis.set_ylabel("components")
