"""The tables that variates are looked up in, against mpmath. No statistics."""

import mpmath
import numpy as np
import pytest

from kacsim import variate_tables as tables


def speed(x):
    x = mpmath.mpf(float(x))
    return x**2 * mpmath.exp(1 - x**2)


def speeds_beyond(x):
    """Return the integral of `speed` from x on."""
    x = mpmath.mpf(float(x))
    return mpmath.e * (mpmath.sqrt(mpmath.pi) / 4 * mpmath.erfc(x) + x / 2 * mpmath.exp(-(x**2)))


def strip_errors(edge, least, largest, width):
    """Return the largest relative errors of what the strips must be."""
    area = speeds_beyond(edge[-1])
    ends = [speed(x) for x in edge]
    errors = {"area": 0.0, "width": 0.0, "least": 0.0, "largest": 0.0}
    for k in range(edge.size - 1):
        top = mpmath.mpf(1) if edge[k] < 1.0 <= edge[k + 1] else max(ends[k], ends[k + 1])
        bottom = min(ends[k], ends[k + 1])
        found = {
            "area": largest[k] * mpmath.mpf(width[k]) / area,
            "width": (edge[k + 1] - mpmath.mpf(edge[k])) / width[k],
            "least": least[k] / bottom if bottom else 1 + least[k],
            "largest": largest[k] / top,
        }
        for name, ratio in found.items():
            errors[name] = max(errors[name], float(abs(ratio - 1)))
    return errors


def test_strips_and_the_tail_have_one_area():
    """Edges have errors of half a unit in the last place, so that their differences have more."""
    columns = tables.SPEED_EDGE, tables.SPEED_LEAST, tables.SPEED_LARGEST, tables.SPEED_WIDTH
    assert tables.SPEED_EDGE.size == tables.LAYERS == 256
    assert tables.SPEED_EDGE[0] == 0.0
    assert tables.SPEED_EDGE[-1] == tables.SPEED_TAIL
    found = strip_errors(*columns)
    assert max(found["least"], found["largest"], found["area"]) < 5e-15
    assert found["width"] < 5e-14
    # The last entries are the tail's: no place in it is sure.
    assert [column[-1] for column in columns[1:]] == [0.0, 0.0, 0.0]


def test_other_strips_are_told():
    """Negative control: another common area, which leaves another tail."""
    found = strip_errors(*tables.strips("4.7779e-3"))
    assert found["area"] > 1e-5


def test_heights_that_are_sure_fill_the_width():
    """A height below the least density, in units of 2**-53 of the largest, is scaled to a place."""
    share = tables.SPEED_LEAST[:-1] / tables.SPEED_LARGEST[:-1]
    np.testing.assert_array_equal(tables.SPEED_SURE[:-1], np.floor(share * 2.0**53))
    assert tables.SPEED_SURE[-1] == 0
    places = tables.SPEED_SURE * tables.SPEED_SCALE
    sure = tables.SPEED_SURE > 0
    np.testing.assert_allclose(places[sure], tables.SPEED_WIDTH[sure], rtol=1e-15)
    assert sure.sum() == 254  # not the tail, nor the strip at 0
    chance = tables.SPEED_SURE.sum() / 2.0**53 / 256
    assert chance > 0.96


@pytest.mark.parametrize(
    ("layers", "density", "beyond", "tail"),
    [
        (tables.EXPONENTIAL, lambda x: mpmath.exp(-x), lambda x: mpmath.exp(-x), tables.E_TAIL),
        (
            tables.NORMAL,
            lambda x: mpmath.exp(-(x**2) / 2),
            lambda x: mpmath.sqrt(mpmath.pi / 2) * mpmath.erfc(x / mpmath.sqrt(2)),
            tables.N_TAIL,
        ),
    ],
    ids=["exponential", "normal"],
)
def test_layers_and_the_tail_have_one_area(layers, density, beyond, tail):
    edge, scale, sure, height = layers
    assert (edge.size, edge[1], edge[-1], height[-1]) == (257, tail, 0.0, 1.0)
    area = tail * density(mpmath.mpf(tail)) + beyond(mpmath.mpf(tail))
    for k in range(1, 256):
        assert float(abs(density(mpmath.mpf(edge[k])) / height[k] - 1)) < 1e-14
        # The uppermost layer ends at the density's maximum, as well as the areas are known.
        assert float(abs(edge[k] * (height[k + 1] - height[k]) / area - 1)) < 1e-9
    np.testing.assert_array_equal(scale, edge * 2.0**-53)
    np.testing.assert_allclose(sure / 2.0**53, edge[1:] / edge[:-1], atol=2.0**-52)
    assert edge[0] == pytest.approx(float(area / density(mpmath.mpf(tail))), rel=1e-9)


def test_points_on_the_circle_are_the_nearest_numbers():
    with mpmath.workdps(40):
        angles = [2 * mpmath.pi * k / tables.POINTS for k in range(tables.POINTS)]
        wanted = [[float(mpmath.cos(x)), float(mpmath.sin(x))] for x in angles]
    np.testing.assert_allclose(tables.COS_SIN.reshape(-1, 2), wanted, rtol=3e-16, atol=1e-16)
    # Negative control: points off by one.
    turned = np.roll(tables.COS_SIN.reshape(-1, 2), 1, axis=0)
    assert abs(turned - wanted).max() > 1e-3
