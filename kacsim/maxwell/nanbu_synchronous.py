"""Nanbu's algorithm, synchronous, for Maxwell molecules: that of `kacsim.kac.nanbu_synchronous`."""

from kacsim.kac.nanbu_synchronous import arguments, at_old_level, forward_draws, history, prepare
from kacsim.kac.tape import ancestral_draws
from kacsim.maxwell import model

__all__ = ["ancestral", "arguments", "forward"]

forward = forward_draws(model)
ancestral = ancestral_draws(model, prepare, history, at_old_level)
