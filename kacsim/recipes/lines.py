"""Recipes: what a file says of how it was made, as data, and what of it is believed.

A recipe names an item or a sampler, its settings, hashes of what made it, and versions. It is read
from files that may come from anywhere: every word is checked, and nothing of it is run.
"""

import json
from typing import NamedTuple

from kacsim.files import StoreError
from kacsim.kernels import provenance, sources

KEYS = {"item": str, "settings": dict, "code": dict, "source": str, "options": str}
OPTIONAL = {"options"}
LARGEST = 1_000_000  # characters


class Recipe(NamedTuple):
    """How a file was made.

    Attributes
    ----------
    item : str, name of the item; empty for the samples of one case
    settings : dict, of the item, or sampler, parameters and size of the case
    code : dict stage -> hash of the sources that the stage depends on
    source : str, version, commit and versions of libraries
    options : str, of the command that a report tells; words for its page only
    """

    item: str
    settings: dict
    code: dict
    source: str
    options: str = ""


def of_figure(dataset, code):
    """Return the recipe of what is drawn from a dataset, as one line of text.

    Parameters
    ----------
    dataset : of `kacsim.store.read_dataset`
    code : hash of the sources that draw it
    """
    about = dataset.attrs
    recipe = {
        "item": about["item"],
        "settings": about["settings"],
        "code": {"reduce": about["code"], "draw": code},
        "source": about["source"],
    }
    return json.dumps(recipe, sort_keys=True)


def of_case(case):
    """Return the recipe of the samples of a case, as one line of text."""
    recipe = {
        "item": "",
        "settings": case.settings(),
        "code": {"sample": sources.code(case.roots)},
        "source": provenance.source(),
    }
    return json.dumps(recipe, sort_keys=True)


def of_report(settings, source, options):
    """Return the recipe of a report: the settings of all its items, as one line of text."""
    return json.dumps(Recipe("", settings, {}, source, options)._asdict())


def parsed(text, path):
    """Return the recipe that a text holds.

    Raises
    ------
    StoreError
        Names the file and what in its recipe is not known or not allowed.
    """
    if len(text) > LARGEST:
        raise StoreError(f"{path}: its recipe has {len(text)} characters, more than {LARGEST}")
    try:
        found = json.loads(text)
    except ValueError as error:
        raise StoreError(f"{path}: carries no recipe of kacsim: {error}") from error
    if not isinstance(found, dict) or (missing := sorted(KEYS.keys() - found.keys() - OPTIONAL)):
        lack = f": {', '.join(missing)} is missing" if isinstance(found, dict) else ""
        raise StoreError(f"{path}: carries no recipe of kacsim{lack}")
    if unknown := sorted(found.keys() - KEYS):
        raise StoreError(f"{path}: its recipe has unknown words: {', '.join(unknown)}")
    for key, kind in KEYS.items():
        if key in found and not isinstance(found[key], kind):
            value = str(found[key])[:60]
            raise StoreError(f"{path}: {key} = {value!r} in its recipe: must be a {kind.__name__}")
    return Recipe(**found)


def words_of(source):
    """Return the parts of a source: the version, the commit, each library's version."""
    return [part.strip() for part in source.split(",")]


def unclean(source):
    """Tell whether the sources had changes that no commit holds."""
    return any(part.endswith("+changes") for part in words_of(source))
