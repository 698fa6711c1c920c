"""The map of where a stability case holds and where it breaks, as SVG."""
from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

from .model import CaseResult, RunResult, Verdict
from .svg import DIGIT, LETTER, WIDTH, drawing, element, text_at, title
from .text import number, shorten

_CELL, _LEAST_WIDTH = 40.0, 46.0
_MOST_LETTERS = 14  # of a value of a swept parameter, or in a cell
_IN_A_ROW = 7  # more columns than that had better be rows
_LETTERS = "SDXR!"  # of verdicts, so that the map can be read without colours


@dataclass
class Cell:
    verdict: Verdict | None = None  # None: there is no such run
    as_required: bool = True
    value: str = ""  # a short text below the verdict's letter
    hover: str = ""

    def show(self, run: RunResult) -> None:
        """Of several runs with the same swept values, the worst one stands in the cell."""
        self.hover += ("\n" if self.hover else "") + _hover(run)
        if self.verdict is None or run.verdict > self.verdict or (self.as_required and not run.as_required):
            self.verdict, self.as_required = run.verdict, self.as_required and run.as_required
            self.value = next((number(o.value, 3) for o in run.observed if o.found and o.value is not None), "")

    @property
    def css(self) -> str:
        return "none" if self.verdict is None else self.verdict.name

    @property
    def letter(self) -> str:
        return "–" if self.verdict is None else _LETTERS[self.verdict]


@dataclass
class StabilityMap:
    """Columns and rows as the suite has them; the longer sweep stands in rows where it would be too wide. No rows: one parameter."""

    label: str
    column_name: str = ""
    row_name: str = ""
    columns: list[str] = field(default_factory=list)
    rows: list[str] = field(default_factory=list)
    cells: list[Cell] = field(default_factory=list)  # row by row
    value_name: str = ""  # what the values in the cells are; blank: there are none

    def turn(self) -> None:
        n = len(self.columns)
        self.cells = [self.cells[r * n + c] for c in range(n) for r in range(len(self.rows))]
        self.columns, self.rows = self.rows, self.columns
        self.column_name, self.row_name = self.row_name, self.column_name


def verdict_counts(case: CaseResult) -> str:
    """ "12 stable, 3 degraded, 1 stopped", those that occur."""
    counts = Counter(run.verdict for run in case.runs)
    return ", ".join(f"{counts[v]} {v.name}" for v in Verdict if counts[v])


def _hover(run: RunResult) -> str:
    parts = [f"{run.setting}: {run.verdict.name}" + ("" if run.as_required else ", which the suite does not allow"), *run.exceeded]
    parts += [f"{o.name} {number(o.value)}" for o in run.observed if o.value is not None]
    return "; ".join(parts + ([run.reason] if run.verdict != Verdict.stable and run.reason else []))


def stability_map(case: CaseResult, setting: str = "") -> StabilityMap | None:
    """With a setting, of its runs alone (their names begin with it). None for other cases."""
    stability = case.definition.stability
    if stability is None:
        return None
    runs = [r for r in case.runs if not setting or r.setting == setting or r.setting.startswith(setting + ", ")]
    out = StabilityMap(f"{case.definition.title}: {verdict_counts(case)}")
    if not stability.sweep:  # runs by their names
        out.columns, out.cells = [run.name for run in runs], [Cell() for _ in runs]
        for cell, run in zip(out.cells, runs, strict=True):
            cell.show(run)
    else:
        (out.column_name, out.columns), *more = stability.sweep
        out.row_name, out.rows = more[0] if more else ("", [])
        for row in out.rows or [""]:
            for column in out.columns:
                wanted = {out.column_name: column, **({out.row_name: row} if out.rows else {})}
                out.cells.append(Cell())
                for run in runs:
                    if wanted.items() <= run.parameters.items():
                        out.cells[-1].show(run)
        if len(out.columns) > _IN_A_ROW and 0 < len(out.rows) < len(out.columns):
            out.turn()
    out.value_name = next((o.name for run in runs for o in run.observed if o.found and o.value is not None), "")
    return out


def _longest(texts: Sequence[str]) -> int:
    return max((min(len(text), _MOST_LETTERS) for text in texts), default=0)


