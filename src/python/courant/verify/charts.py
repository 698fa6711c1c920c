"""Charts and maps of the reports as SVG in the one style: each line has a marker of its own, so that they can be read without colours, they fit dark pages, and
tell their numbers when pointed at. No script."""
from __future__ import annotations

import io
import math
import re
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from .. import style
from ..optional import module
from .model import CaseResult, RunResult, Verdict
from .text import escape_xml, number, percent, plain, shorten

WIDTH = 3.9  # of charts [inches]
_HEIGHT, _CELL, _LETTER = 2.7, 0.42, 0.085  # of charts without a legend; of a row of a map; of a letter [inches]
_MARKERS = "o" + style.MARKERS
_IN_A_ROW = 7  # columns of a map; of more the longer sweep had better be rows
_MOST_LETTERS = 14  # of a value of a swept parameter, or in a cell
_FRONT, _BOUND = "#d9b300", "#b00020"
# letter of a verdict, so that the map can be read without colours, and its colour; None: there is no run
_VERDICTS = {Verdict.stable: ("S", "#a6d4f0"), Verdict.degraded: ("D", "#f5e07a"), Verdict.stopped: ("X", "#eb9a5c"),
             Verdict.refused: ("R", "#c9c9c9"), Verdict.broken: ("!", "#222222"), None: ("–", "#f4f4f4")}
LETTERS = {verdict: letter for verdict, (letter, _) in _VERDICTS.items()}
DARK = "@media screen and (prefers-color-scheme:dark){svg.chart{filter:invert(.91) hue-rotate(180deg)}}"


@dataclass
class Point:
    x: float
    y: float
    hover: str = ""  # what is shown when the point is pointed at


@dataclass
class Line:
    """`style`: joined (a marker at each point), line (a few markers), reference (dashed), dots (circles)."""

    name: str
    points: list[Point] = field(default_factory=list)
    style: str = "joined"


@dataclass
class Chart:
    label: str = ""  # for those who cannot see the chart
    x_label: str = ""
    y_label: str = ""
    logarithmic: bool = False
    percent: bool = False  # y is a fraction that is shown in per cent
    lines: list[Line] = field(default_factory=list)
    front: list[Point] = field(default_factory=list)  # drawn as a broad light line and rings below the lines
    levels: list[tuple[str, float]] = field(default_factory=list)  # name and y of horizontal dashed lines


def literal(text: str, most: int = 50) -> str:
    """Text without formulas and control characters."""
    return shorten(plain(text), most).replace("$", "\\$")


class _Svg:
    """A figure of matplotlib that becomes an `svg` element, whose artists tell texts when they are pointed at."""

    def __init__(self, width: float, height: float) -> None:
        self.plt = style.pyplot()
        self.figure, self.axes = self.plt.subplots(figsize=(width, height))
        self.hovers: list[str] = []

    def tells(self, artist: Any, text: str) -> None:
        if text:
            artist.set_gid(f"tells-{len(self.hovers)}-")
            self.hovers.append(text)

    def element(self, label: str) -> str:
        """One `svg` element without ids of its own, but for clips and markers, whose ids follow from their content."""
        file = io.StringIO()
        with self.plt.rc_context({"svg.fonttype": "none", "font.family": ["DejaVu Sans", "sans-serif"]}):
            self.figure.savefig(file, format="svg", bbox_inches="tight", pad_inches=0.06, metadata={"Date": None})
        self.plt.close(self.figure)
        svg = file.getvalue()
        svg = re.sub(r"<metadata>.*?</metadata>|<style.*?</style>|<!--.*?-->", "", svg[svg.index("<svg"):], flags=re.S)
        svg = re.sub(r'<g id="tells-(\d+)-">', lambda found: f"<g><title>{escape_xml(self.hovers[int(found[1])])}</title>", svg)
        svg = re.sub(r'(?<=<g) id="[\w.]+"| transform="rotate\(-0 [^)]*\)"|(?<=\d\.\d\d)\d+', "", svg)
        size = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', svg)
        assert size is not None  # matplotlib writes it
        head = f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" class="chart" viewBox="0 0 {size[1]} {size[2]}" ' \
               f'width="{size[1]}" height="{size[2]}" role="img" aria-label="{escape_xml(label)}" stroke-linejoin="round">'
        return re.sub(r">\s+<", "><", head + svg[svg.index(">") + 1:]).strip()


def width_of(svg: str) -> float:
    """Of an element over that of charts."""
    found = re.search(r' width="([\d.]+)"', svg)
    return float(found[1]) / (72 * WIDTH) if found else 1.0


