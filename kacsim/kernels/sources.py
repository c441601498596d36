"""What a result depends on, derived from the syntax trees of the package.

A *definition* is what a module binds at its top level: a function, a class, a constant. From its
roots (the code of a case or of an item's stage) a result reaches definitions by the names that
these use, through imports at any depth, lazy modules and dispatch by name. Their trees, without
docstrings, comments, annotations and the messages of errors, are hashed, with what their names
stand for and with the versions of the libraries that they import. A module that sets ``OUTSIDE``
decides nothing by its code: of it only the constants that are used count, by their values.

What cannot be followed counts whole, as a module that is handed on, or is refused: code that is
found by a name which stands nowhere, and constants that are changed from elsewhere.
"""

import functools
import hashlib
import importlib.metadata
import importlib.util
import sys

from kacsim.kernels import names, tables
from kacsim.kernels.names import UnknownError
from kacsim.kernels.provenance import version, versions
from kacsim.kernels.scopes import CALLED

OUTSIDE = "what it computes are names for results, not results"

# What imports a module by a name that it is given: such modules are roots (`kacsim.jobs.stages`).
BY_ROOTS = frozenset([("kacsim.items", "load")])
# What finds code by a name, in Python and in its library.
FINDERS = ("__import__", "compile", "eval", "exec", "globals", "vars")
LIBRARIES = ("builtins", "gc", "importlib", "inspect", "lazy_loader", "pickle", "pkgutil", "runpy")
LIBRARIES += ("sys._getframe", "sys.modules")
HARMLESS = ("importlib.metadata", "lazy_loader.attach")
RENAMED = {"yaml": "PyYAML"}  # to look such names up takes a tenth of a second
PLAIN = (str, bytes, bool, int, float, complex, type(None))


class UnfollowedError(LookupError):
    """Code that a result depends on in a way that its tree does not show."""


@functools.cache
def _used(module, name):
    """Return name as written -> sorted (module, name) that one definition uses by it."""
    entry = names.table(module)["definitions"][name]
    found = {}
    for path in entry["uses"]:
        local = entry["aliases"].get(path[0], ())
        found[".".join(path)] = names.resolve(module, path, local)
    for words in entry["dispatches"]:
        found[" ".join(map(str, words))] = names.dispatched(*words)
    for target in entry["whole"]:
        found[target] = names.follow(target)
    found = {text: sorted(set(ends), key=str) for text, ends in found.items()}
    if (module, name) not in BY_ROOTS:
        for reason in _unfollowed(module, entry, found):
            raise UnfollowedError(f"{module}.{name}: {reason}: cannot be followed")
    return {text: ends for text, ends in found.items() if ends}


def _unfollowed(module, entry, found):
    """Yield what a definition does that its tree does not show."""
    yield from entry["unfollowed"]
    if "*" in {*entry["aliases"], *names.table(module)["aliases"]}:
        yield "import *"
    for text, ends in found.items():
        if not ends and text.split(".")[0] in FINDERS:
            yield text
        for target, name in ends:
            if name == "" and _within(target, LIBRARIES) and not _within(target, HARMLESS):
                yield target


def _within(target, tops):
    return any(target == top or target.startswith(f"{top}.") for top in tops)


@functools.cache
def _changed():
    """Return (module, name) -> who changes it, when a function runs or from another module."""
    found = {}
    for module in names.modules():
        known = names.table(module)
        for name, entry in known["definitions"].items():
            for kind, later, path in entry["changes"]:
                for home, end in names.resolve(module, path, entry["aliases"].get(path[0], ())):
                    elsewhere = home != module or later
                    if end != "" and elsewhere and _may_change(kind, known, home, end):
                        found[home, end] = f"{module}.{name}"
    return found


def _may_change(kind, known, home, name):
    """Tell whether a definition that `known` holds may change what a name stands for.

    A call changes no function and no module; what lies outside may keep things for itself.
    """
    table = names.table(home)
    if known["outside"] and table["outside"]:
        return False
    changeable = name is not None and table["definitions"][name]["kind"] != "function"
    return kind != CALLED or changeable


