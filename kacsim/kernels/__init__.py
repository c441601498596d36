"""Compiling: decorators, the cache of compiled kernels, and what a result depends on."""
