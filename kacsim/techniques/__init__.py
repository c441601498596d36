"""The tools of the two papers: inversion, rejection, injection, integration (the chapter)."""

import importlib

# Loaded at first use: formulas need no compiler.
_HOME = {
    "draw_by_inversion": "inverse_transform",
    "draw_by_rejection": "rejection",
    "draw_from_table": "inverse_transform",
    "inject": "injection",
    "inject_particles": "particles",
    "integrate": "integration",
    "lattice_count": "integration",
    "sphere_volume": "integration",
    "tabulate": "inverse_transform",
}

__all__ = [*_HOME]


def __getattr__(name):
    """Return a public function from the module that defines it."""
    if name in _HOME:
        return getattr(importlib.import_module(f"kacsim.techniques.{_HOME[name]}"), name)
    raise AttributeError(f"module 'kacsim.techniques' has no attribute '{name}'")