def _draw_cell(cell: Cell, x: float, y: float, width: float) -> str:
    out = title(cell.hover) + element("rect", css=f"cell cell-{cell.css}", x=x, y=y, width=width, height=_CELL)
    if not cell.as_required:
        out += element("rect", css="fault", x=x + 2.5, y=y + 2.5, width=width - 5, height=_CELL - 5)
    letter = cell.letter + ("" if cell.as_required else " ✗")
    out += text_at(x + width / 2, y + (17 if cell.value else 25), "middle", letter, f"symbol on-cell on-{cell.css}")
    if cell.value:
        out += text_at(x + width / 2, y + 33, "middle", shorten(cell.value, _MOST_LETTERS), f"on-cell on-{cell.css}")
    return element("g", out)


def _draw_block(map_: StabilityMap, columns: range, left: float, width: float, y: float) -> str:
    """Some columns of the map with their header."""
    out = ""
    for i, c in enumerate(columns):
        name = text_at(left + (i + 0.5) * width, y + 14, "middle", shorten(map_.columns[c], _MOST_LETTERS))
        out += element("g", title(f"{map_.column_name} = {map_.columns[c]}") + name)
    for r in range(max(len(map_.rows), 1)):
        top = y + 20 + r * _CELL
        if map_.rows:
            out += text_at(left - 8, top + _CELL / 2 + 4.5, "end", shorten(map_.rows[r], _MOST_LETTERS))
        out += "".join(_draw_cell(map_.cells[r * len(map_.columns) + c], left + i * width, top, width) for i, c in enumerate(columns))
    return out


def _legend(map_: StabilityMap, full: float, y: float) -> tuple[str, float]:
    """What the colours mean, and where it ends."""
    counts = Counter(cell.verdict for cell in map_.cells)
    entries = [(Cell(v), f"{v.name} ({counts[v]})", _LETTERS[v]) for v in Verdict if counts[v]]
    faults = sum(not cell.as_required for cell in map_.cells)
    entries += [(Cell(as_required=False), f"not allowed here ({faults})", "✗")] if faults else []
    entries += [(Cell(), f"no run ({counts[None]})", "–")] if counts[None] else []
    out, x = "", 8.0
    for sample, text, letter in entries:
        width = 30 + LETTER * len(text) + 14
        if x > 8 and x + width > full:
            x, y = 8.0, y + 24
        out += element("rect", css=f"cell cell-{sample.css}", x=x, y=y, width="22", height="20")
        if not sample.as_required:
            out += element("rect", css="fault", x=x + 1.5, y=y + 1.5, width="19", height="17")
        paper = " on-cell" if sample.verdict is not None else ""
        out += text_at(x + 11, y + 15, "middle", letter, f"symbol{paper} on-{sample.css}")
        out += text_at(x + 28, y + 15, "start", text)
        x += width
    return out, y + 28


def svg_map(map_: StabilityMap) -> str:
    """Cells are as wide as their texts need: a map with more of them than fit into a chart's width is wider than that. One parameter: rows of
    values below each other."""
    left = 16 + DIGIT * _longest(map_.rows) if map_.rows else 8.0
    least = max(_LEAST_WIDTH, DIGIT * _longest([*map_.columns, *(cell.value for cell in map_.cells)]) + 8)
    count = max(len(map_.columns) if map_.rows else min(len(map_.columns), int((WIDTH - 16) / least)), 1)
    width = min(max((WIDTH - left - 8) / count, least), max(least, 90.0))
    full = max(float(WIDTH), left + width * count + 8)
    names = ", ".join(filter(None, [map_.row_name and f"{map_.row_name} ↓", map_.column_name and f"{map_.column_name} →"]))
    y = 26.0 if names else 6.0
    body = text_at(8, 18, "start", shorten(names, 54), "symbol") if names else ""
    for first in range(0, len(map_.columns), count):
        body += _draw_block(map_, range(first, min(first + count, len(map_.columns))), left, width, y)
        y += 28 + _CELL * max(len(map_.rows), 1)
    legend, end = _legend(map_, full, y + 6)
    return drawing(full, end, map_.label, body + legend)
