"""Three-dimensional Maxwell molecules from the BKW mode on, by the Kac paper's algorithms."""

import lazy_loader

# Loaded at first use: formulas need no compiler.
__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "exact": ["cumulative", "density", "survival"],
        "moments": ["fourth_moment"],
    },
)
