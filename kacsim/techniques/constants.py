"""Named laws of the chapter's examples, axes and faces."""

import math

# law -> (lower, upper) end of its table or box; beyond them f0 has 8e-11 and the exponential 6e-6
SUPPORT = {
    "kac_initial": (-5.0, 5.0),
    "exponential": (0.0, 12.0),
    "ramp": (0.0, 1.0),
    "triangle": (0.0, 1.0),
}
LAWS = tuple(SUPPORT)
KAC_INITIAL, EXPONENTIAL, RAMP, TRIANGLE = map(
    LAWS.index, ("kac_initial", "exponential", "ramp", "triangle")
)
CLOSED = ("exponential", "ramp", "triangle")  # cumulative functions with an inverse in closed form
AXES = ("x", "y", "z")
FACES = ("-x", "+x", "-y", "+y", "-z", "+z")  # the normal that points inward is the opposite one


def flux_at_rest(density, temperature):
    """Return the particles that cross per area and time in a gas at rest (exercise 2)."""
    return density * (math.sqrt(temperature) * (1.0 / math.sqrt(2.0 * math.pi)))
