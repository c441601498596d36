"""Reproducible Monte Carlo experiments on Kac's model and the Boltzmann equation."""

import importlib

__version__ = "0.1.0"

_PUBLIC = ("boltzmann", "kac")


def __getattr__(name):
    """Load the numba-backed subpackages on first use, so that planning stays light."""
    if name in _PUBLIC:
        return importlib.import_module(f"kacsim.{name}")
    raise AttributeError(f"module 'kacsim' has no attribute '{name}'")
