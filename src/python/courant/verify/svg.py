"""Line charts as SVG, without any script: they scale with the page, can be read without colours (each line has a marker of its own), fit light and
dark pages, and tell their numbers when pointed at."""
from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from .text import escape_xml, number, shorten

WIDTH = 420  # of the charts' coordinates
LETTER, DIGIT = 7.3, 8.6  # widths of letters and digits in the page's font, in these coordinates
_TOP, _HEIGHT, _ROW = 30.0, 225.0, 21.0  # of the plot; of a row of the legend
_COLOURS = 7  # of the style sheet
_MOST_DECADES = 7  # with a number each
_SMALLEST_RATIO = 3.0  # of the ends of a logarithmic axis: one narrower carries too few numbers
_OUTLINES = ("", "M-.9-.9h1.8v1.8h-1.8z", "M0-1.2L1.1.8H-1.1z", "M0-1.3L1.3 0 0 1.3-1.3 0z", "M0 1.2L1.1-.8H-1.1z",
             "M-.4-1.2h.8v.8h.8v.8h-.8v.8h-.8v-.8h-.8v-.8h.8z",
             "M-1.2-.5L-.5-1.2 0-.6.5-1.2 1.2-.5.6 0 1.2.5.5 1.2 0 .6-.5 1.2-1.2.5-.6 0z", "M0-1.3L1.2-.4.8 1H-.8L-1.2-.4z")


@dataclass
class Point:
    x: float
    y: float
    hover: str = ""  # what is told when the point is pointed at


@dataclass
class Line:
    """`style`: joined (a marker at each point), line (a few markers), reference (dashed), dots (circles)."""

    name: str
    points: list[Point] = field(default_factory=list)
    style: str = "joined"

    def css(self, index: int) -> str:
        if self.style in ("reference", "dots"):
            return "reference" + (" dots" if self.style == "dots" else "")
        return f"s{index % _COLOURS}" + (" again" if index >= len(_OUTLINES) else "")


@dataclass
class Chart:
    label: str = ""  # for those who cannot see the chart
    x_label: str = ""
    y_label: str = ""
    logarithmic: bool = False
    percent: bool = False  # y is a fraction that is told in per cent
    lines: list[Line] = field(default_factory=list)
    front: list[Point] = field(default_factory=list)  # drawn as a broad light line and rings below the lines
    levels: list[tuple[str, float]] = field(default_factory=list)  # name and y of horizontal dashed lines


def element(tag: str, content: str = "", **attributes: object) -> str:
    """An element; numbers have one digit behind the point, `css` is the class, other _ in names are -."""
    words = [f' {("class" if name == "css" else name.replace("_", "-"))}="'
             f'{f"{value:.1f}" if isinstance(value, float) else value}"' for name, value in attributes.items() if value is not None]
    return f"<{tag}{''.join(words)}>{content}</{tag}>" if content else f"<{tag}{''.join(words)}/>"


def text_at(x: float, y: float, anchor: str, text: str, css: str | None = None) -> str:
    return element("text", escape_xml(text), x=float(x), y=float(y), text_anchor=anchor, css=css)


def title(hover: str) -> str:
    return f"<title>{escape_xml(hover)}</title>" if hover else ""


def drawing(width: float, height: float, label: str, body: str) -> str:
    """One `svg` element in the style of the page's style sheet."""
    size = f'width="{width:.0f}" height="{height:.0f}"'
    return (f'<svg xmlns="http://www.w3.org/2000/svg" class="chart" viewBox="0 0 {width:.0f} {height:.0f}" {size} role="img" '
            f'aria-label="{escape_xml(label)}"><rect class="paper" {size}/>{body}</svg>')


