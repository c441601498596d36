"""The Boltzmann equation probed by branching trees: estimators and exact results."""

import importlib

# Loaded at first use: formulas need no compiler.
_HOME = {
    "BudgetError": "estimators",
    "Estimate": "estimators",
    "estimate_bkw": "estimators",
    "estimate_bkw_fraction": "estimators",
    "estimate_extinction": "estimators",
    "estimate_trap": "trap_estimators",
    "estimate_trap_fraction": "trap_estimators",
}

__all__ = [*_HOME]


def __getattr__(name):
    """Return a public function from the module that defines it."""
    if name in _HOME:
        return getattr(importlib.import_module(f"kacsim.boltzmann.{_HOME[name]}"), name)
    raise AttributeError(f"module 'kacsim.boltzmann' has no attribute '{name}'")
