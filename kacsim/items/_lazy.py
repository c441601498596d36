"""Heavy modules, imported at their first use: the plan reads every item at every start."""

from kacsim.kernels.lookup import lazy

np = lazy("numpy")
xr = lazy("xarray")
kac = lazy("kacsim.kac")
ancestors = lazy("kacsim.kac.ancestors")
bkw = lazy("kacsim.boltzmann.bkw")
extinction = lazy("kacsim.boltzmann.extinction")
trap = lazy("kacsim.boltzmann.trap")
exact = lazy("kacsim.kac.exact")
nanbu_babovsky = lazy("kacsim.kac.nanbu_babovsky")
techniques_exact = lazy("kacsim.techniques.exact")
flux = lazy("kacsim.techniques.flux")
inverse_transform = lazy("kacsim.techniques.inverse_transform")
estimate = lazy("kacsim.statistics.estimate")
histogram = lazy("kacsim.statistics.histogram")
slope = lazy("kacsim.statistics.slope")
special = lazy("scipy.special")
tail = lazy("kacsim.statistics.tail")
verdict = lazy("kacsim.statistics.verdict")
store = lazy("kacsim.store")
plotting = lazy("kacsim.plotting")
