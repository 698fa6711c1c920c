"""Arithmetic expressions of suites and scenes: `0.5 * rho0 * U^2`, over numbers or whole arrays. The grammar is that of scenes: + - * / ^ (or **),
parentheses, functions, names (or &name), and conditions: `x < 6 and y > 0` is 1 where it holds, else 0. A value that is not finite is a fault: strict evaluation raises `ExpressionFault`, evaluation over arrays
gives NaN instead."""
from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from functools import reduce
from typing import Any

import numpy as np

from .words import nearest_word

Array = Any  # a float or a numpy array of floats; operations work on both
Node = Callable[[Sequence[Array], bool], Array]

DEEPEST = 100  # nested parentheses: keeps hostile input from exhausting the stack
_LIMIT = 2.0**63  # of integers
_NUMBER = re.compile(r"(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?", re.ASCII)
_WORD = re.compile(r"[A-Za-z_][A-Za-z_0-9]*", re.ASCII)


class ExpressionFault(Exception):
    """What is wrong with an expression; `hint` may be empty."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.message, self.hint = message, hint


def _rounded(x: Array) -> Array:
    """Nearest whole number, halves away from zero."""
    whole = np.trunc(x)
    return whole + np.where(np.abs(x - whole) >= 0.5, np.copysign(1.0, x), 0.0)


def _whole(f: Callable[[Array], Array]) -> Callable[[Array], Array]:
    """A rounding whose result must fit an integer of 64 bits."""
    def cut(x: Array) -> Array:
        value = f(x)
        return np.where((value >= -_LIMIT) & (value < _LIMIT), value, np.nan)
    return cut


def _remainder(a: Array, b: Array) -> Array:
    return np.fmod(_whole(_rounded)(a), _whole(_rounded)(b))


def _by_c(f: Callable[..., float]) -> Callable[..., Array]:
    """A function of C's library, whose bits are those of the solver on every machine; those of numpy depend on the processor. NaN where it has no value."""
    def one(*arguments: float) -> float:
        try:
            return f(*arguments)
        except (ValueError, OverflowError):
            return math.nan
    def of(*arguments: Array) -> Array:
        if all(np.ndim(a) == 0 for a in arguments):
            return one(*(float(a) for a in arguments))
        columns = [a.ravel().tolist() for a in np.broadcast_arrays(*(np.asarray(a, dtype=float) for a in arguments))]
        try:
            values = list(map(f, *columns))
        except (ValueError, OverflowError):
            values = list(map(one, *columns))
        return np.array(values, dtype=float).reshape(np.broadcast_shapes(*(np.shape(a) for a in arguments)))
    return of


_pow = _by_c(math.pow)


def _power(a: Array, b: Array) -> Array:
    return np.square(a) if np.ndim(b) == 0 and b == 2 else _pow(a, b)  # rounded right, as that of C is


def _sign(a: Array, b: Array) -> Array:
    return np.where(np.isnan(b), np.nan, np.where(b < 0, -np.abs(a), np.abs(a)))


def _when(compare: Callable[[Array, Array], Array]) -> Callable[[Array, Array], Array]:
    """1 where a comparison holds, else 0."""
    return lambda a, b: np.where(np.isnan(a) | np.isnan(b), np.nan, compare(a, b))


