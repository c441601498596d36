"""Which case a mark of a figure was drawn from: by its value, found again in the dataset.

A figure need not say it: an estimate with its bar, or the bar of a histogram, stands in the dataset
with the same bits, and the coordinates of that place are settings of cases.
"""

import numpy as np


def of_series(series, dataset, cases):
    """Return for each mark of a series the place of its case, None where that is not known.

    An exact value or a curve has none, nor has what agrees with several cases.

    Parameters
    ----------
    series : dict of `marks.named`
    dataset : xarray.Dataset, what the figure was drawn from
    cases : list of (title, settings) of the item's cases

    Returns
    -------
    list of int or None, one a mark
    """
    y = series["y"]
    finite = y[np.isfinite(y)]
    if finite.size and (series["kind"] == "bars" or {"error", "low"} & series.keys()):
        for variable in dataset.data_vars.values():
            if variable.dtype.kind in "if" and np.isin(finite, variable.values).all():
                places = [np.argwhere(variable.values == value) for value in y]
                told = _told(variable.dims, dataset, cases)
                found = [_agreeing(one, told, cases) for one in _narrowed(places, series, variable)]
                return [one.pop() if len(one) == 1 else None for one in found]
    return [None] * len(y)


def _narrowed(found, series, variable):
    """Keep of several places of one value those whose coordinate is x, or where the others are."""
    single = [k for k, places in enumerate(found) if len(places) == 1]
    for axis, dim in enumerate(variable.dims):
        own = [places[:, axis] for places in found]
        along, x = variable[dim].values, series["x"]
        if len(x) == len(found) and all(along[own[k]] == x[k] for k in single):
            chosen = [along[places] == x[k] for k, places in enumerate(own)]
        elif len({int(own[k][0]) for k in single}) == 1:
            chosen = [places == own[single[0]] for places in own]
        else:
            continue
        found = [_kept(*pair) for pair in zip(found, chosen, strict=True)]
    return found


def _kept(places, chosen):
    """Return the chosen places, or all where none is."""
    return places[chosen] if chosen.any() else places


def _told(dims, dataset, cases):
    """Return what a dataset says of settings along some dimensions: (setting, axes, values) each.

    A coordinate of another name is the setting that takes all of its values, if only one does.
    """
    taken = {}
    for _, settings in cases:
        for name, value in (settings | _all_draws(settings)).items():
            taken.setdefault(name, set()).update(np.atleast_1d(value).tolist())
    found = []
    for name in (*dataset.coords, "n_draws"):
        variable = dataset.get(name)
        if variable is not None and variable.dims and set(variable.dims) <= set(dims):
            names = [name]
            if name in dims and name not in taken:
                values = set(variable.values.tolist())
                names = [other for other, those in taken.items() if values <= those]
            if len(names) == 1 and names[0] in taken:
                axes = [dims.index(dim) for dim in variable.dims]
                found.append((names[0], axes, variable.values))
    return found


def _agreeing(places, told, cases):
    """Return which cases agree with all that is told of some places, a set of int."""
    return {
        k
        for k, (_, settings) in enumerate(cases)
        for place in places
        if all(
            values[tuple(place[axes])] in np.atleast_1d((settings | _all_draws(settings))[name])
            for name, axes, values in told
            if name in settings
        )
    }


def _all_draws(settings):
    """Return the draws of all replicates, which datasets tell."""
    return {"n_draws": settings["n_draws"] * settings["n_replicates"]}
