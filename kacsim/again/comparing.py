"""Two files of one kind, compared without what says how they were made."""

from pathlib import Path

import numpy as np

from kacsim import store
from kacsim.recipes import carriers
from kacsim.report.page import without_files

PROVENANCE = ("source", "code", "checksum")


def differences(first, second):
    """Return a line for each part of the content that differs; none if the bits are the same."""
    first, second = Path(first), Path(second)
    if first.suffix == ".nc":
        return _of_datasets(store.read(first), store.read(second))
    if first.suffix == ".html":
        pages = (_plain(path.read_text(encoding="utf-8")) for path in (first, second))
        return _of_bytes(*(page.encode() for page in pages))
    return _of_bytes(first.read_bytes(), second.read_bytes())


def _plain(page):
    return carriers.without_sources(without_files(page))


def _of_bytes(first, second):
    if first == second:
        return []
    size = min(len(first), len(second))
    equal = np.frombuffer(first, np.uint8, size) == np.frombuffer(second, np.uint8, size)
    place = size if equal.all() else int(np.argmin(equal))
    return [f"bits: {len(first)} bytes there, {len(second)} here, the first other one at {place}"]


def _of_datasets(first, second):
    """Return a line for each variable or attribute of a dataset that differs."""
    found = [
        f"bits: other attribute {key}"
        for key in sorted(first.attrs.keys() | second.attrs.keys())
        if key not in PROVENANCE and first.attrs.get(key) != second.attrs.get(key)
    ]
    for name in sorted(first.variables.keys() | second.variables.keys()):
        if name not in first.variables or name not in second.variables:
            where = "here" if name in first.variables else "there"
            found.append(f"bits: no variable {name} {where}")
        elif not _same(first[name].variable, second[name].variable):
            found.append(f"bits: other {name}{_by(first[name].values, second[name].values)}")
    return found


def _same(one, other):
    values = [np.asarray(v.values) for v in (one, other)]
    kinds = [(v.dims, v.attrs, a.dtype, a.shape) for v, a in zip((one, other), values, strict=True)]
    if kinds[0] != kinds[1]:
        return False
    if values[0].dtype.kind in "OU":
        return values[0].tolist() == values[1].tolist()
    return values[0].tobytes() == values[1].tobytes()


def _by(first, second):
    """Return by how much numbers differ, as the end of a line."""
    if first.shape != second.shape or first.dtype.kind not in "fi":
        return ""
    apart = np.abs(np.asarray(first, float) - np.asarray(second, float))
    if not np.isfinite(apart).any():
        return ""
    return (
        f", by at most {np.nanmax(apart):.3g} where the largest is {np.nanmax(np.abs(first)):.3g}"
    )
