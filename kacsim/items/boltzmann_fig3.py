"""Fig. 3 of the Boltzmann paper: f at two probe speeds against time, by Algorithm 2."""

import functools

from kacsim.items import _bkw
from kacsim.items._lazy import bkw, estimate, verdict

cases = functools.partial(_bkw.cases, "bkw")
reduce = functools.partial(_bkw.reduce, "bkw")
draw = functools.partial(_bkw.draw, "bkw", "time")
NEEDED = 4.0  # moment that a standard error of the sample variance rests on


def claims(dataset):
    """Compare the means with eq. (7) at all times where a sample variance has an error itself."""
    parts = []
    for time in dataset.time.values:
        if bkw.tail_index(time) <= NEEDED:
            continue
        for speed in dataset.speed.values:
            here = dataset.sel(size="large", speed=speed, time=time)
            mean = estimate.Mean(float(here.value), float(here.error)).over(float(here.exact))
            parts.append(verdict.Part(mean, f"c = {speed:g} c_q, t = {time:g}", printed=1.0))
    evidence = f"{int(dataset.n_draws.sel(size='large')):,} realizations a point."
    return [verdict.Finding("boltzmann_unbiased", tuple(parts), evidence)]
