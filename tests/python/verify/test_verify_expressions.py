"""Expressions of suites: grammar, faults, values over arrays."""

from __future__ import annotations

import math

import numpy as np
import pytest

from courant.expressions import ExpressionFault, Formula, constant_value, evaluate
from courant.variables import VARIABLES
from courant.verify.names import find_history_names


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1 + 2 * 3", 7),
        ("-2 ^ 2", -4),
        ("2 ** -1", 0.5),
        ("2 ^ 3 ^ 2", 512),
        ("(1 + 2) * 3", 9),
        ("&a / 4", 0.5),
        ("${a} * ${b + 1}", 8),
        ("1.5e2", 150),
        ("1d-3", 1e-3),
        (".5", 0.5),
        ("3 - 2 - 1", 0),
        ("8 / 4 / 2", 1),
        ("min(3, 1, 2)", 1),
        ("MAX(a, b)", 3),
        ("mod(7.4, 3)", 1),
        ("mod(-7, 3)", -1),
        ("sign(3, -2)", -3),
        ("sign(-3, 0)", 3),
        ("nint(2.5)", 3),
        ("nint(-2.5)", -3),
        ("int(-2.7)", -2),
        ("floor(-2.1)", -3),
        ("ceil(2.1)", 3),
        ("atan2(1, 1)", math.pi / 4),
        ("ctn(1)", 1 / math.tan(1)),
        ("sqrt(abs(-4))", 2),
        ("+a", 2),
    ],
)
def test_values(text: str, value: float) -> None:
    assert evaluate(text, {"a": 2, "b": 3}) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "a value is missing"),
        ("1 +", "a value is missing"),
        ("(1", "')' is missing"),
        ("1 2", "'2' is not understood"),
        ("depht", "unknown parameter 'depht', did you mean depth?"),
        ("sqr(2)", "unknown function 'sqr', did you mean sqrt?"),
        ("min(1)", "min takes 2 arguments or more, got 1"),
        ("sin(1, 2)", "sin takes 1 argument, got 2"),
        ("1 / 0", "division by zero"),
        ("0 ^ -1", "division by zero"),
        ("mod(1, 0.2)", "division by zero"),
        ("log(-1)", "the result is not a finite number"),
        ("int(1e30)", "the result is too large for an integer"),
        ("1e999", "the number 1e999 is too large or too small"),
        ("& 1", "a name is missing behind '&'"),
        ("$", "expected a number or a name, got '$'"),
        ("${a", "'}' is missing"),
        ("(" * 200 + "1" + ")" * 200, "too deeply nested"),
        ("1 = 2", "'= 2' is not understood"),
    ],
)
def test_faults(text: str, message: str) -> None:
    with pytest.raises(ExpressionFault) as fault:
        evaluate(text, {"depth": 2, "a": 1})
    assert str(fault.value) == message
    with pytest.raises(ExpressionFault, match="got '"):
        constant_value(text, {"depth": 2, "a": 1})


def test_over_arrays_what_has_no_value_is_nan() -> None:
    x = np.array([-1.0, 0, 4])
    formula = Formula("sqrt(x) / x + a", ["x"], {"a": 1})
    assert formula.over({"x": x}, 3) == pytest.approx([math.nan, math.nan, 1.5], nan_ok=True)
    assert Formula("(0 / x) ^ 0", ["x"]).over({"x": x}, 3) == pytest.approx([1, math.nan, 1], nan_ok=True), "NaN^0 is no number"
    assert Formula("max(1, 1 / x)", ["x"])(0.0) != Formula("max(1, 1 / x)", ["x"])(0.0), "a comparison does not lose it"
    assert Formula("2", ["x"]).over({}, 2).tolist() == [2, 2]


def test_names_that_mean_two_things() -> None:
    formula = Formula("h * 2", VARIABLES, {"h": 1})
    assert formula.error == "'h' is both a parameter and a variable here"
    assert Formula("p * 2", VARIABLES, {"h": 1}).ok
    assert Formula("p * 2", VARIABLES).used == {"p"}


def test_names_of_datasets() -> None:
    text = find_history_names("global/kinetic/2 - parts/12/momentum.y/global/kinetic + x/y")
    assert [(n.path, n.component) for n in text.names] == [("/global/kinetic", None), ("/parts/12/momentum", 1)]
    assert text.text == "history_dataset_0/2 - history_dataset_1/history_dataset_0 + x/y"
    for nothing in ("parts/1", "my_global/kinetic", "global/", "parts/x/mass"):
        assert find_history_names(nothing).names == []
