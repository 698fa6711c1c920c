"""Blocks of a deck, a keyword with its lines, and the fields of its cards. Comments and the order of lines stay as they are."""
from __future__ import annotations

import math
import re
from typing import Any, Union

from ..diagnostics import CourantError, Diagnostics, Location
from ..scene.numbers import number_text
from ..words import did_you_mean, shortest
from .tables import CardOf, FieldOf, TableOf, table_of

Value = Union[int, float, str, None]
_INTEGER = re.compile(r"[+-]?\d+", re.ASCII)
_REAL = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+))(?:[eEdD]?([+-]\d+)|[eEdD](\d+))?", re.ASCII)
_NAMED = re.compile(r"&|<.*>")  # of a parameter or an expression
_LEAST_DIGITS = 1e-6  # a number that its columns hold less exactly is refused


def value_of(text: str) -> Value:
    """A number, a text, or None of a blank field, whose default counts."""
    text = text.strip()
    if not text:
        return None
    if _INTEGER.fullmatch(text):
        return int(text)
    if match := _REAL.fullmatch(text):
        return float(match[1] + ("e" + (match[2] or match[3]) if match[2] or match[3] else ""))
    return text


def split_at_commas(line: str, columns: int) -> list[str] | None:
    """Fields between commas; None of a line in fixed columns, whose commas are behind the last column or within brackets."""
    if "," not in line[:columns]:
        return None
    out: list[str] = []
    depth = begin = 0
    whole = line.count("(") == line.count(")") and line.count("<") == line.count(">")
    for k, letter in enumerate(line):
        depth += (letter in "(<") - (letter in ")>" and depth > 0) if whole else 0
        if letter == "," and depth == 0:
            if not out and k >= columns:
                return None
            out.append(line[begin:k])
            begin = k + 1
    return [*out, line[begin:]] if out else None


def column_width(columns: int, wide: int) -> int:
    """Of a field: with I10=Y ten at least, in long format 20 or twice its own."""
    return max(columns, 10) if wide == 10 else columns if not wide else 2 * columns if columns > 20 else 20


