"""Numbers as the report prints them."""

import numpy as np
import pytest

from kacsim.report import numbers as report_numbers


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0, "0"),
        (-3, "−3"),
        (100000, "100\u202f000"),
        (2564.0, "2564"),
        (948.2, "948.2"),
        (0.0078125, "0.0078125"),
        (0.0187, "0.0187"),
        (-12345.678, "−12\u202f345.7"),
        (7.123456789, "7.12346"),
        (123450.4, "123\u202f450"),
        (1e-6, "10⁻⁶"),
        (-2.5e-12, "−2.5·10⁻¹²"),
        (2e-5, "2·10⁻⁵"),
        (np.inf, "∞"),
        (-np.inf, "−∞"),
        (np.nan, "not a number"),
    ],
)
def test_number(value, text):
    assert report_numbers.number(value) == text


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (0.048617, 0.0001427, "0.04862 ± 0.00014"),
        (3204.937, 0.584, "3204.94 ± 0.58"),
        (-12.3, 45.6, "−12 ± 46"),
        (20000.0, 123.0, "20\u202f000 ± 123"),
        (7.646e-6, 8.596e-6, "(7.6 ± 8.6)·10⁻⁶"),
        (4225, 0.0, "4225"),
        (0.123456, np.nan, "0.1235"),
    ],
)
def test_an_estimate_shows_two_digits_of_its_error(value, error, text):
    assert report_numbers.pm(value, error) == text


def test_formulas_and_estimates_do_not_break():
    assert report_numbers.bound("N = 5: 1 ± 2") == "N\u00a0=\u00a05: 1\u00a0±\u00a02"


@pytest.mark.parametrize(
    ("values", "text"), [([], "none"), ([5], "5"), ([1, 2], "1 and 2"), ([1, 2, 3], "1, 2 and 3")]
)
def test_a_list_in_words(values, text):
    assert report_numbers.listed(values) == text


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (4.5537, 0.003, "4.5537"),
        (1.089e-9, 2.6e-11, "1.089·10⁻⁹"),
        (-0.0002, 1e-5, "−2.00·10⁻⁴"),
        (0, 1e-9, "0"),
        (5, 0.0, "5"),
    ],
)
def test_a_number_beside_an_estimate_has_its_digits(value, error, text):
    assert report_numbers.beside(value, error) == text


def test_subscripts():
    text = report_numbers.subscripted("u N_t < F_j, L_y = 2: n_draws, x_max")
    assert text == "u N<sub>t</sub> &lt; F<sub>j</sub>, L<sub>y</sub> = 2: n_draws, x_max"


@pytest.mark.parametrize(
    ("low", "high", "text"),
    [
        (0.0432, 0.0532, "0.0432 to 0.0532"),
        (2305.8, 2790.2, "2306 to 2790"),
        (-1.5e-6, 2.5e-6, "(−1.5 to 2.5)·10⁻⁶"),
        (1.5, 1.5, "1.5"),
        (0.1, float("inf"), "0.1 to ∞"),
    ],
)
def test_an_interval_has_the_digits_of_its_width(low, high, text):
    assert report_numbers.span(low, high) == text
