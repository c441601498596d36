"""What the samplers of the Boltzmann paper accept: probes by trees, and the trap."""

from kacsim.checks import (
    MAX_NODES,
    RATE,
    Problem,
    _is_number,
    at_least,
    count,
    finite,
    not_negative,
    one_of,
    positive,
)

LONGEST_LITERAL = 10.0  # mean collision times; plain recursion has no budget
STARTS = ("bkw", "breathing")
PUBLISHED_CHOICES = {"majorant_factor": 1.0, "spread": 1.0, "anisotropy": 0.0}


def breathing(name, value):
    """Yield a problem unless the value is an amplitude of eq. (31), in [0, 1)."""
    if not _is_number(value) or not 0 <= value < 1:
        yield Problem(name, value, "must be at least 0 and less than 1")


def trap_choices(*, majorant_factor, spread, anisotropy):
    """Yield the problems of the sampling laws of Algorithms 5 and 6."""
    yield from positive("majorant_factor", majorant_factor)
    # The weight of c* grows without bound for a narrower law than the Maxwellian.
    yield from at_least("spread", spread, 1.0)
    if not _is_number(anisotropy) or not -1 < anisotropy < 1:
        yield Problem("anisotropy", anisotropy, "must be greater than -1 and less than 1")


def _probes(*, max_nodes=MAX_NODES, oversampling=1.0, onset=0.0, **axes):
    """Yield the problems of a grid of probes of the Boltzmann paper."""
    for name, values in axes.items():
        if not isinstance(values, (list, tuple)) or not values:
            yield Problem(name, values, "must be a list of numbers")
            continue
        for value in values:
            yield from (positive if name == "majorant" else not_negative)(name, value)
    yield from count("max_nodes", max_nodes)
    for value in oversampling if isinstance(oversampling, (list, tuple)) else [oversampling]:
        yield from at_least("oversampling", value, 1.0)
    yield from not_negative("onset", onset)


def kac_probe(*, speed, time, collision_rate=RATE, **tree):
    """Yield the problems of probing the Kac equation by trees."""
    yield from positive("collision_rate", collision_rate)
    yield from _probes(speed=speed, time=time, **tree)


bkw = bkw_fraction = bkw_moment = extinction = _probes


def bkw_literal(*, initial, speed, time):
    """Yield the problems of the literal Algorithm 2."""
    yield from one_of("initial", initial, ("bkw", "equilibrium"))
    yield from _probes(speed=speed, time=time)
    yield from _literal_times(time)


def _literal_times(time):
    for value in time:
        if _is_number(value) and value > LONGEST_LITERAL:
            yield Problem("time", value, f"the literal algorithm takes at most {LONGEST_LITERAL:g}")


def bkw_tree(*, speed, time):
    """Yield the problems of recorded trees."""
    yield from not_negative("speed", speed)
    yield from not_negative("time", time)


def trap(*, radius, time, initial, max_nodes, coupling, start_phase, **others):
    """Yield the problems of probing the trap (`breathing` and the sampling laws among others)."""
    choices = dict(others)
    yield from breathing("breathing", choices.pop("breathing"))
    yield from one_of("initial", initial, STARTS)
    yield from positive("coupling", coupling)
    yield from finite("start_phase", start_phase)
    yield from trap_choices(**choices)
    yield from _probes(radius=radius, time=time, max_nodes=max_nodes)


trap_fraction = trap_energy = trap


def trap_literal(*, radius, time, initial, coupling, **state):
    """Yield the problems of the literal Algorithms 5 and 6."""
    yield from breathing("breathing", state["breathing"])
    yield from one_of("initial", initial, STARTS)
    yield from positive("coupling", coupling)
    yield from _probes(radius=radius, time=time)
    yield from _literal_times(time)
