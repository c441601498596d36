# The public names, for tools that run nothing; made by tests/unit/test_types.py.

from .injection import inject as inject
from .integration import integrate as integrate
from .integration import lattice_count as lattice_count
from .integration import sphere_volume as sphere_volume
from .inverse_transform import draw_by_inversion as draw_by_inversion
from .inverse_transform import draw_from_table as draw_from_table
from .inverse_transform import tabulate as tabulate
from .particles import inject_particles as inject_particles
from .rejection import draw_by_rejection as draw_by_rejection
