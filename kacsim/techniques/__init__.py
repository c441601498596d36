"""The tools of the two papers: inversion, rejection, injection, integration (the chapter)."""

import lazy_loader

# Loaded at first use: formulas need no compiler.
__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "injection": ["inject"],
        "integration": ["integrate", "lattice_count", "sphere_volume"],
        "inverse_transform": ["draw_by_inversion", "draw_from_table", "tabulate"],
        "particles": ["inject_particles"],
        "rejection": ["draw_by_rejection"],
    },
)
