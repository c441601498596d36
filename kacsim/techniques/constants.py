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
KAC_INITIAL, EXPONENTIAL, RAMP = map(LAWS.index, ("kac_initial", "exponential", "ramp"))
CLOSED = ("exponential", "ramp", "triangle")  # cumulative functions with an inverse in closed form
FACES = ("-x", "+x", "-y", "+y", "-z", "+z")  # the normal that points inward is the opposite one
POWERS = (1, 2, 3, 4)  # of values, whose means are kept
# What is summed over the particles that enter through a face; tangents are velocities.
SUMS = ("number", "speed", "speed_2", "speed_4", "tangent_1", "tangent_2", "product", "squares")
NUMBER, SPEED, SPEED_2, SPEED_4, TANGENT_1, TANGENT_2, PRODUCT, SQUARES = range(len(SUMS))
REACH = 8.0  # thermal velocities from which particles of the outer gas come
FACE, POSITION, VELOCITY = 0, 1, 4  # columns of a particle that is kept, the last two of three
BLOCK = 65536  # values that are worked on at once where no kernel does it


def flux_at_rest(density, temperature):
    """Return the particles that cross per area and time in a gas at rest (exercise 2)."""
    return density * (math.sqrt(temperature) * (1.0 / math.sqrt(2.0 * math.pi)))
