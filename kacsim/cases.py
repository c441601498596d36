"""A case: one sampler with one set of parameters. Its id, its command line, its sources."""

import dataclasses
import hashlib
import math
import shlex
from dataclasses import dataclass

from kacsim import checks, checks_boltzmann, checks_techniques
from kacsim.samplers import (
    ALGORITHM_FILES,
    DEFAULTS,
    FAMILY_SOURCES,
    LISTS,
    PROBES,
    SAMPLE_SOURCES,
    SAMPLER_FILES,
    SAMPLERS,
    UNSHARDED,
    WORK_SECONDS,
)


@dataclass(frozen=True)
class Case:
    """One sampler with one set of parameters, drawn n_replicates times n_draws.

    Attributes
    ----------
    sampler : name in `SAMPLERS`
    parameters : dict, every parameter of the sampler (see `make_case`)
    n_draws, n_replicates : int, draws of each replicate, and replicates
    seed : int, not part of the id
    shard : (k, K), the k-th of K parts of the replicates; not part of the id: the draws are those
        of the whole case
    """

    sampler: str
    parameters: dict
    n_draws: int
    n_replicates: int
    seed: int
    shard: tuple = (1, 1)

    @property
    def replicates(self):
        """Return the range of the replicates of this shard."""
        number, total = self.shard
        first, last = (k * self.n_replicates // total for k in (number - 1, number))
        return range(first, last)

    @property
    def id(self):
        """Return the case's name, made from its parameters; never parsed back."""
        tokens = [self.sampler.replace("_", "-")]
        for name, short in SAMPLERS[self.sampler].items():
            value = self.parameters[name]
            if name not in DEFAULTS or value != DEFAULTS[name]:
                tokens.append(short + _plain(value))
        return "-".join([*tokens, f"{self.n_replicates}x{self.n_draws}"])

    def split(self, number):
        """Return the shards of the case."""
        return [dataclasses.replace(self, shard=(k, number)) for k in range(1, number + 1)]

    def whole(self):
        """Return the case that this is a shard of."""
        return dataclasses.replace(self, shard=(1, 1))

    def title(self):
        """Return one sentence that says what the file of the samples holds."""
        return f"{self.n_replicates} x {self.n_draws} draws of {self.id}"

    def arguments(self):
        """Return the command-line words that sample this case, or the shard."""
        words = [self.sampler]
        for name, value in self.parameters.items():
            if name not in DEFAULTS or value != DEFAULTS[name]:
                values = value if isinstance(value, (list, tuple)) else [value]
                words += [flag(name), *map(str, values)]
        for name in ("n_draws", "n_replicates", "seed"):
            words += [flag(name), str(getattr(self, name))]
        if self.shard != (1, 1):
            words += ["--shard", "/".join(map(str, self.shard))]
        return shlex.join(words)

    def output(self):
        """Return the file of the case's samples, or of the shard's."""
        if self.shard == (1, 1):
            return f"results/samples/{self.id}.nc"
        return "results/shards/{}.{}of{}.nc".format(self.id, *self.shard)

    def seconds(self):
        """Return roughly how long the kernels take: the order of jobs, their size and limits."""
        p = self.parameters
        draws = float(self.n_draws * len(self.replicates))
        if self.sampler == "kac_equilibrium":
            work = 0.4 * p["n_particles"] ** 2 * max(1.0, -math.log10(p["tolerance"]))
        elif self.family == "techniques":
            work = max(p.get("n_points", [1])) * sum(p.get("dimension", [6]))
        elif self.sampler in PROBES:
            many = p.get("oversampling", 1.0)
            growth = 2.0 * (max(many) if isinstance(many, (list, tuple)) else many) - 1.0
            growth *= 0.5 if self.sampler.startswith("trap") else 1.0
            probes = math.prod(len(p[name]) for name in LISTS[self.sampler]) / len(p["time"])
            work = probes * sum(math.exp(min(30.0, growth * time)) for time in p["time"])
        else:
            work = p["n_particles"] if p.get("engine") == "forward" else 6.0
        return WORK_SECONDS * draws * work

    def minutes(self):
        """Return the time limit for a scheduler."""
        return time_limit(self.seconds())

    def megabytes(self):
        """Return the memory to ask for: 350, and for a replicate its histograms, three times."""
        tables = len(self.parameters.get("n_table", [1]))
        each = 0.25 * tables if self.family == "techniques" else 0.008
        return 350 + math.ceil(each * len(self.replicates))

    def problems(self):
        """Return the list of what is wrong with the parameters and the size."""
        size = {"n_draws": self.n_draws, "n_replicates": self.n_replicates, "seed": self.seed}
        homes = (checks, checks_boltzmann, checks_techniques)
        check = next(getattr(home, self.sampler) for home in homes if hasattr(home, self.sampler))
        return [*check(**self.parameters), *checks.amount(**size), *self._shard_problems()]

    def _shard_problems(self):
        number, total = self.shard
        most = 1 if self.sampler in UNSHARDED else self.n_replicates
        if isinstance(most, int) and not 1 <= number <= total <= max(most, 1):
            allowed = f"must be k/K with 1 <= k <= K <= {most}"
            yield checks.Problem("shard", f"{number}/{total}", allowed)

    @property
    def kernel_module(self):
        """Return the package's file that holds the sampler's kernels."""
        return SAMPLER_FILES.get(self.sampler) or ALGORITHM_FILES[self.parameters["algorithm"]]

    def compiled(self):
        """Return the file that stands for the sampler's compiled kernels."""
        return f"results/kernels/{self.kernel_module.removesuffix('.py')}.txt"

    def sources(self):
        """Return the package's files that the draws depend on."""
        return (*SAMPLE_SOURCES, *FAMILY_SOURCES[self.family], self.kernel_module)

    @property
    def family(self):
        """Return the package's folder that holds the sampler."""
        return self.kernel_module.partition("/")[0]

    def settings(self):
        """Return everything that determines the draws, as a JSON-ready dict."""
        size = {"n_draws": self.n_draws, "n_replicates": self.n_replicates, "seed": self.seed}
        known = {k: v for k, v in self.parameters.items() if v is not None}
        part = {} if self.shard == (1, 1) else {"shard": list(self.shard)}
        return {"sampler": self.sampler, **known, **size, **part}


def make_case(sampler, *, n_draws, n_replicates, seed, shard=(1, 1), **parameters):
    """Return a case with the sampler's defaults filled in."""
    names = SAMPLERS[sampler]
    complete = {name: parameters.get(name, DEFAULTS.get(name)) for name in names}
    return Case(sampler, complete, n_draws, n_replicates, seed, shard)


def time_limit(seconds):
    """Return the minutes to ask a scheduler for: ten times the expected time, and a margin."""
    return 10 + round(10.0 * seconds / 60.0)


def flag(name):
    """Return the command-line flag of a parameter."""
    return "--" + name.replace("_", "-")


def _plain(value):
    """Return a value as part of an id; of a list its ends, its length and a hash."""
    if isinstance(value, (list, tuple)):
        if len(value) == 1:
            return _plain(value[0])
        digest = hashlib.sha256(repr([float(one) for one in value]).encode()).hexdigest()[:8]
        return f"{_plain(value[0])}to{_plain(value[-1])}x{len(value)}.{digest}"
    text = f"{value:.6g}" if isinstance(value, float) and len(str(value)) > 12 else str(value)
    return text.removesuffix(".0").replace("_", "-")


def compile_sources(module):
    """Return the package's files that the compiled kernels of a module depend on."""
    family = FAMILY_SOURCES[module.partition("/")[0]]
    return (*(source for source in SAMPLE_SOURCES if source != "store.py"), *family, module)
