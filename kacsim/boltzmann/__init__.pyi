# The public names, for tools that run nothing; made by tests/unit/test_types.py.

from .bkw_estimators import estimate_bkw as estimate_bkw
from .bkw_estimators import estimate_bkw_fraction as estimate_bkw_fraction
from .bkw_estimators import estimate_extinction as estimate_extinction
from .estimators import BudgetError as BudgetError
from .estimators import Estimate as Estimate
from .initial_laws import Mixture as Mixture
from .initial_laws import Transform as Transform
from .relaxation_estimators import estimate_relaxation as estimate_relaxation
from .relaxation_estimators import estimate_relaxation_fraction as estimate_relaxation_fraction
from .second_moment import relative_deviation as relative_deviation
from .trap_estimators import estimate_trap as estimate_trap
from .trap_estimators import estimate_trap_fraction as estimate_trap_fraction
