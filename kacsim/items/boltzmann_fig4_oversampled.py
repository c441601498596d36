"""Study: Fig. 4 of the Boltzmann paper with oversampling, so that its bars are standard errors."""

import functools

from kacsim.items import _bkw

cases = functools.partial(_bkw.cases, "bkw")
reduce = functools.partial(_bkw.reduce, "bkw")
draw = functools.partial(_bkw.draw, "bkw", "speed")
claims = _bkw.claims
