"""The numbers behind a figure as one table of text, for those who do not read NetCDF.

One row per place: a column for every dimension, then one for every variable. Variables of the same
dimensions share their rows; cells that a row has nothing for are empty. So a filter on one column
that is not empty gives a table with values, errors and exact values beside each other.
"""

import csv
import itertools
import json
from pathlib import Path

from kacsim.files import replace_file
from kacsim.recipes import carriers

BIN, EDGE = "bin", "edge"  # bins have no coordinate but edges, one more than bins


KINDS = {"f": "double", "i": "integer", "u": "integer", "b": "boolean"}  # of CSV on the Web


def write(dataset, path, recipe):
    """Write a dataset as CSV, and beside it what its columns are and how it was made.

    The same dataset gives the same bytes. What lies beside has the form of CSV on the Web.

    Parameters
    ----------
    dataset : xarray.Dataset
    path : file to create or replace; the other one's name is longer by ``carriers.TABLE``
    recipe : str, how the dataset was made
    """

    def to(name):
        with open(name, "w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows(table(dataset))

    replace_file(path, to)
    about = {
        "@context": "http://www.w3.org/ns/csvw",
        "url": Path(path).name,
        "dc:title": dataset.attrs.get("title", Path(path).stem),
        "dc:description": recipe,
        "tableSchema": {"columns": [_described(dataset, name) for name in next(table(dataset))]},
    }
    text = json.dumps(about, indent=1, sort_keys=True) + "\n"
    beside = carriers.beside(path)
    replace_file(beside, lambda name: Path(name).write_text(text, encoding="utf-8"))


def _described(dataset, head):
    """Return what a column holds, from its head."""
    name = head.partition(" [")[0]
    there = dataset.variables.get(EDGE if name in ("bin_from", "bin_to") else name)
    kind = "integer" if there is None else KINDS.get(there.dtype.kind, "string")
    about = {"titles": head, "name": name, "datatype": kind, "null": ""}
    if there is not None and "long_name" in there.attrs:
        about["dc:description"] = there.attrs["long_name"]
    return about


def table(dataset):
    """Yield the header, ``name [unit]`` per column, then the rows as lists of text."""
    groups = {}
    for name, variable in dataset.data_vars.items():
        groups.setdefault(variable.dims, []).append(name)
    axes = {dim: _axis(dataset, dim) for dims in groups for dim in dims}
    columns = [column for axis in axes.values() for column, _ in axis]
    columns += [name for names in groups.values() for name in names]
    yield [_head(dataset, name) for name in columns]
    for dims, names in groups.items():
        yield from _rows(dataset, [axes[dim] for dim in dims], names, columns)


def _axis(dataset, dim):
    """Return the columns of a dimension: (name, values), two for bins between edges."""
    size = dataset.sizes[dim]
    if dim == BIN and dataset.sizes.get(EDGE) == size + 1:
        edges = dataset[EDGE].values.tolist()
        return [("bin_from", edges[:-1]), ("bin_to", edges[1:])]
    values = dataset[dim].values.tolist() if dim in dataset.coords else list(range(size))
    return [(dim, values)]


def _head(dataset, name):
    """Return a column's name with its unit, if it holds numbers."""
    name_there = EDGE if name in ("bin_from", "bin_to") else name
    if name_there not in dataset.variables:
        return name  # places that are only counted, from 0 on
    variable = dataset[name_there]
    units = variable.attrs.get("units", "1")
    return name if variable.dtype.kind in "OU" else f"{name} [{units}]"


def _rows(dataset, axes, names, columns):
    """Yield the rows of the variables that share the dimensions with these axes."""
    places = [[axis for _, axis in group] for group in axes]
    heads = [name for group in axes for name, _ in group]
    at = [columns.index(name) for name in heads + names]
    flat = [dataset[name].values.ravel().tolist() for name in names]
    steps = itertools.product(*(zip(*group, strict=True) for group in places))
    for place, *values in zip(steps, *flat, strict=True):
        row = [""] * len(columns)
        for k, value in zip(at, [*itertools.chain(*place), *values], strict=True):
            row[k] = repr(value) if isinstance(value, float) else str(value)
        yield row
