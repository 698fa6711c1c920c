"""Numbers, placeholders and expressions of scenes."""
from __future__ import annotations

import math

import numpy as np
import pytest
from courant.expressions import ExpressionFault, PlaceFormula, evaluate
from courant.scene.numbers import number_text, numbers, whole_numbers
from courant.scene.placeholders import PlaceholderFault, substitute

VARIABLES = {"dx": 0.5, "n": 4.0}


@pytest.mark.parametrize(("text", "value"), [
    ("1 + 2 * 3", 7), ("(1 + 2) * 3", 9), ("8 / 4 / 2", 1), ("5 - 3 - 1", 1), ("-2^2", -4), ("2^3^2", 512), ("2^-1", 0.5), ("-1.5e-3 * -2", 3e-3),
    ("dx / n", 0.125), ("${dx} * ${n + 1}", 2.5), ("ceil(2.1) + floor(2.9) + round(2.6) + abs(-1) + sqrt(16)", 13), ("min(dx, n) + max(dx, n)", 4.5),
    ("dx < n", 1), ("dx >= n", 0), ("0 < dx < 1 and n == 4", 1), ("0 < dx < 0.5", 0), ("not dx < n or n != 4", 0), ("(n > 5) * 7 + 1", 1)])
def test_expressions_have_their_values(text: str, value: float) -> None:
    assert evaluate(text, VARIABLES) == value


@pytest.mark.parametrize(("text", "message"), [
    ("2 * spacing", "unknown parameter 'spacing'"), ("2 * dy", "unknown parameter 'dy', did you mean dx?"), ("1 / (n - 4)", "division by zero"),
    ("(1 + 2", "')' is missing"), ("1 +", "a value is missing"), ("", "a value is missing"), ("2o.0", "'o.0' is not understood"),
    ("sine(1)", "unknown function 'sine', did you mean sin?"), ("2 * ${dx + 1", "'}' is missing"), ("2 * (dx}", "')' is missing"),
    ("sqrt(-1)", "the result is not a finite number"), ("(" * 5000, "too deeply nested"), ("not " * 5000 + "1", "too deeply nested"),
    ("dx <", "a value is missing"), ("dx < 1 and", "a value is missing")])
def test_expressions_name_what_is_wrong(text: str, message: str) -> None:
    with pytest.raises(ExpressionFault) as fault:
        evaluate(text, VARIABLES)
    assert fault.value.message == message


def test_functions_have_the_bits_of_the_c_library() -> None:
    x = np.linspace(-3, 700, 4001)
    for name in ("sin", "cos", "tan", "atan", "sinh", "exp"):
        values = PlaceFormula(f"{name}(x)", {}).over([x, x, x], len(x))
        assert values.tolist() == [getattr(math, name)(v) for v in x]
    assert np.isnan(PlaceFormula("log(x)", {}).over([x, x, x], len(x))[x <= 0]).all()


def test_conditions_hold_where_they_hold_and_keep_what_has_no_value() -> None:
    x = np.array([-1.0, 0.0, 2.0, 5.0])
    assert PlaceFormula("x < 6 and 1 / x > 0.3", {}).over([x, x, x], 4)[[0, 2, 3]].tolist() == [0, 1, 0]
    assert np.isnan(PlaceFormula("x < 6 or 1 / x > 0", {}).over([x, x, x], 4)[1])


@pytest.mark.parametrize(("value", "width", "text"), [
    (1000, 10, "1000"), (0.1 + 0.2, 10, "0.3"), (-0.0, 10, "0"), (2.202256e9, 10, "2202256000"), (2.202256e12, 11, "2.202256e12"),
    (2.202256e12, 10, "2.2023e12"), (1e-20, 10, "1e-20"), (-1e20, 10, "-1e20"), (1 / 3, 10, "0.3333333"), (-1.23456789e-100, 6, ""), (1e5, 0, "100000")])
def test_numbers_keep_digits_and_fit_their_columns(value: float, width: int, text: str) -> None:
    assert number_text(value, width) == text


def test_arrays_of_numbers_are_written_as_each_of_them() -> None:
    random = np.random.default_rng(1)
    spread = random.normal(size=4000) * 10.0 ** random.integers(-7, 15, 4000)
    halves = (random.integers(0, 2000, 2000) + 0.5) * 0.0125  # the 14th digit is a five, or nothing
    values = np.concatenate([spread, halves, np.round(spread, 3), [0.0, -0.0, 1e-3, 9.9999999999999, 99.99999999999999, 9.5e12, 1e13, 1e300, -5e-324]])
    for width, total in ((15, 16), (20, 20)):
        text = numbers(values, width, total)
        assert [row.tobytes().decode() for row in text] == [number_text(float(v), width).rjust(total) for v in values]
    whole = np.array([0, 1, 9, 10, 999, 1000, 12345678])
    assert [row.tobytes().decode() for row in whole_numbers(whole, 8)] == [f"{k:8}" for k in whole]


def test_placeholders_are_filled_and_keep_columns() -> None:
    assert substitute("d1/${n}", VARIABLES) == "d1/4"
    assert substitute("         1${dx:10}${2 * n:10}\n", VARIABLES) == "         1       0.5         8\n"
    assert substitute("no placeholder", VARIABLES) == "no placeholder"


def test_faults_of_placeholders_have_their_line() -> None:
    with pytest.raises(PlaceholderFault) as fault:
        substitute("a\nb ${dx}\nc ${dy}\n", VARIABLES)
    assert (fault.value.message, fault.value.line) == ("in '${dy}': unknown parameter 'dy', did you mean dx?", 2)
    for text in ("${dx", "${dx\n}", "${dx:0}", "${dx:1x}", "${dx/3:4}"):
        with pytest.raises(PlaceholderFault):
            substitute(text, VARIABLES)
