"""The Kac equation probed by branching trees: the Boltzmann paper's estimator for Kac's eq. (6)."""

from kacsim.boltzmann.model import KAC_LAW, tree, workspace
from kacsim.kac.constants import THERMAL
from kacsim.kernels.jit import kernel


@kernel
def estimate(values, nodes, speed, time, oversampling, onset, max_nodes, stream):
    """Draw realizations of f(v; t) / M(v), M the Normal(0, 3/2) of eq. (9).

    Parameters
    ----------
    values : float64[n], overwritten
    nodes : int64[n], overwritten by the numbers of t' drawings; -1 marks an exceeded budget
    speed, time : |v| / sqrt(3/2) and rate * t
    oversampling, onset : m >= 1, and the time from which on it is used
    max_nodes : int, budget of one realization
    stream : from `new_stream`, advanced

    Returns
    -------
    bool, False if a realization exceeded the budget
    """
    stack, counts = workspace()
    for k in range(values.size):
        values[k], nodes[k] = tree(
            KAC_LAW, speed * speed, time, oversampling, onset, max_nodes, stack, counts, stream
        )
        if nodes[k] < 0:
            return False
    return True


def kac_probe(speed, time, *, collision_rate, oversampling, onset, max_nodes):
    """Return the kernel at one probe: callable(values, nodes, stream), in units of M(v)."""
    probe = float(abs(speed) / THERMAL), float(collision_rate * time)
    more = float(oversampling), float(collision_rate * onset)
    return lambda values, nodes, stream: estimate(values, nodes, *probe, *more, max_nodes, stream)
