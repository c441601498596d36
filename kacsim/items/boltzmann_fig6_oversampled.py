"""Study: Fig. 6 of the Boltzmann paper with oversampling, so that its bars are standard errors."""

import functools

from kacsim.items import _bkw

cases = functools.partial(_bkw.cases, "bkw_fraction")
reduce = functools.partial(_bkw.reduce, "bkw_fraction")
draw = functools.partial(_bkw.draw, "bkw_fraction", "threshold")
claims = _bkw.claims
