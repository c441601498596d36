"""From a configuration to items and cases; every value is checked before anything runs.

Nothing heavy is imported here: Snakemake reads the plan at every start.
"""

import json
import math
import os
import shlex
from pathlib import Path

import yaml

from kacsim import files, items
from kacsim.checks import MISSING
from kacsim.jobs.batches import make_batches
from kacsim.jobs.shards import make_shards
from kacsim.kernels.provenance import ROOT

SCHEMA = ROOT / "workflow" / "schemas" / "config.schema.yaml"
RUNTIME = "runtime.html"  # has a page of its own
REPORT_FILES = (
    *(path.name for path in sorted((ROOT / "reports").glob("*.html.j2")) if path.stem != RUNTIME),
    *("style.css", "captions.yaml", "errata.yaml", "findings.yaml", "glossary.yaml"),
    *(f"scripts/{path.name}" for path in sorted((ROOT / "reports" / "scripts").glob("*.js"))),
    *(f"published/{path.name}" for path in items.PUBLISHED),
    *(f"inventory/{path.name}" for path in sorted((ROOT / "reports" / "inventory").glob("*.yaml"))),
    *(path.name for path in (ROOT / "reports").glob("registered.yaml")),
)
# Thresholds of tails, and the width of the bins that samples are counted in.
EDGES = {"tail_above", "tail_threshold", "claim_threshold"}
FINEST = 0.05
JOBS = ("batch_seconds", "shard_seconds")  # how cases become jobs: no result depends on them
COMMON = ("seed", "bin_width", "other_bin_widths")


class PlanError(Exception):
    """Everything that is wrong with a configuration, one line each."""


def _in_one_line(text):
    """Return a text whose line ends and other unprintable characters are escaped."""
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)


def read_config(*paths):
    """Return the merged configuration of YAML files, later ones over earlier ones.

    Raises
    ------
    PlanError
        Names the file that is missing, empty, not YAML or not a mapping.
    """
    config = {}
    for path in paths:
        _merge(config, _read_yaml(path))
    return config


def _read_yaml(path):
    try:
        content = files.read_yaml(path)
    except OSError as error:
        raise PlanError(f"{path}: cannot be read: {error.strerror}") from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise PlanError(f"{path}: is not YAML: {' '.join(str(error).split())}") from error
    if not isinstance(content, dict):
        kind = "empty" if content is None else f"a {type(content).__name__}"
        raise PlanError(f"{path}: is {kind}; a configuration is a mapping of items to settings")
    return content


def _merge(base, over):
    for key, value in over.items():
        if isinstance(value, dict) and isinstance(base.get(key), dict):
            _merge(base[key], value)
        else:
            base[key] = value


