"""A deck as an editor has it, whole or half typed: blocks, cards and fields by line and column, ids and where they are defined.

Lines and columns count from 0; columns are characters of Python. Nothing here knows the protocol. Text of any kind is taken: what is not understood
has no field.
"""
from __future__ import annotations

import os
import re
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from ..deck.blocks import Block, column_width, split_at_commas
from ..deck.deck import split_deck
from ..deck.tables import CardOf, FieldOf

_MOST_BYTES = 64 << 20  # of an included file that is read
_DEEPEST = 20  # includes in each other
_ID = re.compile(r"\s*([+-]?\d{1,16})\s*")
_FOLLOWED_BY_A_CARD = ("MPP",)


@dataclass(frozen=True)
class FieldAt:
    """A field at a position. `begin`, `end`: its columns in the line; `text`: what is in them."""

    card: int  # from 0
    of: CardOf
    field: FieldOf
    begin: int
    end: int
    text: str


@dataclass(frozen=True)
class Definition:
    """Where an id is defined. `space`: what it numbers: "part"."""

    space: str
    id: int
    file: str
    line: int
    title: str
    keyword: str


class DeckText:
    """The text of one file. `file`: its path."""

    def __init__(self, text: str, file: str) -> None:
        self.file = file
        self.lines = text.splitlines()
        self.blocks = split_deck(text, file)[1]
        self._starts = [block.line - 1 for block in self.blocks]

    def block_at(self, line: int) -> Block | None:
        k = bisect_right(self._starts, line) - 1
        return self.blocks[k] if k >= 0 else None

    def is_keyword_line(self, line: int) -> bool:
        return 0 <= line < len(self.lines) and self.lines[line].startswith("*")

    @property
    def is_main(self) -> bool:
        """Whether it is a deck, not a file that decks include."""
        return any(block.name in ("KEYWORD", "CONTROL_TERMINATION", "END") for block in self.blocks)

    # cards and fields

    def cards_at(self, line: int) -> list[tuple[int, CardOf]]:
        """Number and table of the card on a line; several where other fields decide which one it is. None for titles, comments and keyword lines."""
        block = self.block_at(line)
        if block is None or block.table is None or line >= len(self.lines) or self.lines[line].startswith(("*", "$")):
            return []
        row = sum(1 for other in block.lines[1 : line - block.line + 2] if not other.startswith("$"))
        return cards_of_row(block, row)

    def field_at(self, line: int, column: int) -> FieldAt | None:
        """The field at a position, of the first of the cards that it may belong to."""
        cards = self.cards_at(line)
        return self._field(self.block_at(line), cards[0], self.lines[line], column) if cards else None  # type: ignore[arg-type]

    def fields_of(self, line: int) -> list[FieldAt]:
        """All fields of the card on a line."""
        out: list[FieldAt] = []
        cards = self.cards_at(line)
        column = 0
        while cards and (found := self._field(self.block_at(line), cards[0], self.lines[line].ljust(column + 1), column)):  # type: ignore[arg-type]
            out.append(found)
            if found.end <= column:
                break
            column = found.end if "," not in self.lines[line] else found.end + 1
            if column > len(self.lines[line]):
                break
        return out

    def _field(self, block: Block, card: tuple[int, CardOf], line: str, column: int) -> FieldAt | None:
        fields = card[1].fields
        if not fields:
            return None
        spans = _spans(block, card[1])
        if (words := split_at_commas(line, spans[-1][1])) is not None:
            begin = 0
            for k, word in enumerate(words):
                if begin <= column <= begin + len(word):
                    of = fields[min(k, len(fields) - 1)] if k < len(fields) or fields[-1].listed else None
                    return FieldAt(card[0], card[1], of, begin, begin + len(word), word.strip()) if of else None
                begin += len(word) + 1
            return None
        for of, (begin, end) in zip(fields, spans, strict=True):
            if begin <= column < end:
                if of.listed and len(fields) == 1:  # many values side by side
                    width = 8 if of.kind == "I" and end - begin <= 8 else column_width(10, block._wide)
                    begin += (column - begin) // width * width
                    end = min(end, begin + width)
                return FieldAt(card[0], card[1], of, begin, end, line[begin:end].strip())
        return None

    # ids

    @cached_property
    def definitions(self) -> list[Definition]:
        return [one for block in self.blocks for one in _definitions(block, self.file)]

    # included files

    def includes(self) -> Iterator[str]:
        """Paths of the files that it includes, as far as they are there."""
        folders = [Path(self.file).parent]
        for block in self.blocks:
            rows = [block.lines[k].strip() for k in block.rows]
            if block.name in ("INCLUDE_PATH", "INCLUDE_PATH_RELATIVE"):
                folders += [Path(self.file).parent / row for row in rows if row]
            elif block.name.startswith("INCLUDE"):
                names = rows if block.name == "INCLUDE" else rows[:1]
                for name in names:
                    found = next((folder / name for folder in folders if name and _is_file(folder / name)), None)
                    if found:
                        yield os.path.normpath(found)


