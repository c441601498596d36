"""What the Boltzmann paper states on eqs. (20) to (29), by the moments of Algorithm 4 themselves.

In units of f0 and 1 / (alpha f0). The moments come from the equations that the printed algorithm
gives them (`extinction.moments`), not from eqs. (21) and (29), which they are compared with.
"""

import math

from kacsim.items._lazy import bkw, estimate, extinction, np, second_moment, verdict

LOW = (0.5, 0.8)  # raised frequencies below the bound
LATE = (10.0, 100.0, 1000.0)  # times of the limits
LATEST = 50.0  # of the search for an infinite variance
N_NODES = 200  # of a quadrature
COMPARED = (1.0, 2.0)  # times between which growths are compared, in mean collision times
SPEED = 1.0  # of the probe of Algorithm 2 there, in c_q


def claims(majorants, last):
    """Return the findings that take no draws.

    Parameters
    ----------
    majorants : the two raised frequencies of Fig. 7, the lower one first
    last : its last time
    """
    return [
        _density(last),
        _source(majorants, last),
        _variance(majorants, last),
        _end(),
        *_limits(majorants),
        _growth(majorants),
        _compromise(majorants, last),
    ]


def _part(value, label, **known):
    return verdict.Part(estimate.Exact(float(value)), label, **known)


def _quadrature(function, stop):
    """Return the integral of a smooth function from 0."""
    nodes, weights = np.polynomial.legendre.leggauss(N_NODES)
    return float(0.5 * stop * (weights * function(0.5 * stop * (nodes + 1.0))).sum())


def _density(last):
    """Return what eq. (23) and Algorithm 4's first moment give, where eq. (21) is printed."""
    printed = float(extinction.density(last, 1.0, 1.0))
    beer = math.exp(-_quadrature(lambda t: extinction.density(t, 1.0, 1.0), last))
    moment = extinction.moments(last, 1.0)[0]
    pairs = ((beer, "eq. (23)"), (moment, "mean of Algorithm 4"))
    parts = tuple(_part(value, label, printed=printed) for value, label in pairs)
    return verdict.Finding("boltzmann_21_density", parts, f"t = {last:g}.")


def _source(majorants, last):
    """Return the right side of eq. (26), its source at t' as derived and at t as printed."""
    f = float(extinction.density(last, 1.0, 1.0))
    parts = []
    for majorant in majorants:

        def source(t, majorant=majorant):
            density = extinction.density(t, 1.0, 1.0)
            return majorant * np.exp(-majorant * (last - t)) * (density - density**2 / majorant)

        left = math.exp(-majorant * last)
        derived = _quadrature(source, last) + left
        printed = (1.0 - left) * (f - f**2 / majorant) + left
        label = f"ν̂ = {majorant:g} αf₀"
        parts.append(_part(derived, label, printed=printed, corrected=f))
    return verdict.Finding("boltzmann_26_source", tuple(parts), f"t = {last:g}, f = {f:.4f} f₀.")


def _relative(time, ratio):
    first, second = extinction.moments(time, ratio)
    return (second - first**2) / first**2


def _printed(time, ratio):
    variance = extinction.variance(time, 1.0, 1.0, ratio)
    return float(variance / extinction.density(time, 1.0, 1.0) ** 2)


def _variance(majorants, last):
    """Return the relative variance beside eq. (29a), also before it is infinite."""
    places = [(m, t) for m in majorants for t in (last / 2.0, last)]
    places += [(low, 0.5 * low / (1.0 - low)) for low in LOW]
    parts = [
        _part(_relative(t, m), f"ν̂ = {m:g} αf₀, t = {t:g}", printed=_printed(t, m))
        for m, t in places
    ]
    return verdict.Finding("boltzmann_29_variance", tuple(parts))


def _end():
    """Return when the variance becomes infinite, where eq. (29b) has (1/r - 1) t = 1."""
    parts = [
        _part(extinction.moment_end(low, LATEST), f"ν̂ = {low:g} αf₀", printed=low / (1.0 - low))
        for low in LOW
    ]
    return verdict.Finding("boltzmann_29b_infinite", tuple(parts))


def _limits(majorants):
    """Return the limits at large times: of the relative variance, and of the absolute one."""
    equal, above = majorants
    level = 1.0 / (above - 1.0)
    finite = _part(_relative(LATE[-1], above), f"t = {LATE[-1]:g}", printed=level)
    linear = [_part(_relative(t, equal) / t, f"t = {t:g}", printed=1.0) for t in LATE]
    falls = []
    for majorant in majorants:
        early, late = (_absolute(t, majorant) for t in (1.0, LATE[-1]))
        falls.append(_part(1.0 - late / early, f"ν̂ = {majorant:g} αf₀"))
    return [
        verdict.Finding("boltzmann_limit_above", (finite,), f"ν̂ = {above:g} αf₀."),
        verdict.Finding("boltzmann_limit_equal", tuple(linear), f"ν̂ = {equal:g} αf₀."),
        verdict.Finding(
            "boltzmann_limit_absolute", tuple(falls), f"Fall from t = 1 to {LATE[-1]:g}."
        ),
    ]


def _absolute(time, ratio):
    first, second = extinction.moments(time, ratio)
    return second - first**2


def _growth(majorants):
    """Return the growth of Algorithm 2's relative variance over that of Algorithm 4's."""
    early, late = (second_moment.relative_deviation(SPEED, time) ** 2 for time in COMPARED)
    sharp = float(late / early)
    parts = []
    for majorant in majorants:
        own = _relative(COMPARED[1], majorant) / _relative(COMPARED[0], majorant)
        parts.append(_part(sharp / own, f"ν̂ = {majorant:g} αf₀"))
    evidence = (
        f"From {COMPARED[0]:g} to {COMPARED[1]:g} mean collision times the relative variance of "
        f"Algorithm 2 at c = {SPEED:g} c_q grows by {sharp:.2f}; it is infinite from "
        f"{bkw.critical_time():.3f} on."
    )
    return verdict.Finding("boltzmann_no_sharp_increase", tuple(parts), evidence)


def _compromise(majorants, last):
    """Return what the higher raised frequency saves in variance and costs in recursion."""
    low, high = majorants
    variances = [_absolute(last, m) for m in (low, high)]
    recursions = [float(extinction.mean_recursion(last, m)) for m in (low, high)]
    saved = _part(1.0 - variances[1] / variances[0], "variance saved")
    paid = _part(recursions[1] / recursions[0] - 1.0, "recursion added")
    evidence = f"ν̂ = {high:g} αf₀ against {low:g} αf₀ at t = {last:g}."
    return verdict.Finding("boltzmann_compromise", (saved, paid), evidence)
