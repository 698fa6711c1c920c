"""Figures of a recipe: what they show, and figures.json with all their numbers.

A chart of one's own is a function of matplotlib's axes with a decorator; its parameters are keys of the figure:

    from courant.post import chart

    @chart("histogram")
    def histogram(axes, tables, table, of, bins: float = 20):
        axes.hist(tables[table].find(of).values, int(bins))

and `{name: h, chart: histogram, table: depth, of: depth}` is under `figures`.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..diagnostics import Diagnostics, Location
from ..expressions import Formula
from ..key_tables import keys as keys_of_map
from ..registry import Registry
from ..words import did_you_mean
from ..yaml_map import Node, YamlMap, as_number, is_list, is_map, key, keys_of, scalar_text
from .state import read_expression
from .tables import Image, Table

STYLES = ("line", "dashed", "points", "line+points")
SCALES = ("linear", "log_x", "log_y", "log")
COLOURS = ("viridis", "cividis", "magma", "plasma", "coolwarm", "Greys")
_PARTS = keys_of_map("more of a figure", "curves [@curve], references [@reference of a figure], map @map of a figure")
_REFERENCE = keys_of_map("reference of a figure", "formula text, from number, to number, points list, x number, y number, label text, style text")
CHARTS: Registry[Callable[..., None]] = Registry("chart", {name: f"{__package__}.charts" for name in ("drop_regimes", "jump_types")})
chart = CHARTS  # the decorator: functions (axes, tables by name, **keys of the figure)


@dataclass
class Curve:
    """A curve from a table: x and y are expressions over its columns; `each`: a column, one curve for each of its values."""

    table: str = key("text", required=True)
    x: str = key("text", required=True)
    y: str = key("text", required=True)
    each: str = key("text")
    label: str = key("text")
    style: str = key("choice", words=STYLES)
    where: Location = Location()


@dataclass
class Reference:
    """A curve or points that others found, or a straight line: `across` "x" is upright at x[0], "y" level at y[0]."""

    label: str
    style: str
    x: list[float] = field(default_factory=list)
    y: list[float] = field(default_factory=list)
    across: str = " "


@dataclass
class Map:
    """A field of an image as colours, with streamlines: two fields, or none."""

    image: str = key("text", required=True)
    field: str = key("text", required=True)
    label: str = key("text")
    streamlines: list[str] = key("texts")
    range: tuple[float, float] | None = key("range")
    colours: str = key("choice", words=COLOURS)
    where: Location = Location()


@dataclass
class Figure:
    """`walls`: traces of the shells; `equal`: the same scale on both axes; `chart`: one of CHARTS, with its `keys`."""

    name: str = key("text", required=True)
    title: str = key("text")
    x_label: str = key("text")
    y_label: str = key("text")
    x_range: tuple[float, float] | None = key("range")
    y_range: tuple[float, float] | None = key("range")
    scale: str = key("choice", words=SCALES)
    curves: list[Curve] = field(default_factory=list)
    references: list[Reference] = field(default_factory=list)
    map: Map | None = None
    walls: bool = key("flag", False)
    equal: bool = key("flag", False)
    chart: str = ""
    keys: dict[str, Any] = field(default_factory=dict)


def read_figure(parent: YamlMap, node: Node) -> Figure:
    """Faults are reported."""
    keys = parent.element(node, "figures")
    own = keys.text("chart")
    if own and own not in CHARTS:
        hint = f"{did_you_mean(own, CHARTS.names())}charts: {', '.join(CHARTS.names())}"
        keys.error(keys.get("chart") or node, f"there is no chart '{own}'", hint)
    field_map = keys.map("map")
    out = keys.read(
        Figure,
        *_PARTS,
        *(text for text, _, _ in keys.entries() if own),  # a chart of one's own has its own keys
        curves=[_read_curve(keys.element(one, "curves")) for one in keys.list("curves")],
        references=[_read_reference(keys.element(one, "references")) for one in keys.list("references")],
        map=_read_map(field_map) if field_map else None,
        chart=own,
    )
    told = (*keys_of(Figure), *_PARTS, "chart")
    out.keys = {text: plain_value(value) for text, _, value in keys.entries() if own and text not in told}
    if is_map(node) and not (out.curves or out.map or own):
        keys.error(node, f"the figure '{out.name}' shows nothing", "add curves or a map")
    return out


def plain_value(node: Node) -> Any:
    """Numbers, texts and lists of a YAML node."""
    if is_list(node):
        return [plain_value(one) for one in node.value]
    if is_map(node):
        return {scalar_text(key): plain_value(value) for key, value in node.value}
    number = as_number(scalar_text(node))
    return scalar_text(node) if number is None else number


def _read_curve(keys: YamlMap) -> Curve:
    return keys.read(Curve, where=keys.where())


def _read_reference(keys: YamlMap) -> Reference:
    """{formula: exp(-0.028 * x), from: 0, to: 40}, {points: [[x, y], ...]}, {x: 3.5} or {y: 1}."""
    keys.allow(*_REFERENCE)
    out = Reference(keys.text("label"), keys.choice("style", STYLES))
    if sum(keys.has(key) for key in ("formula", "points", "x", "y")) != 1:
        hint = "for example {formula: exp(-0.028 * x), from: 0, to: 40}, {points: [[3.4, 0.342]]} or {y: 1}"
        keys.error(keys.node, f"'{keys.name}' needs one of formula, points, x and y", hint)
        return out
    for node in keys.list("points"):
        if not is_list(node) or len(node.value) != 2:
            keys.error(node, "a point has two numbers")
            continue
        for to, one in zip((out.x, out.y), node.value, strict=True):
            to.append(keys.scalar(one, "points") or 0.0)
    for across in "xy":
        if keys.has(across):
            out.across = across
            getattr(out, across).append(keys.number(across))
    formula = keys.get("formula")
    if formula is not None:
        start, end = keys.number("from", required=True), keys.number("to", required=True)
        of, steps = read_expression(keys, formula, "formula", ("x",)), 200
        if of.ok:
            x = start + (end - start) * np.arange(steps + 1) / steps
            out.x, out.y = x.tolist(), of.over({"x": x}, len(x)).tolist()
    return out


def _read_map(keys: YamlMap) -> Map:
    out = keys.read(Map, where=keys.where())
    if out.streamlines and len(out.streamlines) != 2:
        node = keys.get("streamlines") or keys.node
        keys.error(node, f"'{keys.name}.streamlines' must be two fields", "for example [vx_mean, vy_mean]")
    return out


def _numbers(values: Sequence[float] | np.ndarray) -> list[float | None]:
    """For JSON: seven digits, null where there is no number."""
    return [float(f"{value:.7g}") if math.isfinite(value) else None for value in values]


def _range(bounds: tuple[float, float] | None) -> list[float] | None:
    return None if bounds is None else [float(f"{bound:g}") for bound in bounds]


def _is_word(name: str) -> bool:
    return name.isascii() and name.isidentifier()


class FiguresData:
    """Makes the content of figures.json. What a figure names but is not there is reported."""

    def __init__(self, tables: Sequence[Table], images: Sequence[Image], diagnostics: Diagnostics) -> None:
        self.tables, self.images, self.diagnostics = tables, images, diagnostics

    def of(self, figure: Figure) -> dict[str, Any]:
        references = [
            {"label": one.label, "style": one.style, "across": one.across, "x": _numbers(one.x), "y": _numbers(one.y)} for one in figure.references
        ]
        curves = [data for curve in figure.curves for data in self._curves(curve)]
        out: dict[str, Any] = {key: getattr(figure, key) for key in ("name", "title", "x_label", "y_label", "scale")}
        out |= {"x_range": _range(figure.x_range), "y_range": _range(figure.y_range), "walls": figure.walls, "equal": figure.equal}
        out |= {"curves": curves, "references": references, "map": self._map(figure.map) if figure.map else None}
        return out

    def _named(self, all_of_them: Sequence[Any], name: str, what: str, where: Location) -> Any:
        found = next((one for one in all_of_them if one.name == name), None)
        if found is None:
            names = ", ".join(one.name for one in all_of_them)
            self.diagnostics.error(where, f"there is no {what} '{name}' for the figure", f"there are: {names}")
        return found

    def _curves(self, curve: Curve) -> list[dict[str, Any]]:
        table = self._named(self.tables, curve.table, "table", curve.where)
        if table is None:
            return []
        x, y = self._values(curve, table, "x"), self._values(curve, table, "y")
        each = table.find(curve.each) if curve.each else None
        if curve.each and each is None:
            names = ", ".join(column.name for column in table.columns)
            self.diagnostics.error(curve.where, f"the table '{table.name}' has no column '{curve.each}'", f"it has {names}")
            return []
        if x is None or y is None:
            return []
        look = {"label": curve.label, "style": curve.style}
        if each is None:
            return [{**look, "x": _numbers(x), "y": _numbers(y)}]
        out: list[dict[str, Any]] = []
        for key in np.unique(each.values):
            rows = each.values == key
            one = {"each": float(f"{key:.7g}"), "x": _numbers(x[rows]), "y": _numbers(y[rows])}
            out.append({**look, "label": "" if out else curve.label, **one})
        return out

    def _values(self, curve: Curve, table: Table, key: str) -> np.ndarray | None:
        """A column by its name, which may be no word ("depth@0.5"), or an expression over columns."""
        text = getattr(curve, key)
        column = table.find(text)
        if column is not None:
            return column.values
        columns = {one.name: one.values for one in table.columns if _is_word(one.name)}
        of = Formula(text, tuple(columns))
        if of.ok:
            return of.over(columns, table.rows)
        hint = f"the table has {', '.join(one.name for one in table.columns)}"
        if len(columns) < len(table.columns):
            alone = next(one.name for one in table.columns if not _is_word(one.name))
            hint += f"; a name like {alone} must be all of '{key}', not a term of an expression"
        self.diagnostics.error(curve.where, f"'{key}' of a curve from '{table.name}': {of.error}", hint)
        return None

    def _map(self, one: Map) -> dict[str, Any] | None:
        image = self._named(self.images, one.image, "grid", one.where)
        if image is None:
            return None
        nx, ny, _ = image.n
        places = zip(("x0", "y0", "dx", "dy"), (*image.origin[:2], *image.spacing[:2]), strict=True)
        out: dict[str, Any] = {"nx": nx, "ny": ny, **{key: float(f"{value:.9g}") for key, value in places}}
        out |= {"label": one.label, "range": _range(one.range), "colours": one.colours}
        wanted = [("field", one.field), *zip("uv", one.streamlines, strict=False)]
        for key, name in wanted:
            column = self._named(image.fields, name, "field", one.where)
            if column is None:
                return None
            out[key] = _numbers(column.values[: nx * ny])  # the lowest layer of a grid in space
        return out


def figures_json(
    figures: Sequence[Figure],
    tables: Sequence[Table],
    images: Sequence[Image],
    walls: np.ndarray,
    formats: Sequence[str],
    title: str,
    diagnostics: Diagnostics,
) -> str:
    """All figures with their numbers as JSON; those of charts of one's own have none."""
    make = FiguresData(tables, images, diagnostics)
    traces = [[float(f"{value:.6g}") for value in wall] for wall in walls.tolist()]
    drawn = [make.of(figure) for figure in figures if not figure.chart]
    return json.dumps({"title": title, "formats": list(formats), "walls": traces, "figures": drawn}, ensure_ascii=False) + "\n"
