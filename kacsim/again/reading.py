"""The recipe of any file that the project writes, and what it asks for, checked."""

import itertools
import json
from pathlib import Path
from typing import NamedTuple

from kacsim import items, plan, store
from kacsim.cases import make_case
from kacsim.files import StoreError
from kacsim.jobs import stages
from kacsim.kernels import provenance, sources
from kacsim.recipes import carriers, lines
from kacsim.samplers import registry

ADDED = ("costs", "items")  # what the plan adds to the settings of an item
SIZE = ("n_draws", "n_replicates", "seed")


class Order(NamedTuple):
    """What makes a file again.

    Attributes
    ----------
    path : Path of the file
    text : str, its recipe as it is carried; empty where the file says it elsewhere
    recipe : kacsim.recipes.lines.Recipe
    case : kacsim.cases.Case of a file of samples, else None
    plan : kacsim.plan.Plan of any other file, else None
    """

    path: Path
    text: str
    recipe: object
    case: object
    plan: object

    def seconds(self):
        """Return the expected time in the kernels."""
        cases = [self.case] if self.case else self.plan.cases.values()
        if self.recipe.item:
            cases = self.plan.cases_of[self.recipe.item]
        return sum(case.seconds() for case in cases)


def read(path):
    """Return the order that a file carries.

    Raises
    ------
    StoreError, PlanError
        Names the file and what cannot be read, is not known or is not allowed.
    """
    path = Path(path)
    if path.suffix == ".html":
        return _of_page(path)
    if path.suffix == ".nc":
        text, recipe = "", _of_dataset(path)
    else:
        text = carriers.read(path)
        recipe = lines.parsed(text, path)
    if recipe.item == "" and "sampler" in recipe.settings:
        return Order(path, text, recipe, case_of(recipe.settings, path), None)
    if recipe.item == "":
        return Order(path, text, recipe, None, plan_of(recipe.settings, path))
    if recipe.item not in items.NAMES:
        what = f"item = {recipe.item!r} in its recipe"
        raise StoreError(f"{path}: {what}: is not one of this version")
    checked = plan_of({recipe.item: recipe.settings}, path)
    return Order(path, text, recipe, None, checked)


def _of_dataset(path):
    about = store.read(path).attrs
    if "item" in about:
        return lines.Recipe(
            about["item"], about["settings"], {"reduce": about["code"]}, about["source"]
        )
    return lines.Recipe("", about["settings"], {"sample": about["code"]}, about["source"])


def _of_page(path):
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise StoreError(f"{path}: cannot be read: {error}") from error
    settings, source, options = carriers.of_page(text, path)
    recipe = lines.Recipe("", settings, {}, source, options)
    return Order(path, "", recipe, None, plan_of(settings, path))


def case_of(settings, path):
    """Return the case that settings describe, whatever they are.

    Raises
    ------
    StoreError
        Names the file, the word and what is allowed.
    """
    given = dict(settings)
    name = given.pop("sampler", None)
    if name not in registry():
        raise StoreError(f"{path}: sampler = {name!r} in its recipe: is not one of this version")
    refuse_paths(given, path)
    try:
        size = {key: given.pop(key) for key in SIZE}
        shard = tuple(given.pop("shard", (1, 1)))
        case = make_case(name, **size, shard=shard, **given)
        problems = case.problems()
    except KeyError as error:
        raise StoreError(f"{path}: {error.args[0]} is missing in its recipe") from error
    except (ValueError, TypeError) as error:
        raise StoreError(f"{path}: its recipe: {error}") from error
    if problems:
        raise StoreError("\n".join(f"{path}: {one}" for one in problems))
    return case


def refuse_paths(settings, path):
    """Raise StoreError for a word that leads out of this folder."""
    for key, value in settings.items():
        if isinstance(value, str) and (Path(value).is_absolute() or ".." in Path(value).parts):
            what = "must be a name, or a file below this folder"
            raise StoreError(f"{path}: {key} = {value!r} in its recipe: {what}")


def configuration(settings):
    """Return the sections of a configuration that gives an item or more these settings.

    Parameters
    ----------
    settings : dict item -> its settings, those of the items that it uses among them
    """
    found = {}
    for name, one in settings.items():
        own = {key: value for key, value in one.items() if key not in (*plan.COMMON, *ADDED)}
        found |= configuration(one.get("items", {}))
        found |= {key: one[key] for key in plan.COMMON if key in one} | {name: own}
    return found


def plan_of(settings, path):
    """Return the plan of a configuration that gives items these settings.

    Raises
    ------
    PlanError
        Names the file, each key that is not known or wrong, and what is allowed.
    """
    try:
        config = configuration(settings)
    except AttributeError as error:
        raise StoreError(f"{path}: settings in its recipe: must be mappings") from error
    for one in config.values():
        if isinstance(one, dict):
            refuse_paths(one, path)
    return plan.Plan(config, [path])


def differences(order):
    """Return a line for what differs here from what a recipe tells: settings, sources, versions."""
    found = []
    changed = _changed_settings(order)
    if changed:
        found.append(f"settings: other {', '.join(changed)} here")
    if changed := [
        stage for stage, code in order.recipe.code.items() if _code(order, stage) != code
    ]:
        found.append(f"sources: other code here to {' and '.join(changed)}")
    both = lines.words_of(provenance.source()), lines.words_of(order.recipe.source)
    other = [
        f"{ours} here, {theirs} there"
        for ours, theirs in itertools.zip_longest(*both, fillvalue="nothing")
        if ours != theirs
    ]
    if other:
        found.append(f"versions: {'; '.join(other)}")
    if lines.unclean(order.recipe.source):
        found.append("sources: made from files with changes that no commit holds")
    return found


def _changed_settings(order):
    """Return the keys of an item's settings that a run here would have otherwise."""
    if not order.recipe.item:
        return []
    here = json.loads(json.dumps(order.plan.settings[order.recipe.item]))
    there = order.recipe.settings
    return sorted(key for key in here.keys() | there.keys() if here.get(key) != there.get(key))


def _code(order, stage):
    """Return the hash of what a stage depends on here."""
    name = order.recipe.item
    roots = {"reduce": stages.reduce_roots, "draw": stages.draw_roots}
    if stage == "sample" and order.case:
        return sources.code(order.case.roots)
    return stages.code(roots[stage](name)) if stage in roots and name else None
