"""Readings of the coupling times: their moments, and whether they give the published numbers."""

import math

from kacsim.items._lazy import extremes, np

PUBLISHED_DRAWS = 100_000
HALF_UNIT = 0.05  # of the last digit of the published mean
CHANCE = 1e-3  # of an extreme outside the interval in which it is looked for
DEVIATIONS = 3.5  # of a mean that is looked for
NUMBERS = {
    "mean": "mean coupling time",
    "error": "standard error of the mean",
    "spread": "standard deviation of the coupling time",
    "skewness": "skewness of the coupling time",
    "least_low": "lower end of the interval for the smallest of the published number of draws",
    "least_high": "its upper end",
    "most_low": "lower end of the interval for the largest of the published number of draws",
    "most_high": "its upper end",
}


def moments(sample, case, rule, place):
    """Return NUMBERS of a reading, from the sums of its draws."""
    n_draws = case.n_draws * case.n_replicates
    here = sample.isel(rule=rule, tolerance=place)
    means = here["mean"].values
    mean = float(means.mean())
    variance = float(here["variance"].mean() + means.var())
    # Third moments about the replicates' means, moved to the mean of all.
    gap = means - mean
    third = float((here["third"] + 3.0 * here["variance"] * gap + gap**3).mean())
    return _numbers(mean, variance, third, n_draws)


def of_draws(times):
    """Return NUMBERS of a reading, from draws."""
    gap = times - times.mean()
    return _numbers(times.mean(), (gap**2).mean(), (gap**3).mean(), times.size)


def _numbers(mean, variance, third, n_draws):
    spread = math.sqrt(max(0.0, variance))
    skewness = third / spread**3 if spread > 0.0 else 0.0
    error = spread / math.sqrt(n_draws)
    return [float(mean), error, spread, skewness, *ends(mean, spread, skewness, n_draws)]


def ends(mean, spread, skewness, n_measured=math.inf):
    """Return where the extremes of the published number of draws are looked for."""
    least, most = extremes.expected(mean, spread, skewness, PUBLISHED_DRAWS, CHANCE, n_measured)
    return [*least, *most]


def at_mean(table, mean):
    """Return NUMBERS at the tolerance that gives a mean, between two of them; nan if none does."""
    values = np.array(table)
    if not values[0, 0] <= mean <= values[-1, 0]:
        return [math.nan] * len(NUMBERS)
    return [float(np.interp(mean, values[:, 0], column)) for column in values.T]


def fits(numbers, published):
    """Tell which of the published mean, smallest and largest time a reading gives.

    Parameters
    ----------
    numbers : float[..., number], those of NUMBERS
    published : (mean, smallest, largest)

    Returns
    -------
    bool[..., 3]
    """
    values = dict(zip(NUMBERS, np.moveaxis(np.asarray(numbers, float), -1, 0), strict=True))
    mean, least, most = published
    drawn = values["spread"] / math.sqrt(PUBLISHED_DRAWS)
    reach = HALF_UNIT + DEVIATIONS * np.hypot(values["error"], drawn)
    found = (
        np.abs(values["mean"] - mean) <= reach,
        (values["least_low"] <= least) & (least <= values["least_high"]),
        (values["most_low"] <= most) & (most <= values["most_high"]),
    )
    return np.stack(found, axis=-1)