def _limits(values: Sequence[float], logarithmic: bool) -> tuple[float, float]:
    """The ends of an axis that shows all values: on a logarithmic one at least a factor of three apart, so that it carries some numbers."""
    if not values:
        return (1.0, 10.0) if logarithmic else (0.0, 1.0)
    low, high = min(values), max(values)
    if logarithmic:
        width = math.log(high / low) if high / low < math.inf else math.log(high) - math.log(low)
        margin = math.exp(0.06 * width + max((math.log(3.0) - width) / 2, 0))
        return low / margin, high * margin
    margin = 0.04 * (high - low) if high - low > 1e-9 * max(abs(low), abs(high)) else 0.1 * max(abs(low), abs(high)) or 1.0
    return low - margin, high + margin


class _Drawing(_Svg):
    """A chart with its axes. Points without a location on them are not dropped: zero and negative values on a logarithmic axis are at its beginning, infinite
    ones and what is not a number at its end, with their value."""

    def __init__(self, chart: Chart) -> None:
        super().__init__(WIDTH, _HEIGHT)
        self.chart, points = chart, [p for line in chart.lines for p in line.points]
        values = {"x": [p.x for p in points], "y": [p.y for p in points] + [y for _, y in chart.levels]}
        self.limits = {axis: _limits([v for v in some if self.has_place(v)], chart.logarithmic) for axis, some in values.items()}
        self.axes.set(xlim=self.limits["x"], ylim=self.limits["y"])
        if chart.logarithmic:
            self.axes.set(xscale="log", yscale="log")
            self._round_numbers()
        self.axes.set_title(literal(chart.y_label, 54), loc="left", fontsize=10, x=-0.16)
        self.axes.set_xlabel(literal(chart.x_label), loc="right")
        self.axes.grid(True)
        self.axes.set_axisbelow(True)

    def has_place(self, value: float) -> bool:
        return abs(value) < 1e150 and (not self.chart.logarithmic or value > 1e-150)

    def _round_numbers(self) -> None:
        """Numbers at powers of ten, at 1, 2 and 5 between them on a short axis, and at all digits on a very short one."""
        ticker = module("matplotlib.ticker")
        for axis, (low, high) in ((self.axes.xaxis, self.limits["x"]), (self.axes.yaxis, self.limits["y"])):
            decades = math.log10(high) - math.log10(low)
            axis.set_major_locator(ticker.LogLocator(subs=(1.0,) if decades > 2.5 else (1.0, 2.0, 5.0) if decades > 1 else range(1, 10), numticks=8))
            axis.set_minor_locator(ticker.NullLocator())
            told = percent if self.chart.percent and axis is self.axes.yaxis and low > 5e-6 and high < 200 else number
            axis.set_major_formatter(ticker.FuncFormatter(lambda value, position, told=told: told(value)))

    def place(self, p: Point) -> tuple[float, float]:
        """Where it is drawn: what has no location, at an end of the axis."""
        return tuple(v if self.has_place(v) else self.limits[axis][0 if v <= 0 else 1]  # type: ignore[return-value]
                     for axis, v in (("x", p.x), ("y", p.y)))

    def path(self, points: Sequence[Point]) -> tuple[list[float], list[float]]:
        """Coordinates of those that have a location, NaN between them."""
        kept = [(p.x, p.y) if self.has_place(p.x) and self.has_place(p.y) else (math.nan, math.nan) for p in points]
        return [x for x, _ in kept], [y for _, y in kept]

    def mark(self, p: Point, **look: Any) -> None:
        x, y = self.place(p)
        self.tells(self.axes.plot([x], [y], linestyle="none", clip_on=False, zorder=3, **look)[0], p.hover)
        if (x, y) == (p.x, p.y):
            return
        off_y = not self.has_place(p.y)
        told = f"time {number(p.x, 2)}" if not off_y else "NaN" if math.isnan(p.y) else f"{p.y:g}" if math.isinf(p.y) else number(p.y, 2)
        away = (-7, "right") if self.axes.transAxes.inverted().transform(self.axes.transData.transform((x, y)))[0] > 0.8 else (7, "left")
        arrow = ("↓ " if p.y <= 0 else "↑ ") if off_y else ""
        self.axes.annotate(arrow + told, (x, y), xytext=(away[0], 7 if off_y and p.y <= 0 else -7), textcoords="offset points", ha=away[1], va="center",
                           fontsize=9.5)

    def line(self, line: Line, index: int) -> None:
        color, marker = style.PALETTE[index % len(style.PALETTE)], _MARKERS[index % len(_MARKERS)]
        x, y = self.path(line.points)
        name = literal(line.name)
        if line.style in ("reference", "dots"):
            look: dict[str, Any] = {"linestyle": (0, (5, 4))} if line.style == "reference" else {"linestyle": "none", "marker": "o", "markerfacecolor": "none"}
            self.tells(self.axes.plot(x, y, color="0.13", linewidth=1.2, label=name, markersize=5, **look)[0], line.name)
            return
        look = {"color": color, "marker": marker, "markersize": 6.5, "markeredgecolor": "white", "markeredgewidth": 0.4}
        again = "-" if index < len(_MARKERS) else "--"
        self.tells(self.axes.plot(x, y, color=color, linewidth=1.4, linestyle=again)[0], line.name)
        self.axes.plot([], [], linewidth=1.4, linestyle=again, label=name, **look)  # of the legend
        stride = len(line.points) // 6 if line.style == "line" and len(line.points) > 12 else 1
        first = stride * (index % 4) // 4  # or the markers of lines that lie on each other would hide one another
        for p in line.points[first::stride]:
            if line.style == "joined" or (self.has_place(p.x) and self.has_place(p.y)):
                self.mark(p, **look)

    def rest(self) -> None:
        if self.chart.front:
            look = {"marker": "o", "markersize": 11, "markerfacecolor": "none", "markeredgecolor": "#a88600"}
            self.axes.plot(*self.path(self.chart.front), color=_FRONT, alpha=0.45, linewidth=6, label="best error for the time", zorder=1, **look)
        for name, y in self.chart.levels:
            if self.has_place(y):
                self.tells(self.axes.axhline(y, color=_BOUND, linestyle=(0, (2, 3)), linewidth=1.5, label=literal(name)), name)


