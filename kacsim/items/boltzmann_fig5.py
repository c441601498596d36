"""Fig. 5 of the Boltzmann paper: high-energy fractions against time, by Algorithm 3."""

from kacsim.items import _bkw

SAMPLER = "bkw_fraction"


def cases(settings):
    """Return the probes at the published and at the large number of realizations."""
    return list(_bkw.cases_by_size(SAMPLER, settings).values())


def reduce(samples, settings):
    """Return the estimates with errors beside the exact values."""
    return _bkw.reduce(SAMPLER, samples, settings)


def draw(dataset):
    """Draw values and relative errors."""
    return _bkw.draw(SAMPLER, dataset, "time")
