"""Nanbu's algorithm, sequential, for Maxwell molecules: that of `kacsim.kac.nanbu_sequential`."""

from kacsim.kac.nanbu_sequential import arguments, forward_draws, history, in_place, prepare
from kacsim.kac.tape import ancestral_draws
from kacsim.maxwell import model

__all__ = ["ancestral", "arguments", "forward"]

forward = forward_draws(model)
ancestral = ancestral_draws(model, prepare, history, in_place)