def legend_below(axes: Any, handles: Sequence[Any] | None = None, down: float = 0.52) -> None:
    """A legend below the axes, its entries side by side where they fit. `down`: inches between them."""
    artists, names = axes.get_legend_handles_labels() if handles is None else (handles, [one.get_label() for one in handles])
    if names:
        letters = _LETTER * max(map(len, names)) + 0.55
        width, height = axes.figure.get_size_inches() * axes.get_position().size
        axes.legend(artists, names, loc="upper left", bbox_to_anchor=(-0.14, -down / height), ncol=max(1, min(len(names), int(1.1 * width / letters))),
                    frameon=False, fontsize=9.5, borderaxespad=0, columnspacing=1.0, handlelength=2.2)


def svg_chart(chart: Chart) -> str:
    """The chart as one `svg` element. Any text is allowed in names."""
    d = _Drawing(chart)
    for index, line in enumerate(chart.lines):
        d.line(line, index)
    d.rest()
    legend_below(d.axes)
    return d.element(chart.label)


# ---- where a stability case holds and where it breaks


@dataclass
class Cell:
    verdict: Verdict | None = None  # None: there is no such run
    as_required: bool = True
    value: str = ""  # a short text below the verdict's letter
    hover: str = ""

    def show(self, run: RunResult) -> None:
        """Of several runs with the same swept values, the worst one is in the cell."""
        parts = [f"{run.setting}: {run.verdict.name}" + ("" if run.as_required else ", which the suite does not allow"), *run.exceeded]
        parts += [f"{o.name} {number(o.value)}" for o in run.observed if o.value is not None]
        parts += [run.reason] if run.verdict != Verdict.stable and run.reason else []
        self.hover += ("\n" if self.hover else "") + "; ".join(parts)
        if self.verdict is None or run.verdict > self.verdict or (self.as_required and not run.as_required):
            self.verdict, self.as_required = run.verdict, self.as_required and run.as_required
            self.value = next((number(o.value, 3) for o in run.observed if o.found and o.value is not None), "")


@dataclass
class StabilityMap:
    """Columns and rows as the suite has them; the longer sweep is in rows where it would be too wide. No rows: one parameter."""

    label: str
    column_name: str = ""
    row_name: str = ""
    columns: list[str] = field(default_factory=list)
    rows: list[str] = field(default_factory=list)
    cells: list[Cell] = field(default_factory=list)  # row by row
    value_name: str = ""  # what the values in the cells are; blank: there are none


def verdict_counts(case: CaseResult) -> str:
    """ "12 stable, 3 degraded, 1 stopped", those that occur."""
    counts = Counter(run.verdict for run in case.runs)
    return ", ".join(f"{counts[v]} {v.name}" for v in Verdict if counts[v])


def _cell_of(runs: Sequence[RunResult], wanted: Callable[[RunResult], bool]) -> Cell:
    out = Cell()
    for run in filter(wanted, runs):
        out.show(run)
    return out


