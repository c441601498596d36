"""The public interface as its users type it: read by mypy, never run.

Right uses have the types that are asserted; each wrong one is an error, or its comment is.
"""

from typing import assert_type

import numpy as np

from kacsim import boltzmann, kac, maxwell, techniques
from kacsim.boltzmann import Estimate
from kacsim.typed import Floats, Integers

assert_type(kac.draw("bird", n_particles=5, time=1.0, n_draws=10, seed=1), Floats)
assert_type(kac.draw("poisson", n_particles=np.inf, time=1, n_draws=10, seed=1), Floats)
assert_type(kac.draw_perfect(n_particles=5, n_draws=10, seed=1), Floats)
assert_type(
    kac.draw_equilibrium(n_particles=5, tolerance=1e-3, n_draws=10, seed=1),
    tuple[Floats, Integers],
)
assert_type(kac.density([0.0, 1.0], 2.0), float | Floats)
assert_type(kac.fourth_moment(2.0, 50, algorithm="nanbu_sequential", time_step=0.5), float)
assert_type(kac.moment(6, 2.0, 50), float)
assert_type(kac.ALGORITHMS, tuple[str, ...])
assert_type(maxwell.draw("bird", n_particles=5, time=1.0, n_draws=10, seed=1), Floats)
assert_type(boltzmann.estimate_bkw([0.0, 1.0, 2.0], 1.0, n_realizations=10, seed=1), Estimate)
assert_type(boltzmann.estimate_bkw(2.0, 1.0, n_realizations=10, seed=1).mean, float)
two = boltzmann.Mixture(((1.0, 0.5, 0.0),), 1)
assert_type(kac.estimate_relaxation(1.0, 1.0, initial=two, n_realizations=10, seed=1), Estimate)
assert_type(techniques.tabulate(np.cos, 0.0, 1.0, 8), Floats)
table = techniques.tabulate(np.cos, 0.0, 1.0, 8)
kac.draw("bird", n_particles=5, time=1.0, n_draws=10, seed=1, initial=table, scattering="forward")

kac.draw("bird", n_particles="5", time=1.0, n_draws=10, seed=1)  # type: ignore[arg-type]
kac.draw("bird", n_particles=5, time=1.0, n_draws=10)  # type: ignore[call-arg]
kac.draw(7, n_particles=5, time=1.0, n_draws=10, seed=1)  # type: ignore[arg-type]
kac.drew("bird")  # type: ignore[attr-defined]
kac.estimate_density([1.0], 1.0, n_realizations=10, seed=1)  # type: ignore[arg-type]
found = boltzmann.estimate_bkw(2.0, 1.0, n_realizations=10, seed=1).average  # type: ignore[attr-defined]
kac.estimate_relaxation(1.0, 1.0, initial=1.5, n_realizations=10, seed=1)  # type: ignore[arg-type]
techniques.sphere_volume("3", 10, seed=1)  # type: ignore[arg-type]
