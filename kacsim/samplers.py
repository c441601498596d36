"""What a sampler is, told once: the command line, checks, ids, jobs and tests read it here.

Every family of samplers (a folder with a module ``samplers``) declares its own; they are found by
that name. Nothing heavy is imported: Snakemake reads the declarations at every start.
"""

import dataclasses
import difflib
import functools
import importlib
import math
import pkgutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from kacsim.checks import Problem, each

OUTSIDE = "a case carries every value that its declaration sets"
REQUIRED = object()  # default of a parameter that has none
REPLICATE_MEGABYTES = 0.008


def real(text):
    """Return a word of the command line as a float; what is none stays, for a check to refuse."""
    try:
        return float(text)
    except ValueError:
        return text


def whole(text):
    """Return a word of the command line as an integer; what is none stays."""
    try:
        return int(text)
    except ValueError:
        return text


def whole_or_infinite(text):
    """Return an integer, or infinity for ``inf``; what is neither stays."""
    return math.inf if text == "inf" else whole(text)


@dataclass(frozen=True)
class Parameter:
    """One parameter of a sampler.

    Attributes
    ----------
    name, short : str, its name, and what stands before its value in a case's id
    meaning : str, one line of help
    check : callable(name, value) that yields problems; of each value if there are many
    default : REQUIRED, or the value that need not be given
    kind : callable that reads a word of the command line; what it cannot read it returns as it is,
        for the check to refuse by name
    many : bool, a list of values
    whole : callable(name, values) that yields problems of a list as such
    shown : bool, part of the id even where it has its default
    settle : callable(value) -> what a case keeps of it, if that is not the value itself
    token : callable(value) -> its part of the id, if that is not the value itself
    """

    name: str
    short: str
    meaning: str
    check: Callable
    default: object = REQUIRED
    kind: Callable = str
    many: bool = False
    whole: Callable | None = None
    shown: bool = False
    settle: Callable | None = None
    token: Callable | None = None

    def problems(self, value):
        """Return the list of what is wrong with a value."""
        if self.many:
            found = list(each(self.name, value, self.check))
            return found or list(self.whole(self.name, value) if self.whole else ())
        return list(self.check(self.name, value))

    def is_shown(self, value):
        """Tell whether a value stands in the id and in the recipe."""
        return self.shown or self.default is REQUIRED or value != self.default


@dataclass(frozen=True)
class Variant:
    """One of several algorithms of a sampler: its kernels are the module of its name.

    Attributes
    ----------
    name, title : str, as in a configuration, and as in a figure
    parameters : tuple of Parameter that not every variant has
    check : callable(**parameters) that yields the problems of these together
    tiny : dict, values of its own parameters that make the smallest case
    """

    name: str
    title: str
    parameters: tuple = ()
    check: Callable | None = None
    tiny: dict = dataclasses.field(default_factory=dict)


