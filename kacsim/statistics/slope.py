"""The power of N that squared errors fall with, and its standard error."""

import math

import numpy as np

from kacsim.statistics.estimate import Mean

MOST_STEPS = 200
SMALLEST_STEP = 1e-12  # of a logarithm


def of_squares(n, squares, groups):
    """Fit E e**2 = exp(a + 2 b log n); return b with a standard error that needs no noise model.

    A generalized linear model with logarithmic link and constant relative spread: squares near
    zero, which a fit of log |e| would take for large deviations, weigh little. The error is that
    of leaving out a group at a time (jackknife, one Newton step from the fit to all), so that
    squares may depend on each other within a group; of few groups the sandwich is too small.

    Parameters
    ----------
    n : float64[k], numbers of points
    squares : float64[k], squared errors
    groups : int[k], group of each square; groups are independent

    Returns
    -------
    (Mean, float), the slope b, and the root of exp(a): the error extrapolated to n = 1. The slope
    has the degrees of freedom of its groups: all but one if they weigh the same, fewer if some lie
    farther out on the line than others (Satterthwaite)
    """
    n, squares, groups = (np.asarray(x) for x in (n, squares, groups))
    x = np.log(n)
    centre = x.mean()
    design = np.stack([np.ones(x.size), x - centre], axis=1)
    inverse = np.linalg.inv(design.T @ design)
    known = np.maximum(squares, 1e-6 * squares.mean())
    beta = _fitted(design, squares, inverse @ design.T @ np.log(known))
    many, shifts = np.unique(groups).size, _left_out(design, squares, groups, beta)[:, 1] / 2.0
    error = math.sqrt((many - 1) / many * ((shifts - shifts.mean()) ** 2).sum())
    weights = np.bincount(np.unique(groups, return_inverse=True)[1], (x - centre) ** 2)
    degrees = weights.sum() ** 2 / (weights**2).sum() - 1.0
    slope = Mean(float(beta[1]) / 2.0, error, float(degrees))
    return slope, float(math.exp((beta[0] - beta[1] * centre) / 2.0))


def _left_out(design, squares, groups, beta):
    """Return by how much the coefficients change without each group: one Newton step."""
    ratio = squares * np.exp(-design @ beta)
    shifts = []
    for g in np.unique(groups):
        own = groups == g
        slopes = design[own].T @ (ratio[own] - 1.0)
        curvature = (design[~own].T * ratio[~own]) @ design[~own]
        shifts.append(-np.linalg.pinv(curvature, hermitian=True) @ slopes)
    return np.array(shifts)


def _fitted(design, squares, beta):
    """Return the coefficients that make sum(squares / fit + log fit) least, from a first guess.

    The sum is convex in them: Newton's steps, each halved until it leads down.
    """

    def height(coefficients):
        logarithm = design @ coefficients
        return (squares * np.exp(-logarithm) + logarithm).sum()

    for _ in range(MOST_STEPS):
        ratio = squares * np.exp(-design @ beta)
        slopes, curvature = design.T @ (ratio - 1.0), (design.T * ratio) @ design
        step = np.linalg.lstsq(curvature, slopes, rcond=None)[0]
        while not height(beta + step) <= height(beta) and np.abs(step).max() > SMALLEST_STEP:
            step = step / 2.0
        if np.abs(step).max() <= SMALLEST_STEP:
            break
        beta = beta + step
    return beta
