"""The density or the tail that one tree gives, its leaves' values integrated out.

Given the tree, the transform of the value is prod L0(a_i z), so that the quantity is an integral
along z = eta + i omega. The trapezoid rule's error falls exponentially with the inverse step.
"""

import math

import numpy as np

from kacsim.elementary.circular import cos_sin
from kacsim.elementary.exponential import exp
from kacsim.kernels.jit import allocating, inlined, kernel
from kacsim.mckean.constants import LEAST_ETA
from kacsim.mckean.fragments import LEFT, SHARE, first_split, next_end, waiting_nodes
from kacsim.mckean.laws import BETA, ELL, KAPPA, product_mean, saddle_point

DENSITY, TAIL, BEYOND, SHELL = range(4)
POINTS, STEP = 24, 0.5  # of the contour, omega = 0, 0.5 ... 11.5
ORDERS = 8  # sums of powers that stand for small shares
SERIES = 1.0 / 16.0  # largest |beta z**2 rho| of a share in the power sums
FEW = 32  # the first ends are listed all: without sums there is no exponential to take
NEAR = 0.01  # speeds below it take sinh(z v) / v by its series
RE, IM, RE_SQUARE, IM_SQUARE = range(4)


@inlined
def times(a, b, c, d):
    """Return the product of the complex numbers a + ib and c + id."""
    return a * c - b * d, a * d + b * c


@inlined
def factor(quantity, v, re, im):
    """Return F(z) of a quantity, z = re + i im: what multiplies the transform."""
    size = re * re + im * im
    if quantity == DENSITY:
        return 1.0, 0.0
    if quantity == TAIL:
        return re / size, -im / size
    if quantity == BEYOND:
        return 2.0 * (re / size + v), -2.0 * im / size
    return re / (2.0 * math.pi * v), im / (2.0 * math.pi * v)


@inlined
def shell_near_zero(v, re, im):
    """Return F(z) exp(-z v) of the density at a small speed: -z sinh(z v) / (2 pi v).

    The transform is even, so that exp(-z v) can be replaced by -sinh(z v).
    """
    square_re, square_im = times(re, im, re, im)
    fourth_re, fourth_im = times(square_re, square_im, square_re, square_im)
    sixth_re, sixth_im = times(fourth_re, fourth_im, square_re, square_im)
    s = v * v
    total_re = square_re + s * (fourth_re / 6.0 + s * sixth_re / 120.0)
    total_im = square_im + s * (fourth_im / 6.0 + s * sixth_im / 120.0)
    return -total_re / (2.0 * math.pi), -total_im / (2.0 * math.pi)


@allocating
def contour(quantity, v, eta, scale, law):
    """Return the contour's points and what multiplies a tree's product there.

    Parameters
    ----------
    quantity, v : what is estimated, where
    eta : real part of the contour
    scale : values are in units of its exponential

    Returns
    -------
    (float64[4, POINTS] real and imaginary part of the weight and of beta z**2, largest |z**2| beta)
    """
    points = np.empty((4, POINTS))
    beta, ell = BETA[law], ELL[law]
    for k in range(POINTS):
        omega = STEP * k
        weight = STEP / math.pi * (0.5 if k == 0 else 1.0)
        square_re, square_im = eta * eta - omega * omega, 2.0 * eta * omega
        if quantity == SHELL and v < NEAR:
            re, im = shell_near_zero(v, eta, omega)
            growth, angle = ell * square_re - scale, ell * square_im
        else:
            re, im = factor(quantity, v, eta, omega)
            growth, angle = ell * square_re - eta * v - scale, ell * square_im - omega * v
        size = weight * exp(growth)
        cos, sin = cos_sin(angle)
        points[RE, k], points[IM, k] = times(re, im, size * cos, size * sin)
        points[RE_SQUARE, k], points[IM_SQUARE, k] = beta * square_re, beta * square_im
    return points, beta * (eta * eta + (STEP * (POINTS - 1)) ** 2)


@inlined
def multiply_listed(listed, shares, b, points, product):
    """Set product[2, POINTS] to prod (1 + beta z**2 rho_i) / (1 + b rho_i) over listed shares."""
    for k in range(POINTS):
        product[0, k], product[1, k] = 1.0, 0.0
    for i in range(listed):
        share = shares[i]
        inverse = 1.0 / (1.0 + b * share)
        slope = inverse * share
        for k in range(POINTS):
            re = inverse + slope * points[RE_SQUARE, k]
            im = slope * points[IM_SQUARE, k]
            old = product[0, k]
            product[0, k] = old * re - product[1, k] * im
            product[1, k] = old * im + product[1, k] * re