def _is_file(path: Path) -> bool:
    try:
        return path.is_file() and path.stat().st_size <= _MOST_BYTES
    except (OSError, ValueError):
        return False


def cards_of_row(block: Block, row: int) -> list[tuple[int, CardOf]]:
    """Of the data line with this number, from 1 on."""
    table = block.table
    if table is None or not table.cards or row < 1:
        return []
    first, length = block._first, block._length(table)
    at = row - 1
    if length and table.many:
        at %= length
    at -= first
    if at < 0:
        return []
    out: list[tuple[int, CardOf]] = []
    least, most = 0, 0.0
    for number, card in enumerate(table.cards):
        if least <= at <= most + (float("inf") if card.repeated else 0):
            out.append((number, card))
        least += not card.conditional
        most += float("inf") if card.repeated else 1
    out.sort(key=lambda one: (one[1].conditional, one[0] != at))
    if not out and table.many:  # further sets of cards, some of which are optional
        out = [(at % len(table.cards), table.cards[at % len(table.cards)])]
    return out


def _spans(block: Block, card: CardOf) -> list[tuple[int, int]]:
    if not block._wide:
        return [(one.begin, one.end) for one in card.fields]
    out, end = [], 0
    for one in card.fields:
        begin, end = end, end + column_width(one.end - one.begin, block._wide)
        out.append((begin, end))
    return out


def id_in(line: str, card: CardOf | None, wide: int) -> int | None:
    """The number in the first field of a line."""
    width = column_width(card.fields[0].end - card.fields[0].begin if card and card.fields else 10, wide)
    word = line.split(",", 1)[0] if "," in line[: 8 * width] else line[:width]
    found = _ID.fullmatch(word)
    return int(found[1]) if found else None


def _definitions(block: Block, file: str) -> Iterator[Definition]:
    table = block.table
    if table is None or not table.defines or not table.cards:
        return
    rows = block.rows
    step = block._length(table) or (1 if len(table.cards) == 1 and not table.cards[0].repeated and not block._first else 0)
    begins = range(0, len(rows), step) if step and table.many else range(min(1, len(rows)))
    for begin in begins:
        at = begin + (0 if "ID" in block._options else block._first)
        if "ID" in block._options and "MPP" in block._options and block._options.index("MPP") < block._options.index("ID"):
            at += 1
        if at >= len(rows):
            return
        id = id_in(block.lines[rows[at]].rstrip("\r\n"), None if "ID" in block._options else table.cards[0], block._wide)
        if id is None:
            continue
        title = block.lines[rows[begin]].strip() if block._first else ""
        if "ID" in block._options:
            title = title[10:].strip() if "," not in title else title.partition(",")[2].strip()
        yield Definition(table.defines, id, file, block.line - 1 + rows[at], title, block.name)


class Workspace:
    """Texts of an editor and of the disk. `open`: by path, the unsaved ones."""

    def __init__(self) -> None:
        self.open: dict[str, DeckText] = {}
        self._read: dict[str, tuple[float, DeckText]] = {}

    def text(self, file: str) -> DeckText | None:
        """The unsaved text of a file, else that on the disk."""
        if file in self.open:
            return self.open[file]
        try:
            changed = os.stat(file).st_mtime
            known = self._read.get(file)
            if known is None or known[0] != changed:
                if not _is_file(Path(file)):
                    return None
                known = (changed, DeckText(Path(file).read_text(errors="replace"), file))
                self._read[file] = known
            return known[1]
        except (OSError, ValueError):
            return None

    def with_includes(self, deck: DeckText) -> list[DeckText]:
        """A deck and all that it includes, each once."""
        out, seen = [deck], {deck.file}
        level = [deck]
        for _ in range(_DEEPEST):
            names = [name for one in level for name in one.includes()]
            level = []
            for name in names:
                if name not in seen and (text := self.text(name)) is not None:
                    seen.add(name)
                    out.append(text)
                    level.append(text)
        return out

    def scope(self, deck: DeckText) -> list[DeckText]:
        """The files whose ids a file may name: its own includes, and those of open decks that include it."""
        found = {one.file: one for one in self.with_includes(deck)}
        for other in list(self.open.values()):
            if other.file not in found:
                whole = self.with_includes(other)
                if any(one.file == deck.file for one in whole):
                    found |= {one.file: one for one in whole}
        return list(found.values())

    def deck_of(self, text: DeckText) -> DeckText | None:
        """The deck to check: the file itself, or an open one that includes it; None where there is none."""
        if text.is_main:
            return text
        mains = (other for other in list(self.open.values()) if other.is_main)
        return next((other for other in mains if any(one.file == text.file for one in self.with_includes(other))), None)

    def find(self, deck: DeckText, space: str, id: int) -> list[Definition]:
        """Definitions of an id. `space` "varies": of any kind but nodes and elements, sets first."""
        out = []
        for text in self.scope(deck):
            for one in text.definitions:
                if one.id == id and (one.space == space or (space == "varies" and one.space not in _MESH)):
                    out.append(one)
        return sorted(out, key=lambda one: "set" not in one.space) if space == "varies" else out


_MESH = ("node", "solid element", "shell", "beam", "discrete element", "mass element")
