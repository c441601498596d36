"""Where compiled kernels are kept, and checksums of them.

numba's own cache does not notice an edited callee in another module, and where it cannot write it
goes, silently, to a folder beside the source. The folder of a kernel is therefore named by the
`kacsim.kernels.sources.code` of the kernel as it is built: everything that is compiled into it.

numba reads its cache without a check, and machine code with a flipped bit must not draw anything.
Whoever compiles leaves the checksums of the folder; whoever loads compares them first, and
compiles again what does not fit. A folder without checksums is left alone: another process may be
compiling there.
"""

import contextlib
import functools
import hashlib
import json
import os
import sys
import tempfile
import time
from pathlib import Path

from numba.core import caching, config

from kacsim.kernels import folder, sources

OUTSIDE = "a kernel from the cache is the kernel that would be compiled"

CHECKSUMS = "checksums.json"
PATIENCE = 0.2  # seconds between another process saving code and sealing it, twice


def roots_of(function):
    """Return (roots, values) that a kernel is compiled from.

    Parameters
    ----------
    function : Python function; what it encloses, such as the law of a collision, counts too

    Returns
    -------
    (frozenset of (module, name), list of str)
    """
    roots, values = {(function.__module__, function.__qualname__.split(".")[0])}, []
    for name, cell in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
        enclosed = cell.cell_contents
        inner = getattr(enclosed, "py_func", enclosed)
        if callable(inner):
            more, inner_values = roots_of(inner)
            roots |= more
            # Two may reach the same definitions, and enclose each other's choice.
            values += [f"{name} = {inner.__module__}.{inner.__qualname__}", *inner_values]
        else:
            values.append(f"{name} = {sources.plain(enclosed, name)}")
    for default in (function.__defaults__, function.__kwdefaults__):
        values.append(sources.plain(default, f"a default of {function.__qualname__}"))
    return frozenset(roots), values


def key(function):
    """Return the hash of everything that a kernel is compiled from."""
    roots, values = roots_of(function)
    code = sources.code(roots)
    return hashlib.sha256("\n".join([code, *values]).encode()).hexdigest()[:16]


def written(function):
    """Return the hash of the bytecode of a function and of those that it encloses."""
    code = function.__code__
    constants = [one for one in code.co_consts if type(one) in sources.PLAIN]
    if constants[:1] == [function.__doc__]:
        del constants[0]
    parts = [code.co_code.hex(), repr(code.co_names), repr(constants)]
    for cell in function.__closure__ or ():
        inner = getattr(cell.cell_contents, "py_func", cell.cell_contents)
        if hasattr(inner, "__code__"):
            parts.append(written(inner))
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


class Locator:
    """Tells numba where the code of a kernel lies: a folder named by its key."""

    def __init__(self, function):
        self._key = key(function)

    @classmethod
    def from_function(cls, function, file):
        """Return the locator of a function; numba's interface."""
        return cls(function)

    def ensure_cache_path(self):
        """Make the folder."""
        os.makedirs(self.get_cache_path(), exist_ok=True)

    def get_cache_path(self):
        """Return the folder."""
        return str(folder.root() / self._key)

    def get_source_stamp(self):
        """Return what makes code stale: nothing, for the folder's name says it all."""
        return self._key

    def get_disambiguator(self):
        """Return what tells functions of one name apart: lines move, keys do not."""
        return "kernel"


class _Files(caching.CompileResultCacheImpl):
    _locator_classes = (Locator,)


class _Cache(caching.FunctionCache):
    """numba's cache of one function, in a checked folder."""

    _impl_class = _Files

    def __init__(self, function):
        super().__init__(function)
        repair(Path(self.cache_path))

    def _index_key(self, signature, codegen):
        """Return what tells compiled code of one folder apart.

        numba would hash what the function encloses as pickled, and a compiled function is pickled
        with a number of its process: its code would never be found.
        """
        return signature, codegen.magic_tuple(), written(self._py_func)

    def save_overload(self, signature, data):
        """Save compiled code and seal the folder."""
        with contextlib.suppress(OSError):  # a full disk: compiled again by the next process
            super().save_overload(signature, data)
            seal(Path(self.cache_path))


def cached(dispatcher):
    """Return a compiled function that keeps its machine code."""
    if config.DISABLE_JIT:  # it is the plain function
        return dispatcher
    dispatcher._cache = _Cache(dispatcher.py_func)
    return dispatcher


def _compiled(place):
    return {
        file.name: hashlib.sha256(file.read_bytes()).hexdigest()
        for file in sorted(place.glob("*.nb[ic]"))
    }


def seal(place):
    """Write the checksums of the compiled code in a folder."""
    handle, name = tempfile.mkstemp(dir=place, prefix=".checksums-")
    with os.fdopen(handle, "w", encoding="utf-8") as file:
        json.dump(_compiled(place), file)
    os.replace(name, place / CHECKSUMS)


@functools.cache
def repair(place):
    """Remove the compiled code of a folder if it does not fit its checksums.

    Returns
    -------
    bool, whether something was removed: it is compiled again at its first call
    """
    for wait in (PATIENCE, PATIENCE, 0.0):
        try:
            text = (place / CHECKSUMS).read_text(encoding="utf-8")
            found = _compiled(place)
        except OSError:
            return False
        if text == json.dumps(found):
            return False
        time.sleep(wait)
    for name in (*found, CHECKSUMS):
        (place / name).unlink(missing_ok=True)
    print(f"{place}: damaged kernels are compiled again", file=sys.stderr)
    return True