_SAME = np.positive
# name: (fewest arguments, most arguments or None for any number, function of arrays)
FUNCTIONS: dict[str, tuple[int, int | None, Callable[..., Array]]] = {
    "sin": (1, 1, _by_c(math.sin)), "cos": (1, 1, _by_c(math.cos)), "tan": (1, 1, _by_c(math.tan)), "csc": (1, 1, lambda x: 1 / FUNCTIONS["sin"][2](x)),
    "sec": (1, 1, lambda x: 1 / FUNCTIONS["cos"][2](x)), "ctn": (1, 1, lambda x: 1 / FUNCTIONS["tan"][2](x)), "asin": (1, 1, _by_c(math.asin)),
    "acos": (1, 1, _by_c(math.acos)), "atan": (1, 1, _by_c(math.atan)), "atan2": (2, 2, _by_c(math.atan2)), "sinh": (1, 1, _by_c(math.sinh)),
    "cosh": (1, 1, _by_c(math.cosh)), "tanh": (1, 1, _by_c(math.tanh)), "asinh": (1, 1, _by_c(math.asinh)), "acosh": (1, 1, _by_c(math.acosh)),
    "atanh": (1, 1, _by_c(math.atanh)), "exp": (1, 1, _by_c(math.exp)), "log": (1, 1, _by_c(math.log)), "log10": (1, 1, _by_c(math.log10)),
    "sqrt": (1, 1, np.sqrt), "min": (2, None, lambda *values: reduce(np.minimum, values)),
    "max": (2, None, lambda *values: reduce(np.maximum, values)), "mod": (2, 2, _remainder),
    "abs": (1, 1, np.abs), "sign": (2, 2, _sign),
    "int": (1, 1, _whole(np.trunc)), "aint": (1, 1, np.trunc), "nint": (1, 1, _whole(_rounded)),
    "anint": (1, 1, _rounded), "float": (1, 1, _SAME), "ls_integer": (1, 1, _whole(np.trunc)),
    "ls_real": (1, 1, _SAME), "floor": (1, 1, _whole(np.floor)), "ceil": (1, 1, _whole(np.ceil)), "round": (1, 1, _whole(_rounded))}
_OPERATORS: dict[str, Callable[..., Array]] = {"+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide, "^": _power,
    "<=": _when(np.less_equal), ">=": _when(np.greater_equal), "<": _when(np.less), ">": _when(np.greater), "==": _when(np.equal), "!=": _when(np.not_equal),
    "and": _when(np.logical_and), "or": _when(np.logical_or)}
_COMPARISONS = ("<=", ">=", "==", "!=", "<", ">")


def _fault_of(name: str, arguments: Sequence[Array]) -> str:
    """Why a single number is not finite."""
    a, b = arguments[0], arguments[-1]
    if (name == "/" and b == 0) or (name == "mod" and _rounded(b) == 0) or (name == "^" and a == 0 and b < 0):
        return "division by zero"
    whole = name in ("int", "nint", "ls_integer", "floor", "ceil", "round", "mod")
    return "the result is too large for an integer" if whole else "the result is not a finite number"


def _operation(name: str, f: Callable[..., Array], operands: list[Node]) -> Node:
    def evaluate(values: Sequence[Array], strict: bool) -> Array:
        arguments = [operand(values, strict) for operand in operands]
        with np.errstate(all="ignore"):
            out = f(*arguments)
        if strict:
            if not math.isfinite(out):
                raise ExpressionFault(_fault_of(name, arguments))
            return float(out)
        good = np.isfinite(out)
        if name == "^":  # NaN^0 and 1^NaN are 1 to C
            good = good & ~np.isnan(arguments[0]) & ~np.isnan(arguments[1])
        return out if np.all(good) else np.where(good, out, np.nan)
    return evaluate


def _constant(value: float) -> Node:
    return lambda values, strict: value


def _variable(index: int) -> Node:
    def evaluate(values: Sequence[Array], strict: bool) -> Array:
        value = values[index]
        good = np.isfinite(value)
        if strict and not good:
            raise ExpressionFault("the result is not a finite number")
        return value if np.all(good) else np.where(good, value, np.nan)
    return evaluate


