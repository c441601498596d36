"""The four numba decorators of the package."""

import numba

from kacsim.kernels import cache

# numpy's error model spares a test for zero at every division.
ERROR_MODEL = "numpy"


def kernel(function):
    """Compile a function that is called from Python, once, and keep it in the kernel cache."""
    return cache.cached(numba.njit(error_model=ERROR_MODEL)(function))


# Called from kernels. It borrows the arrays that it is given: counting a reference would take an
# atomic addition each time. So it can neither make nor return an array.
inlined = numba.njit(forceinline=True, _nrt=False, error_model=ERROR_MODEL)

# Called from kernels for what is rare and long: inlining it everywhere would cost compile time.
apart = numba.njit(_nrt=False, error_model=ERROR_MODEL)

# Called from kernels, before their loops: it may make arrays.
allocating = numba.njit(error_model=ERROR_MODEL)
