"""Study: Fig. 5 of the Boltzmann paper, high-energy fractions against time, by McKean's trees."""

import functools

from kacsim.items import _bkw

cases = functools.partial(_bkw.cases, "bkw_fraction")
reduce = functools.partial(_bkw.reduce, "bkw_fraction")
draw = functools.partial(_bkw.draw, "bkw_fraction", "time")
claims = _bkw.claims
