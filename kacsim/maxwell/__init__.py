"""Maxwell molecules in three dimensions: the algorithms of the Kac paper for the gas of BKW."""

import lazy_loader

# Loaded at first use: formulas need no compiler.
__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "constants": ["RATE"],
        "draws": ["draw"],
        "exact": ["cumulative", "density", "survival"],
        "moments": ["fourth_moment"],
        "samplers": ["ALGORITHMS"],
    },
)
