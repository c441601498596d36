"""Trees whose ends are handed out: for initial laws that no kernel knows."""

from kacsim.kernels.jit import kernel
from kacsim.mckean.contour import FEW, ORDERS
from kacsim.mckean.fragments import first_split, next_end, waiting_nodes


@kernel
def grow(time, b, law, small, cut, shares, left, sums, stream):
    """Draw one tree that splits at least once.

    Parameters
    ----------
    time : > 0, in mean collision times
    b, law : of the tilt
    small : shares of leaves below it enter the sums of their powers, from the `FEW`th end on
    cut : share below which a node ends
    shares, left : float64[m], overwritten by those of the other ends; time still to go, 0 at a leaf
    sums : float64[ORDERS], overwritten

    Returns
    -------
    (number of listed ends, number of ends); -1 if there is no room for them
    """
    waiting = waiting_nodes()
    for k in range(ORDERS):
        sums[k] = 0.0
    listed, ends = 0, 0
    level = first_split(time, b, law, waiting, stream)
    while level > 0:
        level, share, rest = next_end(level, b, law, cut, waiting, stream)
        ends += 1
        if level < 0 or listed >= shares.size:
            return -1, ends
        if rest <= 0.0 and share < small and ends > FEW:
            power = share
            for k in range(ORDERS):
                sums[k] += power
                power *= share
        else:
            shares[listed], left[listed] = share, rest
            listed += 1
    return listed, ends
