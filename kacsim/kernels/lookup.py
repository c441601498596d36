"""Looking modules up by name: the forms that `kacsim.kernels.trees` can follow."""

import importlib

OUTSIDE = "the trees name what is looked up"


class _Lazy:
    def __init__(self, name):
        self._name = name

    def __getattr__(self, attribute):
        return getattr(importlib.import_module(self._name), attribute)


def lazy(module):
    """Return a module that is imported at its first use: the plan reads items at every start."""
    return _Lazy(module)


def named(package, module, attribute):
    """Return what a module of a package, found by its name, binds to an attribute.

    Where package and attribute are literals what they name counts as used: in the module, or, if
    that is no literal, in every module of the package. Where package or attribute is none, what
    is looked up must be a root of its own. The function itself must not be handed on.
    """
    return getattr(importlib.import_module(f"{package}.{module}"), attribute)