@dataclass(frozen=True)
class Sampler:
    """One kind of sample.

    Attributes
    ----------
    name : str
    draws : str, what it draws, for help
    parameters : tuple of Parameter, in the order of ids
    tiny : tuple of dict, the smallest parameters, several where kernels differ
    kernels : str, module of the family that holds the kernels; "" if each variant has its own
    entries : callable(parameters) -> names of that module that the sampler looks up
    beside : callable(parameters) -> (module of the family, name) of what else it looks up
    check : callable(**parameters) that yields the problems of values that are each right
    work : callable(parameters) -> dict of what one draw takes, such as its collisions or nodes;
        ``call`` is how often a replicate starts to draw. `kacsim.costs` knows how long each takes
    replicate_megabytes : callable(parameters) -> memory of one replicate's counts
    by_replicate : bool, replicates are independent of each other: they can be drawn in shards
    variants : tuple of Variant, the values of the first parameter
    variant_place : int, place among the parameters where those of a variant stand
    engines : tuple of str, the values of the parameter ``engine`` of a sampler with variants
    streaming : str, function of the family's ``sampling`` that streams a case; ``sample_{name}``
        if not given
    family : str, the folder that declares it; set by `registry`
    """

    name: str
    draws: str
    parameters: tuple
    tiny: tuple
    kernels: str = ""
    entries: Callable = lambda parameters: ()
    beside: Callable = lambda parameters: ()
    check: Callable | None = None
    work: Callable = lambda parameters: {"draw": 1.0}
    replicate_megabytes: Callable = lambda parameters: REPLICATE_MEGABYTES
    by_replicate: bool = True
    streaming: str = ""
    variants: tuple = ()
    variant_place: int = 0
    engines: tuple = ()
    family: str = ""

    def parameters_of(self, given):
        """Return the parameters of a case, its variant's among them (of all, if it is unknown)."""
        name = given.get(self.parameters[0].name) if self.variants else None
        mine = [variant for variant in self.variants if variant.name == name]
        more = [parameter for variant in mine or self.variants for parameter in variant.parameters]
        unique = {parameter.name: parameter for parameter in more}
        place = self.variant_place
        return (*self.parameters[:place], *unique.values(), *self.parameters[place:])

    def complete(self, given):
        """Return the parameters of a case: those given, and defaults for the others.

        Raises
        ------
        ValueError
            Names a parameter that the sampler, or its variant, does not have.
        """
        known = {parameter.name: parameter for parameter in self.parameters_of(given)}
        for name, value in given.items():
            if name not in known and value is not None:
                near = difflib.get_close_matches(name, known, n=1)
                hint = f"did you mean {near[0]}?" if near else f"it has {', '.join(known)}"
                owner = given[self.parameters[0].name] if self.variants else self.name
                problem = Problem(name, value, f"{owner} has no such parameter; {hint}")
                raise ValueError(str(problem))
        complete = {}
        for name, parameter in known.items():
            default = None if parameter.default is REQUIRED else parameter.default
            value = given.get(name)
            if value is not None and parameter.settle:
                value = parameter.settle(value)
            complete[name] = default if value is None else value
        return complete

    def problems(self, parameters):
        """Return what is wrong with a case's parameters, each and then together."""
        first = parameters[self.parameters[0].name] if self.variants else None
        unknown = self.variants and first not in [variant.name for variant in self.variants]
        found = [
            problem
            for parameter in (self.parameters if unknown else self.parameters_of(parameters))
            if parameter.default is not None or parameters[parameter.name] is not None
            for problem in parameter.problems(parameters[parameter.name])
        ]
        if not found and self.check:
            found += self.check(**parameters)
        for variant in self.variants:
            if not found and variant.check and variant.name == first:
                found += variant.check(**parameters)
        return found

    def kernel_module(self, parameters):
        """Return the module that holds the kernels, such as ``kacsim.kac.bird``."""
        return f"kacsim.{self.family}.{self.kernels or parameters[self.parameters[0].name]}"

    def roots(self, parameters):
        """Return (module, name) of what draws: the function that streams, and what it looks up."""
        streaming = self.streaming or f"sample_{self.name}"
        module = self.kernel_module(parameters)
        looked_up = ((module, entry) for entry in self.entries(parameters))
        family = f"kacsim.{self.family}"
        others = ((f"{family}.{one}", name) for one, name in self.beside(parameters))
        return ((f"{family}.sampling", streaming), *looked_up, *others)


@functools.cache
def families():
    """Return the names of the families: the folders that declare samplers."""
    folder = Path(__file__).parent
    return [
        found.name
        for found in pkgutil.iter_modules([str(folder)])
        if found.ispkg and (folder / found.name / "samplers.py").exists()
    ]


@functools.cache
def registry():
    """Return name -> Sampler of all families."""
    found = {}
    for family in families():
        home = importlib.import_module(f"kacsim.{family}.samplers")
        for sampler in home.SAMPLERS:
            found[sampler.name] = dataclasses.replace(sampler, family=family)
    return found


def declared(sampler, parameters):
    """Yield the problems of parameters that a sampler declares: for functions that have some."""
    known = {one.name: one for one in registry()[sampler].parameters}
    for name, value in parameters.items():
        yield from known[name].problems(value)