def stability_map(case: CaseResult, setting: str = "") -> StabilityMap | None:
    """With a setting, of its runs alone (their names begin with it). None for other cases."""
    stability = case.definition.stability
    if stability is None:
        return None
    runs = [r for r in case.runs if not setting or r.setting == setting or r.setting.startswith(setting + ", ")]
    out = StabilityMap(f"{case.definition.title}: {verdict_counts(case)}")
    out.value_name = next((o.name for run in runs for o in run.observed if o.found and o.value is not None), "")
    if not stability.sweep:  # runs by their names
        out.columns, out.cells = [run.name for run in runs], [_cell_of([run], lambda r: True) for run in runs]
        return out
    across, down = (*stability.sweep, ("", []))[:2]
    if len(across[1]) > _IN_A_ROW and 0 < len(down[1]) < len(across[1]):
        across, down = down, across
    (out.column_name, out.columns), (out.row_name, out.rows) = across, down
    for row in out.rows or [""]:
        for column in out.columns:
            wanted = {out.column_name: column, **({out.row_name: row} if out.rows else {})}
            out.cells.append(_cell_of(runs, lambda r, wanted=wanted: wanted.items() <= r.parameters.items()))  # type: ignore[misc]
    return out


def _draw_cell(drawing: _Svg, cell: Cell, x: float, y: float) -> None:
    letter, colour = _VERDICTS[cell.verdict]
    patches, ink = module("matplotlib.patches"), "white" if cell.verdict == Verdict.broken else "0.07"
    drawing.tells(drawing.axes.add_patch(patches.Rectangle((x - 0.49, y - 0.48), 0.98, 0.96, facecolor=colour)), cell.hover)
    if not cell.as_required:
        drawing.axes.add_patch(patches.Rectangle((x - 0.46, y - 0.44), 0.92, 0.88, fill=False, edgecolor=_BOUND, linewidth=2))
        letter += " ✗"
    look = {"ha": "center", "va": "center", "color": ink}
    drawing.axes.text(x, y + (0.18 if cell.value else 0), letter, weight="bold", fontsize=9.5, **look)
    if cell.value:
        drawing.axes.text(x, y - 0.24, literal(cell.value, _MOST_LETTERS), fontsize=9.5, **look)


def _handles(map_: StabilityMap) -> list[Any]:
    """Of the legend: what the colours mean."""
    patches, counts = module("matplotlib.patches"), Counter(cell.verdict for cell in map_.cells)
    out = [patches.Patch(color=colour, label=f"{letter}  {v.name} ({counts[v]})" if v is not None else f"{letter}  no run ({counts[v]})")
           for v, (letter, colour) in _VERDICTS.items() if counts[v]]
    faults = sum(not cell.as_required for cell in map_.cells)
    return out + ([patches.Patch(fill=False, edgecolor=_BOUND, linewidth=2, label=f"✗  not allowed here ({faults})")] if faults else [])


def svg_map(map_: StabilityMap) -> str:
    """Cells are as wide as their texts need: a map with more of them than fit into a chart's width is wider than that. One parameter: rows of
    values below each other."""
    columns, cells = [literal(name, _MOST_LETTERS) for name in map_.columns], [literal(cell.value, _MOST_LETTERS) for cell in map_.cells]
    wide = max(0.45, _LETTER * max(map(len, [*columns, *cells]), default=0) + 0.1)
    count = max(1, len(columns) if map_.rows else min(len(columns), int(WIDTH / wide)))
    lines = len(map_.rows) or math.ceil(len(columns) / count)
    high = 1.0 if map_.rows else 1.6  # of a row [cells]: one parameter has its values above them
    drawing = _Svg(max(count * wide, min(WIDTH - 0.4, count * 0.9)), max(1, lines) * high * _CELL)
    axes = drawing.axes
    axes.set_position((0, 0, 1, 1))
    axes.set(xlim=(-0.5, count - 0.5), ylim=(-0.5 - (lines - 1) * high, 0.5 if map_.rows else 1.0))
    axes.tick_params(length=0, labeltop=True, labelbottom=False)
    axes.set_frame_on(False)
    for k, cell in enumerate(map_.cells):
        row, column = divmod(k, count)
        _draw_cell(drawing, cell, column, -high * row)
        if not map_.rows:
            name = axes.text(column, -high * row + 0.6, columns[k], ha="center", va="bottom", fontsize=9.5)
            drawing.tells(name, f"{map_.column_name} = {map_.columns[k]}")
    axes.set_xticks(range(count) if map_.rows else [], columns if map_.rows else [], fontsize=9.5)
    axes.set_yticks([-row for row in range(len(map_.rows))], [literal(row, _MOST_LETTERS) for row in map_.rows], fontsize=9.5)
    names = [map_.row_name and f"{map_.row_name} ↓", map_.column_name and f"{map_.column_name} →"]
    axes.set_title(literal(", ".join(filter(None, names)), 54), loc="left", fontsize=10, weight="bold", pad=8 if map_.rows else 6)
    legend_below(axes, _handles(map_), 0.12)
    return drawing.element(map_.label)
