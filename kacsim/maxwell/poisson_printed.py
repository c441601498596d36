"""The Poisson algorithm with the printed rate for Maxwell molecules, as in `kacsim.kac`."""

from kacsim.kac.poisson_printed import arguments, history, prepare
from kacsim.kac.tape import ancestral_draws
from kacsim.maxwell import model
from kacsim.maxwell.poisson import forward

__all__ = ["ancestral", "arguments", "forward"]

ancestral = ancestral_draws(model, prepare, history)
