"""Study: Fig. 4 of the Boltzmann paper, f along an axis at three times, by McKean's trees."""

import functools

from kacsim.items import _bkw

cases = functools.partial(_bkw.cases, "bkw")
reduce = functools.partial(_bkw.reduce, "bkw")
draw = functools.partial(_bkw.draw, "bkw", "speed")
claims = _bkw.claims
