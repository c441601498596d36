"""What Figs. 9 and 10 of the Boltzmann paper share: the cases, and the agreement of replicates."""

import math

from kacsim.items import _probes
from kacsim.items._lazy import np

STATE = ("breathing", "start_phase", "coupling", "max_nodes")


def problems(settings):
    """Return (key, sentence) if the larger run has times that the figure has not."""
    if set(settings["large_turn"]) - set(settings["turn"]):
        return [("large_turn", f"must be among turn, {settings['turn']}")]
    return []


def cases_by_size(sampler, settings, **choices):
    """Return size -> case: radius by time, the time given in turns of the trap.

    The large size has times of its own: those where it takes less than a minute.
    """
    common = {key: settings[key] for key in STATE} | choices
    found = {}
    for size, key in zip(_probes.SIZES, ("turn", "large_turn"), strict=True):
        times = [2.0 * math.pi * turn for turn in settings[key]]
        where = {"radius": settings["radius"], "time": times}
        found[size] = _probes.case(settings, sampler, size, **where, **common)
    return found


def places(settings):
    """Return size -> places of its times among all times."""
    return {
        size: [settings["turn"].index(turn) for turn in settings[key]]
        for size, key in zip(_probes.SIZES, ("turn", "large_turn"), strict=True)
    }


def batches(samples, cases, places, shape):
    """Return the worst disagreement of replicates' means, float64[size, radius, turn]."""
    found = np.full((len(cases), *shape), np.nan)
    for k, (size, one) in enumerate(cases.items()):
        found[k][:, places[size]] = _probes.worst_batch(samples[one.id])
    return found
