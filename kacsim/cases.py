"""A case: one sampler with one set of parameters. Its id, its command line, its sources."""

import dataclasses
import hashlib
import math
import shlex
from dataclasses import dataclass

from kacsim import checks, checks_techniques
from kacsim.checks import BREATHING, MAX_NODES, RATE

_TREE = {"oversampling": "m", "onset": "from", "max_nodes": "budget"}
_GAS = {
    "density": "n",
    "temperature": "temp",
    "drift": "drift",
    "half_width": "box",
    "step": "dt",
}
_TRAP = {
    "initial": "",
    "breathing": "eps",
    "start_phase": "phi",
    "coupling": "coupling",
    "majorant_factor": "majorant",
    "spread": "spread",
    "anisotropy": "anisotropy",
    "max_nodes": "budget",
}
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
    "kac_probe": {"speed": "v", "time": "t", "collision_rate": "rate", **_TREE},
    "bkw": {"speed": "c", "time": "t", **_TREE},
    "bkw_fraction": {"threshold": "c", "time": "t", **_TREE},
    "bkw_tree": {"speed": "c", "time": "t"},
    "bkw_literal": {"initial": "", "speed": "c", "time": "t"},
    "extinction": {"majorant": "nu", "time": "t", "max_nodes": "budget"},
    "trap": {"radius": "r", "time": "t", **_TRAP},
    "trap_fraction": {"radius": "r", "time": "t", **_TRAP},
    "trap_energy": {"radius": "r", "time": "t", **_TRAP},
    "trap_literal": {
        "initial": "",
        "radius": "r",
        "time": "t",
        "breathing": "eps",
        "coupling": "coupling",
    },
    "bkw_moment": {"time": "t", **_TREE},
    "inverse_transform": {"law": "", "n_table": "table"},
    "inversion": {"law": "", "rate": "rate"},
    "rejection": {"law": "", "envelope": ""},
    "identity": {},
    "injection": _GAS,
    "outer_gas": _GAS,
    "weighted_particles": {"n_representatives": "n", "temperature": "temp", "drift": "drift"},
    "sphere_lattice": {"dimension": "d", "edge": "m"},
    "sphere_points": {"generator": "", "dimension": "d", "n_points": "n"},
    "area": {"exponent": "power", "n_points": "n"},
}
# Parameters that are lists: a case of the Boltzmann paper holds a grid of probes.
LISTS = {
    name: {"speed", "time", "threshold", "majorant", "radius"} & set(SAMPLERS[name])
    | ({"oversampling"} if name == "bkw_moment" else set())
    for name in (
        "kac_probe",
        "bkw",
        "bkw_fraction",
        "bkw_literal",
        "extinction",
        "trap",
        "trap_fraction",
        "trap_energy",
        "trap_literal",
        "bkw_moment",
    )
}
PROBES = tuple(LISTS)  # samplers at grids of probes
LISTS |= {
    name: {"n_table", "drift", "half_width", "dimension", "edge", "n_points"} & set(SAMPLERS[name])
    for name in (
        "inverse_transform",
        "injection",
        "outer_gas",
        "weighted_particles",
        "sphere_lattice",
        "sphere_points",
        "area",
    )
}
DEFAULTS = {
    "time_step": None,
    "collision_rate": RATE,
    "keep_above": None,
    "energy": None,
    "oversampling": 1.0,
    "onset": 0.0,
    "max_nodes": MAX_NODES,
    "initial": "bkw",
    "breathing": BREATHING,
    "start_phase": 0.0,
    "coupling": 3.0,
    "majorant_factor": 1.0,
    "spread": 1.0,
    "anisotropy": 0.0,
}

# The sources that a draw's bits depend on; `Case.sources` adds the files of the sampler.
SAMPLE_SOURCES = ("jit.py", "streams.py", "variates.py", "sampling.py", "store.py")
FAMILY_SOURCES = {
    "kac": ("kac/sampling.py", "kac/draws.py", "kac/model.py"),
    "boltzmann": (
        "boltzmann/sampling.py",
        "boltzmann/estimators.py",
        "boltzmann/model.py",
        "boltzmann/trap.py",
        "boltzmann/literal.py",
    ),
    "techniques": (
        "techniques/sampling.py",
        "techniques/model.py",
        "techniques/exact.py",
        "techniques/flux.py",
        "checks_techniques.py",
        "kac/model.py",
    ),
}
ALGORITHM_FILES = {
    "nanbu_sequential": "kac/nanbu.py",
    "nanbu_synchronous": "kac/nanbu.py",
    "nanbu_babovsky": "kac/nanbu_babovsky.py",
    "bird": "kac/bird.py",
    "poisson": "kac/poisson.py",
    "poisson_printed": "kac/poisson.py",
}
SAMPLER_FILES = {
    "kac_equilibrium": "kac/perfect.py",
    "kac_corners": "kac/perfect.py",
    "kac_probe": "boltzmann/kac_tree.py",
    "bkw": "boltzmann/bkw_tree.py",
    "bkw_fraction": "boltzmann/bkw_tree.py",
    "bkw_tree": "boltzmann/literal.py",
    "bkw_literal": "boltzmann/literal.py",
    "extinction": "boltzmann/null_collisions.py",
    "trap": "boltzmann/trap_tree.py",
    "trap_fraction": "boltzmann/trap_tree.py",
    "trap_energy": "boltzmann/trap_tree.py",
    "trap_literal": "boltzmann/literal_trap.py",
    "bkw_moment": "boltzmann/bkw_tree.py",
    "inverse_transform": "techniques/inverse_transform.py",
    "inversion": "techniques/inverse_transform.py",
    "rejection": "techniques/rejection.py",
    "identity": "techniques/identity.py",
    "injection": "techniques/injection.py",
    "outer_gas": "techniques/injection.py",
    "weighted_particles": "techniques/particles.py",
    "sphere_lattice": "techniques/integration.py",
    "sphere_points": "techniques/integration.py",
    "area": "techniques/integration.py",
}
# Measured: a collision, or a node of a tree, with all that belongs to it.
WORK_SECONDS = 3e-8
# Samplers that record runs, or are short whatever is asked: a file of theirs is drawn in one go.
UNSHARDED = ("kac_corners", "bkw_tree", "inverse_transform", "inversion", "rejection", "identity")
UNSHARDED += ("injection", "outer_gas", "weighted_particles")
UNSHARDED += ("sphere_lattice", "sphere_points", "area")
KERNEL_MODULES = tuple(dict.fromkeys([*ALGORITHM_FILES.values(), *SAMPLER_FILES.values()]))


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
        """Return the memory to ask for: 350, and 8 kB a replicate (histogram, file and buffers)."""
        return 350 + math.ceil(0.008 * len(self.replicates))

    def problems(self):
        """Return the list of what is wrong with the parameters and the size."""
        size = {"n_draws": self.n_draws, "n_replicates": self.n_replicates, "seed": self.seed}
        home = checks if hasattr(checks, self.sampler) else checks_techniques
        check = getattr(home, self.sampler)
        size_problems = [*checks.amount(**size), *self._shard_problems()]
        return [*check(**self.parameters), *size_problems]

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