@inlined
def log_of_sums(sums, w_re, w_im):
    """Return the sum of log(1 + w rho) over shares from the sums of their powers."""
    re, im = 0.0, 0.0
    for k in range(ORDERS - 1, -1, -1):
        coefficient = (1.0 - 2.0 * (k & 1)) * sums[k] / (k + 1.0)
        re, im = times(re + 0.0, im, w_re, w_im)
        re += coefficient
    return times(re, im, w_re, w_im)


@inlined
def integral(listed, shares, sums, gone, b, points, product):
    """Return the integral along the contour of one tree's transform over its tilt."""
    multiply_listed(listed, shares, b, points, product)
    real, _ = log_of_sums(sums, b, 0.0)
    real += b * gone
    plain = sums[0] == 0.0 and gone == 0.0
    total = 0.0
    for k in range(POINTS):
        re, im = points[RE, k], points[IM, k]
        if not plain:
            w_re, w_im = points[RE_SQUARE, k], points[IM_SQUARE, k]
            log_re, log_im = log_of_sums(sums, w_re, w_im)
            size = exp(log_re + w_re * gone - real)
            cos, sin = cos_sin(log_im + w_im * gone)
            re, im = times(re, im, size * cos, size * sin)
        total += re * product[0, k] - im * product[1, k]
    return total


@inlined
def fragment(level, b, law, small, cut, max_nodes, waiting, shares, sums, stream):
    """Draw the ends of one tree.

    The subtree of an end of share rho with s still to go gives on average what a leaf of share
    rho e gives, e = exp(-kappa s), times exp((beta z**2 - b) rho (1 - e)).

    Parameters
    ----------
    level : number of nodes in `waiting`
    b, law : of the tilt
    small : larger shares are listed in `shares`, smaller ones enter the sums of their powers
    cut : share below which a node ends
    max_nodes : int, budget
    waiting, shares, sums : overwritten

    Returns
    -------
    (number of listed shares, ends or -1 if the budget is exceeded, sum of rho (1 - e))
    """
    for k in range(ORDERS):
        sums[k] = 0.0
    listed, ends, gone = 0, 0, 0.0
    while level > 0:
        level, share, left = next_end(level, b, law, cut, waiting, stream)
        ends += 1
        if level < 0 or ends + level > max_nodes:
            return 0, -1, 0.0
        if left > 0.0:
            kept = share * exp(-KAPPA[law] * left)
            gone += share - kept
            share = kept
        if share < small and ends > FEW:
            power = share
            for k in range(ORDERS):
                sums[k] += power
                power *= share
        else:
            shares[listed] = share
            listed += 1
    return listed, ends, gone


@kernel
def estimate(values, nodes, quantity, v, time, scale, law, cut, max_nodes, stream):
    """Draw realizations of a quantity at one place by tilted trees.

    Parameters
    ----------
    values : float64[n], overwritten
    nodes : int64[n], overwritten by the numbers of ends; -1 marks an exceeded budget
    quantity : DENSITY of the component, its TAIL above v, BEYOND: the fraction of speeds above v,
        or SHELL: the density of velocities at speed v
    v, time : >= 0; time in mean collision times
    scale : values are in units of exp(scale)
    law : BKW or KAC
    cut : a node with beta eta**2 rho below it is replaced by its subtree's mean; 0 for none
    max_nodes : int, budget of one tree
    stream : from `new_stream`, advanced

    Returns
    -------
    bool, False if a tree exceeded the budget
    """
    saddle = saddle_point(v, time, law)
    eta = max(saddle, LEAST_ETA)
    b = BETA[law] * saddle * saddle
    gathered, mean = product_mean(b, time, law)
    points, largest = contour(quantity, v, eta, scale - gathered, law)
    small, least = SERIES / largest, cut / (BETA[law] * eta * eta)
    waiting, shares = waiting_nodes(), np.empty(int(1.0 / small) + FEW + 2)
    sums, product = np.zeros(ORDERS), np.empty((2, POINTS))
    stratified = time > 0.0 and least <= 1.0
    known, rest = 0.0, mean
    if stratified:
        # The tree that is one leaf is known; the others are drawn.
        shares[0], chance = 1.0, exp(-time - gathered) * (1.0 + b)
        known = chance * integral(1, shares, sums, 0.0, b, points, product)
        rest = mean - chance
    for k in range(values.size):
        waiting[0, SHARE], waiting[0, LEFT] = 1.0, time
        level = first_split(time, b, law, waiting, stream) if stratified else 1
        listed, nodes[k], gone = fragment(
            level, b, law, small, least, max_nodes, waiting, shares, sums, stream
        )
        if nodes[k] < 0:
            return False
        values[k] = known + rest * integral(listed, shares, sums, gone, b, points, product)
    return True
