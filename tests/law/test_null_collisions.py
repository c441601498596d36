"""The second moment of Algorithm 6 in a uniform gas against its equation.

Where the fourth moment is finite, by far: at most half of the time from which, about, it is not.
"""

import numpy as np
import pytest
from law import compare
from law.compare import caught, ok
from law.realizations import kernel_draws

from kacsim.boltzmann import null_moment, uniform_tree

N = 400_000


@pytest.mark.parametrize(("ratio", "time"), [(1.3, 0.5), (1.7, 0.9), (2.3, 0.4)])
def test_second_moment(ratio, time, seed):
    """9 z: mean 1, mean square G(t) and mean t' drawings."""
    name = f"uniform {ratio}"
    values, nodes = kernel_draws(uniform_tree.estimate_moment, (ratio, time, 10**7), N, seed, name)
    assert ok(compare.of_mean(values, 1.0))
    assert ok(compare.of_mean(values**2, float(null_moment.second_moment(time, ratio))))
    assert ok(compare.of_mean(nodes.astype(float), float(null_moment.mean_calls(time, ratio))))
    # Negative controls: the moment without its source, and of the smallest possible one.
    assert caught(compare.of_mean(values**2, 1.0))
    later = float(null_moment.mean_calls(1.05 * time, ratio))
    assert caught(compare.of_mean(nodes.astype(np.float64), later))
