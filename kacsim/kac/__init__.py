"""Kac's one-dimensional model of a gas: samplers and exact results (the Kac paper)."""

import importlib

from kacsim.checks import ALGORITHMS, RATE

# Loaded at first use: formulas need no compiler, and kernels no special functions.
_HOME = {
    "cumulative": "exact",
    "density": "exact",
    "survival": "exact",
    "fourth_moment": "moments",
    "draw": "draws",
    "draw_equilibrium": "draws",
    "estimate_density": "probe",
}

__all__ = ["ALGORITHMS", "RATE", *_HOME]


def __getattr__(name):
    """Return a public function from the module that defines it."""
    if name in _HOME:
        return getattr(importlib.import_module(f"kacsim.kac.{_HOME[name]}"), name)
    raise AttributeError(f"module 'kacsim.kac' has no attribute '{name}'")
