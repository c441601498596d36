"""The findings that come first: sentences with numbers of the run, ranked by a stated rule."""

import math

import yaml
from markupsafe import Markup
from scipy import special

from kacsim.report.numbers import number, pm

MANY = 10
WEIGHTS = ("conclusion", "number", "formula", "beyond")
RANKED = (
    "First what a text concludes, then the numbers that it prints, then its formulas; among alike "
    "the larger departure first, which is the distance from interval to set over the set’s nearer "
    "edge. A sentence stands here only while its row has the verdict that it tells."
)
WIDTH, HEIGHT, PAD = 150.0, 26.0, 6.0


def shown(text, claims, raw, settings, entries, render):
    """Return the findings to show, the first first: dicts of sentence, claim, verdict, picture.

    Parameters
    ----------
    text : of reports/findings.yaml
    claims : claim id -> row as of `kacsim.report.verdicts.rows`
    raw : claim id -> list of the row's components, dicts of numbers as the datasets hold them
    settings : item -> its settings
    entries : claim id -> entry of reports/published/
    render : callable(template, **words) -> Markup
    """
    found = []
    for entry in yaml.safe_load(text):
        row = claims.get(entry["claim"])
        if row is None or row["verdict"] != entry["verdict"]:
            continue
        part = deciding(raw[entry["claim"]], entry["verdict"])
        label, own = row["shown"]["label"], entries[entry["claim"]]
        words = {"where": f" ({label})" if label else "", "s": settings[row["item"]]}
        words |= {"value": value(part), "interval": row["shown"]["interval"]}
        words["printed"] = own.get("printed", "")
        words |= {"allowed": allowed(part), "allowed_set": row["shown"]["allowed"].split(": ")[-1]}
        words["right"] = row["shown"]["right"]
        about = {"claim": entry["claim"], "verdict": row["verdict"], "item": row["item"]}
        rank = WEIGHTS.index(entry["weight"]), -departure(part)
        about |= {"sentence": render(entry["sentence"], **words), "picture": picture(part)}
        found.append((rank, len(found), about))
    return [about for *_, about in sorted(found, key=lambda one: one[:2])][:MANY]


def narrowed(raw, settings, intervals):
    """Return the rows whose interval the page's own draws can narrow, by the mean of v_1**4.

    Parameters
    ----------
    raw, settings : as of `shown`
    intervals : text -> (its intervals, the chance that they share), as on the page

    Returns
    -------
    list of dict: problem, given, claim, the set's low and high, deviations of the interval's half
    """
    if "kac_51_perfect" not in raw:
        return []
    (part,), own = raw["kac_51_perfect"], settings["kac_forward"]
    many, error = intervals["kac"]
    given = {"n_particles": own["n_particles"], "tolerance": own["tolerance"]}
    return [
        {
            "problem": "perfect",
            "given": given,
            "claim": "kac_51_perfect",
            "low": part["allowed_low"],
            "high": part["allowed_high"],
            "deviations": -float(special.ndtri(0.5 * error / many)),
        }
    ]


def deciding(parts, verdict):
    """Return the component that has the row's verdict, as the tables show it."""
    return next(part for part in parts if part["part_verdict"] == verdict)


def value(part):
    """Return what was measured, with its standard error, as text."""
    if part["law"] == "exact":
        return number(part["measured"])
    if part["standard_error"] > 0.0:
        return pm(part["measured"], part["standard_error"])
    return f"{number(part['measured'], 3)} ({number(part['low'], 3)} to {number(part['high'], 3)})"


def allowed(part):
    """Return the middle of the set that the text allows, or its end, as text."""
    low, high = part["allowed_low"], part["allowed_high"]
    return number(low, 3) if math.isinf(high) else number(0.5 * (low + high), 4)


def departure(part):
    """Return how far the interval lies from the set, over the set's nearer edge."""
    if part["high"] < part["allowed_low"]:
        gap, edge = part["allowed_low"] - part["high"], part["allowed_low"]
    else:
        gap, edge = max(0.0, part["low"] - part["allowed_high"]), part["allowed_high"]
    return gap / abs(edge) if edge else math.inf


def picture(part):
    """Return the set, the interval and the right value of a component on one line, as SVG."""
    ends = [part["low"], part["high"], part["allowed_low"]]
    ends += [one for one in (part["allowed_high"], part["right_low"]) if math.isfinite(one)]
    low, high = min(ends), max(ends)
    room = 0.08 * (high - low) or 1.0
    low, high = low - room, high + room

    def place(x):
        inside = min(max(x, low), high)
        return PAD + (inside - low) / (high - low) * (WIDTH - 2 * PAD)

    left = place(part["allowed_low"])
    wide = max(2.0, place(min(part["allowed_high"], high)) - left)
    from_, to = place(part["low"]), place(part["high"])
    middle = HEIGHT / 2
    marks = [
        f'<rect class="set" x="{left:.1f}" y="4" width="{wide:.1f}" height="18"/>',
        f'<path class="interval" d="M{from_:.1f} {middle}H{max(to, from_ + 1.5):.1f}"/>',
        f'<circle class="value" cx="{place(part["measured"]):.1f}" cy="{middle}" r="3"/>',
    ]
    label = f"Measured {value(part)}; the text allows {number(part['allowed_low'], 3)}"
    if math.isfinite(part["allowed_high"]):
        label += f" to {number(part['allowed_high'], 3)}"
    size = f'viewBox="0 0 {WIDTH:g} {HEIGHT:g}" width="{WIDTH:g}" height="{HEIGHT:g}"'
    return Markup(
        f'<svg class="spark" {size} role="img" aria-label="{label}">{"".join(marks)}</svg>'
    )
