"""A case: one sampler with one set of parameters. Its id, its command line, its size."""

import dataclasses
import functools
import hashlib
import json
import math
import shlex
from dataclasses import dataclass

from kacsim import checks, costs
from kacsim.samplers import registry

OUTSIDE = "what a case decides is in its recipe and in the names of its files"

BASE_MEGABYTES = 350
WHOLE = (1, 1)  # the shard that is all of a case


@dataclass(frozen=True)
class Case:
    """One sampler with one set of parameters, drawn n_replicates times n_draws.

    Attributes
    ----------
    name : of its sampler
    parameters : dict, every parameter of the sampler (see `make_case`)
    n_draws, n_replicates : int, draws of each replicate, and replicates
    seed : int, not part of the id
    shard : (k, K), the k-th of K parts of the replicates; not part of the id: the draws are those
        of the whole case
    """

    name: str
    parameters: dict
    n_draws: int
    n_replicates: int
    seed: int
    shard: tuple = WHOLE

    @property
    def sampler(self):
        """Return the declaration of the case's sampler."""
        return registry()[self.name]

    @property
    def replicates(self):
        """Return the range of the replicates of this shard."""
        number, total = self.shard
        first, last = (k * self.n_replicates // total for k in (number - 1, number))
        return range(first, last)

    @functools.cached_property
    def id(self):
        """Return the case's name, made from its parameters; never parsed back."""
        tokens = [self.name.replace("_", "-")]
        for parameter in self.sampler.parameters_of(self.parameters):
            value = self.parameters[parameter.name]
            if parameter.is_shown(value):
                tokens.append(parameter.short + (parameter.token or _token)(value))
        return "-".join([*tokens, f"{self.n_replicates}x{self.n_draws}"])

    def split(self, number):
        """Return the shards of the case."""
        return [dataclasses.replace(self, shard=(k, number)) for k in range(1, number + 1)]

    def whole(self):
        """Return the case that this is a shard of."""
        return dataclasses.replace(self, shard=WHOLE)

    def title(self):
        """Return one sentence that says what the file of the samples holds."""
        return f"{self.n_replicates} x {self.n_draws} draws of {self.id}"

    def arguments(self):
        """Return the command-line words that sample this case, or the shard."""
        words = [self.name]
        for parameter in self.sampler.parameters_of(self.parameters):
            value = self.parameters[parameter.name]
            if parameter.is_shown(value):
                values = value if parameter.many else [value]
                words += [flag(parameter.name), *map(str, values)]
        for name in ("n_draws", "n_replicates", "seed"):
            words += [flag(name), str(getattr(self, name))]
        if self.shard != WHOLE:
            words += ["--shard", "/".join(map(str, self.shard))]
        return shlex.join(words)

    def output(self):
        """Return the file of the case's samples, or of the shard's."""
        if self.shard == WHOLE:
            return f"results/samples/{self.id}.nc"
        return "results/shards/{}.{}of{}.nc".format(self.id, *self.shard)

    @property
    def kind(self):
        """Return the name that the case's costs have."""
        settled = {one.name for one in self.sampler.parameters if one.settle}
        plain = {k: v for k, v in self.parameters.items() if k not in settled}
        kind = costs.kind_of(self.name, plain)
        # Whatever the table, its draws take as long.
        return f"{kind}-own" if any(self.parameters[k] is not None for k in settled) else kind

    def amounts(self):
        """Return what the draws take, term -> amount: of the whole case, of each call, of all."""
        rows = len(self.replicates)
        each = {"call": 1.0} | self.sampler.work(self.parameters)
        calls = {"case": 1.0, "call": rows * each.pop("call")}
        return calls | {term: amount * rows * self.n_draws for term, amount in each.items()}

    def seconds(self):
        """Return how long the kernels should take: the order of jobs, their size and limits."""
        return costs.seconds(self.kind, self.amounts())

    def minutes(self):
        """Return the time limit for a scheduler."""
        return time_limit(self.seconds())

    def megabytes(self):
        """Return the memory to ask for: a program, and the histograms of every replicate."""
        each = self.sampler.replicate_megabytes(self.parameters)
        return BASE_MEGABYTES + math.ceil(each * len(self.replicates))

    def problems(self):
        """Return the list of what is wrong with the parameters and the size."""
        size = {"n_draws": self.n_draws, "n_replicates": self.n_replicates, "seed": self.seed}
        found = [*self.sampler.problems(self.parameters), *checks.amount(**size)]
        return found or list(self._shard_problems())

    def _shard_problems(self):
        number, total = self.shard
        most = self.n_replicates if self.sampler.by_replicate else 1
        if not 1 <= number <= total <= most:
            allowed = f"must be k/K with 1 <= k <= K <= {most}"
            yield checks.Problem("shard", f"{number}/{total}", allowed)

    @property
    def kernel_module(self):
        """Return the module that holds the sampler's kernels."""
        return self.sampler.kernel_module(self.parameters)

    @property
    def roots(self):
        """Return (module, name) of the definitions that draw the case."""
        return self.sampler.roots(self.parameters)

    @property
    def unit(self):
        """Return the name of what is compiled for this case: kernels and what looks them up."""
        tail = ".".join(dict.fromkeys([self.name, *self.sampler.entries(self.parameters)]))
        return self.kernel_module.removeprefix("kacsim.").replace(".", "/") + f".{tail}"

    def compiled(self):
        """Return the file that stands for the sampler's compiled kernels."""
        return f"results/kernels/{self.unit}.txt"

    def settings(self):
        """Return everything that determines the draws, as a JSON-ready dict."""
        size = {"n_draws": self.n_draws, "n_replicates": self.n_replicates, "seed": self.seed}
        known = {k: v for k, v in self.parameters.items() if v is not None}
        part = {} if self.shard == WHOLE else {"shard": list(self.shard)}
        return {"sampler": self.name, **known, **size, **part}

    def recipe(self):
        """Return `settings` and the replicates as one line of JSON: what jobs are compared by."""
        replicates = [self.replicates.start, self.replicates.stop]
        return json.dumps([self.id, self.settings(), replicates], sort_keys=True)


def make_case(sampler, *, n_draws, n_replicates, seed, shard=WHOLE, **parameters):
    """Return a case with the sampler's defaults filled in.

    Raises
    ------
    ValueError
        Names a parameter that the sampler does not have.
    """
    complete = registry()[sampler].complete(parameters)
    return Case(sampler, complete, n_draws, n_replicates, seed, shard)


def tiny_cases():
    """Yield a case of every sampler, variant and engine, as small as can be."""
    for name, sampler in registry().items():
        for tiny in sampler.tiny:
            yield from _tiny(name, sampler, tiny)


def _tiny(name, sampler, tiny):
    size = {"n_draws": 2, "n_replicates": 1, "seed": 0}
    if not sampler.variants:
        yield make_case(name, **tiny, **size)
        return
    choice = sampler.parameters[0].name
    for variant in sampler.variants:
        known = {one.name for one in sampler.parameters_of({choice: variant.name})}
        mine = {key: value for key, value in (tiny | variant.tiny).items() if key in known}
        for engine in sampler.engines:
            case = make_case(name, **{choice: variant.name}, engine=engine, **mine, **size)
            if not case.problems():  # not every variant has every kernel
                yield case


def time_limit(seconds):
    """Return the minutes to ask a scheduler for: ten times the expected time, and a margin."""
    return 10 + round(10.0 * seconds / 60.0)


def flag(name):
    """Return the command-line flag of a parameter."""
    return "--" + name.replace("_", "-")


def _token(value):
    """Return a value as part of an id; of a list its ends, its length and a hash."""
    if isinstance(value, (list, tuple)):
        if len(value) == 1:
            return _token(value[0])
        digest = hashlib.sha256(repr([float(one) for one in value]).encode()).hexdigest()[:8]
        return f"{_token(value[0])}to{_token(value[-1])}x{len(value)}.{digest}"
    text = f"{value:.6g}" if isinstance(value, float) and len(str(value)) > 12 else str(value)
    return text.removesuffix(".0").replace("_", "-")
