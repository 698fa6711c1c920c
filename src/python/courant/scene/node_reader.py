"""Values of the nodes of a scene with their checks, and messages with the position."""
from __future__ import annotations

import math
import re
from collections.abc import Sequence

import yaml

from ..diagnostics import Diagnostics, Location
from ..expressions import ExpressionFault, evaluate
from ..words import did_you_mean, nearest_word, shortest
from ..yaml_map import Node, as_flag, is_list, is_map, is_scalar
from .model import LARGEST_ID, PlaceExpression, Variables, Vector
from .placeholders import PlaceholderFault, substitute

_WORD = re.compile(r"[A-Za-z0-9_.]+", re.ASCII)
_NOT_FINITE = re.compile(r"[-+]?\.?(nan|inf(inity)?)", re.IGNORECASE)
PLACES = ("x", "y", "z")
OF_PYTHON = "!mesh"  # the tag of what Python gave and YAML has no form for


def named_places(text: str) -> set[str]:
    """Which of x, y, z an expression names."""
    return set(PLACES) & set(_WORD.findall(text))


class Mark(yaml.Mark):
    """Where an argument of a scene that is made in Python was given: file and line of the call."""

    def __init__(self, file: str, line: int) -> None:
        super().__init__(file, 0, line - 1, -1, None, None)  # type: ignore[arg-type]
        self.of_call = True


class NodeReader:
    """Faults become errors with their line, and a value that goes on, so that all are reported at once."""

    def __init__(self, path: str, diagnostics: Diagnostics) -> None:
        self.path, self.diagnostics = path, diagnostics
        self.variables: Variables = {"pi": math.pi}
        self._meant: set[tuple[int, str]] = set()  # nodes, and the keys that unknown ones of theirs resemble

    def at(self, node: Node, extra_lines: int = 0) -> Location:
        mark = node.start_mark
        if mark is None:
            return Location(self.path)
        file = mark.name if isinstance(mark, Mark) else self.path
        return Location(file, mark.line + 1 + (0 if isinstance(mark, Mark) else extra_lines), 0 if extra_lines else mark.column + 1)

    def error(self, node: Node, message: str, hint: str = "") -> None:
        self.diagnostics.error(self.at(node), message, hint)

    @staticmethod
    def get(node: Node, key: str) -> Node | None:
        """The value under a key, None where there is none."""
        return next((value for name, value in node.value if isinstance(name, yaml.ScalarNode) and name.value == key), None) if is_map(node) else None

    def is_map(self, node: Node, example: str = "", name: str = "") -> bool:
        if is_map(node):
            return True
        self.error(node, f"{name}: expected a map" if name else "expected a map", example)
        return False

    def check_keys(self, node: Node, what: str, known: Sequence[str]) -> None:
        """Unknown and repeated keys: both would otherwise be ignored in silence."""
        seen: set[str] = set()
        for key, _ in node.value if is_map(node) else ():
            if not isinstance(key, yaml.ScalarNode):
                self.error(key, f"{what}: a key must be a word")
                continue
            if key.value not in known:
                self._meant.add((id(node), nearest_word(key.value, known)))
                self.error(key, f"{what}: unknown key '{key.value}'", f"{did_you_mean(key.value, known)}known keys: {', '.join(known)}")
            if key.value in seen:
                self.error(key, f"{what}: '{key.value}' stands twice")
            seen.add(key.value)

    def missing(self, node: Node, key: str, hint: str = "") -> None:
        """Reports a key that is not there, unless it is misspelt, which is reported already."""
        if (id(node), key) not in self._meant:
            self.error(node, f"'{key}' is missing", hint)

    def text(self, node: Node) -> str:
        if not is_scalar(node):
            self.error(node, "expected text")
            return ""
        try:
            text = substitute(node.value, self.variables)
        except PlaceholderFault as fault:
            self.error(node, fault.message)
            return ""
        if "\n" in text:
            self.error(node, "expected one line of text")
        return text

    def number(self, node: Node, what: str) -> float | None:
        """The value of an expression; None, with a message, where there is none."""
        if not is_scalar(node):
            self.error(node, f"{what}: expected a number")
            return None
        if node.tag == OF_PYTHON:
            self.error(node, f"{what}: expected a number, got {node.value}", "a number, or a text with an expression of the scene's parameters")
            return None
        try:
            return evaluate(node.value, self.variables)
        except ExpressionFault as fault:
            odd = _NOT_FINITE.fullmatch(node.value.strip())
            self.error(node, f"{what}: {'expected a finite number' if odd else fault.message}" + (f", got '{node.value}'" if odd or "got '" not in fault.message else ""))
            return None

    def id(self, node: Node, key: str, required: bool = False) -> int:
        entry = self.get(node, key)
        if entry is None:
            if required:
                self.missing(node, key)
            return 0
        value = self.number(entry, key)
        if value is None:
            value = 0.0
        least = 1 if required else 0
        if not least <= value <= LARGEST_ID or value != math.floor(value):
            self.error(entry, f"{key}: expected a whole number from {least} to 99999999, got {shortest(value)}")
            return 0
        return int(value)

    def vector(self, node: Node, key: str) -> tuple[Vector, int]:
        """A point or vector, and the number of its components, 0 where it is none."""
        entry = self.get(node, key)
        if entry is None:
            self.missing(node, key)
        elif not is_list(entry) or not 2 <= len(entry.value) <= 3:
            self.error(entry, f"{key}: expected [x, y] or [x, y, z]")
        else:
            values = [self.number(one, key) or 0.0 for one in entry.value]
            return (values[0], values[1], values[2] if len(values) > 2 else 0.0), len(values)
        return (0.0, 0.0, 0.0), 0

    def of_place(self, node: Node, what: str) -> PlaceExpression | None:
        """x, y, z are the position; a parameter of that name would be hidden."""
        if not is_scalar(node):
            self.error(node, f"{what}: expected an expression of x, y, z")
            return None
        for name in sorted(named_places(node.value)):
            if name in self.variables:
                self.error(node, f"{what}: {name} is the place of a particle here, and a parameter of the scene", "give the parameter another name")
        if not node.value:
            self.error(node, f"{what}: the expression is missing")
        return PlaceExpression(node.value, self.at(node))

    def length(self, node: Node, key: str, what: str = "length") -> float:
        """A number > 0 under that key, which messages call `what`; 0, with a message, where there is none."""
        entry = self.get(node, key)
        if entry is None:
            self.missing(node, key)
            return 0.0
        return self.length_of(entry, key, what)

    def length_of(self, node: Node, key: str, what: str = "length") -> float:
        value = self.number(node, key)
        if value is not None and not value > 0:
            self.error(node, f"{key}: expected a {what} > 0, got {shortest(value)}")
        return value if value is not None and value > 0 else 0.0

    def flag(self, node: Node, key: str, default: bool) -> bool:
        entry = self.get(node, key)
        if entry is None:
            return default
        value = as_flag(entry)
        if value is None:
            self.error(entry, f"{key}: expected true or false")
        return default if value is None else value
