"""How much work a draw of the Kac paper is: particles, collisions and steps, in closed form."""

import math

from kacsim.kac.constants import LIMIT_STEPS, SINGLE
from kacsim.kac.contraction import blocks_per_draw, chosen_block, predicted_steps

LARGEST = 700.0  # exponent of the growth, whatever a configuration asks for


def history(span, n_particles):
    """Return about the mean number of collisions of particle 1's ancestors, as without chance.

    The mean number s of ancestors grows as s (N - s) / (N - 1), and s (1 - (s - 1) / (2 (N - 1)))
    collisions touch them: `kacsim.kac.ancestors` has the exact mean. For N infinite it is
    exp(span) - 1.

    Parameters
    ----------
    span : mean number of collisions of one particle
    n_particles : int >= 2 or math.inf
    """
    if n_particles == math.inf:
        return math.expm1(min(LARGEST, span))
    n = float(n_particles)
    left = math.exp(-min(LARGEST, span * n / (n - 1.0)))
    ancestors = n / (1.0 + (n - 1.0) * left)
    share = (ancestors - 1.0) / (n - 1.0)
    touched = 0.5 * (n - 1.0) * (-math.log1p(-share) if share < 1.0 else span * n / (n - 1.0))
    return touched + 0.5 * (ancestors - 1.0)


def of_velocities(parameters):
    """Return the work of one draw of v_1.

    Returns
    -------
    dict: draw, 1; particle, those drawn at time 0; collision; own, the collisions of particle 1;
    step, and busy, steps in which there are collisions; visit, particles times steps
    """
    n, span = parameters["n_particles"], parameters["collision_rate"] * parameters["time"]
    step = parameters.get("time_step")
    steps = parameters["time"] / step if step else 0.0
    if parameters["engine"] == "forward":
        collisions = 0.5 * n * span
        each = {"draw": 1.0, "particle": n, "collision": collisions, "visit": n * steps}
        return each | {"step": steps, "busy": min(steps, collisions)}
    # A step multiplies the ancestors by 1 + rate step at most.
    collisions = history(steps * math.log1p(span / steps) if steps else span, n)
    each = {"draw": 1.0, "own": span, "collision": collisions}
    return each | {"step": steps, "busy": min(steps, collisions)}


def _steps(n_particles, tolerance, energy=None):
    """Return about the steps until corner points have met; two particles meet in one."""
    return max(1.0, predicted_steps(n_particles, tolerance, energy)) if n_particles > 2 else 1.0


def of_coupling(parameters):
    """Return the work of one epsilon-perfect draw: steps of N entries, and looks at all of them."""
    n = parameters["n_particles"]
    steps = _steps(n, parameters["tolerance"], parameters["energy"])
    return {"draw": 1.0, "step": steps, "entry": n * steps, "square": n * n}


def of_blocks(parameters):
    """Return the work of one perfect draw: blocks of steps of N entries, bounds among them."""
    n, block = parameters["n_particles"], parameters["block"]
    block = chosen_block(n) if block is None else block
    blocks = blocks_per_draw(n, block)
    steps = blocks * (block + n)  # the bounds take as long as N steps
    return {"draw": 1.0, "block": blocks, "step": steps, "entry": n * steps}


def of_corners(parameters):
    """Return the work of one recorded run: every corner at every step."""
    n = parameters["n_particles"]
    steps = _steps(n, parameters["tolerance"])
    return {"draw": 1.0, "step": steps, "entry": n**3 * steps}


def of_readings(parameters):
    """Return the work of one draw of the times of all rules, until the last tolerance."""
    n = parameters["n_particles"]
    steps = _steps(n, min(parameters["tolerance"]), energy=1.0)
    if parameters["walk"] == SINGLE:
        steps = min(steps, LIMIT_STEPS)
    return {"draw": 1.0, "step": steps, "entry": n * steps}
