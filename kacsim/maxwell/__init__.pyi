# The public names, for tools that run nothing; made by tests/unit/test_types.py.

from .constants import RATE as RATE
from .draws import draw as draw
from .exact import cumulative as cumulative
from .exact import density as density
from .exact import survival as survival
from .moments import fourth_moment as fourth_moment
from .samplers import ALGORITHMS as ALGORITHMS
