"""What Figs. 9 and 10 of the Boltzmann paper share: the cases, and the agreement of replicates."""

import math

from kacsim.items import _probes
from kacsim.items._lazy import np

STATE = ("breathing", "start_phase", "coupling", "max_nodes")


def cases_by_size(sampler, settings, **choices):
    """Return size -> case: radius by time, the time given in turns of the trap."""
    times = [2.0 * math.pi * turn for turn in settings["turn"]]
    common = {key: settings[key] for key in STATE} | choices
    return {
        size: _probes.case(settings, sampler, size, radius=settings["radius"], time=times, **common)
        for size in _probes.SIZES
    }


def batches(samples, cases):
    """Return the worst disagreement of replicates' means, float64[size, radius, turn]."""
    return np.stack([_probes.worst_batch(samples[one.id]) for one in cases.values()])
