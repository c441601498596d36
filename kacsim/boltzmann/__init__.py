"""The Boltzmann equation probed by branching trees: estimators and exact results."""

import lazy_loader

# Loaded at first use: formulas need no compiler.
__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "bkw_estimators": ["estimate_bkw", "estimate_bkw_fraction", "estimate_extinction"],
        "estimators": ["BudgetError", "Estimate"],
        "initial_laws": ["Mixture", "Transform"],
        "relaxation_estimators": ["estimate_relaxation", "estimate_relaxation_fraction"],
        "second_moment": ["relative_deviation"],
        "trap_estimators": ["estimate_trap", "estimate_trap_fraction"],
    },
)
