"""Numbers of the gas: velocities in units of the RMS velocity per axis at equilibrium."""

RATE = 1.0  # collisions of one particle per time: times are mean collision times
INITIAL_SCALE = 1.2  # |v|**2 of the BKW mode at time 0 is this times a Gamma(5/2) variate
