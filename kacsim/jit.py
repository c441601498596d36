"""The two numba decorators of the package, and where compiled kernels are kept.

numba's own cache does not notice an edited callee in another module, so the cache folder of a
kernel is named by the hash of every source that it may call, and by the versions of the compilers.
"""

import os
from pathlib import Path

import numba

from kacsim import kernel_cache
from kacsim.provenance import PACKAGE, source_hash, versions

# Sources that kernels of all modules call; a folder's model.py is called by its other modules.
COMMON_SOURCES = ("jit.py", "streams.py", "variates.py")


def kernel_sources(module):
    """Return the sources that the kernels of a module are compiled from.

    Parameters
    ----------
    module : path relative to the package, such as "kac/bird.py"
    """
    model = (Path(module).parent / "model.py").as_posix()
    called = (model,) if (PACKAGE / model).exists() and model != module else ()
    if module == "techniques/identity.py":  # it calls another folder's model
        called += ("kac/model.py",)
    return (*COMMON_SOURCES, *called, module)


def cache_folder(module):
    """Return the folder of a module's compiled kernels.

    It lies below ``KACSIM_CACHE_DIR`` or, without that, the user's cache.
    """
    default = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "kacsim"
    root = Path(os.environ.get("KACSIM_CACHE_DIR") or default)
    compilers = versions().replace(", ", "-").replace(" ", "")
    return root / f"{source_hash(*kernel_sources(module))}-{compilers}"


def kernel(function):
    """Compile a function that is called from Python, once, and keep it in the kernel cache.

    numpy's error model spares a test for zero at every division.
    """
    module = Path(function.__code__.co_filename).relative_to(PACKAGE).as_posix()
    numba.config.CACHE_DIR = str(cache_folder(module))
    compiled = numba.njit(cache=True, error_model="numpy")(function)
    kernel_cache.watch(compiled)
    return compiled


# Called from kernels: forced inlining spares an atomic reference count of the stream per call.
inlined = numba.njit(forceinline=True, error_model="numpy")
