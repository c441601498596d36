"""What the code of a definition may load, whether it runs or not: from its bytecode.

This is a second derivation, that shares nothing with `kacsim.kernels.trees`: Python's compiler says
which names are global, and the imported modules say what they hold.
"""

import __future__

import ast
import copy
import dis
import importlib
import sys
from types import CodeType, ModuleType

from tracer import LOADS, READ, definitions, statements

LOCAL = ("LOAD_FAST", "LOAD_DEREF", "LOAD_CLASSDEREF")
ATTRIBUTE = ("LOAD_ATTR", "LOAD_METHOD")


class _WithoutMessages(ast.NodeTransformer):
    """Take out what errors say, which changes no result."""

    def visit_Raise(self, node):
        if isinstance(node.exc, ast.Call):
            node.exc.args, node.exc.keywords = [], []
        node.cause = None
        return node


def loads(module, name):
    """Return {(module, name)} of the package that one definition may load.

    Parameters
    ----------
    module, name : of a module that is imported
    """
    found = set()
    for one in statements(module):
        if name in one.names and not one.is_import:
            tree = ast.Module([_WithoutMessages().visit(copy.deepcopy(one.node))], [])
            flags = __future__.annotations.compiler_flag
            code = compile(tree, module, "exec", flags, dont_inherit=True)
            found |= set(_loaded(code, module, {}))
    return found


def _loaded(code, module, around):
    """Yield what a code object loads, and those inside it.

    Parameters
    ----------
    around : dict local name -> what an import has bound it to, of the functions around it
    """
    steps = [i for i in dis.get_instructions(code) if i.opname not in ("CACHE", "PRECALL")]
    local = around | dict(_imported(steps))
    for k, step in enumerate(steps):
        if step.opname in LOADS and step.argval in vars(sys.modules[module]):
            yield from definitions(READ, module, step.argval)
            yield from _attributes(vars(sys.modules[module])[step.argval], steps[k + 1 :])
        elif step.opname in LOCAL and step.argval in local:
            value, origin = local[step.argval]
            yield from origin
            yield from _attributes(value, steps[k + 1 :])
    for inner in code.co_consts:
        if isinstance(inner, CodeType):
            yield from _loaded(inner, module, local)


def _imported(steps):
    """Yield (local name, (value, definitions that it stands for)) of imports in a function."""
    home = None
    for step, after in zip(steps, [*steps[1:], None], strict=True):
        if step.opname == "IMPORT_NAME":
            home = step.argval
            if after.opname.startswith("STORE"):
                yield after.argval, (sys.modules.get(home.split(".")[0]), ())
        elif step.opname == "IMPORT_FROM" and home.split(".")[0] == "kacsim":
            value = _get(home, step.argval)
            origin = () if isinstance(value, ModuleType) else [*_named(home, step.argval)]
            yield after.argval, (value, origin)


def _attributes(value, steps):
    """Yield what the attributes of a module are, if a value is one."""
    for step in steps:
        if type(value).__name__ == "_Lazy":
            value = importlib.import_module(object.__getattribute__(value, "_name"))
        if not isinstance(value, ModuleType) or value.__name__.split(".")[0] != "kacsim":
            return
        if step.opname not in ATTRIBUTE:  # the module is handed on: any of its names may be read
            for one in statements(value.__name__):
                yield from ((value.__name__, name) for name in one.names if not one.is_import)
            return
        home, value = value.__name__, _get(value.__name__, step.argval)
        if not isinstance(value, ModuleType):
            yield from _named(home, step.argval)


def _get(home, name):
    """Return what a module holds under a name, a submodule perhaps."""
    module = importlib.import_module(home)
    return (
        getattr(module, name)
        if hasattr(module, name)
        else importlib.import_module(f"{home}.{name}")
    )


def _named(home, name):
    """Yield the definition that a module's attribute is, also if a package has it from a module."""
    value = getattr(importlib.import_module(home), name)
    bound = any(name in one.names for one in statements(home))
    yield from definitions(READ, home, name)
    if not bound and not name.startswith("__"):
        value = getattr(value, "py_func", value)
        yield value.__module__, value.__name__