class Axis:
    """An axis that shows all values that can have a place on it, with at least two ticks. Without any such value it goes from 1 to 10, or from 0
    to 1. `percentages`: fractions are labelled as per cent, unless their range is so wide that powers of ten are easier to read. `ticks`: values
    and labels."""

    def __init__(self, logarithmic: bool, values: Iterable[float], percentages: bool = False) -> None:
        self.logarithmic = logarithmic
        self._set_range([v for v in values if self.shows(v)])
        ticks = self._logarithmic_ticks() if logarithmic else self._linear_ticks()
        as_percent = percentages and self.start > 5e-6 and self.end < 200
        digits = 6  # enough to tell neighbouring ticks apart, too few to show that 0.3 is not 3/10
        if not logarithmic:
            size = max(abs(self.start), abs(self.end))
            digits = min(max(int(math.log10(size / (ticks[1] - ticks[0]))) + 3, 6), 15)
        self.ticks = [(v, self._label(100 * v if as_percent else v, digits) + (" %" if as_percent else "")) for v in ticks]

    @staticmethod
    def _label(value: float, digits: int) -> str:
        shown = float(f"{value:.{digits - 1}e}")
        return number(shown, digits) if shown != 0 and not 1e-4 <= abs(shown) < 1e6 else f"{shown:.{digits}g}"

    def shows(self, value: float) -> bool:
        """Whether a value has a place: finite, and positive on a logarithmic axis."""
        return abs(value) < 1e300 and (not self.logarithmic or value > 1e-300)

    def place(self, value: float) -> float:
        """0 at the beginning of the axis, 1 at its end; the value must have a place."""
        if self.logarithmic:
            return (math.log(value) - math.log(self.start)) / (math.log(self.end) - math.log(self.start))
        return (value - self.start) / (self.end - self.start)

    def _set_range(self, values: Sequence[float]) -> None:
        if not values:
            self.start, self.end = (1.0, 10.0) if self.logarithmic else (0.0, 1.0)
            return
        self.start, self.end = min(values), max(values)
        if self.logarithmic:
            width = math.log(self.end) - math.log(self.start)
            margin = math.exp(0.06 * width + max((math.log(_SMALLEST_RATIO) - width) / 2, 0))
            self.start, self.end = max(self.start / margin, 1e-300), min(self.end * margin, 1e300)
            return
        size = max(abs(self.start), abs(self.end))
        if self.end - self.start < 1e-9 * size or size == 0:
            margin = 0.1 * size or 1.0
            self.start, self.end = self.start - margin, self.end + margin

    def _digits_of_decades(self, digits: Sequence[int]) -> list[float]:
        decades = range(math.floor(math.log10(self.start)), math.ceil(math.log10(self.end)) + 1)
        values = (float(f"{digit}e{decade}") for decade in decades for digit in digits)
        return [v for v in values if self.start <= v <= self.end]

    def _logarithmic_ticks(self) -> list[float]:
        values = self._digits_of_decades((1,))
        if len(values) < 3 and self.end / self.start < 300:
            values = self._digits_of_decades((1, 2, 5))
        if len(values) < 2:
            values = self._digits_of_decades(range(1, 10))
        return values[::max(1, -(-len(values) // _MOST_DECADES))]

    def _linear_ticks(self) -> list[float]:
        rough = (self.end - self.start) / 5
        decade = 10.0 ** math.floor(math.log10(rough))
        step = next((digit * decade for digit in (1, 2, 5) if digit * decade >= rough * (1 - 1e-9)), 10 * decade)
        first, last = math.floor(self.start / step + 1e-9), math.ceil(self.end / step - 1e-9)
        self.start, self.end = first * step, last * step
        return [k * step for k in range(first, last + 1)]


def marker(index: int, x: float, y: float, hover: str = "") -> str:
    """The mark of line number `index`."""
    outline = _OUTLINES[index % len(_OUTLINES)]
    if not outline:
        return element("circle", title(hover), cx=float(x), cy=float(y), r=4.6, css="mark")
    return element("path", title(hover), d=outline, transform=f"translate({x:.1f} {y:.1f}) scale(4.6)", css="mark")


class _Drawing:
    """A chart with its axes: where things are."""

    def __init__(self, chart: Chart) -> None:
        points = [p for line in chart.lines for p in line.points]
        self.chart = chart
        self.x = Axis(chart.logarithmic, [p.x for p in points])
        self.y = Axis(chart.logarithmic, [p.y for p in points] + [y for _, y in chart.levels], chart.percent)
        self.left = min(10 + DIGIT * max(2, *(len(label) for _, label in self.y.ticks)), 140.0)
        self.right, self.bottom = WIDTH - 14.0, _TOP + _HEIGHT

    def at_x(self, v: float) -> float:
        """Also of what has no place: near the beginning of the axis, or its end for what is too large or not a number."""
        if self.x.shows(v):
            return self.left + self.x.place(v) * (self.right - self.left)
        return self.left + 10 if v <= 0 else self.right - 10

    def at_y(self, v: float) -> float:
        if self.y.shows(v):
            return self.bottom - self.y.place(v) * _HEIGHT
        return self.bottom - 10 if v <= 0 else _TOP + 10

    def shows(self, p: Point) -> bool:
        return self.x.shows(p.x) and self.y.shows(p.y)

    def grid(self) -> str:
        """Lines of the grid with their numbers; numbers along x that would touch each other are thinned out."""
        lines = [f"M{self.left:.1f} {self.at_y(v):.1f}H{self.right:.1f}" for v, _ in self.y.ticks]
        lines += [f"M{self.at_x(v):.1f} {_TOP:.1f}V{self.bottom:.1f}" for v, _ in self.x.ticks]
        out = element("g", "".join(element("path", d=d) for d in lines), css="grid")
        out += "".join(text_at(self.left - 6, self.at_y(v) + 4.5, "end", label) for v, label in self.y.ticks)
        taken = -math.inf
        for v, label in self.x.ticks:
            half = DIGIT * len(label) / 2
            middle = min(max(self.at_x(v), half), WIDTH - half - 1)
            if middle - half >= taken + 8:
                taken = middle + half
                out += text_at(middle, self.bottom + 18, "middle", label)
        return out + element("path", css="frame", d=f"M{self.left:.1f} {_TOP:.1f}V{self.bottom:.1f}H{self.right:.1f}")

    def path(self, points: Sequence[Point]) -> str:
        """The lines through those points in a row that have a place."""
        out, pen_down = "", False
        for p in points:
            shown = self.shows(p)
            out += f"{'L' if pen_down else 'M'}{self.at_x(p.x):.1f} {self.at_y(p.y):.1f}" if shown else ""
            pen_down = shown
        return out

    def stray(self, p: Point, index: int) -> str:
        """A point that has no place on the axes: at the edge, with an arrow and its value."""
        x, y, high, y_off = self.at_x(p.x), self.at_y(p.y), not p.y <= 0, not self.y.shows(p.y)
        out = marker(index, x, y, p.hover)
        if y_off:
            arrow = "m-3.5 3.5L0 0 3.5 3.5M0 0V6" if high else "m-3.5-3.5L0 0 3.5-3.5M0 0V-6"
            top = _TOP - 2 if high else self.bottom + 1
            out += element("path", css="arrow", transform=f"translate({x:.1f} {top:.1f})", d=f"M0 0{arrow}")
        value = f"time {number(p.x, 2)}" if not y_off else "NaN" if math.isnan(p.y) else "inf" if math.isinf(p.y) else number(p.y, 2)
        at_right = x > self.right - 60
        return out + text_at(x - 8 if at_right else x + 8, y + 4.5, "end" if at_right else "start", value)

    def line(self, line: Line, index: int) -> str:
        out = "" if line.style == "dots" else element("path", title(line.name), css="line", d=self.path(line.points))
        stride = len(line.points) // 6 if line.style == "line" and len(line.points) > 12 else 1
        first = stride * (index % 4) // 4  # or the markers of lines that lie on each other would hide one another
        for i, p in enumerate(line.points):
            if not self.shows(p):
                out += self.stray(p, index) if line.style == "joined" else ""
            elif line.style == "dots":
                out += element("circle", title(p.hover), cx=self.at_x(p.x), cy=self.at_y(p.y), r="4.2")
            elif i % stride == first and line.style != "reference":
                out += marker(index, self.at_x(p.x), self.at_y(p.y), p.hover)
        return element("g", out, css=line.css(index))

    def front(self) -> str:
        if not self.chart.front:
            return ""
        rings = (element("circle", cx=self.at_x(p.x), cy=self.at_y(p.y), r="9") for p in self.chart.front)
        return element("g", element("path", d=self.path(self.chart.front)) + "".join(rings), css="front")

    def levels(self) -> str:
        return "".join(element("path", title(name), css="bound", d=f"M{self.left:.1f} {self.at_y(y):.1f}H{self.right:.1f}")
                       for name, y in self.chart.levels if self.y.shows(y))


def _samples(chart: Chart) -> Iterable[tuple[str, str]]:
    """Of the legend: what is drawn around (13, 0), and its name."""
    stroke = element("path", css="line", d="M0 0H26")
    for i, line in enumerate(chart.lines):
        sample = element("circle", cx="13", cy="0", r="4.2") if line.style == "dots" else stroke
        yield element("g", sample + (marker(i, 13, 0) if line.style in ("joined", "line") else ""), css=line.css(i)), line.name
    if chart.front:
        ring = element("path", d="M0 0H26") + element("circle", cx="13", cy="0", r="8")
        yield element("g", ring, css="front"), "best error for the time"
    for name, _ in chart.levels:
        yield element("path", css="bound", d="M0 0H26"), name


def svg_chart(chart: Chart) -> str:
    """The chart as one `svg` element. Points without a place on the axes are not dropped: zero and negative values on a logarithmic axis stand at
    its beginning with an arrow and their value, infinite ones and what is not a number at its end. Any text is allowed in names."""
    d = _Drawing(chart)
    body = d.grid() + text_at(2, 16, "start", shorten(chart.y_label, 54))
    body += text_at(d.right, d.bottom + 38, "end", shorten(chart.x_label, 50)) + d.front() + d.levels()
    body += "".join(d.line(line, i) for i, line in enumerate(chart.lines))
    x, y = 8.0, d.bottom + 60
    for sample, full in _samples(chart):  # side by side where they fit
        name = shorten(full, 50)
        width = 34 + LETTER * len(name) + 22
        if x > 8 and x + width > WIDTH:
            x, y = 8.0, y + _ROW
        hover = "" if name == full else title(full)
        body += element("g", sample + hover + text_at(33, 4.5, "start", name), transform=f"translate({x:.1f} {y:.1f})")
        x += width
    return drawing(WIDTH, y + _ROW - 8, chart.label, body)
