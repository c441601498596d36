"""From a configuration to items and cases; every value is checked before anything runs.

Nothing heavy is imported here: Snakemake reads the plan at every start.
"""

import json
import math
import os
import shlex
from dataclasses import dataclass
from pathlib import Path

import yaml

from kacsim import checks, items
from kacsim.checks import RATE
from kacsim.provenance import ROOT

SCHEMA = ROOT / "workflow" / "schemas" / "config.schema.yaml"
REPORT_FILES = ("report.html.j2", "style.css", "published.yaml", "captions.yaml", "errata.yaml")
COMMON = ("seed", "bin_width", "other_bin_widths")

# sampler -> its parameters with their short forms in a case id, in the order of both
SAMPLERS = {
    "kac": {
        "algorithm": "",
        "engine": "",
        "n_particles": "n",
        "time": "t",
        "time_step": "dt",
        "collision_rate": "rate",
        "keep_above": "above",
    },
    "kac_equilibrium": {"n_particles": "n", "tolerance": "eps", "energy": "e"},
    "kac_corners": {"n_particles": "n", "tolerance": "eps"},
}
# The sources that a draw's bits depend on; the files of the algorithms are added by `Case.sources`.
SAMPLE_SOURCES = (
    "jit.py",
    "streams.py",
    "variates.py",
    "sampling.py",
    "store.py",
    "kac/draws.py",
    "kac/model.py",
)
ALGORITHM_FILES = {
    "nanbu_sequential": "kac/nanbu.py",
    "nanbu_synchronous": "kac/nanbu.py",
    "nanbu_babovsky": "kac/nanbu_babovsky.py",
    "bird": "kac/bird.py",
    "poisson": "kac/poisson.py",
    "poisson_printed": "kac/poisson.py",
}
KERNEL_MODULES = (*dict.fromkeys(ALGORITHM_FILES.values()), "kac/perfect.py")
DEFAULTS = {"time_step": None, "collision_rate": RATE, "keep_above": None, "energy": None}


class PlanError(Exception):
    """Everything that is wrong with a configuration, one line each."""


@dataclass(frozen=True)
class Case:
    """One sampler with one set of parameters, drawn n_replicates times n_draws.

    Attributes
    ----------
    sampler : name in `SAMPLERS`
    parameters : dict, every parameter of the sampler (see `make_case`)
    n_draws, n_replicates : int, draws of each replicate, and replicates
    seed : int, not part of the id
    """

    sampler: str
    parameters: dict
    n_draws: int
    n_replicates: int
    seed: int

    @property
    def id(self):
        """Return the case's name, made from its parameters; never parsed back."""
        tokens = [self.sampler.replace("_", "-")]
        for name, short in SAMPLERS[self.sampler].items():
            value = self.parameters[name]
            if name not in DEFAULTS or value != DEFAULTS[name]:
                tokens.append(short + _plain(value))
        return "-".join([*tokens, f"{self.n_replicates}x{self.n_draws}"])

    def arguments(self):
        """Return the command-line words that sample this case."""
        words = [self.sampler]
        for name, value in self.parameters.items():
            if name not in DEFAULTS or value != DEFAULTS[name]:
                words += [flag(name), str(value)]
        for name in ("n_draws", "n_replicates", "seed"):
            words += [flag(name), str(getattr(self, name))]
        return shlex.join(words)

    def priority(self):
        """Return a rank that starts the longest cases first: the logarithm of their work."""
        p = self.parameters
        work = self.n_draws * self.n_replicates
        if self.sampler == "kac_equilibrium":
            work *= 20.0 * p["n_particles"] ** 2 * max(1.0, -math.log10(p["tolerance"]))
        elif p.get("engine") == "forward":
            work *= p["n_particles"]
        else:
            work *= 6.0
        return round(10.0 * math.log2(max(1.0, work)))

    def problems(self):
        """Return the list of what is wrong with the parameters and the size."""
        size = {"n_draws": self.n_draws, "n_replicates": self.n_replicates, "seed": self.seed}
        check = getattr(checks, self.sampler)
        return [*check(**self.parameters), *checks.amount(**size)]

    @property
    def kernel_module(self):
        """Return the package's file that holds the sampler's kernels."""
        return ALGORITHM_FILES.get(self.parameters.get("algorithm"), "kac/perfect.py")

    def compiled(self):
        """Return the file that stands for the sampler's compiled kernels."""
        return f"results/kernels/{self.kernel_module.removesuffix('.py')}.txt"

    def sources(self):
        """Return the package's files that the draws depend on."""
        return (*SAMPLE_SOURCES, self.kernel_module)

    def settings(self):
        """Return everything that determines the draws, as a JSON-ready dict."""
        size = {"n_draws": self.n_draws, "n_replicates": self.n_replicates, "seed": self.seed}
        known = {k: v for k, v in self.parameters.items() if v is not None}
        return {"sampler": self.sampler, **known, **size}


