"""The three numba decorators of the package."""

import numba

from kacsim.kernels import cache

# numpy's error model spares a test for zero at every division.
ERROR_MODEL = "numpy"


def kernel(function):
    """Compile a function that is called from Python, once, and keep it in the kernel cache."""
    return cache.cached(numba.njit(error_model=ERROR_MODEL)(function))


# Called from kernels: forced inlining spares an atomic reference count of the stream per call.
inlined = numba.njit(forceinline=True, error_model=ERROR_MODEL)

# Called from kernels for what is rare and long: inlining it everywhere would cost compile time.
apart = numba.njit(error_model=ERROR_MODEL)
