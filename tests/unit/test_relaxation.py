"""Any initial law by McKean's trees: bad laws are refused, the exact ones come out."""

import math

import numpy as np
import pytest

from kacsim import boltzmann, kac
from kacsim.boltzmann import bkw
from kacsim.boltzmann.initial_laws import variance_of
from kacsim.boltzmann.relaxation import Relaxation
from kacsim.mckean import constants
from kacsim.streams import new_stream

BKW = boltzmann.Mixture(((0.6, (0.0, 1.0 / 1.8)),))  # c**2 times a Gaussian: the BKW mode's start
KAC = boltzmann.Mixture(((0.5, (0.0, 2.0)),), dimensions=1)
TWO = boltzmann.Mixture(((0.5, (0.6,)), (1.75, (0.4,))))
SIZE = {"n_realizations": 200, "seed": 3}


@pytest.mark.parametrize("z", [0.0, 0.7, 1.3 + 2.0j, 5.0j])
def test_transforms_of_mixtures(z):
    z = np.array([z], complex)
    assert BKW.mgf(z)[0] == pytest.approx(np.exp(0.3 * z * z)[0] * (1 + 0.2 * z * z)[0])
    assert KAC.mgf(z)[0] == pytest.approx(np.exp(0.25 * z * z)[0] * (1 + 0.5 * z * z)[0])
    two = 0.6 * np.exp(0.25 * z * z) + 0.4 * np.exp(0.875 * z * z)
    assert TWO.mgf(z)[0] == pytest.approx(two[0])


def test_densities_of_mixtures():
    speed = np.array([0.0, 0.4, 2.5])
    np.testing.assert_allclose(BKW.density(speed), bkw.density(speed, 0.0), rtol=1e-12)
    np.testing.assert_allclose(KAC.density(speed), kac.density(speed, 0.0), rtol=1e-12)
    assert [variance_of(law) for law in (BKW, KAC, TWO)] == pytest.approx([1.0, 1.5, 1.0])


def test_the_density_of_a_mixture_has_the_total_one():
    speed = np.linspace(0.0, 30.0, 30_001)
    density = TWO.density(speed) * 4.0 * math.pi * speed**2
    assert np.trapezoid(density, speed) == pytest.approx(1.0, abs=1e-8)


@pytest.mark.parametrize(
    ("parts", "sentence"),
    [
        (((0.6, (0.0, 1.0)),), "total is 1.8, and must be 1"),
        (((0.6, (2.0, -1.0 / 1.8)),), "density is negative near"),
        (((-0.6, (1.0,)),), "variance = -0.6: must be a positive finite number"),
        (((0.6, (math.nan,)),), "coefficients = nan: must be a finite number"),
        ((), "at least one part"),
    ],
)
def test_bad_mixtures_are_refused(parts, sentence):
    with pytest.raises(ValueError, match=sentence):
        boltzmann.Mixture(parts)


@pytest.mark.parametrize(
    ("mgf", "sentence"),
    [
        (lambda z: np.exp(z), "must be even"),
        (lambda z: 2.0 * np.exp(z * z), "is 2.* at 0, and must be 1"),
        (lambda z: np.exp(-z * z), "grow along the real axis"),
        (lambda z: 2.0 * np.cosh(3.0 * z) - np.cosh(z), "at most 1 along the imaginary axis"),
        (lambda z: np.nan, "a finite number for each"),
    ],
)
def test_bad_transforms_are_refused(mgf, sentence):
    with pytest.raises(ValueError, match=sentence):
        boltzmann.Transform(mgf)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"initial": 3}, "initial = 3: must be a law"),
        ({"time": 13.0}, "time = 13.0: must be at most 12 without a cut"),
        ({"time": -1.0}, "time = -1.0"),
        ({"cut": -1.0}, "cut = -1.0"),
        ({"n_realizations": 1}, "n_realizations = 1"),
    ],
)
def test_bad_arguments_are_refused(change, sentence):
    arguments = {"velocity": 1.0, "time": 1.0, "initial": TWO, **SIZE} | change
    with pytest.raises(ValueError, match=sentence):
        boltzmann.estimate_relaxation(**arguments)


def test_the_start_is_exact():
    for speed in (0.0, 0.004, 1.3):
        found = boltzmann.estimate_relaxation(speed, 0.0, initial=TWO, **SIZE)
        assert found.mean == pytest.approx(float(TWO.density(speed)), rel=1e-9)
        assert found.standard_error < 1e-7 * found.mean
    found = kac.estimate_relaxation(-0.8, 0.0, initial=KAC, **SIZE)
    assert found.mean == pytest.approx(float(KAC.density(0.8)), rel=1e-9)


@pytest.mark.parametrize("cut", [0.0, 0.5])
@pytest.mark.parametrize(("law", "kind"), [(BKW, constants.BKW), (KAC, constants.KAC)])
def test_a_general_tree_gives_what_the_kernel_of_its_law_gives(law, kind, cut, seed):
    """The same draws again; and each end of a tree by closed forms, cut at any age or not."""
    found = Relaxation(law, lambda z: 1.0 / z, 3.1, 1.8, kind, cut)
    values, nodes, again = np.empty(20), np.empty(20, np.int64), np.empty(20)
    assert found(values, nodes, new_stream(seed))
    assert found(again, nodes, new_stream(seed))
    np.testing.assert_array_equal(values, again)
    beta, ell = constants.BETA[kind], constants.ELL[kind]
    order = np.arange(1, 7)
    logs = -((-beta) ** order) / order + ell * (order == 1)
    np.testing.assert_allclose(found.series[:6], logs, rtol=1e-6)
    z = np.sqrt(found.squares)
    left = np.array([0.0, 0.4, 1.1, 1.8]) * (cut > 0.0)
    shares = found.cut * np.array([0.3, 0.9, 0.6, 0.95]) if cut else np.full(4, 0.2)
    kept = (shares * np.exp(-constants.KAPPA[kind] * left))[:, None]
    square = beta * z**2
    wanted = np.exp(ell * z**2 * shares[:, None] + square * (shares[:, None] - kept))
    wanted *= 1.0 + square * kept
    tilt = np.exp(found.b * (shares[:, None] - kept)) * (1.0 + found.b * kept)
    np.testing.assert_allclose(found.transforms(shares, left) * tilt, wanted, rtol=1e-9)
