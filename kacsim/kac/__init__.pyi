# The public names, for tools that run nothing; made by tests/unit/test_types.py.

from .constants import RATE as RATE
from .draws import draw as draw
from .draws import draw_equilibrium as draw_equilibrium
from .draws import draw_perfect as draw_perfect
from .exact import cumulative as cumulative
from .exact import density as density
from .exact import survival as survival
from .high_moments import moment as moment
from .moments import fourth_moment as fourth_moment
from .probe import estimate_density as estimate_density
from .probe import estimate_tail as estimate_tail
from .relaxation import estimate_relaxation as estimate_relaxation
from .relaxation import estimate_relaxation_tail as estimate_relaxation_tail
from .samplers import ALGORITHMS as ALGORITHMS