@functools.cache
def closure(roots):
    """Return what the roots reach.

    Parameters
    ----------
    roots : frozenset of (module, name); name None stands for all of a module

    Returns
    -------
    (frozenset of (module, name), frozenset of libraries)

    Raises
    ------
    UnknownError
        Names a root that does not exist: it would depend on nothing, silently.
    UnfollowedError
        Names a definition that reaches more than its tree shows.
    """
    seen, libraries, done, waiting = set(), set(), set(), [*roots]
    while waiting:
        module, name = one = waiting.pop()
        if one in done:
            continue
        done.add(one)
        if name == "":
            libraries.add(module.split(".")[0])
            continue
        waiting += _with(module, name)
        if name is None or name not in names.table(module)["definitions"]:
            continue
        seen.add(one)
        if not names.table(module)["outside"]:
            for place in (one, (module, None)):
                if place in _changed():
                    raise UnfollowedError(f"{module}.{name}: is changed by {_changed()[place]}")
            for ends in _used(module, name).values():
                waiting += ends
    return frozenset(seen), frozenset(libraries)


def _with(module, name):
    """Yield what counts with a name of a module: what its import does, what the name stands for."""
    known = names.table(module)
    if known is None or (name is not None and not names.binds(module, name)):
        raise UnknownError(f"{module}: binds no {name}")
    yield from _effects(module)
    if name is not None:
        yield from names.resolve(module, [name])
        return
    for other in {*known["definitions"], *known["aliases"]}:
        yield from names.resolve(module, [other])
    yield from ((one, None) for one in names.modules() if one.rpartition(".")[0] == module)


@functools.cache
def _effects(module):
    """Return the statements that do more than to bind names when a module is imported."""
    inside = (one for one in names.imported(module) if not names.table(one)["outside"])
    return [(one, effect) for one in inside for effect in names.table(one)["effects"]]


def code(roots):
    """Return 16 hex digits that change when something that the roots depend on does.

    Parameters
    ----------
    roots : (module, name) of definitions
    """
    return _code(frozenset(roots))


@functools.cache
def _code(roots):
    definitions, libraries = closure(roots)
    found = {one for library in libraries for one in _distributions(library)}
    digest = hashlib.sha256(versions(sorted(found)).encode())
    for module, name in sorted(definitions):
        digest.update(f"{module}.{name} {_digest(module, name)}\n".encode())
    tables.keep()
    return digest.hexdigest()[:16]


@functools.cache
def _distributions(library):
    """Return the installed distributions that hold a library, none if it is Python's own."""
    if library in sys.stdlib_module_names:
        return ()
    library = RENAMED.get(library, library)
    if version(library) == "none":  # it has another name than its distribution, or is not there
        found = importlib.metadata.packages_distributions().get(library)
        if not found and importlib.util.find_spec(library):
            raise UnknownError(f"{library}: is neither of the package nor installed")
        return tuple(found or (library,))
    return (library, "llvmlite") if library == "numba" else (library,)


@functools.cache
def _digest(module, name):
    """Return the digest of a definition, or the value of a constant that lies outside."""
    entry = names.table(module)["definitions"][name]
    if not names.table(module)["outside"]:
        return f"{entry['digest']} {sorted(_used(module, name).items())}"
    if entry["kind"] != "constant":
        return ""
    return plain(getattr(importlib.import_module(module), name), f"{module}.{name}")


def plain(value, name):
    """Return a plain value as text, the same in every process.

    Raises
    ------
    UnfollowedError
        If the text would not say all of the value, as that of a long array or of a function.
    """
    if isinstance(value, dict):
        pairs = [(plain(key, name), plain(one, name)) for key, one in value.items()]
        return f"{type(value).__name__}{pairs}"
    if isinstance(value, (tuple, list)):
        return f"{type(value).__name__}{[plain(one, name) for one in value]}"
    if isinstance(value, (set, frozenset)):
        return f"{type(value).__name__}{sorted(plain(one, name) for one in value)}"
    if not isinstance(value, PLAIN):
        raise UnfollowedError(f"{name}: is no plain value, which results could depend on")
    return repr(value)
