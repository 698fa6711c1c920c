"""Waves of a driven wall: the keys of `motion: {waves: ...}`."""
from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..waves import KINDS, WaveFault, Waves
from ..words import did_you_mean, shortest
from ..yaml_map import Node, is_list

if TYPE_CHECKING:
    from .basin_reader import BasinReader

_KEYS = ("kind", "depth", "height", "period", "seed", "gamma", "focus", "components", "ramp", "record", "towards")
_SIDES = {"x": ("x", 1.0), "-x": ("x", -1.0), "y": ("y", 1.0), "-y": ("y", -1.0)}


def read_waves(reader: BasinReader, node: Node, gravity: float, end: float) -> tuple[str, np.ndarray] | None:
    """The axis along which a wall moves, and time and displacement (n, 2); None, with a message, where there are none."""
    if not reader.is_map(node, "waves: {kind: regular, depth: 0.5, height: 0.1, period: 1.4}", "waves"):
        return None
    reader.check_keys(node, "waves", _KEYS)
    before = reader.diagnostics.errors
    kind_node = reader.get(node, "kind")
    kind = reader.text(kind_node) if kind_node is not None else "regular"
    if kind not in (*KINDS, "displacement"):
        reader.error(kind_node or node, f"no kind of waves '{kind}'", f"{did_you_mean(kind, KINDS)}{', '.join(KINDS)}, displacement")
        return None
    towards_node = reader.get(node, "towards")
    towards = reader.text(towards_node) if towards_node is not None else "x"
    if towards not in _SIDES:
        reader.error(towards_node or node, f"towards: '{towards}' is no direction", ", ".join(_SIDES))
        return None
    numbers = {key: value for key in ("depth", "height", "period", "gamma", "ramp") if (value := _number(reader, node, key)) is not None}
    whole = {key: int(value) for key in ("seed", "components") if (value := _number(reader, node, key)) is not None}
    record = _record(reader, node) if kind in ("elevation", "displacement") else None
    focus_node = reader.get(node, "focus")
    focus = (0.0, 0.0)
    if focus_node is not None:
        if not is_list(focus_node) or len(focus_node.value) != 2:
            reader.error(focus_node, "focus: expected [distance from the wall, time]")
        else:
            focus = (reader.number(focus_node.value[0], "focus") or 0.0, reader.number(focus_node.value[1], "focus") or 0.0)
    if reader.diagnostics.errors > before:
        return None
    axis, sign = _SIDES[towards]
    if kind == "displacement":
        return (axis, np.column_stack([record[:, 0], sign * record[:, 1]])) if record is not None else None
    try:
        waves = Waves(kind, g=gravity, focus=focus, record=record if record is not None else np.empty((0, 2)), **({"depth": 0.0} | numbers), **whole)  # type: ignore[arg-type]
        made = waves.displacement(end)
    except WaveFault as fault:
        reader.error(node, f"waves: {fault}")
        return None
    return axis, np.column_stack([made[:, 0], sign * made[:, 1]])


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
    if rows.shape[1] != 2 or not np.isfinite(rows).all() or not (np.diff(rows[:, 0]) > 0).all():
        reader.error(entry, f"record: '{name}' must have two columns, and times that go upwards")
        return None
    return rows
