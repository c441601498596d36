"""What a result depends on, derived from the syntax trees of the package.

A *definition* is what a module binds at its top level: a function, a class, a constant. From its
roots (the code of a case or of an item's stage) a result reaches definitions by the names that
these use, through imports at any depth, lazy modules and dispatch by name. Their trees, without
docstrings, comments, annotations and the messages of errors, are hashed, with the versions of the
libraries that they import. A module that sets ``OUTSIDE`` decides nothing by its code: of it only
the constants that are used count, by their values.
"""

import functools
import hashlib
import importlib
import pkgutil

from kacsim.kernels import trees
from kacsim.kernels.provenance import PACKAGE, versions

OUTSIDE = "what it computes are names for results, not results"


class UnknownError(LookupError):
    """A root or a name in the package that no module binds."""


@functools.cache
def _module(name):
    """Return the tables of a module of the package (`trees.tables`), None if there is none."""
    path = PACKAGE.parent.joinpath(*name.split("."))
    for file in (path.with_suffix(".py"), path / "__init__.py"):
        if file.is_file():
            return trees.tables(file, name)
    return None


def _resolve(module, path):
    """Yield what a dotted name in a module stands for.

    Yields
    ------
    (module, name) of a definition, (module, None) for all of a module, (library, "") for one that
    is not of the package
    """
    table = _module(module)
    if path[0] in table["definitions"]:
        yield module, path[0]
    elif path[0] in table["aliases"]:
        yield from _follow(table["aliases"][path[0]], path[1:])


def _follow(target, rest):
    """Yield what the attributes `rest` of a dotted target stand for."""
    top = target.split(".")[0]
    if top != "kacsim":
        yield top, ""
        return
    while _module(target) is None:  # the last part is a name in a module
        target, _, name = target.rpartition(".")
        rest = (name, *rest)
        if not target:
            return
    if not rest:
        yield target, None
    elif _module(f"{target}.{rest[0]}") is not None:
        yield from _follow(f"{target}.{rest[0]}", rest[1:])
    else:
        yield from _resolve(target, rest)


def _dispatched(package, attribute):
    """Yield (module, attribute) for every module of a package that binds the attribute."""
    for found in pkgutil.iter_modules([str(PACKAGE.parent.joinpath(*package.split(".")))]):
        name = f"{package}.{found.name}"
        if not found.ispkg and attribute in _module(name)["definitions"] | _module(name)["aliases"]:
            yield name, attribute


@functools.cache
def _used(module, name):
    """Return the frozenset of what one definition uses."""
    entry = _module(module)["definitions"][name]
    found = set()
    for path in entry["uses"]:
        local = entry["aliases"].get(path[0])
        found.update(_follow(local, path[1:]) if local else _resolve(module, path))
    for package, attribute in entry["dispatches"]:
        found.update(_dispatched(package, attribute))
    return frozenset(found)


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
    """
    seen, libraries, waiting = set(), set(), list(roots)
    while waiting:
        module, name = waiting.pop()
        if name == "":
            libraries.add(module)
            continue
        table = _module(module)
        if table is None or (name is not None and name not in table["definitions"]):
            found = [*_resolve(module, (name,))] if table else []
            if not found:
                raise UnknownError(f"{module}: binds no {name}")
            waiting += found
            continue
        effects = () if table["outside"] else table["effects"]
        names = [*table["definitions"]] if name is None else [name, *effects]
        for one in names:
            if (module, one) not in seen:
                seen.add((module, one))
                if not table["outside"]:
                    waiting += _used(module, one)
    return frozenset(seen), frozenset(libraries)


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
    compilers = {"llvmlite"} if "numba" in libraries else set()
    digest = hashlib.sha256(versions(sorted(libraries | compilers)).encode())
    for module, name in sorted(definitions):
        digest.update(f"{module}.{name} {_digest(module, name)}\n".encode())
    trees.keep()
    return digest.hexdigest()[:16]


def _digest(module, name):
    """Return the digest of a definition, or of the value of a constant that lies outside."""
    table = _module(module)
    entry = table["definitions"][name]
    if not table["outside"]:
        return entry["digest"]
    if not entry["constant"]:
        return ""
    return repr(getattr(importlib.import_module(module), name))