class _Parser:
    """Recursive descent; operands come before their operation."""

    def __init__(self, text: str, names: Sequence[str], unknown: str) -> None:
        self.text, self.names, self.unknown = text, list(names), unknown
        self.at = self.depth = 0
        self.used: set[int] = set()

    def run(self) -> Node:
        node = self.condition()
        self.blanks()
        if self.at < len(self.text):
            raise ExpressionFault(f"'{self.text[self.at:]}' is not understood")
        return node

    def blanks(self) -> None:
        while self.at < len(self.text) and self.text[self.at] in " \t\n\r\v\f":
            self.at += 1

    def take(self, token: str) -> bool:
        self.blanks()
        if not self.text.startswith(token, self.at):
            return False
        self.at += len(token)
        return True

    def chain(self, operators: str, operand: Callable[[], Node]) -> Node:
        node = operand()
        while True:
            name = next((o for o in operators if self.take(o)), None)
            if name is None:
                return node
            node = _operation(name, _OPERATORS[name], [node, operand()])

    def take_word(self, word: str) -> bool:
        self.blanks()
        found = _WORD.match(self.text, self.at)
        if not found or found[0] != word or word in self.names:
            return False
        self.at = found.end()
        return True

    def condition(self) -> Node:
        """1 where it holds, 0 where it does not; a sum alone has its own value."""
        node = self.all_of()
        while self.take_word("or"):
            node = _operation("or", _OPERATORS["or"], [node, self.all_of()])
        return node

    def all_of(self) -> Node:
        node = self.inverted()
        while self.take_word("and"):
            node = _operation("and", _OPERATORS["and"], [node, self.inverted()])
        return node

    def inverted(self) -> Node:
        self.depth += 1
        if self.depth > DEEPEST:
            raise ExpressionFault("too deeply nested")
        node = _operation("==", _OPERATORS["=="], [self.inverted(), _constant(0.0)]) if self.take_word("not") else self.comparison()
        self.depth -= 1
        return node

    def comparison(self) -> Node:
        """0 < x < 1 means what it says."""
        left, node = self.sum(), None
        while name := next((one for one in _COMPARISONS if self.take(one)), ""):
            right = self.sum()
            one = _operation(name, _OPERATORS[name], [left, right])
            left, node = right, one if node is None else _operation("and", _OPERATORS["and"], [node, one])
        return node or left

    def sum(self) -> Node:
        return self.chain("+-", self.product)

    def product(self) -> Node:
        return self.chain("*/", self.signed_power)

    def signed_power(self) -> Node:
        """-a^2 is -(a^2), and a^-2 is allowed."""
        self.depth += 1
        if self.depth > DEEPEST:
            raise ExpressionFault("too deeply nested")
        if self.take("-"):
            node = _operation("-", _OPERATORS["-"], [_constant(0.0), self.signed_power()])
        elif self.take("+"):
            node = self.signed_power()
        else:
            node = self.primary()
            if self.take("**") or self.take("^"):
                node = _operation("^", _OPERATORS["^"], [node, self.signed_power()])
        self.depth -= 1
        return node

    def primary(self) -> Node:
        self.blanks()
        if self.at >= len(self.text):
            raise ExpressionFault("a value is missing")
        if self.take("("):
            node = self.condition()
            self.close()
            return node
        reference = self.take("&")
        self.blanks()
        word = _WORD.match(self.text, self.at)
        if word:
            self.at = word.end()
            return self.call(word[0]) if not reference and self.take("(") else self.named(word[0])
        if reference:
            raise ExpressionFault("a name is missing behind '&'")
        return self.number()

    def close(self) -> None:
        if not self.take(")"):
            raise ExpressionFault("')' is missing")

    def named(self, name: str) -> Node:
        if name not in self.names:
            near = nearest_word(name, self.names)
            raise ExpressionFault(f"unknown {self.unknown} '{name}'", f"did you mean {near}?" if near else "")
        index = self.names.index(name)
        self.used.add(index)
        return _variable(index)

    def call(self, name: str) -> Node:
        arguments: list[Node] = []
        if not self.take(")"):
            arguments.append(self.sum())
            while self.take(","):
                arguments.append(self.sum())
            self.close()
        if name.lower() not in FUNCTIONS:
            near = nearest_word(name.lower(), list(FUNCTIONS))
            raise ExpressionFault(f"unknown function '{name}'", f"did you mean {near}?" if near else "")
        least, most, f = FUNCTIONS[name.lower()]
        if len(arguments) < least or (most is not None and len(arguments) > most):
            raise ExpressionFault(f"{name.lower()} takes {least} argument{'' if least == 1 else 's'}"
                                  f"{' or more' if most is None else ''}, got {len(arguments)}")
        return _operation(name.lower(), f, arguments)

    def number(self) -> Node:
        digits = _NUMBER.match(self.text, self.at)
        if not digits:
            raise ExpressionFault(f"expected a number or a name, got '{self.text[self.at:]}'")
        self.at = digits.end()
        value = float(re.sub("[dD]", "e", digits[0]))
        if not math.isfinite(value) or (value == 0 and re.search("[1-9]", re.split("[eEdD]", digits[0])[0])):
            raise ExpressionFault(f"the number {digits[0]} is too large or too small")
        return _constant(value)


