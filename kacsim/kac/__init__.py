"""Kac's one-dimensional model of a gas: samplers and exact results (the Kac paper)."""

import lazy_loader

# Loaded at first use: formulas need no compiler, and kernels no special functions.
__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "constants": ["RATE"],
        "draws": ["draw", "draw_equilibrium", "draw_perfect"],
        "exact": ["cumulative", "density", "survival"],
        "high_moments": ["moment"],
        "moments": ["fourth_moment"],
        "probe": ["estimate_density", "estimate_tail"],
        "relaxation": ["estimate_relaxation", "estimate_relaxation_tail"],
        "samplers": ["ALGORITHMS"],
    },
)
