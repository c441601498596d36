"""Heavy modules, imported at their first use: the plan reads every item at every start."""

import importlib


class _Lazy:
    def __init__(self, name):
        self._name = name

    def __getattr__(self, attribute):
        return getattr(importlib.import_module(self._name), attribute)


np = _Lazy("numpy")
xr = _Lazy("xarray")
kac = _Lazy("kacsim.kac")
ancestors = _Lazy("kacsim.kac.ancestors")
bkw = _Lazy("kacsim.boltzmann.bkw")
extinction = _Lazy("kacsim.boltzmann.extinction")
trap = _Lazy("kacsim.boltzmann.trap")
exact = _Lazy("kacsim.kac.exact")
moments = _Lazy("kacsim.kac.moments")
techniques_exact = _Lazy("kacsim.techniques.exact")
flux = _Lazy("kacsim.techniques.flux")
inverse_transform = _Lazy("kacsim.techniques.inverse_transform")
estimate = _Lazy("kacsim.statistics.estimate")
histogram = _Lazy("kacsim.statistics.histogram")
slope = _Lazy("kacsim.statistics.slope")
special = _Lazy("scipy.special")
tail = _Lazy("kacsim.statistics.tail")
verdict = _Lazy("kacsim.statistics.verdict")
store = _Lazy("kacsim.store")
plotting = _Lazy("kacsim.plotting")
