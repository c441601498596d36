"""What the artists of a panel show, as series of numbers, and labels without TeX."""

import re

import numpy as np
from matplotlib.container import BarContainer, ErrorbarContainer
from matplotlib.patches import StepPatch
from mpl_toolkits.mplot3d import proj3d

GREEK = {
    r"\lambda": "λ", r"\Delta ": "Δ", r"\varepsilon": "ε", r"\epsilon": "ε", r"\theta": "θ",
    r"\pi": "π", r"\omega": "ω", r"\infty": "∞", r"\to": "→", r"\times": "×", r"\nu": "ν",
    r"\tau": "τ", r"\eta": "η", r"\alpha": "α", r"\beta": "β", r"\kappa": "κ", r"\sigma": "σ",
    r"\rho": "ρ", r"\langle": "⟨", r"\rangle": "⟩", r"\,": " ", r"\cdot": "·", r"\leq": "≤",
    r"\geq": "≥", r"\phi": "φ", r"\mu": "μ", r"\gamma": "γ", r"\xi": "ξ", r"\hat": "",
    r"\mathrm": "", r"\sqrt": "√", r"\pm": "±", r"\approx": "≈", r"\prime": "′",
}  # fmt: skip
UP, DOWN = (
    str.maketrans("0123456789-+nk", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺ⁿᵏ"),
    str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"),
)


def of_panel(axes):
    """Yield (artists, what they show) of one panel, flat or in space."""
    return _in_space(axes) if axes.name == "3d" else _flat(axes)


def plain(text):
    """Return a label without TeX."""
    for word, sign in sorted(GREEK.items(), key=lambda pair: -len(pair[0])):
        text = text.replace(word, sign)
    text = re.sub(r"\^\{?([-+0-9nk]+)\}?", lambda found: found[1].translate(UP), text)
    text = re.sub(r"_\{?([0-9]+)\}?", lambda found: found[1].translate(DOWN), text)
    return " ".join(re.sub(r"[${}\\]", "", text).split())


def _flat(axes):
    """Yield what has a place on both axes, as bars, points or curves."""
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
            yield (line,), _values(_kind(line), line.get_label(), *line.get_data(orig=False))
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


def _in_space(axes):
    """Yield the named points and lines of a panel in space, with where they lie in pixels."""
    for line in axes.lines:
        if not line.get_label().startswith("_"):
            x, y, z = (np.asarray(values, float) for values in line.get_data_3d())
            flat = np.stack(proj3d.proj_transform(x, y, z, axes.get_proj())[:2], axis=1)
            left, bottom = axes.transData.transform(flat).T
            own = _values(_kind(line), line.get_label(), x, y)
            yield (line,), own | {"z": z, "left": left, "bottom": bottom}


def _kind(line):
    return "points" if line.get_linestyle() in ("None", "none", "", " ") else "curve"
