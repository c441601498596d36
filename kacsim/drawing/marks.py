"""What a figure shows, as numbers: the values behind its marks, for a page that tells them.

Read off matplotlib's own artists, so that a figure need not say anything twice.
"""

import json
import math
from pathlib import Path

import numpy as np

from kacsim.drawing import origins, series
from kacsim.files import replace_file

DIGITS = 6
MOST = 1500  # values of one series
SHOWN = ("rectilinear", "3d")  # kinds of axes


def named(figure):
    """Give ids to what a figure draws; return list of (axes, list of series) with the ids.

    Parameters
    ----------
    figure : matplotlib Figure

    Returns
    -------
    list of (Axes, list of dict with id, label, kind (points, curve or bars), x, y, and error or low
    and high where there are bars); of bars x are their edges; in space also z, and left and bottom
    in pixels
    """
    found, number = [], 0
    for axes in figure.axes:
        if axes.name not in SHOWN or not axes.get_visible():
            continue
        own = []
        for artists, one in series.of_panel(axes):
            for k, artist in enumerate(artists):
                artist.set_gid(f"mark-{number}-{k}" if k else f"mark-{number}")
            own.append({"id": f"mark-{number}"} | one)
            number += 1
        if own:
            found.append((axes, own))
    return found


def table(figure, dataset, cases):
    """Return all of it as JSON-ready values, with where each of the axes lies on the figure.

    Parameters
    ----------
    figure : matplotlib Figure, laid out
    dataset : xarray.Dataset, what it was drawn from
    cases : list of (title, settings) of its item's cases

    Returns
    -------
    dict: size (width and height in points), cases (titles of those that marks come from) and axes,
    each a dict of box (left, top, width and height in points), x and y (scale, first and last
    value), labels and series as of `named`, in space with left and top in points; case is a place
    among the cases, the same for all marks or one for each (None where it is not known)
    """
    width, height = (72.0 * float(inches) for inches in figure.get_size_inches())
    unit = 72.0 / figure.dpi
    axes, places = [], {}
    for one, shown in named(figure):
        box = one.get_window_extent()
        place = [box.x0 * unit, height - box.y1 * unit, box.width * unit, box.height * unit]
        listed = []
        for values in shown:
            if "left" in values:
                top = height - values.pop("bottom") * unit
                values |= {"left": values["left"] * unit, "top": top}
            case = origins.of_series(values, dataset, cases)
            case = [k if k is None else places.setdefault(k, len(places)) for k in case]
            listed.append(_short(values) | _once(case))
        names = [getattr(one, f"{letter}axis", None) for letter in "xyz"]
        axes.append(
            {
                "box": [round(value, 2) for value in place],
                "x": _scale(one.get_xscale(), one.get_xlim()),
                "y": _scale(one.get_yscale(), one.get_ylim()),
                "labels": [series.plain(name.get_label_text()) for name in names if name],
                "series": listed,
            }
        )
    titles = [cases[k][0] for k in places]
    return {"size": [round(width, 2), round(height, 2)], "cases": titles, "axes": axes}


def write(figure, path, dataset, cases):
    """Write the numbers behind a figure that has been drawn, as JSON: those of `table`."""
    text = json.dumps(table(figure, dataset, cases), ensure_ascii=False, separators=(",", ":"))
    replace_file(path, lambda name: Path(name).write_text(text, encoding="utf-8"))


def _scale(name, limits):
    return {"scale": name, "from": float(limits[0]), "to": float(limits[1])}


def _once(case):
    """Return the case of a series said as shortly as possible; nothing where none is known."""
    if set(case) <= {None}:
        return {}
    return {"case": case[0] if len(set(case)) == 1 else case}


def _short(values):
    """Return a series with few digits; equal steps of x by their ends, long curves thinned."""
    arrays = {key: value for key, value in values.items() if isinstance(value, np.ndarray)}
    words = {key: value for key, value in values.items() if key not in arrays}
    if values["kind"] == "curve" and len(values["x"]) > MOST:
        stride = math.ceil(len(values["x"]) / MOST)
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
