"""What a dotted name in a module of the package stands for, wherever imports lead."""

import functools
import pkgutil

from kacsim.kernels import tables
from kacsim.kernels.provenance import PACKAGE

OUTSIDE = "what it computes are names for results, not results"


class UnknownError(LookupError):
    """A root or a name in the package that no module binds."""


@functools.cache
def table(module):
    """Return the tables of a module of the package (`trees.analysed`), None if there is none."""
    path = PACKAGE.parent.joinpath(*module.split("."))
    for file in (path.with_suffix(".py"), path / "__init__.py"):
        if file.is_file():
            return tables.of(file, module)
    return None


@functools.cache
def modules():
    """Return the names of all modules of the package."""
    files = (file.relative_to(PACKAGE.parent) for file in PACKAGE.rglob("*.py"))
    return sorted(".".join(file.with_suffix("").parts).removesuffix(".__init__") for file in files)


def resolve(module, path, local=()):
    """Yield what a dotted name in a module stands for; all of it, if several things bind it.

    Parameters
    ----------
    module : str
    path : list of str
    local : targets of the first name by imports inside the definition that reads it

    Yields
    ------
    (module, name) of a definition, (module, None) for all of a module, (dotted name, "") for what
    is of a library; nothing for a name of Python or of a function's own
    """
    known = table(module)
    if path[0] in known["definitions"]:
        yield module, path[0]
    for target in {*local, *known["aliases"].get(path[0], ())}:
        yield from follow(target, path[1:])


def follow(target, rest=()):
    """Yield, as `resolve`, what the attributes `rest` of the target of an import stand for."""
    *path, last = target.split(".")
    if target.split(".")[0] != PACKAGE.name:
        yield ".".join([target, *rest]), ""
        return
    home, parts = ".".join(path), [last, *rest]
    if not path:
        home, parts = parts[0], parts[1:]
    if table(home) is None:
        raise UnknownError(f"{target}: no module of {PACKAGE.name} binds it")
    while parts and table(f"{home}.{parts[0]}") is not None:
        itself = [f"{home}.{parts[0]}"]
        if parts[0] in table(home)["definitions"] or _alias(home, parts[0]) not in ([], itself):
            yield from resolve(home, parts)  # a package may give a submodule's name to its content
        home = f"{home}.{parts.pop(0)}"
    if len(parts) > len(rest) and not (binds(home, last) or binds(home, "__getattr__")):
        raise UnknownError(f"{target}: {home} binds no {last}")
    # An attribute that no statement of the module binds may be any of what the module holds.
    yield from list(resolve(home, parts)) if parts and binds(home, parts[0]) else [(home, None)]


def _alias(module, name):
    return table(module)["aliases"].get(name, [])


def binds(module, name):
    """Tell whether a statement of a module binds a name."""
    return name in table(module)["definitions"] or name in table(module)["aliases"]


def dispatched(package, module, attribute):
    """Yield what a look-up by name may find: a module that is not written may be any one."""
    folder = PACKAGE.parent.joinpath(*package.split("."))
    found = [module] if module else [one.name for one in pkgutil.iter_modules([str(folder)])]
    for name in (f"{package}.{one}" for one in found):
        if table(name) is not None and binds(name, attribute):
            yield from resolve(name, [attribute])


@functools.cache
def imported(module):
    """Return the modules of the package that importing a module imports, itself among them."""
    seen, waiting = set(), [module]
    while waiting:
        one = waiting.pop()
        if one in seen or table(one) is None:
            continue
        seen.add(one)
        waiting.append(one.rpartition(".")[0])
        for target in table(one)["imports"]:
            while target and table(target) is None:
                target = target.rpartition(".")[0]
            waiting.append(target)
    return frozenset(seen)
