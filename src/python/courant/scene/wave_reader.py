"""Waves of a driven wall: the keys of `motion: {waves: ...}`."""
from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..diagnostics import Location
from ..waves import KINDS, WaveFault, Waves
from ..words import did_you_mean, shortest
from ..yaml_map import Node, is_list

if TYPE_CHECKING:
    from .basin_reader import BasinReader

# Keys that each kind uses, beside `kind`, `depth` and `towards`. Any other is refused, as it would be ignored.
_IRREGULAR = ("height", "period", "seed", "components", "ramp")
_USED = {
    "regular": ("height", "period", "ramp"),
    "second_order": ("height", "period", "ramp"),
    "focused": ("height", "period", "focus", "gamma", "components", "ramp"),
    "jonswap": (*_IRREGULAR, "gamma"),
    "pierson_moskowitz": _IRREGULAR,
    "solitary": ("height",),
    "elevation": ("record", "ramp"),
    "displacement": ("record",),
}
_KEYS = ("kind", "depth", "height", "period", "seed", "gamma", "focus", "components", "ramp", "record", "towards")
_SIDES = {"x": ("x", 1.0), "-x": ("x", -1.0), "y": ("y", 1.0), "-y": ("y", -1.0)}


@dataclass
class Piston:
    """A wall that makes waves. `series`: time and displacement along `axis` (n, 2); `sign`: 1 where the water is towards greater values of it;
    `depth`: 0 where none is given."""

    axis: str
    sign: float
    series: np.ndarray
    depth: float
    where: Location  # of the depth, or of the waves
    where_towards: Location


def read_waves(reader: BasinReader, node: Node, gravity: float, end: float) -> Piston | None:
    """The motion of a wall; None, with a message, where there is none."""
    if not reader.is_map(node, "waves: {kind: regular, depth: 0.5, height: 0.1, period: 1.4}", "waves"):
        return None
    reader.check_keys(node, "waves", _KEYS)
    before = reader.diagnostics.errors
    kind_node = reader.get(node, "kind")
    kind = reader.text(kind_node) if kind_node is not None else "regular"
    if kind not in (*KINDS, "displacement"):
        reader.error(kind_node or node, f"no kind of waves '{kind}'", f"{did_you_mean(kind, KINDS)}{', '.join(KINDS)}, displacement")
        return None
    for key in _KEYS:
        if (entry := reader.get(node, key)) is not None and key not in ("kind", "depth", "towards", *_USED[kind]):
            reader.error(entry, f"waves: '{key}' has no effect on kind {kind}", f"its keys: {', '.join(('depth', *_USED[kind], 'towards'))}")
    towards_node = reader.get(node, "towards")
    towards = reader.text(towards_node) if towards_node is not None else "x"
    sides = [side for side in _SIDES if reader.dim != 2 or side.endswith("x")]  # y is upwards in the plane
    if towards not in sides:
        reader.error(towards_node or node, f"towards: '{towards}' is no direction", ", ".join(sides))
        return None
    numbers = {key: value for key in ("depth", "height", "period", "gamma", "ramp") if (value := _number(reader, node, key)) is not None}
    whole = {key: value for key in ("seed", "components") if (value := _whole(reader, node, key)) is not None}
    record = _record(reader, node) if kind in ("elevation", "displacement") else None
    focus_node = reader.get(node, "focus")
    focus = None
    if focus_node is not None:
        if not is_list(focus_node) or len(focus_node.value) != 2:
            reader.error(focus_node, "focus: expected [distance from the wall, time]", "focus: [4, 12]")
        else:
            focus = (reader.number(focus_node.value[0], "focus") or 0.0, reader.number(focus_node.value[1], "focus") or 0.0)
    if reader.diagnostics.errors > before:
        return None
    axis, sign = _SIDES[towards]
    depth = numbers.get("depth", 0.0)
    where, where_towards = reader.at(reader.get(node, "depth") or node), reader.at(towards_node or node)
    if kind == "displacement":
        if record is None:
            return None
        return Piston(axis, sign, np.column_stack([record[:, 0], sign * record[:, 1]]), depth, where, where_towards)
    try:
        waves = Waves(kind, g=gravity, focus=focus, record=record if record is not None else np.empty((0, 2)), **({"depth": 0.0} | numbers), **whole)  # type: ignore[arg-type]
        made = waves.displacement(end)
    except WaveFault as fault:
        reader.error(reader.get(node, fault.key) or node, f"waves: {fault}", fault.hint)
        return None
    return Piston(axis, sign, np.column_stack([made[:, 0], sign * made[:, 1]]), depth, where, where_towards)


def check_reach(reader: BasinReader, node: Node, axis: str, series: np.ndarray, points: np.ndarray, low: float, high: float) -> None:
    """A wall that leaves the box lets its water out beside it."""
    a = "xyz".index(axis)
    least, most = float(points[:, a].min() + series[:, 1].min()), float(points[:, a].max() + series[:, 1].max())
    if least < low - 1e-9 or most > high + 1e-9:
        reader.error(node, f"waves: the wall goes from {axis} = {shortest(round(least, 6))} to {shortest(round(most, 6))}, and leaves the box, which is from {shortest(low)} to "
                     f"{shortest(high)}", "make the box wider on that side, or the waves lower or shorter")


def _number(reader: BasinReader, node: Node, key: str) -> float | None:
    entry = reader.get(node, key)
    return None if entry is None else reader.number(entry, key)


def _whole(reader: BasinReader, node: Node, key: str) -> int | None:
    entry = reader.get(node, key)
    value = _number(reader, node, key)
    if entry is None or value is None:
        return None
    if value != math.floor(value):
        reader.error(entry, f"{key}: expected a whole number, got {shortest(value)}")
        return None
    return int(value)


def _record(reader: BasinReader, node: Node) -> np.ndarray | None:
    entry = reader.get(node, "record")
    if entry is None:
        reader.error(node, "'record' is missing: a file of time and value, two numbers a line")
        return None
    name = reader.text(entry)
    try:
        rows = np.loadtxt(Path(reader.path).parent / name, delimiter="," if name.endswith(".csv") else None, comments="#", ndmin=2)
    except (OSError, ValueError) as fault:
        reader.error(entry, f"record: '{name}' cannot be read: {' '.join(str(fault).split())}", "two numbers a line: time and value")
        return None
    if rows.shape[1] != 2 or len(rows) < 2 or not np.isfinite(rows).all() or not (np.diff(rows[:, 0]) > 0).all():
        reader.error(entry, f"record: '{name}' must have two columns, two rows or more, and times that go upwards")
        return None
    return rows
