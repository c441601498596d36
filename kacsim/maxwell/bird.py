"""Bird's algorithm for Maxwell molecules: that of `kacsim.kac.bird`."""

from kacsim.kac.bird import arguments, forward_draws, history, prepare
from kacsim.kac.tape import ancestral_draws
from kacsim.maxwell import model

__all__ = ["ancestral", "arguments", "forward"]

forward = forward_draws(model)
ancestral = ancestral_draws(model, prepare, history)
