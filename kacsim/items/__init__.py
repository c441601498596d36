"""One module per item: what to sample, how to reduce it, how to draw it.

An item module defines ``cases(settings) -> list[Case]``, ``reduce(samples, settings) ->
xarray.Dataset``, ``draw(dataset) -> Figure`` and, if the texts state something about it,
``claims(dataset) -> list[Finding]``. Adding a figure is adding a module here, its section in the
configuration and its schema, and its caption.
"""

import functools
import importlib
import pkgutil
import re

from kacsim import files
from kacsim.kernels.provenance import ROOT


def _order(name):
    """Sort figures by number, then the other studies."""
    family, _, rest = name.partition("_")
    number = re.search(r"(\d+)", rest)
    return family != "kac", family, int(number[1]) if number else 99, rest


NAMES = sorted(
    (module.name for module in pkgutil.iter_modules(__path__) if not module.name.startswith("_")),
    key=_order,
)


PUBLISHED = sorted((ROOT / "reports" / "published").glob("*.yaml"))


def load(name):
    """Return the module of an item."""
    return importlib.import_module(f"kacsim.items.{name}")


def uses(name):
    """Return the items whose findings an item gathers."""
    return getattr(load(name), "USES", ())


def settled(name, settings):
    """Return an item's settings with all that they stand for, such as the content of a file."""
    return getattr(load(name), "settled", lambda given: given)(settings)


def costs(name):
    """Return the measured costs that an item shows, which enter its settings; None without any."""
    return getattr(load(name), "costs", lambda: None)()


@functools.cache
def published():
    """Return claim id -> published entry, from the files of reports/published/, one a text."""
    found = {}
    for path in PUBLISHED:
        found |= files.read_yaml(path)
    return found


def published_of(names):
    """Return claim id -> published entry of those that belong to one of some items."""
    return {key: entry for key, entry in published().items() if shows(entry, names)}


def shows(entry, names):
    """Tell whether a published entry belongs to one of some items."""
    return not {entry["item"], *entry.get("also", ())}.isdisjoint(names)


def reduced(name, samples, settings):
    """Return an item's dataset with what it was made from, as the later stages read it.

    Parameters
    ----------
    name : item
    samples : mapping, case id -> xarray.Dataset
    settings : the item's settings

    Returns
    -------
    xarray.Dataset with attributes ``settings`` and ``published`` (claim id -> printed number)
    """
    dataset = load(name).reduce(samples, settings)
    entries = published_of((name,)).items()
    values = {key: float(entry["printed"]) for key, entry in entries if "printed" in entry}
    return dataset.assign_attrs(settings=settings, published=values)
