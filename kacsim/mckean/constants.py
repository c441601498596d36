"""Numbers of the two laws whose trees are summed; each pair is (Maxwell molecules, Kac).

The value of a particle at time t is a sum of a_i x_i over the leaves of its tree, the x_i
independent draws of one component of the initial law and the squares rho_i = a_i**2 a random
fragmentation of 1: a split sends rho to U rho and (1 - U) rho. Of Maxwell molecules in three
dimensions (a Cartesian component, BKW start) U is uniform, of Kac's equation it is cos**2 of a
uniform angle. For both L0(z) = E exp(z x) = exp(ell z**2) (1 + beta z**2).
"""

BKW, KAC = 0, 1
ELL = (0.3, 0.25)
BETA = (0.2, 0.5)
KAPPA = (1.0 / 6.0, 1.0 / 8.0)  # E[U (1 - U)]
VARIANCE = (1.0, 1.5)  # 2 (ell + beta), of x and of the sum
# One component's initial law: Normal(0, 2 ell) times CONSTANT + SQUARE x**2.
CONSTANT = (2.0 / 3.0, 0.0)
SQUARE = (5.0 / 9.0, 2.0)

METHODS = ("ancestral", "free_leaf", "geometric")
LARGEST_SPEED = 100.0  # beyond it nothing is left in double precision
CUT = 0.5  # of subtrees, where a whole tree is too large
LEAST_ETA = 2.0  # real part of a contour, which keeps clear of the pole of a tail at 0
HALVINGS = 60  # of an interval of saddle points, to the last bit
