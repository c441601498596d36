"""The kernels bound to a place: callables that fill values and numbers of ends."""

from kacsim.mckean import contour, free_leaf
from kacsim.mckean.constants import METHODS, VARIANCE

LOG_2PI = 1.8378770664093454
LOG_MAXWELLIAN = (-1.5 * LOG_2PI, -0.5 * (LOG_2PI + 0.4054651081081644))  # at 0; log(3/2)
KERNELS = dict(
    zip(
        METHODS,
        (contour.estimate, free_leaf.estimate, free_leaf.estimate_geometric),
        strict=True,
    )
)


def bound(quantity, v, time, law, *, method, cut, max_nodes, relative=False):
    """Return a method at one place: callable(values, nodes, stream) -> bool.

    Parameters
    ----------
    quantity : one of `kacsim.mckean.contour`
    v, time : >= 0; time in mean collision times
    law : BKW or KAC
    method, cut, max_nodes : as `kacsim.boltzmann.estimate_bkw`; a cut needs "ancestral"
    relative : values in units of the equilibrium's density at v
    """
    scale = LOG_MAXWELLIAN[law] - 0.5 * v * v / VARIANCE[law] if relative else 0.0
    fixed = (quantity, float(v), float(time), float(scale), law)
    kernel, own = KERNELS[method], (float(cut),) if method == METHODS[0] else ()
    return lambda values, nodes, stream: kernel(values, nodes, *fixed, *own, max_nodes, stream)