def compile_sources(module):
    """Return the package's files that the compiled kernels of a module depend on."""
    return (*(source for source in SAMPLE_SOURCES if source != "store.py"), module)


def reduce_sources(name):
    """Return the package's files that an item's dataset depends on."""
    used = (name, *getattr(items.load(name), "USES", ()))
    shared = ("items/_kac.py", "items/_corners.py", "kac/exact.py", "kac/moments.py", "statistics")
    return (*(f"items/{one}.py" for one in used), *shared, "store.py")


def draw_sources(name):
    """Return the package's files that an item's figure depends on."""
    return f"items/{name}.py", "items/_corners.py", "plotting.py", "kac/exact.py"


def make_case(sampler, *, n_draws, n_replicates, seed, **parameters):
    """Return a case with the sampler's defaults filled in."""
    names = SAMPLERS[sampler]
    complete = {name: parameters.get(name, DEFAULTS.get(name)) for name in names}
    return Case(sampler, complete, n_draws, n_replicates, seed)


def flag(name):
    """Return the command-line flag of a parameter."""
    return "--" + name.replace("_", "-")


def _plain(value):
    return str(value).removesuffix(".0").replace("_", "-")


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
        content = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
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

    Raises
    ------
    PlanError
        Lists every problem, one line each: file, key, value and what is allowed.
    """

    def __init__(self, config, files=("config",)):
        self.files = [os.path.relpath(file) if os.path.isabs(file) else str(file) for file in files]
        from kacsim.schema import complete  # jsonschema is needed once, not by every job

        self.config, wrong = complete(config, SCHEMA)
        self._refuse(wrong)
        self.settings = {name: self._settings_of(name) for name in items.NAMES}
        self.cases_of = {}
        problems = []
        for name in items.NAMES:
            cases = items.load(name).cases(self.settings[name])
            self.cases_of[name] = list({case.id: case for case in cases}.values())
            if "items" not in self.settings[name]:  # else the used items have reported them
                problems += self._case_problems(name)
        self._refuse(problems)
        self.cases = {case.id: case for cases in self.cases_of.values() for case in cases}

    def _settings_of(self, name):
        common = {key: self.config[key] for key in COMMON}
        settings = common | self.config[name]
        uses = getattr(items.load(name), "USES", ())
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
            raise PlanError("\n".join(lines))

    def _file_of(self, path):
        """Return the last file that sets the key of a path, the first file if none does."""
        for file in reversed(self.files):
            try:
                content = _read_yaml(file)
            except PlanError:
                continue
            for key in [key for key in path if isinstance(key, str)]:
                content = content.get(key) if isinstance(content, dict) else None
            if content is not None:
                return file
        return self.files[0]

    def settings_json(self, name):
        """Return an item's settings as JSON: the argument of the later stages."""
        return json.dumps(self.settings[name], sort_keys=True)


MISSING = object()


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
