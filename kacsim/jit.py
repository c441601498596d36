"""The two numba decorators of the package, and where compiled kernels are kept.

numba's own cache does not notice an edited callee in another module, so the cache folder is
named by the hash of every source that holds a kernel, and by the versions of the compilers.
"""

import os
from pathlib import Path

import numba

from kacsim.provenance import KERNEL_SOURCES, source_hash, versions


def cache_folder():
    """Return the folder of compiled kernels: ``KACSIM_CACHE_DIR`` or the user's cache."""
    default = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "kacsim"
    root = Path(os.environ.get("KACSIM_CACHE_DIR") or default)
    compilers = versions().replace(", ", "-").replace(" ", "")
    return root / f"{source_hash(*KERNEL_SOURCES)}-{compilers}"


numba.config.CACHE_DIR = str(cache_folder())

# Called from Python: compiled once and kept. numpy's error model spares a zero test per division.
kernel = numba.njit(cache=True, error_model="numpy")

# Called from kernels: forced inlining spares an atomic reference count of the stream per call.
inlined = numba.njit(forceinline=True, error_model="numpy")
