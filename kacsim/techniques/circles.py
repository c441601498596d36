"""Lattice points inside circles of many sizes: the worked example in two dimensions."""

import numpy as np

from kacsim.elementary.exponential import exp
from kacsim.elementary.logarithm import log
from kacsim.kernels.jit import kernel


@kernel
def count_circles(inside, edges):
    """Count the lattice points inside the unit circle, cell by cell along its edge.

    Twice the coordinates times the edge are odd numbers: inside are those whose squares add up to
    4 edge**2 at most, as in `kacsim.techniques.integration.count_lattice`; about 2 edge steps each.

    Parameters
    ----------
    inside : int64[n], overwritten by the numbers of points of the quarter circle
    edges : int64[n], M points per edge
    """
    for place in range(edges.size):
        edge = edges[place]
        total, rows = 0, edge
        for k in range(edge):
            left = 4 * edge * edge - (2 * k + 1) ** 2
            while rows > 0 and (2 * rows - 1) ** 2 > left:
                rows -= 1
            total += rows
        inside[place] = total


def spread_edges(smallest, largest, n_edges):
    """Return int64[<= n_edges], different edges at about equal steps of their logarithm."""
    edges = np.empty(n_edges, np.int64)
    fill_edges(edges, smallest, largest)
    return np.unique(edges)


@kernel
def fill_edges(edges, smallest, largest):
    """Fill int64[n] with whole numbers near those at equal steps of their logarithm."""
    first, last = log(float(smallest)), log(float(largest))
    for k in range(edges.size):
        share = k / (edges.size - 1.0) if k > 0 else 0.0
        edges[k] = int(exp(first + share * (last - first)) + 0.5)
