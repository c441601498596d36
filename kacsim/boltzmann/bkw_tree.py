"""Algorithms 2 and 3 of the Boltzmann paper: the BKW mode probed by branching trees."""

from kacsim.boltzmann.model import BKW_LAW, shell, speed_beyond, tree, workspace
from kacsim.kernels.jit import kernel
from kacsim.variates import exponential, half_normal


@kernel
def estimate(values, nodes, speed, time, oversampling, onset, max_nodes, stream):
    """Draw realizations of F / M at one probe by Algorithm 2.

    Parameters
    ----------
    values : float64[n], overwritten
    nodes : int64[n], overwritten by the numbers of t' drawings; -1 marks an exceeded budget
    speed, time : |c| / c_q and t, in mean collision times
    oversampling : m >= 1; 1 is the published algorithm
    onset : time from which on collisions are oversampled
    max_nodes : int, budget of one realization
    stream : from `new_stream`, advanced

    Returns
    -------
    bool, False if a realization exceeded the budget (the others after it are not drawn)
    """
    stack, counts = workspace()
    for k in range(values.size):
        values[k], nodes[k] = tree(
            BKW_LAW, speed * speed, time, oversampling, onset, max_nodes, stack, counts, stream
        )
        if nodes[k] < 0:
            return False
    return True


@kernel
def estimate_fraction(values, nodes, threshold, time, oversampling, onset, max_nodes, stream):
    """Draw realizations of the fraction with |c| > threshold by Algorithm 3 and eq. (19).

    Parameters and result as `estimate`, with threshold = c0 / c_q.
    """
    stack, counts = workspace()
    for k in range(values.size):
        speed, weight = speed_beyond(threshold, stream)
        ratio, nodes[k] = tree(
            BKW_LAW, speed * speed, time, oversampling, onset, max_nodes, stack, counts, stream
        )
        values[k] = weight * shell(speed, 1.0) * ratio
        if nodes[k] < 0:
            return False
    return True


@kernel
def estimate_moment(values, nodes, oversampling, time, onset, max_nodes, stream):
    """Draw realizations of F / M with c drawn from M: mean 1, mean square G(t).

    Parameters and result as `estimate`.
    """
    stack, counts = workspace()
    for k in range(values.size):
        z = half_normal(stream)
        square = z * z + 2.0 * exponential(stream)
        values[k], nodes[k] = tree(
            BKW_LAW, square, time, oversampling, onset, max_nodes, stack, counts, stream
        )
        if nodes[k] < 0:
            return False
    return True


def _at(kernel, probe, time, oversampling, onset, max_nodes):
    """Return a kernel at one probe: callable(values, nodes, stream)."""
    fixed = float(probe), float(time), float(oversampling), float(onset), max_nodes
    return lambda values, nodes, stream: kernel(values, nodes, *fixed, stream)


def bkw(speed, time, *, oversampling, onset, max_nodes):
    """Return Algorithm 2 at one probe, in units of M(c): callable(values, nodes, stream)."""
    return _at(estimate, speed, time, oversampling, onset, max_nodes)


def bkw_fraction(threshold, time, *, oversampling, onset, max_nodes):
    """Return Algorithm 3 at one threshold: callable(values, nodes, stream)."""
    return _at(estimate_fraction, threshold, time, oversampling, onset, max_nodes)


def bkw_moment(oversampling, time, *, onset, max_nodes):
    """Return Algorithm 2 at velocities drawn from M: callable(values, nodes, stream)."""
    fixed = float(oversampling), float(time), float(onset), max_nodes
    return lambda values, nodes, stream: estimate_moment(values, nodes, *fixed, stream)