class Block:
    """A keyword line and what follows up to the next one. `name` without *; `line`: of the keyword in its file, from 1."""

    def __init__(self, name: str, lines: list[str], file: str, line: int, wide: int) -> None:
        self.name, self.lines, self.file, self.line = name, lines, file, line
        self._wide = wide  # 20 in long format, 10 where ids have ten columns, else 0
        self.table, self._options = table_of(name)

    def __repr__(self) -> str:
        return f"<*{self.name}, line {self.line}, {len(self.rows)} cards>"

    def fault(self, message: str, hint: str = "") -> CourantError:
        """An exception with the position of the block."""
        diagnostics = Diagnostics()
        diagnostics.error(Location(self.file, self.line), f"*{self.name}: {message}", hint)
        return CourantError(diagnostics)

    @property
    def text(self) -> str:
        """All of it, with comments."""
        return "".join(self.lines)

    @property
    def rows(self) -> list[int]:
        """Indices of the lines that are cards."""
        return [k for k, line in enumerate(self.lines) if k and not line.startswith("$")]

    @property
    def comments(self) -> list[str]:
        return [line.rstrip("\r\n") for line in self.lines[1:] if line.startswith("$")]

    @property
    def title(self) -> str:
        """The line of an option _TITLE or _ID, or the heading of a part; "" where there is none."""
        rows = self.rows
        return self.lines[rows[0]].strip() if rows and (self._options or (self.table and self.table.heading)) else ""

    # sets of cards

    @property
    def _first(self) -> int:
        return len(self._options) + bool(self.table and self.table.heading)

    def _length(self, table: TableOf) -> int:
        """Cards of a set, with its heading; 0 where the block is one set."""
        return self._first + len(table.cards) if not any(card.optional or card.conditional or card.repeated for card in table.cards) else 0

    def __len__(self) -> int:
        """How many sets of cards it has."""
        length = self._length(self.table) if self.table else 0
        return max(1, len(self.rows) // length) if length else 1

    @property
    def sets(self) -> list[CardSet]:
        """Each set of cards, with fields by name."""
        length = self._length(self._known()) or len(self.rows)
        return [CardSet(self, k * length) for k in range(len(self))]

    def _known(self) -> TableOf:
        if self.table is None:
            raise self.fault("the program has no table of this keyword, so its fields have no names: use .lines")
        return self.table

    def _one(self) -> CardSet:
        if len(self) != 1:
            raise self.fault(f"it has {len(self)} sets of cards: take one of .sets")
        return CardSet(self, 0)

    def __getitem__(self, name: str) -> Value:
        """The value of a field of the only set of cards; None where it is blank. Raises CourantError."""
        return self._one()[name]

    def __setitem__(self, name: str, value: Value) -> None:
        self._one()[name] = value

    def __contains__(self, name: str) -> bool:
        return any(one.name == name.upper() for card in (self.table.cards if self.table else ()) for one in card.fields)

    # text of fields

    def _span(self, one: FieldOf, card: CardOf) -> tuple[int, int]:
        """Columns of a field."""
        widths = [column_width(other.end - other.begin, self._wide) for other in card.fields]
        k = card.fields.index(one)
        return (sum(widths[:k]), sum(widths[: k + 1])) if self._wide else (one.begin, one.end)

    def _split(self, row: int, card: CardOf) -> tuple[str, list[str] | None]:
        line = self.lines[row].rstrip("\r\n")
        return line, split_at_commas(line, self._span(card.fields[-1], card)[1])

    def read(self, row: int, one: FieldOf, card: CardOf) -> Value:
        line, fields = self._split(row, card)
        if fields is not None:
            k = card.fields.index(one)
            return value_of(fields[k]) if k < len(fields) else None
        begin, end = self._span(one, card)
        return value_of(line[begin:end])

    def write(self, row: int, one: FieldOf, card: CardOf, value: Value) -> None:
        line, fields = self._split(row, card)
        tail = self.lines[row][len(line):]
        if fields is not None:
            k = card.fields.index(one)
            fields += [""] * (k + 1 - len(fields))
            fields[k] = self._text(one, value, 0)
            self.lines[row] = ",".join(fields) + tail
            return
        begin, end = self._span(one, card)
        line = line.ljust(end)
        self.lines[row] = (line[:begin] + self._text(one, value, end - begin).rjust(end - begin) + line[end:]).rstrip() + tail

    def _text(self, one: FieldOf, value: Value, width: int) -> str:
        if value is None:
            return ""
        if isinstance(value, str):
            text = value
            if one.kind != "A" and isinstance(value_of(text), str) and not _NAMED.search(text):
                raise self.fault(f"{one.name} is a number, got {value!r}", "a number, or a parameter: '&dx'")
        elif not math.isfinite(value):
            raise self.fault(f"{one.name} is a number, got {value!r}")
        elif isinstance(value, bool) or (one.kind == "I" and float(value) != int(value)):
            raise self.fault(f"{one.name} is a whole number, got {value!r}")
        elif one.kind == "A":
            raise self.fault(f"{one.name} is a text, got {value!r}")
        elif one.kind == "I":
            text = str(int(value))
        else:
            text = number_text(float(value), width) or shortest(float(value))
            if width and len(text) <= width and abs(float(text) - float(value)) > _LEAST_DIGITS * abs(float(value)):
                raise self.fault(f"{one.name}: {value!r} does not fit {width} columns: write the card with commas, or in long format")
        if width and len(text) > width:
            raise self.fault(f"{one.name}: '{text}' does not fit {width} columns")
        return text


class CardSet:
    """The fields of one set of cards of a block by their names."""

    def __init__(self, block: Block, first: int) -> None:
        self._block, self._begin = block, first

    def __repr__(self) -> str:
        return f"<{self._block.name}: {', '.join(f'{name}={value}' for name, value in self.items())}>"

    @property
    def title(self) -> str:
        return self._block.lines[self._block.rows[self._begin]].strip() if self._block._first else ""

    @title.setter
    def title(self, text: str) -> None:
        if not self._block._first:
            raise self._block.fault("it has no title")
        row = self._block.rows[self._begin]
        line = self._block.lines[row]
        self._block.lines[row] = text + line[len(line.rstrip("\r\n")):]

    def _find(self, name: str) -> tuple[int, FieldOf, CardOf]:
        """Number of the card, of the field and its card."""
        table = self._block._known()
        for k, card in enumerate(table.cards):
            one = next((one for one in card.fields if one.name == name.upper()), None)
            if one is None:
                continue
            if card.repeated or one.listed:
                raise self._block.fault(f"{name} is a list: use .lines, or Deck.sets and Deck.curves")
            if any(other.conditional or other.repeated for other in table.cards[: k + 1]):
                raise self._block.fault(f"on which card {name} is depends on other fields: use .lines")
            return k, one, card
        known = [one.name for card in table.cards for one in card.fields]
        raise self._block.fault(f"it has no field '{name}'", f"{did_you_mean(name.upper(), known)}it has {', '.join(known)}")

    def __getitem__(self, name: str) -> Value:
        k, one, card = self._find(name)
        rows, at = self._block.rows, self._begin + self._block._first + k
        return self._block.read(rows[at], one, card) if at < len(rows) else None

    def __setitem__(self, name: str, value: Value) -> None:
        k, one, card = self._find(name)
        rows, at = self._block.rows, self._begin + self._block._first + k
        while at >= len(rows):  # optional cards that the deck leaves out
            end = "\r\n" if self._block.lines[0].endswith("\r\n") else "\n"
            self._block.lines.insert(rows[-1] + 1 if rows else len(self._block.lines), " " + end)
            rows = self._block.rows
        self._block.write(rows[at], one, card, value)

    def items(self) -> list[tuple[str, Value]]:
        """All fields that are not blank and whose card is known."""
        out = []
        for card in self._block._known().cards:
            for one in card.fields:
                try:
                    value: Any = self[one.name]
                except CourantError:
                    continue
                if value is not None:
                    out.append((one.name, value))
        return out
