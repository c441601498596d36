"""Where compiled code counts references to arrays, and what functions without references return.

A function of `kacsim.kernels.jit.inlined` or `apart` borrows its arrays. If it returned one, the
caller would give back a reference that nobody took; a kernel that counted references in a loop
would spend an atomic addition on each.
"""

import gc
import re

from numba.core import types
from numba.core.dispatcher import Dispatcher

NAME = r'("[^"]*"|[\w.$-]+)'
DEFINED = re.compile(rf"^define [^\n]*?@{NAME}\([^\n]*\{{\n(.*?)^\}}", re.MULTILINE | re.DOTALL)
LABEL, TARGET = re.compile(rf"^{NAME}:"), re.compile(rf"label %{NAME}")
COUNT = re.compile(r"@(NRT_(?:incref|decref))\(|\b(atomicrmw|cmpxchg)\b")


def blocks(body):
    """Return name -> lines of the basic blocks of a function in LLVM's language."""
    found, name = {"": []}, ""
    for line in body.splitlines():
        if label := LABEL.match(line):
            name = label[1]
            found[name] = []
        else:
            found[name].append(line)
    return found


def reachable(starts, after):
    """Return all blocks that can follow the given ones, those themselves only if they do."""
    found, waiting = set(), [one for start in starts for one in after[start]]
    while waiting:
        one = waiting.pop()
        if one not in found:
            found.add(one)
            waiting += after[one]
    return found


def counted_in_loops(llvm):
    """Return what counts references in blocks that may follow themselves, as written in LLVM."""
    counted = []
    for _, body in DEFINED.findall(llvm):
        lines = blocks(body)
        after = {name: TARGET.findall("\n".join(block)) for name, block in lines.items()}
        for name, block in lines.items():
            here = ["".join(one) for one in COUNT.findall("\n".join(block))]
            if here and name in reachable([name], after):
                counted += here
    return sorted(counted)


def holds_an_array(kind):
    """Return whether a type of numba is an array or a tuple in which there is one."""
    if isinstance(kind, types.BaseTuple):
        return any(map(holds_an_array, kind.types))
    return isinstance(kind, types.Array)


def borrowers():
    """Return name -> types returned, of what has been compiled without references."""
    found = {}
    for one in gc.get_objects():
        # A weak reference to what is gone cannot be asked for its class.
        if issubclass(type(one), Dispatcher) and one.targetoptions.get("_nrt") is False:
            name = f"{one.py_func.__module__}.{one.py_func.__qualname__}"
            kinds = [signature.return_type for signature in one.nopython_signatures]
            found.setdefault(name, []).extend(kinds)
    return found
