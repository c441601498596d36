"""One item on the page: its figure, the texts about it, its facts."""

import functools
import json

import numpy as np

from kacsim.report import svg
from kacsim.report.numbers import measured, number, pm
from kacsim.report.texts import read_text

MARKS = ".marks.json"  # beside a figure: the numbers behind its marks


def item(render, name, dataset, texts, figure, shared):
    """Return what the page shows of one item: rendered texts, figure and facts."""
    s, known = dataset.attrs["settings"], dataset.attrs["published"]
    words = {"s": s, "d": dataset, "published": known}
    words["measured"] = functools.partial(measured, dataset)
    parts = {key: render(text, **words) for key, text in texts.items()}
    alt = " ".join(parts["alt"].striptags().split())
    drawn, box = svg.inline(read_text(figure), figure, name, f"{parts['label']}. {alt}", shared)
    own = {"name": name, "svg": drawn, "box": box, "settings": s, "tvn": tvn_table(dataset)}
    _, _, width, height = box.split()
    own["size"] = f"--width:{width};aspect-ratio:{width}/{height}"
    own |= _marks(figure)
    if "engine" not in parts:
        own["engine"] = s["engine"]
    if "draws" not in parts:
        many = f"{number(s['n_replicates'])} replicates of " if s["n_replicates"] > 1 else ""
        own["draws"] = f"{many}{number(s['n_draws'])} draws"
    return parts | own


def tvn_table(dataset):
    """Return the mean TVN at every bin width and place, None if the item has none."""
    if "tvn" not in dataset or "bin_width" not in dataset.tvn.dims:
        return None
    dataset = dataset.sortby("bin_width")
    *dims, _ = dataset.tvn.dims
    rows = []
    for place in np.ndindex(dataset.tvn.shape[:-1]):
        heads = [dataset[dim].values[k] for dim, k in zip(dims, place, strict=True)]
        heads = [h.replace("_", " ") if isinstance(h, str) else number(h) for h in heads]
        values, errors = dataset.tvn.values[place], dataset.tvn_error.values[place]
        rows.append((heads, [pm(v, e) for v, e in zip(values, errors, strict=True)]))
    return {
        "dims": [dim.replace("n_particles", "N").replace("_", " ") for dim in dims],
        "widths": [number(width) for width in dataset.bin_width.values],
        "rows": rows,
        "floor": [number(value, 3) for value in dataset.floor.values],
    }


def _marks(figure):
    """Return the numbers behind a figure's marks, None without, and the names of its curves."""
    path = figure.with_suffix(MARKS)
    if not path.exists():
        return {"marks": None, "curves": []}
    found = json.loads(read_text(path))
    series = [one for axes in found["axes"] for one in axes["series"]]
    names = dict.fromkeys(one["label"] for one in series if one["label"])
    return {"marks": found if series else None, "curves": list(names) if len(names) > 1 else []}
