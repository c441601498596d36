"""What a figure shows, as numbers: the values behind its marks, for a page that tells them.

Read off matplotlib's own artists, so that a figure need not say anything twice.
"""

import json
import math
import re
from pathlib import Path

import numpy as np
from matplotlib.container import BarContainer, ErrorbarContainer
from matplotlib.patches import StepPatch

from kacsim.files import replace_file

DIGITS = 6
MOST = 1500  # values of one series
GREEK = {
    r"\lambda": "λ", r"\Delta": "Δ", r"\varepsilon": "ε", r"\epsilon": "ε", r"\theta": "θ",
    r"\pi": "π", r"\omega": "ω", r"\infty": "∞", r"\to": "→", r"\times": "×", r"\nu": "ν",
    r"\tau": "τ", r"\eta": "η", r"\alpha": "α", r"\beta": "β", r"\kappa": "κ", r"\sigma": "σ",
    r"\rho": "ρ", r"\langle": "⟨", r"\rangle": "⟩", r"\,": " ", r"\cdot": "·", r"\leq": "≤",
    r"\geq": "≥", r"\phi": "φ", r"\mu": "μ", r"\gamma": "γ", r"\xi": "ξ", r"\hat": "",
    r"\mathrm": "", r"\sqrt": "√", r"\pm": "±", r"\approx": "≈", r"\prime": "′",
}  # fmt: skip
UP, DOWN = (
    str.maketrans("0123456789-+n", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺ⁿ"),
    str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"),
)


def named(figure):
    """Give ids to what a figure draws; return list of (axes, list of series) with the ids.

    Parameters
    ----------
    figure : matplotlib Figure

    Returns
    -------
    list of (Axes, list of dict with id, label, kind (points, curve or bars), x, y, and error or low
    and high where there are bars); of bars x are their edges
    """
    found, number = [], 0
    for axes in figure.axes:
        if axes.name != "rectilinear" or not axes.get_visible():
            continue
        own = []
        for artists, one in _series(axes):
            for k, artist in enumerate(artists):
                artist.set_gid(f"mark-{number}-{k}" if k else f"mark-{number}")
            own.append({"id": f"mark-{number}"} | one)
            number += 1
        if own:
            found.append((axes, own))
    return found


def table(figure):
    """Return all of it as JSON-ready values, with where each of the axes lies on the figure.

    Returns
    -------
    dict: size (width and height in points) and axes, each a dict of box (left, top, width and
    height in points), x and y (scale, first and last value), labels and series as of `named`
    """
    width, height = (72.0 * float(inches) for inches in figure.get_size_inches())
    unit = 72.0 / figure.dpi
    axes = []
    for one, series in named(figure):
        box = one.get_window_extent()
        place = [box.x0 * unit, height - box.y1 * unit, box.width * unit, box.height * unit]
        axes.append(
            {
                "box": [round(value, 2) for value in place],
                "x": _scale(one.get_xscale(), one.get_xlim()),
                "y": _scale(one.get_yscale(), one.get_ylim()),
                "labels": [plain(one.get_xlabel()), plain(one.get_ylabel())],
                "series": [_short(values) for values in series],
            }
        )
    return {"size": [round(width, 2), round(height, 2)], "axes": axes}


def write(figure, path):
    """Write the numbers behind a figure that has been drawn, as JSON."""
    text = json.dumps(table(figure), ensure_ascii=False, separators=(",", ":"))
    replace_file(path, lambda name: Path(name).write_text(text, encoding="utf-8"))


def plain(text):
    """Return a label without TeX."""
    for word, sign in sorted(GREEK.items(), key=lambda pair: -len(pair[0])):
        text = text.replace(word, sign)
    text = re.sub(r"\^\{?([-+0-9n]+)\}?", lambda found: found[1].translate(UP), text)
    text = re.sub(r"_\{?([0-9]+)\}?", lambda found: found[1].translate(DOWN), text)
    return " ".join(re.sub(r"[${}\\]", "", text).split())


def _scale(name, limits):
    return {"scale": name, "from": float(limits[0]), "to": float(limits[1])}


def _series(axes):
    """Yield (artists, what they show) of one panel."""
    taken = set()
    for container in axes.containers:
        if isinstance(container, ErrorbarContainer):
            line, caps, bars = container.lines
            taken |= {line, *caps, *bars}
            if line is not None:
                yield (line, *bars), _with_bars(line, bars, container.get_label())
        elif isinstance(container, BarContainer):
            taken |= set(container.patches)
            edges = [(one.get_x(), one.get_x() + one.get_width()) for one in container.patches]
            heights = [one.get_height() for one in container.patches]
            middle = [0.5 * (left + right) for left, right in edges]
            yield container.patches, _values("points", container.get_label(), middle, heights)
    for line in axes.lines:
        if line not in taken and line.get_transform() == axes.transData:
            kind = "points" if line.get_linestyle() in ("None", "none", "", " ") else "curve"
            yield (line,), _values(kind, line.get_label(), *line.get_data(orig=False))
    for patch in axes.patches:
        if isinstance(patch, StepPatch) and patch not in taken and not patch.get_fill():
            data = patch.get_data()
            yield (patch,), _values("bars", patch.get_label(), data.edges, data.values)


def _values(kind, label, x, y):
    text = "" if label is None or str(label).startswith("_") else plain(str(label))
    return {"label": text, "kind": kind, "x": np.asarray(x, float), "y": np.asarray(y, float)}


def _with_bars(line, bars, label):
    """Return points with the ends of their upright bars; a point without a value has none."""
    found = _values("points", label, *line.get_data(orig=False))
    low, high = np.full((2, found["x"].size), np.nan)
    for collection in bars:
        for ends in collection.get_segments():
            if len(ends) == 2 and ends[0, 0] == ends[1, 0]:
                bottom, top = sorted(ends[:, 1])
                here = (found["x"] == ends[0, 0]) & (bottom <= found["y"]) & (found["y"] <= top)
                free = np.flatnonzero(here & np.isnan(low))
                low[free[:1]], high[free[:1]] = bottom, top
    if np.isnan(low).all():
        return found
    below, above = found["y"] - low, high - found["y"]
    if np.allclose(below, above, rtol=1e-6, atol=0.0, equal_nan=True):
        return found | {"error": 0.5 * (below + above)}
    return found | {"low": low, "high": high}


def _short(series):
    """Return a series with few digits; equal steps of x by their ends, long curves thinned."""
    arrays = {key: value for key, value in series.items() if isinstance(value, np.ndarray)}
    words = {key: value for key, value in series.items() if key not in arrays}
    if series["kind"] == "curve" and len(series["x"]) > MOST:
        stride = math.ceil(len(series["x"]) / MOST)
        arrays = {key: value[::stride] for key, value in arrays.items()}
    listed = {key: [_rounded(one) for one in value] for key, value in arrays.items()}
    x = arrays["x"]
    if len(x) > 8 and np.allclose(np.diff(x), (x[-1] - x[0]) / (len(x) - 1), rtol=1e-6, atol=0.0):
        listed["x"] = {"from": _rounded(x[0], 12), "to": _rounded(x[-1], 12), "many": len(x)}
    return words | listed


def _rounded(value, digits=DIGITS):
    if not math.isfinite(value):
        return None
    found = float(f"{value:.{digits}g}")
    return int(found) if found.is_integer() and abs(found) < 1e15 else found