class Formula:
    """An expression over `variables` whose parameters have their values. A name that is used and is both a variable and a parameter is a fault, as
    is anything else that cannot be evaluated: then `error` says why and `hint` what to do. `used`: the variables that it names."""

    def __init__(self, text: str, variables: Sequence[str] = (), parameters: Mapping[str, float] | None = None) -> None:
        known = dict(sorted((parameters or {}).items()))
        parser = _Parser(text, [*variables, *known], "name")
        self.variables, self._values = list(variables), [float(value) for value in known.values()]
        self.error = self.hint = ""
        self._node = _constant(math.nan)
        try:
            self._node = parser.run()
        except ExpressionFault as fault:
            self.error, self.hint = fault.message, fault.hint
        self.used = {self.variables[k] for k in parser.used if k < len(self.variables)}
        twice = next((name for name in self.variables if name in self.used and name in known), None)
        if twice and not self.error:
            self.error, self.hint = f"'{twice}' is both a parameter and a variable here", "give the parameter another name"

    @property
    def ok(self) -> bool:
        return not self.error

    def uses(self, name: str) -> bool:
        return name in self.used

    def over(self, table: Mapping[str, Array], size: int) -> np.ndarray:
        """Values over a table of columns of shape (size,); NaN where there is none. Shape (size,)."""
        values = [table[name] if name in self.used else 0.0 for name in self.variables]
        out = self._node([*values, *self._values], False)
        return np.array(np.broadcast_to(np.asarray(out, dtype=float), (size,)))

    def __call__(self, *values: float) -> float:
        """The value at one location; NaN where there is none."""
        return float(self._node([*(float(v) for v in values), *self._values], False))


class PlaceFormula:
    """An expression of a scene's parameters and of a position x, y, z. Raises `ExpressionFault` where it is not understood."""

    def __init__(self, text: str, parameters: Mapping[str, float]) -> None:
        names = sorted(parameters)
        self._values = [float(parameters[name]) for name in names]
        self._node = _Parser(_without_placeholders(text), ["x", "y", "z", *names], "parameter").run()

    def over(self, points: Sequence[Array], size: int) -> np.ndarray:
        """Values at positions, three arrays of shape (size,); NaN where there is none. Shape (size,)."""
        return np.array(np.broadcast_to(np.asarray(self._node([*points, *self._values], False), dtype=float), (size,)))

    def at(self, point: Sequence[float]) -> float:
        """The value at one position. Raises `ExpressionFault`."""
        return float(self._node([*point, *self._values], True))


def _without_placeholders(text: str) -> str:
    """Every `${` and its `}` as parentheses, in the same columns."""
    out, opened = list(text), []
    for i, c in enumerate(text):
        if text.startswith("${", i):
            opened.append("$")
            out[i : i + 2] = " ("
        elif c == "(":
            opened.append("(")
        elif c in ")}":
            fits = bool(opened) and (opened[-1] == "$") == (c == "}")
            if opened and opened[-1] == "$" and not fits:
                raise ExpressionFault("'}' is missing")
            out[i] = ")" if fits and opened.pop() else c
    if "$" in opened:
        raise ExpressionFault("'}' is missing")
    return "".join(out)


def evaluate(text: str, variables: Mapping[str, float]) -> float:
    """Value of an expression of parameters, `${name}` and `name` alike. Raises `ExpressionFault`."""
    names = sorted(variables)
    try:
        node = _Parser(_without_placeholders(text), names, "parameter").run()
        return float(node([float(variables[name]) for name in names], True))
    except ExpressionFault as fault:
        raise ExpressionFault(fault.message + (f", {fault.hint}" if fault.hint else "")) from None


def constant_value(text: str, variables: Mapping[str, float]) -> float:
    """As `evaluate`, with the text in the message of the fault."""
    try:
        return evaluate(text, variables)
    except ExpressionFault as fault:
        raise ExpressionFault(f"{fault.message}, got '{text}'") from None