class Plan:
    """The checked configuration: items, their settings and their cases.

    Parameters
    ----------
    config : dict, merged configuration
    files : paths that it came from, the last one that sets a key is named in messages
    given : keys set by ``--config`` on the command line, which messages name instead of a file

    Raises
    ------
    PlanError
        Lists every problem, one line each: file, key, value and what is allowed.
    """

    def __init__(self, config, files=("config",), given=()):
        near = (os.path.relpath(file) if os.path.isabs(file) else str(file) for file in files)
        self.files = [*near] or ["config"]  # as a module of another workflow it comes from no file
        self.given = set(given)
        from kacsim.schema import complete  # jsonschema is needed once, not by every job

        self.config, wrong = complete(config, SCHEMA)
        self._refuse(wrong)
        self.settings = {name: self._settings_of(name) for name in items.NAMES}
        self._refuse([problem for name in items.NAMES for problem in self._own_problems(name)])
        self.cases_of = {}
        problems = []
        for name in items.NAMES:
            cases = items.load(name).cases(self.settings[name])
            self.cases_of[name] = list({case.id: case for case in cases}.values())
            if "items" not in self.settings[name]:  # else the used items have reported them
                problems += self._case_problems(name)
            problems += self._edge_problems(name)
        self._refuse(problems)
        self.cases = {case.id: case for cases in self.cases_of.values() for case in cases}
        self.units = {case.unit: case for case in self.cases.values()}
        self.shards = make_shards(self.cases.values(), self.config["shard_seconds"])
        whole = {
            name: [case for case in cases if case.id not in self.shards]
            for name, cases in self.cases_of.items()
        }
        self.batches = make_batches(whole, self.config["batch_seconds"])

    def _settings_of(self, name):
        common = {key: self.config[key] for key in COMMON}
        settings = items.settled(name, common | self.config[name])
        uses = items.uses(name)
        if items.costs(name):
            settings["costs"] = items.costs(name)
        if uses:
            settings["items"] = {used: self._settings_of(used) for used in uses}
        return settings

    def _case_problems(self, name):
        """Return (path, value, sentence) of each wrong case of an item, traced to its key."""
        found = {}
        for case in self.cases_of[name]:
            for problem in case.problems():
                path = self._key_of(name, problem) or (name, problem.name)
                found[(path, repr(problem.value))] = (path, problem.value, problem.allowed)
        return list(found.values())

    def _own_problems(self, name):
        """Return what an item itself finds wrong: settings that do not go together."""
        check = getattr(items.load(name), "problems", lambda settings: ())
        found = check(self.settings[name])
        return [((name, key), self.config[name][key], sentence) for key, sentence in found]

    def _edge_problems(self, name):
        """Return the thresholds of an item that no fine bin begins at."""
        found = []
        for key in EDGES & set(self.config[name]):
            value = self.config[name][key]
            for place, one in enumerate(value) if isinstance(value, list) else [(None, value)]:
                if abs(one / FINEST - round(one / FINEST)) > 1e-6:
                    path = (name, key) if place is None else (name, key, place)
                    found.append((path, one, f"must be a multiple of {FINEST}"))
        return found

    def _key_of(self, name, problem):
        """Return the path of the setting that a case's wrong value came from."""
        section = self.config[name]
        for key, value in section.items():
            if not key.endswith(problem.name):
                continue
            if isinstance(value, list) and problem.value in value:
                return (name, key, value.index(problem.value))
            if value == problem.value:
                return (name, key)
        return None

    def _refuse(self, problems):
        if problems:
            lines = [
                f"{self._file_of(path)}: {describe(path)}{_shown(value)}: {sentence}"
                for path, value, sentence in problems
            ]
            raise PlanError("\n".join(map(_in_one_line, lines)))

    def _file_of(self, path):
        """Return where the key of a path was set last: on the command line, or in which file."""
        if path and path[0] in self.given:
            return "--config"
        for file in reversed(self.files):
            try:
                content = _read_yaml(file)
            except PlanError:
                continue
            for key in [key for key in path if isinstance(key, str)]:
                content = content.get(key, MISSING) if isinstance(content, dict) else MISSING
            if content is not MISSING:
                return file
        return self.files[0]

    def shard(self, wildcards):
        """Return the case that draws one shard, from the ``case`` and ``number`` of its file."""
        return self.shards[wildcards.case][int(wildcards.number) - 1]

    def items_of(self):
        """Return case id -> list of the items that need the case."""
        found = {}
        for name, cases in self.cases_of.items():
            for case in cases:
                found.setdefault(case.id, []).append(name)
        return found

    def settings_json(self, name):
        """Return an item's settings as JSON: the argument of the later stages."""
        return json.dumps(self.settings[name], sort_keys=True)


def recipe_options(files, values):
    """Return what follows ``snakemake -c2 ITEM`` to run with this configuration again.

    The item comes first, since ``--configfile`` takes all names that follow it for files.

    Parameters
    ----------
    files : configuration files beside the default one
    values : key -> value of ``--config``
    """
    words = []
    if files:
        near = [Path(file).absolute() for file in files]
        words += ["--configfile"]
        words += [str(f.relative_to(ROOT) if f.is_relative_to(ROOT) else f) for f in near]
    values = {key: value for key, value in values.items() if key not in JOBS}
    if values:
        words += ["--config", *(f"{key}={value}" for key, value in sorted(values.items()))]
    return shlex.join(words)


def describe(path):
    """Return a path of keys and places as ``item.key[0]``."""
    text = ""
    for key in path:
        text += f"[{key}]" if isinstance(key, int) else f".{key}" if text else str(key)
    return text


def _shown(value):
    if value is MISSING:
        return ""
    if isinstance(value, float) and not math.isfinite(value):
        return f" = {value}"
    return f" = {value!r}"
