"""Study: Fig. 3 of the Boltzmann paper, f at two probe speeds against time, by McKean's trees."""

import functools

from kacsim.items import _bkw

cases = functools.partial(_bkw.cases, "bkw")
reduce = functools.partial(_bkw.reduce, "bkw")
draw = functools.partial(_bkw.draw, "bkw", "time")
claims = _bkw.claims
