"""Realizations, estimates and probes of the law tests of the Boltzmann paper, and their z."""

import math

import numpy as np
from law import compare
from law import literal_trees as printed

from kacsim.streams import new_stream

N, N_MUTANT = 1_000_000, 100_000
Q, VELOCITY = 1.7, np.array([1.0, 0.5, 2.0])
RATE, START, MAJORANT = 2.3, 0.4, 1.6
# (n, kappa, omega, c_eq, eps, phi0): n kappa omega**2 / c_eq**3 = 2.7
GAS = (2.0, 5.0, 0.6, 1.1, 0.3, 0.4)
TRAP = {
    "amount": 2.0,
    "cross_section": 5.0,
    "angular_frequency": 0.6,
    "rms_velocity": 1.1,
    "breathing": 0.3,
    "start_phase": 0.4,
}
PLACE, SPEED = np.array([0.5, -0.3, 0.2]), np.array([0.4, 0.8, -0.3])
LATE = 1.5 / 0.6


def z_of(estimate, exact):
    return (estimate.mean - exact) / estimate.standard_error


def z_between(a, b):
    return (a.mean - b.mean) / math.hypot(a.standard_error, b.standard_error)


def drawn(function, *arguments, seed, name, n=N_MUTANT, mutation=printed.AS_PRINTED):
    """Return realizations, scaled n, of one of the printed algorithms."""
    values = np.empty(compare.scaled(n))
    function(values, *arguments, mutation, new_stream(seed, f"printed {name}"))
    return values


def z_of_leaves(nodes, time):
    """Return z of the law of (t' drawings + 1) / 2 leaves: geometric, mean exp(time)."""
    leaves, success = (nodes + 1) // 2, math.exp(-time)
    counts = np.bincount(leaves)[1:]
    shares = success * (1.0 - success) ** np.arange(counts.size)
    shares[-1] = 1.0 - shares[:-1].sum()
    return compare.of_counts(counts, shares)


def kernel_draws(kernel, arguments, n, seed, name):
    n = compare.scaled(n)
    values, nodes = np.empty(n), np.empty(n, np.int64)
    assert kernel(values, nodes, *arguments, new_stream(seed, name))
    return values, nodes


def reduced(place, speed):
    """Return radius, radial and tangential velocity in c_eq / omega and c_eq."""
    radius = np.linalg.norm(place)
    radial = speed @ place / radius
    tangential = np.linalg.norm(np.cross(place, speed)) / radius
    return radius * 0.6 / 1.1, radial / 1.1, tangential / 1.1


def z_from(values, estimate):
    """Return z between realizations and an estimate of the package."""
    error = math.hypot(values.std(ddof=1) / math.sqrt(values.size), estimate.standard_error)
    return (values.mean() - estimate.mean) / error
