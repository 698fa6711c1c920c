"""Parameters of a deck."""
from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, MutableMapping
from typing import Union

from ..diagnostics import CourantError
from ..scene.numbers import number_text
from ..words import did_you_mean, shortest
from .blocks import Block, value_of

_DECLARED = re.compile(r"([RrIiCc] +\w+)\s*,?\s*", re.ASCII)
Number = Union[int, float, str, None]


class Parameters(MutableMapping[str, Number]):
    """Values of *PARAMETER and *PARAMETER_EXPRESSION by name, without the letter of their type; expressions are texts. A changed value is written where
    the parameter is defined first."""

    def __init__(self, blocks: list[Block], error: Callable[..., CourantError]) -> None:
        self._error = error
        self._at: dict[str, tuple[Block, int, int, int, str]] = {}  # row, columns of the value, type letter
        for block in blocks:
            for row in block.rows:
                for begin, end, name in _slots(block, row):
                    self._at.setdefault(name[1:].strip().lower(), (block, row, begin, end, name[0].upper()))

    def __len__(self) -> int:
        return len(self._at)

    def __iter__(self) -> Iterator[str]:
        return iter(self._at)

    def _find(self, name: str) -> tuple[Block, int, int, int, str]:
        if name.lower() not in self._at:
            raise self._error(f"the deck has no parameter '{name}'", f"{did_you_mean(name, self._at)}it has {', '.join(self._at) or 'none'}")
        return self._at[name.lower()]

    def __getitem__(self, name: str) -> Number:
        block, row, begin, end, _ = self._find(name)
        return value_of(block.lines[row].rstrip("\r\n")[begin:end])

    def __setitem__(self, name: str, value: Number) -> None:
        block, row, begin, end, letter = self._find(name)
        line = block.lines[row].rstrip("\r\n")
        tail = block.lines[row][len(line):]
        rows = block.rows
        after = rows[rows.index(row) + 1 :][:1]
        if "EXPRESSION" in block.name and after and not _slots(block, after[0]):
            raise block.fault(f"the expression of parameter {name} goes on over several lines", "change block.lines")
        free = "," in line or "EXPRESSION" in block.name  # the rest of the line is the value
        if isinstance(value, str) and letter != "C" and not free and isinstance(value_of(value), str) and not value.lstrip().startswith(("&", "-&")):
            raise block.fault(f"parameter {name} is a number, got {value!r}")
        if value is not None and not isinstance(value, str) and not math.isfinite(value):
            raise block.fault(f"parameter {name} is a number, got {value!r}")
        if letter == "I" and not isinstance(value, str) and (value is None or float(value) != int(value)):
            raise block.fault(f"parameter {name} is a whole number, got {value!r}")
        if isinstance(value, str) or value is None:
            text = value or ""
        elif letter == "I":
            text = str(int(value))
        else:
            text = number_text(float(value), 0 if free else end - begin) or shortest(float(value))
        if not free and (len(text) > end - begin or (not isinstance(value, str) and value is not None and abs(float(text) - value) > 1e-6 * abs(value))):
            raise block.fault(f"parameter {name}: {value!r} does not fit {end - begin} columns", "define it by *PARAMETER_EXPRESSION")
        width = 0 if free else end - begin
        block.lines[row] = (line.ljust(begin)[:begin] + text.rjust(width) + line[end:]).rstrip() + tail
        if "," in line:
            for k, (start, stop, other) in enumerate(_slots(block, row)):
                self._at[other[1:].strip().lower()] = (block, row, start, stop, other[0].upper())

    def __delitem__(self, name: str) -> None:
        raise self._error("a parameter is not taken out by itself", "deck.remove takes out a whole block")


def _slots(block: Block, row: int) -> list[tuple[int, int, str]]:
    """Columns of values with letter and name: four pairs of ten columns, pairs between commas, or an expression up to the end of the line."""
    line = block.lines[row].rstrip("\r\n")
    if "EXPRESSION" in block.name:
        found = _DECLARED.match(line)
        return [(found.end(), len(line), found[1])] if found else []  # a line without a name continues the one before
    if "," in line:
        out, at = [], 0
        words = line.split(",")
        for name, value in zip(words[::2], words[1::2]):
            at += len(name) + 1
            if name.strip():
                out.append((at, at + len(value), name.strip()))
            at += len(value) + 1
        return out
    width = 20 if block._wide > 10 else 10
    return [(k + width, k + 2 * width, line[k : k + width].strip()) for k in range(0, len(line), 2 * width) if line[k : k + width].strip()]
