"""Curves from CSV files."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from ..diagnostics import Diagnostics, Location
from ..files import note_input
from ..words import did_you_mean
from ..yaml_map import as_number
from .series import Series

_BLANKS = ' \t\r"'


def _number(cell: str) -> float | None:
    return None if cell != cell.strip() else as_number(cell)


class _TableReader:
    def __init__(self, file: Path, diagnostics: Diagnostics) -> None:
        self.file, self.diagnostics = file, diagnostics
        self.names: list[str] = []
        self.rows: dict[float, list[float]] = {}  # values of y by x
        self.line, self.before = 0, diagnostics.errors

    def read(self, column_x: str, column_y: str) -> Series:
        try:
            lines = self.file.read_text("utf-8", "replace").split("\n")
        except OSError:
            self.diagnostics.error(self.file, "cannot read the table", "check the path; it counts from the suite")
            return Series()
        note_input(self.file)
        wanted: tuple[int, int] | None = None
        commas = True
        for self.line, line in enumerate(lines, 1):
            text = line.strip(_BLANKS)
            if not text or text[0] == "#":
                continue
            if wanted is None:
                commas = "," in line
            cells = [cell.strip(_BLANKS) for cell in (line.split(",") if commas else line.split())]
            if wanted is None:
                wanted = self.head(cells, column_x, column_y)
                if wanted is None:
                    return Series()
                # a first row may be values beside a column of text: then the wanted ones are numbers, and not
                # asked for by name
                values = [cells[k] for k in wanted]
                if self.names and not (all(_number(v) is not None for v in values) and values[0] != column_x and values[1] != column_y):
                    continue
            self.add_row(cells, wanted)
        if len(self.rows) < 2 and self.diagnostics.errors == self.before:
            self.diagnostics.error(self.file, "the table has fewer than two rows with both columns")
        x = sorted(self.rows)
        return Series(np.array(x), np.array([sum(self.rows[k]) / len(self.rows[k]) for k in x]))

    def head(self, cells: list[str], column_x: str, column_y: str) -> tuple[int, int] | None:
        """Where the two columns stand, from the first line."""
        if any(cell and _number(cell) is None for cell in cells):
            self.names = cells
        x = self.column(column_x, len(cells))
        y = self.column(column_y, len(cells))
        return None if x is None or y is None else (x, y)

    def column(self, wanted: str, count: int) -> int | None:
        if wanted in self.names:
            return self.names.index(wanted)
        number = as_number(wanted)
        if number is not None and 1 <= number <= count and number == int(number):
            return int(number) - 1
        hint = f"{did_you_mean(wanted, self.names)}its columns: {', '.join(self.names)}" if self.names else \
            f"its {count} columns have no names; give a number from 1"
        self.diagnostics.error(Location(str(self.file), self.line), f"the table has no column '{wanted}'", hint)
        return None

    def add_row(self, cells: list[str], wanted: tuple[int, int]) -> None:
        values = []
        for k in wanted:
            cell = cells[k] if k < len(cells) else ""
            if not cell:
                return
            value = _number(cell)
            if value is None:
                self.diagnostics.error(Location(str(self.file), self.line), f"expected a number, got '{cell}'")
                return
            values.append(value)
        self.rows.setdefault(values[0], []).append(values[1])


def read_table(file: Path, column_x: str, column_y: str, diagnostics: Diagnostics) -> Series:
    """Two columns of a file, in order of x; each a name of the head or a number from 1. Values are separated by commas (or by blanks, where the
    first line holds no comma). Lines that begin with # are comments; the first other line may hold names. Rows where one of the two is blank are
    skipped, and rows with the same x averaged. Faults (a column that is not there, no number, fewer than two rows) go to `diagnostics` with their
    line."""
    return _TableReader(file, diagnostics).read(column_x, column_y)
