"""What Fig. 11.3 of the chapter is made of: tallies by face, chosen particles, eq. (11.15)."""

import math

from kacsim.items import _techniques
from kacsim.items._lazy import estimate, np, techniques_exact, verdict
from kacsim.techniques.constants import FACES, SPEED, SPEED_2, SQUARES

RATES = (0.5, 3.0, 40.0)  # particles per step at which sums over eq. (11.15) are taken
FEW = (0.5, 1.0)  # of order unity or smaller
FOUND = (0.5, 30.0, 1000.0)  # rates at which numbers are found in the cumulative steps
PLACES = 100_000  # values of u, equally spaced
LARGE = 10**6  # "maybe millions" of representative particles


def of_source(sample, settings):
    """Return what one source gives at every face.

    Returns
    -------
    dict of means (dict name -> list of Mean over the replicates, by face), p_speed and p_number
    (p-values), share[face, number], speeds[face, bin]
    """
    faces = range(len(FACES))
    columns = [estimate.of_replicates(column) for column in _techniques.per_step(sample).T]
    speed = _techniques.face_means(sample, SPEED)
    square = _techniques.face_means(sample, SPEED_2)
    place = _techniques.face_means(sample, SQUARES)
    numbers = np.arange(sample["steps"].shape[-1])
    share = sample["steps"].values / sample["steps"].values.sum(axis=-1, keepdims=True)
    none = [estimate.of_replicates(column) for column in share[..., 0].T]
    variance = (share * numbers**2).sum(-1) - (share * numbers).sum(-1) ** 2
    ratio = [estimate.of_replicates(c) for c in (variance / (share * numbers).sum(-1)).T]
    edges = sample["speed_edge"].values
    speeds, steps = (sample[name].values.sum(axis=0) for name in ("speeds", "steps"))
    means = _techniques.numbers_per_step(settings)
    due = [poisson(means[face], numbers.size) for face in faces]
    p_speed = [
        _techniques.chi_squared(speeds[face], _techniques.speed_law(settings, edges, face))
        for face in faces
    ]
    p_number = [_techniques.chi_squared(steps[face], due[face]) for face in faces]
    return {
        "means": {"rate": columns, "speed": speed, "square": square, "fano": ratio}
        | {"place": place, "none": none},
        "p_speed": p_speed,
        "p_number": p_number,
        "share": steps / steps.sum(-1, keepdims=True),
        "speeds": speeds,
    }


def poisson(mean, n_numbers):
    """Return the probabilities of eq. (11.15), the last of all larger numbers."""
    shares = techniques_exact.poisson(mean, n_numbers - 1)
    shares[-1] = max(0.0, 1.0 - shares[:-1].sum())
    return shares


def weighted(sample):
    """Return the choice among weighted particles: p-value, mean speeds chosen and expected.

    Expected by weight and speed (exact), and by the weight alone (bare).
    """
    speed = np.maximum(0.0, sample["velocity"].values[:, 0])
    lengths = sample["weight"].values * speed
    shares = lengths / lengths.sum()
    chosen = sample["selected"].values
    mean = estimate.of_replicates((chosen * speed).sum(axis=-1) / chosen.sum(axis=-1))
    inward = shares > 0.0
    flat = np.where(inward, sample["weight"].values, 0.0)
    return {
        "weighted_p_value": _techniques.chi_squared(chosen.sum(axis=0)[inward], shares[inward]),
        "weighted_outward": float(chosen[:, ~inward].sum()),
        "weighted_speed": mean.value,
        "weighted_speed_error": mean.standard_error,
        "weighted_speed_exact": float((shares * speed).sum()),
        "weighted_speed_bare": float((flat * speed).sum() / flat.sum()),
    }


def sums():
    """Return the components that sum eq. (11.15): 1, the mean and the variance over the rate."""
    parts = []
    for rate in RATES:
        share = techniques_exact.poisson(rate, techniques_exact.poisson_most(rate))
        n = np.arange(share.size)
        mean = (share * n).sum()
        variance = (share * (n - mean) ** 2).sum()
        values = {
            "sum": share.sum(),
            "mean over r": mean / rate,
            "variance over r": variance / rate,
        }
        parts += [
            verdict.Part(estimate.Exact(float(value)), f"{name}, r = {rate:g}", printed=1.0)
            for name, value in values.items()
        ]
    return tuple(parts)


def found_numbers():
    """Return the components that find numbers in cumulative steps: means over equally spaced u."""
    u = (np.arange(PLACES) + 0.5) / PLACES
    parts = []
    for rate in FOUND:
        steps = np.cumsum(techniques_exact.poisson(rate, techniques_exact.poisson_most(rate)))
        mean = float(np.searchsorted(steps, u, side="right").mean())
        parts.append(verdict.Part(estimate.Exact(mean), f"r = {rate:g}", printed=rate))
    return tuple(parts)


def lost_spread():
    """Return the relative spread of the number per step that its mean alone does not have."""
    return tuple(
        verdict.Part(estimate.Exact(1.0 / math.sqrt(rate)), f"r = {rate:g}") for rate in FEW
    )
