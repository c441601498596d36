"""Constants of the elementary functions: decimal arithmetic, rounded at its end."""

import decimal
import functools
from decimal import ROUND_FLOOR, Decimal

DIGITS = 40


def precise(make):
    """Have a function that makes constants compute with `DIGITS` digits."""

    @functools.wraps(make)
    def made(*arguments):
        with decimal.localcontext(decimal.Context(prec=DIGITS)):
            return make(*arguments)

    return made


@precise
def rounded(values):
    """Return (high, low): lists of floats whose sums are the decimals to about 106 bits."""
    high = [float(value) for value in values]
    return high, [float(v - Decimal(h)) for v, h in zip(values, high, strict=True)]


@precise
def cut(value, *units):
    """Return a decimal as a sum of floats: whole multiples of each unit, falling, and the rest."""
    parts = []
    for unit in units:
        whole = (value / Decimal(unit)).to_integral_value(ROUND_FLOOR)
        parts.append(float(whole) * unit)
        value -= whole * Decimal(unit)
    return (*parts, float(value))


@precise
def cosine(angle):
    """Return the cosine of a small angle."""
    term = total = Decimal(1)
    for n in range(1, 60, 2):
        term *= -angle * angle / (n * (n + 1))
        total += term
    return total


@precise
def _inverse_tangent(n):
    """Return the arc tangent of 1 / n."""
    term = total = 1 / Decimal(n)
    for k in range(1, 100):
        term = -term / n**2
        total += term / (2 * k + 1)
    return total


@precise
def _pi():
    """Return pi by Machin's formula."""
    return 4 * (4 * _inverse_tangent(5) - _inverse_tangent(239))


PI = _pi()
LN2 = precise(Decimal.ln)(Decimal(2))


@precise
def cosines(parts):
    """Return the cosines of the multiples of 2 pi / parts, from 0 on; parts is a multiple of 4."""
    one, step = Decimal(1), 2 * PI / parts
    first, second = cosine(step), cosine(PI / 2 - step)
    quarter, other = [one], Decimal(0)
    while len(quarter) < parts // 4:
        this = quarter[-1]
        quarter.append(this * first - other * second)
        other = other * first + this * second
    half = [*quarter, Decimal(0), *(-value for value in quarter[::-1])]
    return half + half[-2:0:-1]
