"""What the two readings of Nanbu's algorithm share (Kac paper, 4.1).

At each step every particle i collides with probability p = rate * step; it draws a partner j
and becomes v_i cos(theta) + v_j sin(theta), v_j is unchanged. *Synchronous*, as the formulas are
printed, reads v_j at the old time level; *sequential* updates in place for i = 1..N.

Particles that do not collide are skipped: over the N * steps trials in order, the gaps between
collisions are geometric, which is the law of independent trials.
"""

from numba import int64, uint64

from kacsim.kac.constants import n_steps
from kacsim.kernels.jit import inlined
from kacsim.variates import index_below


def arguments(*, n_particles, time, time_step, collision_rate):
    """Return the kernels' parameters: particles, steps, and collision probability of a step."""
    return n_particles, n_steps(time, time_step), collision_rate * time_step


@inlined
def partner_of(i, n_particles, stream):
    """Return a uniform index below n_particles other than i."""
    j = index_below(n_particles - 1, stream)
    return j + int64(j >= i)


@inlined
def leave_step(left, gap, members):
    """Return (steps left, gap) after the end of a step and the whole steps that the gap spans."""
    whole = int64(uint64(gap) // uint64(members))
    return left - 1 - whole, gap - whole * members
