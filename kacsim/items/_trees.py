"""What a recorded tree of Algorithm 1 returns: as printed, and as a product over its leaves."""

from kacsim.items._lazy import bkw, np


def departures(sample):
    """Return the estimate of each tree over M times the product of its leaves' f / M, less 1.

    A collision returns f1 f2 / M(c*) as printed, c* = c' + c'* - c by its momentum, and a leaf
    eq. (18): together the leaves over the partners.

    Parameters
    ----------
    sample : trees of the sampler ``bkw_tree``, one after the other, children after their parents

    Returns
    -------
    float64[tree]
    """
    velocity, number = sample["velocity"].values, sample["tree"].values
    first = np.searchsorted(number, number)  # row of each branch's root
    parent = sample["parent"].values + first
    leaf, root = sample["stop"].values <= 0.0, sample["parent"].values < 0
    partner = -velocity
    np.add.at(partner, parent[~root], velocity[~root])
    speed = np.linalg.norm(velocity, axis=1)

    def total(rows, logarithm):
        return np.bincount(number[rows], logarithm, number.max() + 1)

    printed = total(leaf, np.log(bkw.density(speed[leaf], 0.0)))
    printed -= total(~leaf, np.log(bkw.maxwellian(np.linalg.norm(partner[~leaf], axis=1))))
    product = total(root, np.log(bkw.maxwellian(speed[root])))
    product += total(leaf, np.log(bkw.relative_density(speed[leaf], 0.0)))
    return np.expm1(printed - product)[np.unique(number)]
