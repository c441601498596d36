"""What the items of the chapter share: their cases, distances of laws, particles by face."""

import math

from kacsim.cases import make_case
from kacsim.items._lazy import estimate, flux, np, special
from kacsim.techniques.constants import NUMBER, POWERS
from kacsim.techniques.samplers import GAS_NAMES

LAW_TITLES = {
    "kac_initial": "$f_0$ of the Kac paper",
    "exponential": "exponential",
    "ramp": "ramp (1 + v)",
    "triangle": "triangle",
}


def case(settings, sampler, **parameters):
    """Return the case of a sampler with the item's size; sizes in `parameters` win."""
    size = {key: settings[key] for key in ("n_draws", "n_replicates", "seed") if key in settings}
    return make_case(sampler, **(size | parameters))


def gas_case(settings, sampler, **parameters):
    """Return the case of particles that enter a cuboid."""
    return case(settings, sampler, **({key: settings[key] for key in GAS_NAMES} | parameters))


def mean_of(here, name, degrees=None):
    """Return a variable of a dataset and its error as an estimate.

    Parameters
    ----------
    here : dataset, reduced to one place
    name : its variable; the error is the variable name_error
    degrees : of freedom; those of the item's replicates if not given
    """
    if degrees is None:
        degrees = here.attrs["settings"]["n_replicates"] - 1
    return estimate.Mean(float(here[name]), float(here[f"{name}_error"]), degrees)


def distance(counts):
    """Return the Kolmogorov-Smirnov distance over the edges of cells of equal probability."""
    share = np.cumsum(counts) / np.sum(counts)
    return float(np.abs(share[:-1] - np.arange(1, share.size) / share.size).max())


def p_of_distance(value, n_draws):
    """Return the Kolmogorov-Smirnov p-value of a distance."""
    return float(special.kolmogorov(math.sqrt(n_draws) * value))


def median_distance(n_draws):
    """Return the median distance of exact draws."""
    return float(special.kolmogi(0.5)) / math.sqrt(n_draws)


def binned(counts, n_bins):
    """Return (share of the draws, cumulative probability of the edges) over groups of cells."""
    starts = np.linspace(0, counts.size, n_bins + 1).astype(int)
    grouped = np.add.reduceat(counts, starts[:-1])
    return grouped / counts.sum(), starts / counts.size


def mean_of_power(sample, power):
    """Return the mean of v to a power in every replicate."""
    return sample["moment"].values[..., POWERS.index(power)]


def per_step(sample):
    """Return the particles per step of each replicate: float64[replicate, face]."""
    steps = sample["steps"].values.sum(axis=-1)
    return sample["sum"].values[..., NUMBER] / steps


def face_means(sample, what):
    """Return mean over particles of a summed quantity by face, with errors over replicates."""
    sums = sample["sum"].values
    ratio = sums[..., what] / np.maximum(1.0, sums[..., NUMBER])
    return [estimate.of_replicates(column) for column in ratio.T]


def numbers_per_step(settings):
    """Return float64[6], mean particles per face and step."""
    state = {key: settings[key] for key in GAS_NAMES}
    step = state.pop("step")
    return flux.face_rates(**state) * step


def speed_law(settings, edges, face):
    """Return the probabilities of normal velocities between edges, the last open."""
    inward = (1.0 - 2.0 * (face % 2)) * settings["drift"][face // 2]
    inside = flux.cumulative(edges, inward, settings["temperature"])
    return np.diff(np.append(inside, 1.0))


def chi_squared(counts, probabilities, least=20.0):
    """Return Pearson's p-value; bins that expect fewer than `least` are one with the bin before."""
    wanted = np.asarray(probabilities) * np.sum(counts)
    groups, total = [], 0.0
    for expected in wanted:
        groups.append(len(set(groups)) if not groups or total >= least else groups[-1])
        total = expected if len(groups) < 2 or groups[-1] != groups[-2] else total + expected
    if total < least and groups[-1] > 0:
        groups = [min(group, groups[-1] - 1) for group in groups]
    seen, due = (np.bincount(groups, weights=x) for x in (np.asarray(counts, float), wanted))
    statistic = float(((seen - due) ** 2 / due).sum())
    return float(special.chdtrc(max(1, seen.size - 1), statistic))
