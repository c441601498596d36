"""Fig. 4 of the Boltzmann paper: f along an axis at two times, by Algorithm 2."""

import functools

from kacsim.items import _bkw

cases = functools.partial(_bkw.cases, "bkw")
reduce = functools.partial(_bkw.reduce, "bkw")
draw = functools.partial(_bkw.draw, "bkw", "speed")
