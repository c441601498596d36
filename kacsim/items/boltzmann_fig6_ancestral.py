"""Study: Fig. 6 of the Boltzmann paper, fractions beyond a speed, by McKean's trees."""

import functools

from kacsim.items import _bkw

cases = functools.partial(_bkw.cases, "bkw_fraction")
reduce = functools.partial(_bkw.reduce, "bkw_fraction")
draw = functools.partial(_bkw.draw, "bkw_fraction", "threshold")
claims = _bkw.claims
