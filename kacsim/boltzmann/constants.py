"""Numbers of the Boltzmann paper that several modules use."""

MAX_NODES = 10_000_000  # budget of one tree
BREATHING = 9.0 / 41.0  # eps of section V
LARGEST_PHASE = 10_000.0  # omega t and phi0 whose sines are known to the last bit
COUPLING = 3.0  # n kappa omega**2 / c_eq**3 of section V
