"""Reproducible Monte Carlo experiments on Kac's model and the Boltzmann equation."""

import lazy_loader

__version__ = "0.5.0"

# Loaded at first use, so that planning stays light.
__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__, submodules=["boltzmann", "kac", "maxwell", "techniques"]
)
